# SPDX-License-Identifier: BSD-3-Clause
"""An interrupted run goes on: it keeps pictures of the same scene and files, and no others."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)


def models(count):
    lines = []
    for model in range(count):
        lines.append("MODEL     %4d" % (model + 1))
        for n in range(6):
            lines.append("ATOM  %5d  CA  ALA A%4d    %8.3f%8.3f%8.3f  1.00 10.00           C" % (n + 1, n + 1, 2.9 * n, 0.3 * model * n, 0.0))
        lines.append("ENDMDL")
    return "\n".join(lines) + "\n"


class ResumedRuns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "run.pdb").write_text(models(5))

    def render(self, *words, code=0, name="f_##.png", run=("--frames", "all")):
        done = subprocess.run([PROGRAM, "render", "run.pdb", *run, "-o", name, "--size", "48x36", "--samples", "1", "--device", "cpu", *words],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def pictures(self):
        return {path.name: path.read_bytes() for path in sorted(self.folder.glob("f_*.png"))}

    def times(self):
        return {path.name: path.stat().st_mtime_ns for path in self.folder.glob("f_*.png")}

    def test_what_is_there_stays_and_the_rest_is_made(self):
        self.render("--resume")
        whole, before = self.pictures(), self.times()
        self.assertEqual(len(whole), 5)
        for name in ("f_01.png", "f_04.png"):
            (self.folder / name).unlink()
        self.assertIn("3 of 5 pictures are there", self.render("--resume"))
        self.assertEqual(self.pictures(), whole)
        self.assertEqual({name for name, time in self.times().items() if time == before[name]}, {"f_00.png", "f_02.png", "f_03.png"})
        self.assertIn("5 of 5 pictures are there", self.render("--resume"))

    def test_one_picture(self):
        one = {"name": "f_one.png", "run": ()}
        self.render("--resume", **one)
        whole, before = self.pictures(), self.times()
        self.assertIn("1 of 1 pictures are there", self.render("--resume", **one))
        self.assertEqual(self.times(), before)
        self.assertIn("f_one.png was made of another scene", self.render("--resume", "--probe", "2", code=2, **one))
        self.assertEqual(self.pictures(), whole)
        self.assertIn("0 of 1 pictures are there", self.render("--resume", "--probe", "2", "--force", **one))
        self.assertNotEqual(self.pictures(), whole)
        (self.folder / "f_one.png").unlink()
        self.render("--resume", **one)
        self.assertEqual(self.pictures(), whole)

    def test_other_pictures_are_not_taken_for_them(self):
        self.render("--resume")
        whole = self.pictures()
        self.assertIn("f_00.png and 4 more were made of another scene", self.render("--resume", "--probe", "2", code=2))
        os.utime(self.folder / "run.pdb", (1e9, 1e9))
        self.assertIn("other files", self.render("--resume", code=2))
        self.assertEqual(self.pictures(), whole)
        self.render("--resume", "--force")
        self.assertIn("5 of 5 pictures are there", self.render("--resume"))

    def test_a_picture_that_is_cut_short_is_made_again(self):
        self.render("--resume")
        whole = self.pictures()
        (self.folder / "f_03.png").write_bytes(whole["f_03.png"][:-1])
        self.assertIn("f_03.png was made of another scene, of other files, by another version, without --resume, or cut short",
                      self.render("--resume", code=2))
        self.assertIn("4 of 5 pictures are there", self.render("--resume", "--force"))
        self.assertEqual(self.pictures(), whole)

    def test_pictures_without_the_note_are_not_taken_and_usual_ones_have_none(self):
        self.render()
        self.assertNotIn(b"Meniscus run", b"".join(self.pictures().values()))
        self.assertIn("without --resume", self.render("--resume", code=2))
        (self.folder / "f_02.png").unlink()
        self.assertIn("f_00.png and 3 more", self.render("--resume", code=2))

    def test_where_it_cannot_be_it_says_so(self):
        self.assertIn("only .png", self.render("--resume", code=2, name="f_##.jpg"))
        self.assertIn("frame_#####.png", self.render("--resume", code=2, name="f.mp4"))


if __name__ == "__main__":
    unittest.main()
