# SPDX-License-Identifier: BSD-3-Clause
"""Bundles from elsewhere: none may write or read outside its folder, or start a program, whatever it contains."""

import hashlib
import json
import os
import shutil

from farm_case import FarmCase, main, sample_run


class Hostile(FarmCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        self = cls("test_commands")
        cls.molecule = sample_run(cls.folder / "run.pdb", 2, atoms=40)
        cls.render = self.bundle("render", "render", cls.molecule, "--frames", "all", "--size", "40x30",
                                 options=("--chunk-frames", "5", "--film", "film.mp4"))
        cls.povray = self.povray_bundle("povray", 2)
        cls.blender = self.bundle("blender", "export", "blender", cls.molecule, "--frames", "all", "--size", "40x30")
        cls.meniscus(self, "work", cls.render)
        cls.meniscus(self, "work", cls.povray)
        cls.outside = cls.folder / "outside"
        cls.outside.mkdir()

    def copy(self, bundle):
        folder = self.folder / "copy"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(bundle, folder, symlinks=True)
        return folder

    def edited(self, bundle, change):
        """A copy whose manifest was changed."""
        folder = self.copy(bundle)
        manifest = json.loads((folder / "bundle.json").read_text())
        change(manifest, folder)
        (folder / "bundle.json").write_text(json.dumps(manifest))
        return folder

    def assert_refused(self, folder, what, commands=(("work",),)):
        outside = sorted(self.outside.iterdir())
        for command in commands:
            result = self.meniscus(*command, folder, code=3)
            self.assertIn(what, result.stderr, command)
        self.assertEqual(sorted(self.outside.iterdir()), outside)

    def test_commands(self):
        """Options that write, unknown ones, files that are not inputs, and ways to say these so that a check misses them."""
        secret = self.outside / "secret.json"
        secret.write_bytes((self.render / "inputs" / "camera.json").read_bytes())
        for words, what in (
                (["--save-camera", "/x"], "--save-camera"), (["--save-camera=/x"], "--save-camera"),
                (["-o", "/x.png"], "-o"), (["-qo/x.png"], "-qo/x.png"), (["-o/x.png"], "-o/x.png"),
                (["--output", "/x.png"], "--output"), (["--force"], "--force"), (["--only", "0"], "--only"),
                (["--select", "all", "surface"], "surface"), (["surface"], "surface"), (["--"], "--"),
                (["--select="], "empty"), (["--select"], "needs a value"), (["--keep-water=1"], "takes no value"),
                (["--device", "cpu"], "--device"), (["--whole", "guess", "/x"], "/x"), (["@/etc/passwd"], "@"),
                (["--camera", str(secret)], "not an input"), (["--camera", "inputs/../../outside/secret.json"], "not an input"),
                (["--camera=./inputs/camera.json"], "not an input"), (["--trajectory", "/etc/passwd"], "not an input"),
                (["--radii-file", "[inputs/run.pdb,/etc/passwd]"], "not an input"), (["--camera-path", "-"], "not an input"),
                (["--color-by-file", "bundle.json"], "not an input")):
            def change(manifest, _):
                manifest["command"] += words
            self.assert_refused(self.edited(self.render, change), what)
        for command in (["surface", "inputs/run.pdb", "--csv", "/x"], ["render"], [], ["export", "ply", "inputs/run.pdb"],
                        ["preview", "inputs/run.pdb", "--serve"], ["render", "-"], ["render", "/etc/passwd"],
                        ["farm", "bundle", "x"], ["render", "--save-camera", "inputs/run.pdb"]):
            self.assert_refused(self.edited(self.render, lambda manifest, _: manifest.update(command=command)),
                                "bundle.json")

    def test_options_are_passed_on_so_that_they_mean_one_thing(self):
        """A value that looks like an option stays a value."""
        def change(manifest, _):
            manifest["command"] += ["--select", "--save-camera=x.json"]
        folder = self.edited(self.render, change)
        result = self.meniscus("work", folder, code=2)
        self.assertIn("--select", result.stderr)
        self.assertFalse((folder / "x.json").exists())

    def test_manifests(self):
        def at(path, value):
            def change(manifest, _):
                place = manifest
                for key in path[:-1]:
                    place = place[key]
                place[path[-1]] = value
            return change

        step = ("steps", 0)
        for change in (at(("inputs", 0, "path"), "../run.pdb"), at(("inputs", 0, "path"), "/etc/passwd"),
                       at(("inputs", 0, "path"), "inputs/../../x"), at(("inputs", 0, "path"), "bundle.json"),
                       at(("inputs", 0, "path"), "inputs/.x"), at(("film", "file"), "../film.mp4"),
                       at(("film", "file"), "/tmp/film.mp4"), at(("film", "file"), "Makefile"),
                       at(("film", "frames_per_second"), -1), at(("film", "codec"), "mjpeg"),
                       at(("film", "codec"), ["h264"]), at(("film", "crf"), 900), at(("film", "bits"), 9), at(("size",), [0, 30]), at(("size",), [40, 100000]),
                       at(("frames",), ""), at(("chunks", "count"), 10**9), at((*step, "name"), "../x"),
                       at((*step, "name"), "paint"), at((*step, "maker"), "povray"), at((*step, "maker"), "/bin/sh"),
                       at((*step, "arguments"), ["--save-camera", "/x"]), at((*step, "arguments"), ["--threads"]),
                       at(("steps",), [])):
            self.assert_refused(self.edited(self.render, change), "bundle.json")
        self.assert_refused(self.edited(self.render, change), "bundle.json", (("farm", "verify"), ("farm", "status")))

    def test_a_damaged_manifest_says_where(self):
        for keys, value, what in (
                (("frames",), None, '/frames'), (("size",), [1], '/size'), (("size",), None, '/size'), (("film",), 5, '/film'),
                (("film", "file"), 5, '/film/file'), (("film", "frames_per_second"), "x", '/film/frames_per_second'),
                (("film", "crf"), -1, '"crf" is -1'), (("command",), "render", '/command'), (("command",), [1], '/command'),
                (("tries",), 3, '/tries'), (("inputs",), [5], '/inputs/0'), (("inputs", 0, "bytes"), -1, '"bytes" is -1'),
                (("steps",), ["render"], '/steps/0'), (("chunks",), [], '/chunks'), (("chunks", "count"), 1.5, '"count" is 1.5'),
                (("frame_count",), "5", '"frame_count"'), (("references",), "x", '/references')):
            def change(manifest, _):
                part = manifest
                for key in keys[:-1]:
                    part = part[key]
                part[keys[-1]] = value
            folder = self.edited(self.render, change)
            error = self.meniscus("work", folder, code=3).stderr
            self.assertIn(what, error, keys)
            self.assertNotIn("json.exception", error)
            self.assertEqual(error.count("\n"), 1)
        folder = self.copy(self.render)
        whole = (folder / "bundle.json").read_text()
        for text in ("", "{", whole[:-20], "[1e999]", "null", "[]"):
            (folder / "bundle.json").write_text(text)
            error = self.meniscus("work", folder, code=3).stderr
            self.assertRegex(error, r"bundle\.json: is (damaged: parse error|damaged: number overflow|damaged: should be an object|not a farm)")

    def test_options_of_renderers(self):
        for words in (["+O/x"], ["+L/etc"], ["+I/x.pov"], ["other.ini"], ["/tmp/x.ini"], ["+GA/x"], ["+GI/x"],
                      ["+HI/x"], ["Pre_Scene_Command=id"], ["Post_Frame_Command=id"], ["Library_Path=/"], ["+C"],
                      ["Create_Ini=/x"], ["All_File=/x"], ["Declare=a=\"/x\""], ["surface.ini[a]/x"], ["-"], [""]):
            self.assert_refused(self.edited(self.povray, lambda manifest, _: manifest["steps"][1].update(
                arguments=words)), "POV-Ray")
        for words in (["--output", "/x"], ["--blend", "/x"], ["--passes", "/x.exr"], ["--outp", "/x"], ["/x.mns"],
                      ["--samples"], ["--python", "/x.py"], ["--", "--python", "/x.py"]):
            self.assert_refused(self.edited(self.blender, lambda manifest, _: manifest["steps"][1].update(
                arguments=words)), "bundle.json")

    def test_blender_runs_no_other_driver(self):
        def change(manifest, folder):
            driver = folder / "inputs" / "blender" / "render_mns.py"
            driver.write_text("raise SystemExit\n")
            for entry in manifest["inputs"]:
                if entry["path"] == "inputs/blender/render_mns.py":
                    entry.update(bytes=driver.stat().st_size,
                                 sha256=hashlib.sha256(driver.read_bytes()).hexdigest())

        self.assert_refused(self.edited(self.blender, change), "add-on")
        # Modules that lie beside the driver are not loaded: its copy is elsewhere.
        folder = self.copy(self.blender)
        (folder / "inputs" / "blender" / "numpy.py").write_text(f"open({str(self.outside / 'hit')!r}, 'w')\n")
        (folder / "inputs" / "blender" / "meniscus_import" / "struct.py").write_text("raise SystemExit\n")
        self.meniscus("work", folder)
        self.assertEqual(len(list((folder / "images").glob("*.png"))), 2)
        self.assertEqual([path.name for path in self.outside.iterdir() if path.name == "hit"], [])
        self.assert_nothing_unfinished(folder)

    def test_links(self):
        """Whatever a bundle has by name is there itself."""
        other = self.outside / "other"
        for name in ("images", "scene", "state", "state/render", "state/surface", "inputs"):
            folder = self.copy(self.povray)
            shutil.rmtree(other, ignore_errors=True)
            shutil.move(folder / name, other)
            (folder / name).symlink_to(other)
            before = {path: path.stat().st_mtime_ns for path in other.rglob("*")}
            self.assert_refused(folder, "symbolic link", commands=(("work", "--force"), ("farm", "verify")))
            self.assertEqual({path: path.stat().st_mtime_ns for path in other.rglob("*")}, before)
        for name in ("inputs/camera.json", "state/render/frame_00000.json", "bundle.json", "scene/surface.pov",
                     "images/frame_00000.png"):
            folder = self.copy(self.povray)
            shutil.move(folder / name, other / "file")
            (folder / name).symlink_to(other / "file")
            self.assert_refused(folder, "symbolic link", commands=(("farm", "verify"),))

    def test_pipes_and_endless_files_do_not_hold_it_up(self):
        for name in ("bundle.json", "state/render/frame_00000.json", "inputs/camera.json", "images/frame_00000.png"):
            folder = self.copy(self.render)
            (folder / name).unlink()
            os.mkfifo(folder / name)
            self.assert_refused(folder, "neither a file", commands=(("farm", "verify"),))
        folder = self.copy(self.povray)
        (folder / "scene" / "surface.pov").unlink()
        os.mkfifo(folder / "scene" / "surface.pov")
        self.assert_refused(folder, "neither a file", commands=(("work", "--force"),))
        folder = self.copy(self.render)
        with open(folder / "state" / "render" / "frame_00000.json", "ab") as record:
            record.truncate(10**12)
        self.assert_refused(folder, "longer than", commands=(("farm", "status"),))

    def test_records(self):
        """Records name files of the bundle only; others count for nothing."""
        for path in ("/etc/passwd", "../x", "inputs/camera.json", "images/../inputs/camera.json"):
            folder = self.copy(self.render)
            record = folder / "state" / "render" / "frame_00000.json"
            content = json.loads(record.read_text())
            content["files"][0]["path"] = path
            record.write_text(json.dumps(content))
            self.assertIn("frame 0: is not made yet", self.meniscus("farm", "verify", folder, code=3).stderr)

    def assert_scene_refused(self, folder, name, text):
        """With a text at the end of a file that the records say is whole."""
        with open(folder / name, "a") as scene:
            scene.write(text)
        self.renew_records(folder)
        result = self.meniscus("work", folder, "--step", "render", "--force", code=3)
        self.assertIn("does not write", result.stderr, text)

    @staticmethod
    def renew_records(folder):
        """The records say that the files are whole, as they are now."""
        for path in (folder / "state" / "surface").glob("*.json"):
            record = json.loads(path.read_text())
            for file in record["files"]:
                content = (folder / file["path"]).read_bytes()
                file.update(bytes=len(content), sha256=hashlib.sha256(content).hexdigest())
            path.write_text(json.dumps(record))

    def test_scenes(self):
        """POV-Ray's scenes are programs: one that this program would not have written is not run, whoever says it was
        made."""
        hit = self.outside / "hit"
        attacks = {
            "scene/surface.pov": [f'#fopen F "{hit}" write\n', '#include "/etc/passwd"\n', '#include "strings.inc"\n',
                                  '#include concat(chr(47), "etc")\n', '#include "\\u002fetc"\n', "# fopen F\n",
                                  "#/**/fopen F\n", "/* // */ #fopen F\n", '#read (F, a)\n', '#declare A = "a \\" b";\n',
                                  '#include substr("surface.inc", 1, 2)\n', 'pigment { image_map { png "surface" } }\n',
                                  "#macro M() #end\n", "Parse_String(A)\n", "#error datetime(0)\n", "\u00e9\n"],
            "scene/surface_geometry_00001.inc": ['#include "../x.inc"\n', "#write (F, 1)\n"],
            "scene/surface_style.inc": ['#fclose F\n'],
            "scene/surface_aov.inc": ["#debug A\n"],
            "scene/surface.ini": ["Pre_Scene_Command=id\n", "Library_Path=/\n", "+I/x\n", "include=x.ini\n",
                                  "Input_File_Name=/x.pov\n", "Output_File_Name=/x.png\n", "Declare=A=\"x\"\n"],
        }
        for name, texts in attacks.items():
            for text in texts:
                self.assert_scene_refused(self.copy(self.povray), name, text)
        folder = self.copy(self.povray)
        (folder / "scene" / "povray.ini").write_text("Pre_Scene_Command=id\n")
        self.assertIn("remove it", self.meniscus("work", folder, "--step", "render", "--force",
                                                    code=3).stderr)
        self.assertFalse(hit.exists())

    def test_scenes_of_this_program_are_run(self):
        """With all that changes their words."""
        for more in (("--material", "glass", "--by", "residue"), ("--color", "radial", "--turntable", "1"),
                     ("--probe", "0", "--projection", "orthographic"), ("--color", "component", "--cavities", "drop"),
                     ("--hide-surface", "--sticks", "all", "--object",
                      json.dumps({"selection": "all", "clip": "depth>0.5", "specular": 0.3}))):
            shutil.rmtree(self.folder / "varied", ignore_errors=True)
            folder = self.bundle("varied", "export", "povray", self.molecule, "--frames", "all", "--size", "40x30",
                                 *more, "--", "surface.ini[ghost]", "+Q5", "-A")
            self.meniscus("work", folder)

    def test_includes_of_frames_are_read_like_the_rest_of_a_scene(self):
        folder = self.bundle("colors", "export", "povray", self.molecule, "--frames", "all", "--size", "40x30", "--color", "radial",
                             "--object", json.dumps({"selection": "all", "representation": "sticks"}), "--", "-A")
        self.meniscus("work", folder)
        for part in ("colors", "object_1"):
            copy = self.copy(folder)
            self.assert_scene_refused(copy, f"scene/surface_{part}_00001.inc", f'#fopen F "{self.outside / "hit"}" write\n')

    def test_a_scene_reaches_only_files_that_were_read(self):
        """Other frames and files with names like theirs are not there for POV-Ray, however a scene comes to name them."""
        hit = self.outside / "hit"
        evil = f'#fopen F "{hit}" write\n#write (F, "x")\n#fclose F\n'
        for victim, text in (("surface_evil.inc", '#include "surface_evil.inc"\n'),
                             ("surface_geometry_00001.inc", '#include "surface_geometry_00001.inc"\n')):
            folder = self.copy(self.povray)
            with open(folder / "scene" / victim, "a") as file:
                file.write(evil)
            with open(folder / "scene" / "surface.pov", "a") as file:
                file.write(text)
            self.renew_records(folder)
            self.meniscus("work", folder, "--step", "render", "--force", "--frames", "0", code=3)
            self.assertFalse(hit.exists(), victim)

    def test_programs_are_not_looked_for_in_the_bundle(self):
        folder = self.copy(self.povray)
        for place in (folder, folder / "scene"):
            (place / "povray").write_text(f"#!/bin/sh\ntouch {self.outside / 'hit'}\n")
            (place / "povray").chmod(0o755)
        (folder / "scene" / "povray").unlink()
        self.meniscus("work", folder, "--step", "render", "--force", env=dict(os.environ, PATH=f".:..::{os.environ['PATH']}"))
        self.assertFalse((self.outside / "hit").exists())

    def test_every_option_is_known_to_the_list_or_refused_on_purpose(self):
        """A new option of a command that can be bundled is looked at before it gets into bundles."""
        refused = {"--output", "--force", "--only", "--progress", "--save-camera", "--save-scene", "--scene", "--trust-scene", "--device",
                   "--threads", "--require-gpu", "--jobs", "--help", "--help-all", "--set", "--legend-file",
                   "--codec", "--crf", "--draft", "--resume"}
        manifest = json.loads((self.render / "bundle.json").read_text())
        names = set()
        for command in (("render",), ("export", "povray"), ("export", "blender"), ("export", "mitsuba"), ("export", "pbrt")):
            text = self.meniscus(*command, "--help-all").stdout
            names |= {name for line in text.splitlines() if line.startswith("  -")
                      for name in line.split()[0].split(",") if name.startswith("--")}
        self.assertTrue(names >= refused and len(names) > 60, names)
        for name in sorted(names):
            words = [*manifest["command"][:2], name]
            folder = self.edited(self.render, lambda changed, _: changed.update(command=words))
            said = self.meniscus("farm", "status", folder, code=None).stderr
            self.assertEqual("not supported in farm bundles" in said, name in refused, f"{name}: {said}")


if __name__ == "__main__":
    main()
