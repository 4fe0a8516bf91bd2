# SPDX-License-Identifier: BSD-3-Clause
"""Tables of many files equal those of each file, faults are rows, and stopped calls continue: PROGRAM FREESASA."""

import csv
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, FREESASA = sys.argv[1:3]
UBIQUITIN, CRAMBIN_SIZED = f"{FREESASA}/1ubq.pdb", f"{FREESASA}/2jo4.pdb"


class SummaryTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, "surface", *words], cwd=self.folder, capture_output=True, text=True, check=False, timeout=240)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def rows(self, name):
        with open(self.folder / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def molecules(self, count):
        """Makes molecules with different numbers of balls."""
        random.seed(7)
        names = []
        for n in range(count):
            names.append(f"m{n:03}.xyzr")
            places = [[random.uniform(0, 12) for _ in range(3)] for _ in range(150)]
            (self.folder / names[-1]).write_text("".join("%.3f %.3f %.3f 1.7\n" % tuple(place) for place in places))
        return names

    def test_rows_are_those_of_each_file_alone(self):
        self.run_program(UBIQUITIN, CRAMBIN_SIZED, "--csv-summary", "all.csv", "--csv", "atoms.csv", "--csv-residues", "residues.csv", "-q")
        atoms, residues = ["file," + (self.folder / "atoms.csv").read_text().splitlines()[0].removeprefix("file,")], []
        for row, file in zip(self.rows("all.csv"), (UBIQUITIN, CRAMBIN_SIZED)):
            told = json.loads(self.run_program(file, "--json", "-q", "--csv", "a.csv", "--csv-residues", "r.csv", "--force").stdout)
            self.assertEqual((row["file"], row["closed"], row["error"]), (file, "yes", ""))
            self.assertEqual(int(row["atoms"]), len(self.rows("a.csv")))
            self.assertEqual(float(row["volume"]), round(told["volume"], 6))
            self.assertEqual(float(row["ses_area"]), round(told["area"], 6))
            atoms += [f"{file},{line}" for line in (self.folder / "a.csv").read_text().splitlines()[1:]]
            residues += [f"{file},{line}" for line in (self.folder / "r.csv").read_text().splitlines()[1:]]
        self.assertEqual((self.folder / "atoms.csv").read_text().splitlines(), atoms)
        self.assertEqual((self.folder / "residues.csv").read_text().splitlines()[1:], residues)

    def test_files_that_fail_are_rows_and_the_others_are_made(self):
        (self.folder / "not, one.pdb").write_text("ATOM      1  C   ALA A   1         nan   0.000   0.000\n")
        done = self.run_program("not, one.pdb", UBIQUITIN, "nowhere.cif", "--csv-summary", "all.csv", code=3)
        self.assertIn("2 of 3 files failed; the first: not, one.pdb:1", done.stderr)
        bad, good, missing = self.rows("all.csv")
        self.assertEqual((bad["file"], bad["volume"], bad["closed"]), ("not, one.pdb", "", ""))
        self.assertTrue(bad["error"].startswith("not, one.pdb:1"), bad["error"])
        self.assertEqual((good["closed"], missing["volume"]), ("yes", ""))
        self.assertIn("nowhere.cif", missing["error"])
        self.assertTrue(all(None not in row and None not in row.values() for row in (bad, good, missing)))  # as wide as the header

    def test_the_table_does_not_depend_on_how_many_are_made_at_once(self):
        names = self.molecules(30)
        for jobs in ("1", "4"):
            self.run_program(*names, "--csv-summary", f"{jobs}.csv", "--csv", f"a{jobs}.csv", "--jobs", jobs, "-q")
        self.assertEqual((self.folder / "1.csv").read_bytes(), (self.folder / "4.csv").read_bytes())
        self.assertEqual((self.folder / "a1.csv").read_bytes(), (self.folder / "a4.csv").read_bytes())
        self.assertEqual([row["file"] for row in self.rows("1.csv")], names)

    def test_a_killed_call_is_gone_on_with(self):
        names = self.molecules(200)
        words = [*names, "--csv-summary", "all.csv", "--csv", "atoms.csv", "-q", "--jobs", "2"]
        self.run_program(*names, "--csv-summary", "whole.csv", "--csv", "whole_atoms.csv", "-q")
        for at_least in (10, 60):
            process = subprocess.Popen([PROGRAM, "surface", *words, *(["--resume"] if at_least > 10 else [])], cwd=self.folder)
            part = self.folder / "all.csv.part"
            while process.poll() is None and (not part.exists() or part.read_bytes().count(b"\n") < at_least):
                time.sleep(0.001)
            process.send_signal(signal.SIGKILL)
            self.assertEqual(process.wait(), -signal.SIGKILL)
            self.assertFalse((self.folder / "all.csv").exists())
        # This is the table after a kill in the middle of a row.
        with open(part, "a", encoding="ascii") as file:
            file.write("m199.xyzr,15")
        with open(self.folder / "atoms.csv.part", "a", encoding="ascii") as file:
            file.write("m199.xyzr,0,1,,,")
        self.assertIn("--resume", self.run_program(*words, code=2).stderr)
        for more in (["--probe", "1.5"], ["--csv-residues", "late.csv"]):
            self.assertIn("other options", self.run_program(*words, "--resume", *more, code=2).stderr)
        # This file has changed since.
        first = next(row["file"] for row in csv.DictReader((self.folder / "all.csv.part").read_text().splitlines()[1:]) if row["closed"] == "yes")
        old = (self.folder / first).read_text()
        (self.folder / first).write_text("0 0 0 1.7\n")
        os.utime(self.folder / first, (time.time() + 60, time.time() + 60))
        (self.folder / "changed").mkdir()
        for part in ("all.csv.part", "atoms.csv.part"):
            (self.folder / "changed" / part).write_bytes((self.folder / part).read_bytes())
        self.run_program(*words, "--resume")
        self.assertEqual([row["atoms"] for row in self.rows("all.csv") if row["file"] == first], ["1"])
        self.assertEqual(len([row for row in self.rows("atoms.csv") if row["file"] == first]), 1)
        (self.folder / first).write_text(old)
        os.utime(self.folder / first, (0, 0))
        for part in ("all.csv.part", "atoms.csv.part"):
            (self.folder / "changed" / part).rename(self.folder / part)
            (self.folder / part.removesuffix(".part")).unlink()
        self.assertIn(" of 200 files are there", self.run_program(*words[:-3], "--resume").stderr)
        for made, whole in (("all.csv", "whole.csv"), ("atoms.csv", "whole_atoms.csv")):
            self.assertEqual(sorted((self.folder / made).read_text().splitlines()), sorted((self.folder / whole).read_text().splitlines()))
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if name.endswith(".part")), [])
        self.assertIn("all.csv", self.run_program(*words, code=6).stderr)  # the file exists
        self.run_program(*words[:3], *words[200:], "--force")
        self.assertEqual([row["file"] for row in self.rows("all.csv")], names[:3])

    def test_what_is_for_one_molecule_is_refused(self):
        for words in (["--json"], ["--frames", "all"], ["--frames", "all", "--csv-series", "s.csv"], ["--gradients", "g.csv"], ["--context", "resid 1"]):
            self.assertIn("--csv-summary is for many molecules", self.run_program(UBIQUITIN, "--csv-summary", "a.csv", *words, code=2).stderr)
        self.run_program(UBIQUITIN, "--csv-summary", "-", code=2)
        self.run_program("-", "--csv-summary", "a.csv", code=2)
        self.assertIn("--resume", self.run_program(UBIQUITIN, "--resume", code=2).stderr)
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
