#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Commands that a signal ends at any moment leave no unfinished file, neither their own nor an encoder's."""

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = os.path.abspath(sys.argv.pop(1))
PLACES = [(0, 0, 0), (3, 1, 0), (1, 4, 1), (4, 4, 2), (2, 2, 4)]
ATOM = "ATOM  {0:5d}  CA  ALA A{0:4d}    {1:8.3f}{2:8.3f}{3:8.3f}  1.00  0.00           C\n"


def model(shift):
    return "".join(ATOM.format(n, x + shift, y, z) for n, (x, y, z) in enumerate(PLACES, 1))


@unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
class Signals(unittest.TestCase):
    TRIES = 10  # tries per command

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "run.pdb").write_text("".join(f"MODEL {n:8d}\n{model(0.1 * n)}ENDMDL\n" for n in range(1, 13)))
        self.random = random.Random(11)

    def start(self, words, output):
        return subprocess.Popen([PROGRAM, *[word.replace("OUT", output) for word in words]], cwd=self.folder,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def check(self, words, ending):
        """Sends signals at random moments of the time that the command takes."""
        begin = time.monotonic()
        self.assertEqual(self.start(words, "whole" + ending).wait(), 0, words)
        whole = time.monotonic() - begin
        before = {path.name for path in self.folder.iterdir()}
        for number in range(self.TRIES):
            output = self.folder / f"out{number}{ending}"
            process = self.start(words, output.name)
            time.sleep(self.random.uniform(0.1, 0.95) * whole)
            sent = self.random.choice([signal.SIGTERM, signal.SIGINT])
            process.send_signal(sent)
            code = process.wait(20)
            self.assertIn(code, (0, 128 + sent, -sent), words)  # the last one: before the program listens
            time.sleep(0.2)  # an encoder that still runs would write its file now
            if output.exists():
                self.check_whole(output, self.folder / f"whole{ending}")
                before.add(output.name)
            self.assertEqual({path.name for path in self.folder.iterdir()}, before, (words, code))

    def check_whole(self, made, whole):
        """The signal came after the last rename, or too late."""
        names = [sorted(str(path.relative_to(place)) for path in place.rglob("*")) for place in (made, whole)]
        self.assertEqual(*names)
        if whole.is_file():
            self.assertEqual(made.read_bytes(), whole.read_bytes())

    def test_films(self):
        for ending in (".mp4", ".webm"):
            self.check(["render", "run.pdb", "--frames", "all", "--device", "cpu", "--size", "160x120", "-q", "-o", "OUT"], ending)

    def test_bundles(self):
        self.check(["farm", "bundle", "OUT", "--", "render", "run.pdb", "--frames", "all", "--size", "64x48"], "")

    def test_folders(self):
        self.check(["export", "povray", "run.pdb", "--device", "cpu", "-q", "-o", "OUT"], "")

    def test_meshes_and_pictures(self):
        self.check(["export", "mesh", "run.pdb", "--device", "cpu", "-q", "--tolerance", "0.001", "-o", "OUT"], ".stl")
        self.check(["render", "run.pdb", "--device", "cpu", "-q", "--size", "640x480", "-o", "OUT"], ".exr")


if __name__ == "__main__":
    unittest.main()
