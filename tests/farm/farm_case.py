# SPDX-License-Identifier: BSD-3-Clause
"""Shares among the tests of the farm a made-up run of a real protein, bundles of it, and the program as users run it."""

import hashlib
import math
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

MENISCUS = os.path.abspath(sys.argv[1])
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"


def sample_run(path, frames, bad_frame=None, atoms=300):
    """Writes a PDB file of models: the first atoms of ubiquitin, breathing. A bad frame has a malformed coordinate."""
    lines = pathlib.Path(UBIQUITIN).read_text().splitlines(keepends=True)
    records = [line for line in lines if line.startswith("ATOM")][:atoms]
    with open(path, "w") as out:
        for frame in range(frames):
            out.write(f"MODEL {frame + 1:8d}\n")
            for n, line in enumerate(records):
                swell = 1.0 + 0.02 * math.sin(0.7 * frame)
                position = [swell * float(line[30 + 8 * k:38 + 8 * k]) for k in range(3)]
                text = "".join(f"{value:8.3f}" for value in position)
                if frame == bad_frame and n == 100:
                    text = "     nan" + text[8:]
                out.write(line[:30] + text + line[54:])
            out.write("ENDMDL\n")
    return str(path)


def sums(folder, pattern):
    """Returns SHA-256 of matching files by name; hidden files, which only killed workers leave, are left out."""
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.glob(pattern)) if not path.name.startswith(".")}


def processes_in(folder):
    """Returns the numbers of processes that work in this folder."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            if str(os.readlink(entry / "cwd")).startswith(str(folder)):
                found.append(int(entry.name))
        except OSError:
            pass
    return found


def wait_until(condition, seconds=120.0, what="condition"):
    """Returns the first true value of the condition; fails when it takes too long."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError(f"waited {seconds} s in vain for {what}")


class FarmCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="meniscus-farm-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)

    def meniscus(self, *arguments, code=0, **more):
        """Runs the program and checks its exit code, unless that is None; returns the result."""
        result = subprocess.run([MENISCUS, *map(str, arguments)], capture_output=True, text=True, timeout=300, **more)
        self.assertIn(result.returncode, [code] if code is not None else range(10), f"{arguments}\n{result.stdout}\n{result.stderr}")
        return result

    def bundle(self, name, *command, options=("--chunk-frames", "5")):
        folder = self.folder / name
        self.meniscus("farm", "bundle", folder, *options, "--", *command)
        return folder

    def povray_bundle(self, name, frames=8, bad_frame=None, options=("--chunk-frames", "5")):
        molecule = self.folder / f"{frames}_{bad_frame}.pdb"
        if not molecule.exists():
            sample_run(molecule, frames, bad_frame)
        return self.bundle(name, "export", "povray", molecule, "--frames", "all", "--size", "160x120", "--device",
                           "cpu", "--", "-A", options=options)

    def programs(self, name, **scripts):
        """Returns an environment in which these programs are found first."""
        folder = self.folder / name
        folder.mkdir()
        for program, text in scripts.items():
            (folder / program).write_text(text)
            (folder / program).chmod(0o755)
        return dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}")

    def start(self, folder, *more, **how):
        return subprocess.Popen([MENISCUS, "work", folder, "--progress", "none", *more], **how)

    def made(self, bundle, pattern="images/frame_*.png"):
        """Returns the numbers of the frames of these files, in order."""
        return sorted(int(path.stem.split("_")[1]) for path in bundle.glob(pattern))

    def kill_worker_in(self, bundle):
        """Kills the parent of a renderer."""
        renderer = wait_until(lambda: processes_in(bundle / "scene"), what="a renderer")[0]
        os.kill(int(pathlib.Path(f"/proc/{renderer}/stat").read_text().rsplit(")", 1)[1].split()[1]), signal.SIGKILL)

    def assert_nothing_unfinished(self, bundle):
        left = [path for path in bundle.rglob(".*") if path.name.startswith(".")]
        self.assertEqual(left, [])


class WorkCase(FarmCase):
    """A test with a bundle that was made in one go, as a reference."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.reference = cls().povray_bundle("reference", options=("--chunk-frames", "5", "--film", "film.mp4"))
        subprocess.run([MENISCUS, "work", cls.reference, "--progress", "none"], check=True)

    def assert_equals_reference(self, folder):
        for place, pattern in (("images", "*.png"), ("scene", "*.inc"), ("scene", "*.pov"), ("scene", "*.ini")):
            expected = sums(self.reference / place, pattern)
            self.assertGreater(len(expected), 0)
            self.assertEqual(sums(folder / place, pattern), expected)


SKIPPED = 77  # ctest shows this exit code as skipped.


def main():
    result = unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2, exit=False).result
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if len(result.skipped) == result.testsRun else 0)
