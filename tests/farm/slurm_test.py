# SPDX-License-Identifier: BSD-3-Clause
"""Tests bundles on a real Slurm: arrays, a task killed, one preempted, requeued and resumed, and a frame that fails."""

import os
import pathlib
import re
import signal
import subprocess
import tempfile
import shutil
import unittest

from farm_case import FarmCase, MENISCUS, main, processes_in, sums, wait_until
from slurm_cluster import SlurmCluster, why_not

FRAMES = 20


@unittest.skipIf(why_not(), why_not())
class Slurm(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        home = tempfile.mkdtemp(prefix="meniscus-slurm-")
        cls.addClassCleanup(shutil.rmtree, home, ignore_errors=True)
        cls.cluster = cls.enterClassContext(SlurmCluster(home))

    def submit(self, folder, *options, **environment):
        """Submits a bundle and returns the numbers of the jobs by step."""
        result = self.cluster.run(folder / "submit.sh", *options, MENISCUS=MENISCUS, **environment)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return dict(line.split() for line in result.stdout.splitlines())

    def worker_of(self, folder, chunk):
        """Returns the process that works on this share."""
        for number in processes_in(folder):
            try:
                words = pathlib.Path(f"/proc/{number}/cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[:2] == [MENISCUS.encode(), b"work"] and f"{chunk}/4".encode() in words:
                return number
        return None

    def state(self, job):
        return self.cluster.job(job).get("JobState", "")

    def logs(self, folder):
        return "\n".join(f"{path.name}:\n{path.read_text()}" for path in sorted((folder / "logs").glob("*.log")))

    def path_of_slow_requeues(self):
        """Returns a search path whose scontrol ends two seconds late, so that a requeued task is stopped before it ends."""
        real = shutil.which("scontrol", path=self.cluster.environment["PATH"])
        return self.programs("slow", scontrol=f'#!/bin/sh\ntrap "" TERM\n"{real}" "$@"\ncode=$?\n'
                                              '[ "$1" != requeue ] || sleep 2\nexit $code\n')["PATH"] + ":/usr/sbin"

    def test_an_array_survives_a_kill_and_a_preemption(self):
        options = ("--chunk-frames", "5", "--film", "film.mp4", "--engine", "slurm", "--task-cores", "1")
        local = self.povray_bundle("local", FRAMES, options=options)
        folder = self.povray_bundle("it's a $queue", FRAMES, options=options)
        jobs = self.submit(folder, "--time=5", PATH=self.path_of_slow_requeues())
        work = jobs["work"]

        # Task 1 is killed like one on a machine out of memory; its script puts it back into the queue.
        victim = wait_until(lambda: self.made(folder) and self.worker_of(folder, 1), 60,
                            "task 1 at work")
        os.kill(victim, signal.SIGKILL)
        # Task 3 gets the signal that comes a minute before its time is over.
        wait_until(lambda: any(10 <= frame < 15 for frame in self.made(folder)) and
                   self.worker_of(folder, 3), 60, "task 3 at work")
        self.cluster.run("scancel", "--batch", "--signal=USR1", f"{work}_3")
        for task, code in ((1, 137), (3, 9)):
            log = folder / "logs" / f"work-{task}.log"
            wait_until(lambda: f"stopped (code {code})" in log.read_text(), 20, f"task {task} to be put back")
            wait_until(lambda: self.cluster.tasks(work)[task]["JobState"] == "PENDING", 20, f"task {task} to wait")
            # A requeued task would wait two minutes, which the test skips.
            wait_until(lambda: self.cluster.run("scontrol", "update", f"JobId={work}_{task}",
                                                "StartTime=now").returncode == 0, 20, "an earlier start")
        self.assertLess(len(self.made(folder)), FRAMES)

        wait_until(lambda: self.state(jobs["verify"]) in ("COMPLETED", "FAILED", "CANCELLED"), 90, "the last job")
        self.assertEqual(self.state(jobs["verify"]), "COMPLETED", self.logs(folder))
        tasks = self.cluster.tasks(work)
        self.assertEqual({task: (tasks[task]["JobState"], int(tasks[task]["Restarts"])) for task in tasks},
                         {1: ("COMPLETED", 1), 2: ("COMPLETED", 0), 3: ("COMPLETED", 1), 4: ("COMPLETED", 0)})

        subprocess.run([MENISCUS, "work", local, "--progress", "none"], check=True)
        self.meniscus("farm", "verify", local)
        for place, pattern, count in (("images", "*.png", FRAMES), ("scene", "*", None), (".", "film.mp4", 1)):
            expected = sums(local / place, pattern)
            self.assertEqual(sums(folder / place, pattern), expected)
            self.assertTrue(count is None or len(expected) == count)
        self.assert_nothing_unfinished(folder)

    def test_a_failing_frame_fails_its_task_with_its_own_code(self):
        folder = self.povray_bundle("failing", 8, bad_frame=5, options=("--chunk-frames", "2", "--engine", "slurm",
                                                                       "--film", "film.mp4", "--task-cores", "1",
                                                                       "--task-memory", "600"))
        jobs = self.submit(folder, MENISCUS_VERIFY_OPTIONS="--allow-missing hold")
        wait_until(lambda: self.state(jobs["verify"]) == "COMPLETED", 90, "the end")
        work = self.cluster.tasks(jobs["work"])
        self.assertEqual({task: (work[task]["JobState"], work[task]["ExitCode"]) for task in work},
                         {1: ("COMPLETED", "0:0"), 2: ("COMPLETED", "0:0"), 3: ("FAILED", "3:0"),
                          4: ("COMPLETED", "0:0")})
        self.assertIn("frame 5", (folder / "logs" / "work-3.log").read_text())
        # All other frames are there, also those of the same task, and so is the film.
        self.assertEqual(self.made(folder), [0, 1, 2, 3, 4, 6, 7])
        self.assertIn("7 frames are good, 1 missing: 5", (folder / "logs" / "verify.log").read_text())
        self.assertGreater((folder / "film.mp4").stat().st_size, 1000)

    def test_gpus_are_asked_for_where_the_command_needs_them(self):
        molecule = self.folder / "8_None.pdb"
        if not molecule.exists():
            self.povray_bundle("unused", 8)
        folder = self.bundle("gpu", "render", molecule, "--frames", "all", "--require-gpu",
                             options=("--chunk-frames", "8", "--engine", "slurm"))
        self.assertRegex((folder / "slurm" / "work.sbatch").read_text(), re.compile("^#SBATCH --gres=gpu:1$", re.M))
        checked = self.cluster.run("sbatch", "--test-only", folder / "slurm" / "work.sbatch")
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_arrays_beyond_the_limit_are_refused_with_a_reason(self):
        folder = self.povray_bundle("many", 8, options=("--chunk-frames", "2", "--engine", "slurm"))
        path = self.programs("shim", scontrol="#!/bin/sh\necho 'MaxArraySize            = 4'\n")["PATH"]
        result = self.cluster.run(folder / "submit.sh", MENISCUS=MENISCUS, PATH=path)
        self.assertEqual(result.returncode, 2)
        self.assertIn("larger chunks", result.stderr)


if __name__ == "__main__":
    main()
