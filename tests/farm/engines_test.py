# SPDX-License-Identifier: BSD-3-Clause
"""Tests job files of the engines. make and Snakemake run themselves; tasks of OpenJD, Flamenco, OpenCue and Kubernetes are
run as those engines would. scripts/check/schedulers.sh has OpenJD's own runner and Kubernetes' schema."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

import yaml

from farm_case import FarmCase, MENISCUS, main, sums, wait_until

HERE = pathlib.Path(__file__).parent
FRAMES = 6
HOSTILE = "it's \"$HOME\" <&> `x` é"


class Engines(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # Farms find the program in PATH.
        (cls.folder / "bin").mkdir()
        (cls.folder / "bin" / "meniscus").symlink_to(MENISCUS)
        cls.environment = dict(os.environ, PATH=f"{cls.folder / 'bin'}:{os.environ['PATH']}", HOME=str(cls.folder))
        local = cls("test_make").povray_bundle("local", FRAMES)
        subprocess.run([MENISCUS, "work", local, "--progress", "none"], check=True)
        cls.expected = sums(local / "images", "*.png")

    def engine_bundle(self, name, engine, *more):
        return self.povray_bundle(name, FRAMES, options=("--chunk-frames", "2", "--engine", engine, "--film", "film.mp4", *more))

    def run_task(self, command, **more):
        result = subprocess.run(command, env={**self.environment, **more}, capture_output=True, text=True, cwd="/")
        self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}\n{result.stderr}")
        return result

    def assert_film_is_done(self, folder):
        self.assertEqual(sums(folder / "images", "*.png"), self.expected)
        self.assertGreater((folder / "film.mp4").stat().st_size, 1000)

    def kill_a_worker(self, folder, command):
        """Starts an engine, kills its worker with all children after the first picture, and returns its exit code."""
        engine = subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd="/")
        wait_until(lambda: self.made(folder), what="a picture")
        self.kill_worker_in(folder)
        return engine.wait(240)

    def test_make(self):
        folder = self.engine_bundle(f"make {HOSTILE}", "make")
        self.assertNotEqual(self.kill_a_worker(folder, ["make", "-C", folder, "-j1"]), 0)
        self.run_task(["make", "-C", folder, "-j2"])
        self.assert_film_is_done(folder)

    @unittest.skipUnless(shutil.which("snakemake"), "snakemake is not installed")
    def test_snakemake(self):
        """Snakemake itself starts the chunk of a killed worker again."""
        folder = self.engine_bundle("snakemake $x", "snakemake")
        flow = ["snakemake", "--cores", "2", "--nocolor", "-d", folder, "-s", folder / "Snakefile"]
        self.assertEqual(self.kill_a_worker(folder, flow), 0)
        self.assert_film_is_done(folder)

    def test_openjd(self):
        folder = self.engine_bundle(f"openjd {HOSTILE}", "openjd")
        template = json.loads((folder / "template.json").read_text())
        values = {f"Param.{entry['name']}": entry["default"] for entry in template["parameterDefinitions"]}
        values["Param.Bundle"] = str(folder / values["Param.Bundle"])  # Relative defaults start from the template.
        work, verify = template["steps"]
        self.assertEqual(verify["dependencies"], [{"dependsOn": work["name"]}])
        (chunk,) = work["parameterSpace"]["taskParameterDefinitions"]
        self.assertEqual(chunk["range"], "1-3")
        for step, task in [*((work, str(k)) for k in (3, 1, 2)), (verify, "")]:
            action = step["script"]["actions"]["onRun"]
            words = [re.sub(r"\{\{([A-Za-z.]+)\}\}", lambda found: {**values, "Task.Param.Chunk": task}[found.group(1)], word)
                     for word in (action["command"], *action["args"])]
            said = self.run_task(words)
            if step == work:
                self.assertIn("openjd_progress: 100.0\n", said.stdout)
        self.assert_film_is_done(folder)

    def test_kubernetes(self):
        folder = self.engine_bundle("kubernetes", "kubernetes")
        job = yaml.safe_load((folder / "kubernetes.yaml").read_text())["spec"]
        self.assertEqual((job["completions"], job["completionMode"]), (3, "Indexed"))
        (container,) = job["template"]["spec"]["containers"]
        shell, option, command = container["command"]
        for index in range(3):
            self.run_task([shell, option, command.replace("/bundle", str(folder))], JOB_COMPLETION_INDEX=str(index))
        self.meniscus("farm", "verify", folder)
        self.assert_film_is_done(folder)

    def test_every_engine_reserves_cores_and_memory(self):
        folder = self.engine_bundle("resources", "all", "--farm-path", "/mnt/film", "--task-cores", "3", "--task-memory", "1234")
        self.assertIn("#SBATCH --cpus-per-task=3\n#SBATCH --mem=1234M\n", (folder / "slurm" / "work.sbatch").read_text())
        work = json.loads((folder / "template.json").read_text())["steps"][0]
        self.assertEqual({amount["name"]: amount["min"] for amount in work["hostRequirements"]["amounts"]},
                         {"amount.worker.vcpu": 3, "amount.worker.memory": 1234})
        self.assertIn("--threads 3", " ".join(work["script"]["actions"]["onRun"]["args"]))
        layer = next(ElementTree.parse(folder / "opencue.xml").getroot().iter("layer"))
        self.assertEqual([layer.findtext(name) for name in ("cores", "threadable", "memory")], ["3", "True", "1234m"])
        self.assertEqual(json.loads((folder / "flamenco_job.json").read_text())["metadata"], {"cores": "3", "memory_mib": "1234"})
        pod = yaml.safe_load((folder / "kubernetes.yaml").read_text())["spec"]["template"]["spec"]
        self.assertEqual(pod["containers"][0]["resources"]["limits"], {"memory": "1234Mi", "cpu": 3})
        self.assertIn("threads: 3\n    resources: mem_mb=1234\n", (folder / "Snakefile").read_text())
        self.assertIn("1234 MiB", (folder / "Makefile").read_text())

    def test_a_trial_frame_measures_the_memory_of_tasks(self):
        folder = self.povray_bundle("measured", FRAMES, options=("--engine", "slurm"))
        peak = json.loads((folder / "bundle.json").read_text())["chunks"]["peak_memory"]
        self.assertTrue(10 < peak < 4000, peak)
        memory = int(re.search(r"--mem=(\d+)M", (folder / "slurm" / "work.sbatch").read_text()).group(1))
        self.assertTrue(1.5 * peak < memory <= 1.5 * peak + 513, (peak, memory))

    def test_make_divides_the_cores_among_its_jobs(self):
        """Six cores go to each of two tasks on a machine of 12 cores."""
        folder = self.povray_bundle("jobs", FRAMES, options=("--chunk-frames", "2", "--engine", "make"))
        path = self.programs("shim", nproc="#!/bin/sh\necho 12\n", meniscus='#!/bin/sh\necho "$@"\n')["PATH"]
        for words, threads in (((), 12), (("-j2",), 6), (("-k", "-j", "5"), 2), (("-j", "64"), 1), (("-j",), 1),
                               (("-j2", "THREADS=3"), 3)):
            said = self.run_task(["make", "-C", folder, *words], PATH=path).stdout
            self.assertEqual(set(re.findall(r"^work .*--threads (\d+)", said, re.M)), {str(threads)}, words)

    def compiled(self, folder, settings):
        result = subprocess.run(["node", HERE / "flamenco_mock.js", folder / "meniscus_film.js", json.dumps(settings)],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_flamenco(self):
        folder = self.engine_bundle(f"flamenco {HOSTILE}", "flamenco", "--farm-path", "/mnt/film")
        settings = json.loads((folder / "flamenco_job.json").read_text())["settings"]
        self.assertEqual(settings, {"bundle": "/mnt/film", "tasks": 3, "threads": 0, "meniscus": "meniscus"})
        job = self.compiled(folder, {**settings, "bundle": str(folder)})
        self.assertEqual(sorted(settings), sorted(setting["key"] for setting in job["settings"]))
        tasks = {task["name"]: task for task in job["tasks"]}
        self.assertEqual(list(tasks), ["frames-1", "frames-2", "frames-3", "verify"])
        self.assertEqual(tasks["verify"]["dependencies"], ["frames-1", "frames-2", "frames-3"])
        for task in tasks.values():
            for command in task["commands"]:
                self.run_task([command["parameters"]["exe"], *command["parameters"]["args"]])
        self.assert_film_is_done(folder)

    def valid(self, path):
        result = subprocess.run(["xmllint", "--noout", "--nonet", "--dtdvalid", HERE / "opencue_job.dtd", path],
                                capture_output=True, text=True)
        return result.returncode == 0, result.stderr

    def test_opencue(self):
        seen = self.folder / "seen-by.the_farm"
        folder = self.engine_bundle("opencue", "opencue", "--farm-path", seen)
        seen.symlink_to(folder)
        path = folder / "opencue.xml"
        self.assertTrue(*self.valid(path))
        spec = ElementTree.parse(path).getroot()
        (depend,) = spec.iter("depend")
        self.assertEqual((depend.findtext("deplayer"), depend.findtext("onlayer")), ("verify", "work"))
        for layer in spec.iter("layer"):
            first, last = map(int, layer.findtext("range").split("-"))
            for frame in range(first, last + 1):
                self.run_task(["/bin/sh", "-c", layer.findtext("cmd").replace("#IFRAME#", str(frame))])
        self.assert_film_is_done(folder)
        text = path.read_text()
        for old, new in (('type="Render"', 'type="Draw"'), ("LAYER_ON_LAYER", "AFTER"), ("<show>testing</show>", "")):
            (folder / "wrong.xml").write_text(text.replace(old, new))
            self.assertFalse(self.valid(folder / "wrong.xml")[0], old)


if __name__ == "__main__":
    main()
