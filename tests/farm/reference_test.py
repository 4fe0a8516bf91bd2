# SPDX-License-Identifier: BSD-3-Clause
"""Bundles whose inputs stay where they are, known by path and checksum."""

import hashlib
import json
import shutil

from farm_case import FarmCase, main, sample_run, sums

FRAMES = 4


class Reference(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.data = cls.folder / "data"
        cls.data.mkdir()
        sample_run(cls.data / "run.pdb", FRAMES, atoms=80)
        (cls.data / "values.csv").write_text("resid,value\n" + "".join(f"{n},{n % 7}\n" for n in range(1, 77)))

    def made(self, name, *options):
        return self.bundle(name, "render", self.data / "run.pdb", "--frames", "all", "--size", "60x45", "--device", "cpu",
                           "--color-by-file", self.data / "values.csv", options=("--chunk-frames", "5", *options))

    def manifest(self, folder):
        return json.loads((folder / "bundle.json").read_text())

    def edited(self, folder, references):
        (folder / "bundle.json").write_text(json.dumps({**self.manifest(folder), "references": references}))

    def test_frames_are_those_of_copies_and_copies_may_be_mixed(self):
        copied, named = self.made("copied"), self.made("named", "--by-reference")
        self.assertEqual([path.name for path in (named / "inputs").iterdir()], ["camera.json"])
        data = self.data.resolve()
        self.assertEqual(self.manifest(named)["references"],
                         {"inputs/run.pdb": f"{data}/run.pdb", "inputs/values.csv": f"{data}/values.csv"})
        self.assertEqual(self.manifest(named)["inputs"], self.manifest(copied)["inputs"])
        self.assertNotIn("references", self.manifest(copied))
        again = self.meniscus("farm", "bundle", named, "--chunk-frames", "5", "--by-reference", "--", "render", self.data / "run.pdb",
                              "--frames", "all", "--size", "60x45", "--device", "cpu", "--color-by-file", self.data / "values.csv")
        self.assertIn("was there already", again.stdout)
        self.meniscus("work", copied)
        self.meniscus("work", named, "--frames", "0-1")
        self.assertIn(f": {FRAMES - 2} taken", self.meniscus("farm", "merge", named, copied).stdout)
        self.meniscus("work", named, "--force")
        self.assertEqual(sums(named / "images", "*.png"), sums(copied / "images", "*.png"))
        self.assertEqual(len(sums(named / "images", "*.png")), FRAMES)
        self.assertEqual([path.name for path in (named / "inputs").iterdir()], ["camera.json"])

    def test_a_trial_reads_them_where_they_are(self):
        folder = self.made("trial", "--by-reference", "--task-cores", "1")
        self.assertEqual(self.manifest(folder)["frame_count"], FRAMES)
        timed = self.folder / "timed"
        self.meniscus("farm", "bundle", timed, "--by-reference", "--", "render", self.data / "run.pdb", "--frames", "all",
                      "--size", "60x45", "--device", "cpu")
        self.assertIn("seconds_per_frame", self.manifest(timed)["chunks"])
        self.assertFalse((timed / "images").exists())

    def test_a_file_that_differs_is_refused(self):
        folder = self.made("differs", "--by-reference")
        elsewhere = self.folder / "elsewhere.pdb"
        shutil.copy(self.data / "run.pdb", elsewhere)
        references = self.manifest(folder)["references"]
        self.edited(folder, {**references, "inputs/run.pdb": str(elsewhere.resolve())})
        self.meniscus("work", folder, "--frames", "0")
        text = elsewhere.read_text()
        elsewhere.write_text(text.replace("MODEL        2", "MODEL        9"))
        told = self.meniscus("work", folder, "--frames", "1", code=3).stderr
        self.assertIn(f"{elsewhere.resolve()}: is not what was bundled", told)
        elsewhere.unlink()
        told = self.meniscus("work", folder, "--frames", "1", code=3).stderr
        self.assertIn(f"{elsewhere.resolve()}: is missing; bring it there, or to {folder}/inputs/run.pdb", told)
        self.assertEqual(sorted(self.records(folder, "render")), [0])
        # The frames that are there can be looked at and shown without it.
        self.assertIn("3 of 4 frames are not good", self.meniscus("farm", "verify", folder, code=3).stderr)
        # A copy in the bundle counts before the path.
        (folder / "inputs" / "run.pdb").write_text(text)
        self.meniscus("work", folder)
        (folder / "inputs" / "run.pdb").unlink()
        self.assertIn("4 frames are good", self.meniscus("farm", "verify", folder).stdout)

    def test_names_that_a_bundle_cannot_have(self):
        odd = self.folder / "a, b"
        odd.mkdir()
        shutil.copy(self.data / "run.pdb", odd / "run.pdb")
        told = self.meniscus("farm", "bundle", self.folder / "odd", "--by-reference", "--chunk-frames", "5", "--", "render",
                             odd / "run.pdb", "--frames", "all", code=2).stderr
        self.assertIn("leave the option out", told)
        self.assertFalse((self.folder / "odd").exists())
        self.meniscus("farm", "bundle", self.folder / "odd", "--by-reference", "--link", "--", "render", odd / "run.pdb", code=2)

    def test_bundles_of_others_learn_of_no_other_file(self):
        """A file outside is read only if it is known to the bundle by checksum, however it is named."""
        folder = self.made("hostile", "--by-reference")
        references = self.manifest(folder)["references"]
        for path in ("relative/run.pdb", "../run.pdb", "/data/../run.pdb", "//run.pdb", "/a,b.pdb", "/a b.pdb", "/[a.pdb",
                     "/.ssh/run.pdb", "/-o", "/", "", "\n", "/x\x1b[2J", 3, None, ["/x"], {}):
            self.edited(folder, {**references, "inputs/run.pdb": path})
            told = self.meniscus("work", folder, code=3 if path != "" else None).stderr
            self.assertNotIn("\x1b", told)
            if path != "":
                self.assertIn("bundle.json", told, path)
        for path in ("/etc/passwd", "/dev/zero", "/etc", "/proc/self/environ", "/nowhere/run.pdb"):
            self.edited(folder, {**references, "inputs/run.pdb": path})
            self.assertRegex(self.meniscus("work", folder, code=3).stderr, f"{path}: (is not what was bundled|is missing)")
        self.edited(folder, {**references, "inputs/other.pdb": "/etc/passwd"})
        self.assertIn("is no input", self.meniscus("work", folder, code=3).stderr)
        # Nor by size alone: the sum of a file elsewhere is looked at however large it is.
        large = self.folder / "large.pdb"
        with open(large, "wb") as file:
            file.truncate((256 << 20) + 1)
        manifest = self.manifest(folder)
        for entry in manifest["inputs"]:
            if entry["path"] == "inputs/run.pdb":
                entry.update(bytes=(256 << 20) + 1, sha256=hashlib.sha256(b"other").hexdigest())
        manifest["references"] = {**references, "inputs/run.pdb": str(large.resolve())}
        (folder / "bundle.json").write_text(json.dumps(manifest))
        self.assertIn("large.pdb: is not what was bundled", self.meniscus("work", folder, code=3).stderr)
        self.assertFalse((folder / "images").exists())


if __name__ == "__main__":
    main()
