# SPDX-License-Identifier: BSD-3-Clause
"""The page of schedulers and the files for OpenJD and Kubernetes, read and run by the schedulers' own code; scripts/check/schedulers.sh installs it."""

import os
import subprocess
import sys
import unittest

import yaml

import page_of_schedulers as page
from farm_case import sums, wait_until
from schedulers_test import Schedulers


class RealSchedulers(Schedulers):
    def test_htcondor(self):
        import htcondor2
        commands = []
        for process in range(page.TASKS):
            job = htcondor2.Submit(page.condor_file())
            self.assertEqual(job.getQArgs(), str(page.TASKS))
            job["Process"] = str(process)
            commands.append(("meniscus " + job.expand("arguments"), {}))
        self.assertEqual(commands, page.condor_tasks())

    def test_kubernetes(self):
        import kubernetes_validate
        job = yaml.safe_load((self.film("kubernetes") / "kubernetes.yaml").read_text())
        kubernetes_validate.validate(job, "1.31", strict=True)
        job["spec"]["completions"] = "ten"
        with self.assertRaises(kubernetes_validate.ValidationError):
            kubernetes_validate.validate(job, "1.31", strict=True)

    def test_aws_batch(self):
        import botocore.session
        import botocore.validate
        shape = botocore.session.get_session().get_service_model("batch").operation_model("RegisterJobDefinition").input_shape
        validator = botocore.validate.ParamValidator()
        self.assertEqual(validator.validate(page.batch_definition(), shape).generate_report(), "")
        self.assertNotEqual(validator.validate({**page.batch_definition(), "kind": "x"}, shape).generate_report(), "")

    def test_openjd(self):
        """Its worker is killed, so that the job fails; the same job once more makes the rest."""
        options = ("--chunk-frames", "4", "--film", "film.mp4")
        folder, alone = (self.povray_bundle(name, options=options) for name in ("openjd", "alone"))
        template = str(folder / "template.json")
        self.run_here(["openjd", "check", template])
        run = ["openjd", "run", template, "-p", f"Bundle={folder}"]
        job = subprocess.Popen(run, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_until(lambda: self.made(folder), what="a picture")
        self.kill_worker_in(folder)
        self.assertNotEqual(job.wait(280), 0)
        self.assertLess(len(self.made(folder)), 8)
        self.run_here(run)
        self.meniscus("work", alone)
        self.assertEqual(sums(folder / "images", "*.png"), sums(alone / "images", "*.png"))
        self.assertTrue((folder / "film.mp4").exists())

    def test_nextflow(self):
        folder, flow = self.film("nextflow-itself"), self.folder / "nextflow"
        flow.mkdir()
        (text,) = page.files("Nextflow")
        (flow / "film.nf").write_text(text.replace(page.BUNDLE, str(folder)))
        self.run_here(["java", "-cp", os.environ["NEXTFLOW_LIBRARIES"], "nextflow.cli.Launcher", "-C", "/dev/null", "run",
                       "film.nf", "-ansi-log", "false"], cwd=flow, variables={"NXF_OFFLINE": "true", "NXF_HOME": str(flow)})
        self.assertTrue((folder / "film.mp4").exists())
        self.assert_each_frame_is_made_once(folder)


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1], verbosity=2, exit=False, defaultTest="RealSchedulers").result
    print(f"cases {result.testsRun} failures {len(result.failures) + len(result.errors)}")
    sys.exit(not result.wasSuccessful())
