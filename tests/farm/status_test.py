# SPDX-License-Identifier: BSD-3-Clause
"""The progress of a bundle and the time left, for people, programs and Prometheus; and the log of each frame."""

import json
import os
import re
import signal
import socket
import time

from prometheus_client.parser import text_string_to_metric_families

from farm_case import WorkCase, main, sample_run, wait_until

FRAMES = 8


class Status(WorkCase):
    def status(self, folder):
        return json.loads(self.meniscus("farm", "status", folder, "--json").stdout)

    def gauges(self, folder):
        """Values by name and labels but for the bundle's, as Prometheus' own parser reads them."""
        text = self.meniscus("farm", "status", folder, "--prometheus").stdout
        self.assertTrue(text.endswith("\n"))
        values = {}
        for family in text_string_to_metric_families(text):
            self.assertEqual(family.type, "gauge")
            self.assertTrue(family.documentation)
            for sample in family.samples:
                self.assertEqual(sample.labels.pop("bundle"), folder.name)
                values[sample.name, *sorted(sample.labels.values())] = sample.value
        return values

    def write_record(self, folder, frame, worker, ended, seconds):
        """As if that worker had made the frame then."""
        path = folder / "state" / "render" / f"frame_{frame:05}.json"
        record = json.loads(path.read_text())
        record.update(worker=worker, ended=ended, seconds=seconds)
        path.write_text(json.dumps(record))

    def live(self, folder, name, age=0.0, lease=60):
        """A worker of another machine that touched its file so many seconds ago."""
        path = folder / "state" / "workers" / f"{name}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps({"host": "far", "process": 1, "space": "elsewhere", "start": "1", "lease": lease}))
        os.utime(path, (time.time() - age,) * 2)

    def test_time_to_go_is_that_of_the_workers_that_live(self):
        """Two that made a frame in 2 s and in 4 s, and one that has made none yet: 3 times the mean pace, (1/2 + 1/4) / 2."""
        molecule = sample_run(self.folder / "pace.pdb", 10, atoms=20)
        folder = self.bundle("pace", "render", molecule, "--frames", "all", "--size", "40x30", "--device", "cpu")
        self.meniscus("work", folder, "--frames", "0-5")
        for frame, worker, ended in ((0, "fast", 1002), (1, "fast", 1004), (2, "slow", 504), (3, "slow", 508), (4, "gone", 7),
                                     (5, "gone", 8)):
            self.write_record(folder, frame, worker, ended, {"fast": 2.0, "slow": 4.0, "gone": 0.5}[worker])
        self.assertEqual((self.status(folder)["workers"], self.status(folder)["seconds_to_go"]), ([], None))
        self.assertIn("no worker is running", self.meniscus("farm", "status", folder).stdout)
        for name in ("slow", "fast", "new"):
            self.live(folder, name)
        self.live(folder, "gone", age=61)
        self.live(folder, "long-lease", age=61, lease=100)
        (folder / "state" / "workers" / "long-lease.json").unlink()
        status = self.status(folder)
        self.assertEqual(status["workers"], ["fast", "new", "slow"])
        expected = 4 / (3 * (1 / 2 + 1 / 4) / 2)
        self.assertAlmostEqual(status["seconds_to_go"], expected)
        (render,) = status["steps"]
        self.assertAlmostEqual(render["seconds_to_go"], expected)
        self.assertAlmostEqual(render["seconds_left"], 4 * (2 * 2 + 2 * 4 + 2 * 0.5) / 6)
        self.assertIn("3 workers are running (fast, new, slow): about 4 s to go", self.meniscus("farm", "status", folder).stdout)
        gauges = self.gauges(folder)
        self.assertAlmostEqual(gauges[("meniscus_farm_to_go_seconds",)], expected)
        self.assertAlmostEqual(gauges["meniscus_farm_step_to_go_seconds", "render"], expected)
        self.assertEqual(gauges[("meniscus_farm_workers",)], 3)
        self.assertEqual({key[1]: value for key, value in gauges.items() if key[0] == "meniscus_farm_frames"},
                         {"done": 6, "failed": 0, "damaged": 0, "missing": 4})
        # Nobody who made a frame lives: the mean of all frames.
        for name in ("slow", "fast"):
            self.live(folder, name, age=61)
        self.assertAlmostEqual(self.status(folder)["seconds_to_go"], 4 * 13 / 6)

    def test_leases_are_those_of_their_workers(self):
        folder = self.povray_bundle("leases")
        self.live(folder, "patient", age=61, lease=100)
        self.live(folder, "hasty", age=30, lease=20)
        self.assertEqual(self.status(folder)["workers"], ["patient"])
        self.assertEqual(sorted(path.name for path in (folder / "state" / "workers").iterdir()), ["hasty.json", "patient.json"])

    def test_a_worker_at_work_is_seen_and_its_end_too(self):
        folder = self.povray_bundle("watched")
        worker = self.start(folder)
        wait_until(lambda: self.records(folder, "render"), what="a picture")
        status = self.status(folder)
        (name,) = status["workers"]
        self.assertIn(f"-{worker.pid}-", name)
        self.assertEqual(self.gauges(folder)[("meniscus_farm_workers",)], 1)
        # Dead without a word: its process is known to be gone here, whatever its lease.
        worker.send_signal(signal.SIGKILL)
        worker.wait(20)
        self.assertEqual(self.status(folder)["workers"], [])
        self.meniscus("work", folder)
        status = self.status(folder)
        self.assertEqual((status["seconds_to_go"], [step["seconds_to_go"] for step in status["steps"]]), (0, [0, 0]))
        self.assertNotIn("worker", self.meniscus("farm", "status", folder).stdout)
        self.assertEqual(self.gauges(folder)[("meniscus_farm_to_go_seconds",)], 0)
        for record in (*self.records(folder, "surface").values(), *self.records(folder, "render").values()):
            host, process, _ = record["worker"].rsplit("-", 2)
            self.assertEqual(host, "".join(c for c in socket.gethostname() if c.isalnum() or c == "-")[:60])
            self.assertGreater(int(process), 0)
            self.assertTrue(time.time() - 600 < record["ended"] <= time.time(), record)

    def test_names_of_bundles_are_labels(self):
        molecule = sample_run(self.folder / "label.pdb", 2, atoms=20)
        folder = self.bundle("it's \"a\" \\ film {x=1} é", "render", molecule, "--frames", "all", "--size", "40x30")
        self.assertEqual(self.gauges(folder)["meniscus_farm_frames", "missing", "render"], 2)
        self.meniscus("farm", "status", folder, "--json", "--prometheus", code=2)

    def test_what_was_said_of_a_frame(self):
        folder = self.povray_bundle("said", frames=4, bad_frame=2)
        self.assertIn("render frame 1: not made yet", self.meniscus("farm", "log", folder, "1").stdout)
        self.meniscus("work", folder, code=3)
        said = self.meniscus("farm", "log", folder, "1").stdout
        self.assertRegex(said, r"(?m)^surface frame 1: made by \S+ at 20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC in \d+\.\d\d s$")
        self.assertRegex(said, r"(?m)^  .*Persistence of Vision")
        self.assertNotIn("surface frame", self.meniscus("farm", "log", folder, "1", "--step", "render").stdout)
        self.assertRegex(self.meniscus("farm", "log", folder, "2").stdout, "surface frame 2: failed by .*, exit code 3: .*finite")
        self.assertIn(f"meniscus farm log '{folder}' 2", self.meniscus("farm", "status", folder).stdout)
        self.meniscus("farm", "log", folder, "9", code=2)
        self.meniscus("farm", "log", folder, "1", "--step", "paint", code=2)
        # Not those of one frame for the other: POV-Ray tells where its picture goes. Of a counter the last number is kept.
        for frame in (0, 1, 3):
            log = (folder / "state" / "render" / f"frame_{frame:05}.log").read_text()
            self.assertEqual(re.findall(r"\.povray_\d+_(\d+)/", log), [f"{frame:05}"])
            # Of a slow picture POV-Ray may begin its counter on a line, and go on with it on the next.
            self.assertEqual(re.findall(r"Rendered \d+ of \d+ pixels.*", log)[-1], "Rendered 19200 of 19200 pixels (100%)")
            self.assertNotIn("\r", log)

    def test_logs_are_short_and_harmless(self):
        """A renderer that says much, and that tries to move the cursor."""
        folder = self.povray_bundle("much", frames=2)
        self.meniscus("work", folder, "--step", "surface")
        loud = self.folder / "loud"
        loud.mkdir()
        (loud / "povray").write_text("#!/bin/sh\nprintf 'first \\033[2J line\\n'; seq -f 'line %.0f of many' 200000; echo the last; "
                                     "exit 1\n")
        (loud / "povray").chmod(0o755)
        self.meniscus("work", folder, code=3, env=dict(os.environ, PATH=f"{loud}:{os.environ['PATH']}"))
        log = (folder / "state" / "render" / "frame_00001.log").read_text()
        self.assertLess(len(log), 66_000)
        lines = log.splitlines()
        self.assertEqual((lines[1], lines[-2], lines[-1]), ("line 1 of many", "line 200000 of many", "the last"))
        (left_out,) = [int(line.split()[1]) for line in lines if line.endswith("lines left out --")]
        self.assertEqual(left_out + len(lines) - 1, 200_002)
        said = self.meniscus("farm", "log", folder, "1").stdout
        self.assertNotIn("\033", said)
        self.assertIn("  the last\n", said)
        # Made after all: its log is that of the time it was made.
        self.meniscus("work", folder)
        self.assertNotIn("of many", self.meniscus("farm", "log", folder, "1").stdout)
        outside = self.folder / "secret"
        outside.write_text("secret")
        path = folder / "state" / "render" / "frame_00001.log"
        path.unlink()
        path.symlink_to(outside)
        self.assertIn("symbolic link", self.meniscus("farm", "log", folder, "1", code=3).stderr)


if __name__ == "__main__":
    main()
