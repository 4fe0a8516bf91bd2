# SPDX-License-Identifier: BSD-3-Clause
"""Files for OpenJD, Flamenco and OpenCue: validated, and their tasks really run here by small stand-ins for the engines.

OpenJD: a schema after the public specification, and a runner of steps. Flamenco: a mock of its author API in Node.
OpenCue: a DTD after Cuebot's. None of the engines themselves runs here.
"""

import copy
import json
import os
import pathlib
import re
import subprocess
import xml.etree.ElementTree as ElementTree

import jsonschema

from farm_case import FarmCase, MENISCUS, main, sums

HERE = pathlib.Path(__file__).parent
FRAMES = 4


def in_order(names, needs):
    """The names, each behind those it needs."""
    ordered = []
    while len(ordered) < len(names):
        ready = [name for name in names if name not in ordered and all(other in ordered for other in needs(name))]
        if not ready:
            raise AssertionError("dependencies run in a circle, or name nobody")
        ordered += ready
    return ordered


class Engines(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # A farm finds the program in PATH.
        (cls.folder / "bin").mkdir()
        (cls.folder / "bin" / "meniscus").symlink_to(MENISCUS)
        cls.environment = dict(os.environ, PATH=f"{cls.folder / 'bin'}:{os.environ['PATH']}")
        local = cls("test_openjd").povray_bundle("local", FRAMES)
        subprocess.run([MENISCUS, "work", local, "--progress", "none"], check=True)
        cls.expected = sums(local / "images", "*.png")

    def hostile_bundle(self, name, engine, *more):
        folder = self.folder / f"{name} it's \"$HOME\" <&> `x` é"
        options = ("--chunk-frames", "2", "--engine", engine, "--film", "film.mp4", *more)
        return self.povray_bundle(folder.name, FRAMES, options=options)

    def run_task(self, command):
        result = subprocess.run(command, env=self.environment, capture_output=True, text=True, cwd="/")
        self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}\n{result.stderr}")
        return result

    def assert_film_is_done(self, folder):
        self.assertEqual(sums(folder / "images", "*.png"), self.expected)
        self.assertTrue((folder / "film.mp4").stat().st_size > 1000)

    def test_openjd(self):
        folder = self.hostile_bundle("openjd", "openjd")
        template = json.loads((folder / "template.json").read_text())
        validator = jsonschema.Draft202012Validator(json.loads((HERE / "openjd_2023_09.schema.json").read_text()))
        validator.validate(template)
        steps = {step["name"]: step for step in template["steps"]}
        self.assertEqual(list(steps), ["surface", "render", "verify"])
        values = {f"Param.{entry['name']}": entry["default"] for entry in template["parameterDefinitions"]}
        # Relative defaults of PATH parameters start from the template.
        values["Param.Bundle"] = str(folder / values["Param.Bundle"])

        def resolved(text, task):
            return re.sub(r"\{\{ *([A-Za-z0-9_.]+) *\}\}", lambda found: {**values, **task}[found.group(1)], text)

        def needs(name):
            return [entry["dependsOn"] for entry in steps[name].get("dependencies", [])]

        for name in in_order(list(steps), needs):
            action = steps[name]["script"]["actions"]["onRun"]
            tasks = [{}]
            if "parameterSpace" in steps[name]:
                first, last = map(int, steps[name]["parameterSpace"]["taskParameterDefinitions"][0]["range"].split("-"))
                tasks = [{"Task.Param.Chunk": str(number)} for number in range(first, last + 1)]
                self.assertEqual(len(tasks), 2)
            for task in tasks:
                said = self.run_task([resolved(action["command"], task),
                                      *(resolved(argument, task) for argument in action["args"])])
                if name != "verify":
                    self.assertIn("openjd_progress: 100.0\n", said.stdout)
        self.assert_film_is_done(folder)

    def test_every_engine_is_told_of_cores_and_memory(self):
        options = ("--chunk-frames", "2", "--engine", "all", "--farm-path", "/mnt/film", "--task-cores", "3",
                   "--task-memory", "1234")
        folder = self.povray_bundle("resources", FRAMES, options=options)
        for step in ("surface", "render"):
            script = (folder / "slurm" / f"{step}.sbatch").read_text()
            self.assertIn("#SBATCH --cpus-per-task=3\n#SBATCH --mem=1234M\n", script)
        for step in json.loads((folder / "template.json").read_text())["steps"][:2]:
            self.assertEqual(step["hostRequirements"]["amounts"], [{"name": "amount.worker.vcpu", "min": 3},
                                                                   {"name": "amount.worker.memory", "min": 1234}])
            self.assertIn("--threads 3", " ".join(step["script"]["actions"]["onRun"]["args"]))
        self.assertTrue(*self.valid(folder / "opencue.xml"))
        for layer in list(ElementTree.parse(folder / "opencue.xml").getroot().iter("layer"))[:2]:
            self.assertEqual([layer.findtext(name) for name in ("cores", "threadable", "memory")], ["3", "True", "1234m"])
            self.assertIn("--threads 3", layer.findtext("cmd"))
        self.assertEqual(json.loads((folder / "flamenco_job.json").read_text())["metadata"],
                         {"cores": "3", "memory_mib": "1234"})
        self.assertIn("1234 MiB", (folder / "Makefile").read_text())

    def test_a_trial_frame_tells_how_much_memory_tasks_need(self):
        folder = self.povray_bundle("measured", FRAMES, options=("--engine", "slurm"))
        peak = json.loads((folder / "bundle.json").read_text())["chunks"]["peak_memory"]
        self.assertTrue(10 < peak < 4000, peak)
        asked = int(re.search(r"--mem=(\d+)M", (folder / "slurm" / "render.sbatch").read_text()).group(1))
        self.assertTrue(1.5 * peak < asked <= 1.5 * peak + 513, (peak, asked))

    def test_make_divides_the_cores_among_its_jobs(self):
        """-j2 on a machine of 12 cores gives each task six; THREADS is obeyed."""
        folder = self.povray_bundle("jobs", FRAMES, options=("--chunk-frames", "2", "--engine", "make"))
        shim = self.folder / "shim"
        shim.mkdir()
        (shim / "nproc").write_text("#!/bin/sh\necho 12\n")
        (shim / "meniscus").write_text("#!/bin/sh\necho \"$@\"\n")
        for program in shim.iterdir():
            program.chmod(0o755)
        environment = dict(os.environ, PATH=f"{shim}:{os.environ['PATH']}")
        for words, threads in (((), 12), (("-j2",), 6), (("-k", "-j", "5"), 2), (("-j", "64"), 1), (("-j",), 1),
                               (("-j2", "THREADS=3"), 3)):
            said = subprocess.run(["make", "-C", folder, *words], env=environment, capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertEqual(set(re.findall(r"^work .*--threads (\d+)", said.stdout, re.M)), {str(threads)}, words)

    def test_the_openjd_schema_refuses_mistakes(self):
        folder = self.povray_bundle("schema", FRAMES, options=("--chunk-frames", "2", "--engine", "openjd"))
        template = json.loads((folder / "template.json").read_text())
        validator = jsonschema.Draft202012Validator(json.loads((HERE / "openjd_2023_09.schema.json").read_text()))

        def broken(change):
            copied = copy.deepcopy(template)
            change(copied)
            return copied

        def task_parameter(job):
            return job["steps"][0]["parameterSpace"]["taskParameterDefinitions"][0]

        def action(job):
            return job["steps"][0]["script"]["actions"]["onRun"]

        changes = [
            lambda job: job.update(specificationVersion="jobtemplate-2099-01"),
            lambda job: job.update(extensions=["TASK_CHUNKING"]),
            lambda job: task_parameter(job).update(type="FLOAT"),
            lambda job: task_parameter(job).update(range="1 to 2"),
            lambda job: action(job).update(command=""),
            lambda job: action(job)["args"].append("#if (x) { union {{ sphere } }"),
            lambda job: action(job)["cancelation"].update(notifyPeriodInSeconds=6000),
            lambda job: job["parameterDefinitions"][0].update(dataFlow="BOTH"),
            lambda job: job["steps"][1]["dependencies"][0].update(after="surface"),
            lambda job: job["steps"][0].pop("script"),
        ]
        for number, change in enumerate(changes):
            with self.assertRaises(jsonschema.ValidationError, msg=f"change {number}"):
                validator.validate(broken(change))

    def compiled(self, folder, settings):
        script = folder / "meniscus_film.js"
        result = subprocess.run(["node", HERE / "flamenco_mock.js", script, json.dumps(settings)], capture_output=True,
                                text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_flamenco(self):
        folder = self.hostile_bundle("flamenco", "flamenco")
        job = self.compiled(folder, {"bundle": str(folder), "tasks": 2})
        tasks = {task["name"]: task for task in job["tasks"]}
        self.assertEqual(sorted(tasks), ["frames-1", "frames-2", "verify"])
        self.assertEqual(sorted(tasks["verify"]["dependencies"]), ["frames-1", "frames-2"])
        for name in in_order(list(tasks), lambda name: tasks[name]["dependencies"]):
            for command in tasks[name]["commands"]:
                self.assertEqual(command["name"], "exec")
                self.run_task([command["parameters"]["exe"], *command["parameters"]["args"]])
        self.assert_film_is_done(folder)

    def test_flamenco_has_one_job_type_for_all_bundles(self):
        path = "/mnt/a \"b\" 'c' \\ `d` ${e} </script>\u2028é"
        folders = [self.povray_bundle(name, 8, options=("--chunk-frames", "3", "--engine", "flamenco", *more))
                   for name, more in (("settings", ("--farm-path", path)), ("others", ("--task-cores", "7")))]
        scripts = [(folder / "meniscus_film.js").read_bytes() for folder in folders]
        self.assertEqual(scripts[0], scripts[1])
        job = json.loads((folders[0] / "flamenco_job.json").read_text())
        self.assertEqual((job["type"], job["settings"]["bundle"], job["settings"]["tasks"]), ("meniscus-film", path, 3))
        compiled = self.compiled(folders[0], job["settings"])
        self.assertEqual(sorted(job["settings"]), sorted(setting["key"] for setting in compiled["settings"]))
        self.assertEqual(compiled["tasks"][1]["commands"][0]["parameters"]["args"],
                         ["work", path, "--chunk", "2/3", "--progress", "plain"])
        limited = self.compiled(folders[0], {**job["settings"], "threads": 4})
        self.assertEqual(limited["tasks"][0]["commands"][0]["parameters"]["args"][-2:], ["--threads", "4"])

    def valid(self, path):
        result = subprocess.run(["xmllint", "--noout", "--nonet", "--dtdvalid", HERE / "opencue_job.dtd", path],
                                capture_output=True, text=True)
        return result.returncode == 0, result.stderr

    def test_opencue(self):
        seen = self.folder / "seen it's \"$HOME\" <&> é"
        folder = self.povray_bundle("opencue", FRAMES, options=("--chunk-frames", "2", "--engine", "opencue", "--film",
                                                                "film.mp4", "--farm-path", seen))
        seen.symlink_to(folder)
        path = folder / "opencue.xml"
        self.assertTrue(*self.valid(path))
        spec = ElementTree.parse(path).getroot()
        layers = {layer.get("name"): layer for layer in spec.iter("layer")}
        depends = {depend.findtext("deplayer"): (depend.findtext("onlayer"), depend.get("type"))
                   for depend in spec.iter("depend")}
        self.assertEqual(depends, {"render": ("surface", "FRAME_BY_FRAME"), "verify": ("render", "LAYER_ON_LAYER")})
        for name in in_order(list(layers), lambda name: [depends[name][0]] if name in depends else []):
            first, last = map(int, layers[name].findtext("range").split("-"))
            for frame in range(first, last + 1):
                self.run_task(["/bin/sh", "-c", layers[name].findtext("cmd").replace("#IFRAME#", str(frame))])
        self.assert_film_is_done(folder)

    def test_the_opencue_dtd_refuses_mistakes(self):
        folder = self.povray_bundle("dtd", FRAMES, options=("--chunk-frames", "2", "--engine", "opencue", "--farm-path",
                                                            "/mnt/film"))
        text = (folder / "opencue.xml").read_text()
        for old, new in (("<cmd>", "<command>"), ('type="Render"', 'type="Draw"'), ("FRAME_BY_FRAME", "AFTER"),
                         ("<show>testing</show>", ""), ("<chunk>1</chunk>", "")):
            self.assertIn(old, text)
            wrong = folder / "wrong.xml"
            wrong.write_text(text.replace(old, new).replace("</cmd>", "</command>" if old == "<cmd>" else "</cmd>"))
            self.assertFalse(self.valid(wrong)[0], old)
        refused = self.meniscus("farm", "bundle", self.folder / "hash", "--chunk-frames", "2", "--engine", "opencue",
                                "--farm-path", "/mnt/#IFRAME#", "--", "render", self.folder / f"{FRAMES}_None.pdb",
                                code=2)
        self.assertIn("OpenCue", refused.stderr)


if __name__ == "__main__":
    main()
