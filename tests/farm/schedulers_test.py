# SPDX-License-Identifier: BSD-3-Clause
"""Schedulers without a template: by the commands of docs/reference/schedulers.md each frame is made by one task."""

import os
import re
import subprocess

import page_of_schedulers as page
from farm_case import FarmCase, MENISCUS, main, sample_run, sums

FRAMES = 23  # more frames than tasks, and no multiple of them


class Schedulers(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "bin").mkdir()
        (cls.folder / "bin" / "meniscus").symlink_to(MENISCUS)
        cls.environment = dict(os.environ, PATH=f"{cls.folder / 'bin'}:{os.environ['PATH']}", HOME=str(cls.folder))
        cls.molecule = sample_run(cls.folder / "run.pdb", FRAMES, atoms=20)
        cls.reference = cls("test_every_queue_of_the_page_is_tried").film("reference")
        subprocess.run([MENISCUS, "work", cls.reference, "--progress", "none"], check=True)

    def film(self, name):
        return self.bundle(name, "render", self.molecule, "--frames", "all", "--size", "40x30", "--device", "cpu",
                           options=("--chunk-frames", "5", "--film", "film.mp4"))

    def run_here(self, command, **more):
        done = subprocess.run(command, env={**self.environment, **more.pop("variables", {})}, capture_output=True, text=True,
                              check=False, timeout=280, **more)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done

    def assert_each_frame_is_made_once(self, folder):
        self.assertEqual(sums(folder / "images", "*.png"), sums(self.reference / "images", "*.png"))
        self.meniscus("farm", "verify", folder)

    def test_every_queue_of_the_page_is_tried(self):
        headings = re.findall(r"^## (.*)$", page.PAGE.read_text(), re.M)
        self.assertEqual(headings, ["HTCondor", "AWS Batch", "Nextflow", "Deadline 10", "Grid Engine, PBS, LSF"])

    def test_tasks_by_their_numbers(self):
        """Ten tasks run in reverse order, and each makes its own share and nothing else."""
        for queue, tasks in page.TASKS_OF.items():
            with self.subTest(queue):
                folder = self.film(queue.replace(" ", ""))
                count = 0
                for command, variables in reversed(tasks()):
                    self.run_here(["sh", "-c", command.replace(page.BUNDLE, str(folder))], variables=variables)
                    made = len(sums(folder / "images", "*.png"))
                    self.assertIn(made - count, (2, 3))
                    count = made
                self.assert_each_frame_is_made_once(folder)

    def test_nextflow(self):
        """Only Nextflow's commands run here: Nextflow itself runs in scripts/check/schedulers.sh."""
        folder = self.film("nextflow")
        (text,) = page.files("Nextflow")
        commands = re.findall(r'"""\n\s*(.*?)\n\s*"""', text)
        self.assertEqual(len(commands), 2)
        for k in range(1, page.TASKS + 1):
            values = {"params.bundle": str(folder), "k": str(k), "params.tasks": str(page.TASKS), "task.cpus": "2"}
            self.run_here(["sh", "-c", re.sub(r"\$\{(.*?)\}", lambda found: values[found.group(1)], commands[0])])
        self.run_here(["sh", "-c", commands[1].replace("${params.bundle}", str(folder))])
        self.assert_each_frame_is_made_once(folder)


if __name__ == "__main__":
    main()
