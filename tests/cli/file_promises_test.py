#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Inputs are never replaced, foreign scenes read and write nowhere else, and the same command makes the same bytes."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)

ATOM = "ATOM  {0:5d}  CA  ALA A{0:4d}    {1:8.3f}{2:8.3f}{3:8.3f}  1.00 {4:5.2f}           C\n"
PLACES = [(0, 0, 0), (3, 1, 0), (1, 4, 1), (4, 4, 2), (2, 2, 4)]
MODEL = "".join(ATOM.format(n, *place, 10.0 * n) for n, place in enumerate(PLACES, 1))
CAMERA = {"position": [20, 5, 40], "target": [2, 2, 1], "up": [0, 1, 0], "projection": "perspective", "vertical_fov": 30}
INPUTS = {
    "one.pdb": MODEL + "END\n",
    "run.pdb": "".join(f"MODEL {n:8d}\n{MODEL}ENDMDL\n" for n in (1, 2)) + "END\n",
    "numbers.txt": "1\n2\n3\n4\n5\n", "ramp.txt": "#ff0000\n#0000ff\n", "radii.txt": "ALA CA 2.0\n",
    "curve.csv": "frame,area\n0,1\n1,2\n", "camera.json": json.dumps(CAMERA),
    "path.json": json.dumps({"keys": [{"frame": 0, "camera": CAMERA}]}),
    "scene.json": json.dumps({"meniscus_scene": 1, "molecule": {"file": "one.pdb"}}),
    "map.dx": "object 1 class gridpositions counts 2 2 2\norigin -9 -9 -9\ndelta 20 0 0\ndelta 0 20 0\ndelta 0 0 20\n"
              "object 2 class gridconnections counts 2 2 2\n"
              "object 3 class array type double rank 0 items 8 data follows\n0 1 2 3 4 5 6 7\n",
    "job.xyzr": "0 0 0 1.7\n2 0 0 1.7\n",
}
SMALL = ["--size", "32x24", "--samples", "1"]
ON_CPU = ["--device", "cpu"]

# Every option that names a file to read, with words that read it.
READING = [
    ["render", "one.pdb"], ["render", "run.pdb", "--frames", "0"], ["render", "one.pdb", "--trajectory", "run.pdb"],
    ["render", "one.pdb", "--color-by-file", "numbers.txt"],
    ["render", "one.pdb", "--color", "bfactor", "--map-file", "ramp.txt"], ["render", "one.pdb", "--radii-file", "radii.txt"],
    ["render", "one.pdb", "--color-map-file", "map.dx", "--color-range", "0:7"],
    ["render", "one.pdb", "--camera", "camera.json"], ["render", "run.pdb", "--frames", "0-1", "--camera-path", "path.json"],
    ["render", "run.pdb", "--frames", "0-1", "--curve", "curve.csv"], ["render", "--scene", "scene.json"],
]
# Every option that names a file to write.
WRITING = [
    ["surface", "one.pdb", "--csv"], ["surface", "one.pdb", "--csv-residues"], ["surface", "one.pdb", "--gradients"],
    ["surface", "run.pdb", "--frames", "all", "--csv-series"], ["surface", "run.pdb", "--frames", "all", "--csv-cavities"],
    ["surface", "run.pdb", "--frames", "all", "--plot"], ["pockets", "one.pdb", "--csv"], ["pockets", "one.pdb", "--mesh"],
    ["pockets", "one.pdb", "--figure"], ["render", "one.pdb", *SMALL, "-o"],
    ["render", "one.pdb", *SMALL, "-o", "new.png", "--save-camera"], ["render", "one.pdb", *SMALL, "-o", "new.png", "--save-scene"],
    ["render", "one.pdb", "--size", "200x150", "--color", "bfactor", "-o", "new.png", "--legend-file"],
    ["render", "run.pdb", "--frames", "0-1", "--size", "64x48", "-o"],
    ["export", "blender", "one.pdb", "-o"], ["export", "mesh", "one.pdb", "--format", "ply", "-o"], ["export", "ply", "one.pdb", "-o"],
    ["export", "atoms", "one.pdb", "-o"], ["export", "vdb", "one.pdb", "-o"], ["export", "page", "one.pdb", "-o"],
    ["export", "povray", "one.pdb", "-o", "new", "--save-camera"],
    ["export", "mitsuba", "one.pdb", "-o", "new", "--save-scene"],
    ["preview", "one.pdb", "--commands", "quit.json", "--serve", "--record"],
]


class Workplace(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        for name, text in {**INPUTS, "quit.json": '{"command": "quit"}\n'}.items():
            (self.folder / name).write_text(text)

    def run_program(self, *words, folder=None, **more):
        return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=folder or self.folder,
                              stdin=subprocess.DEVNULL, timeout=100, **more)


class Files(Workplace):
    def names_of(self, name, ending=""):
        """Returns names of a file: its own, a hard link, a symbolic link."""
        place = self.folder / name
        hard, soft = self.folder / ("hard" + (ending or place.suffix)), self.folder / ("soft" + (ending or place.suffix))
        for link in (hard, soft):
            link.unlink(missing_ok=True)
        os.link(place, hard)
        os.symlink(name, soft)
        return [hard.name, soft.name] + ([name] if not ending or name.endswith(ending) else [])

    def check_kept(self, done, name, before=None):
        self.assertIn(done.returncode, (2, 6), done.stderr)
        self.assertEqual((self.folder / name).read_bytes(), before or INPUTS[name].encode(), done.stderr)

    def test_no_output_replaces_the_molecule(self):
        for words in WRITING:
            molecule = next(word for word in words if word.endswith(".pdb"))
            ending = {"--plot": ".svg", "--mesh": ".ply", "--figure": ".json", "--legend-file": ".png"}.get(words[-1], "")
            if words[0] == "render" and words[-1] == "-o":
                ending = ".mp4" if "--frames" in words else ".png"
            for name in self.names_of(molecule, ending):
                with self.subTest(words=words, name=name):
                    done = self.run_program(*words, name, "--force", *ON_CPU)
                    self.check_kept(done, molecule)
                    self.assertIn(name + ": is one of the files that this command reads", done.stderr)

    def test_no_picture_replaces_anything_that_is_read(self):
        for words in READING:
            for read in [word for word in words if word in INPUTS]:
                frames = "--frames" in words or "--trajectory" in words
                for name in self.names_of(read, ".gif" if frames else ".png")[:2]:
                    with self.subTest(words=words, name=name):
                        self.check_kept(self.run_program(*words, *SMALL, "-o", name, "--force", *ON_CPU), read)

    def test_numbered_outputs_keep_what_is_read(self):
        shutil.copy(self.folder / "one.pdb", self.folder / "part_1.stl")
        done = self.run_program("export", "mesh", "one.pdb", "--radii-file", "radii.txt", "-o", "radii.txt", "--format", "ply", "--force")
        self.check_kept(done, "radii.txt")
        os.link(self.folder / "one.pdb", self.folder / "a_1.png")
        done = self.run_program("render", "one.pdb", "--trajectory", "run.pdb", *SMALL, "-o", "a_#.png", "--force", *ON_CPU)
        self.check_kept(done, "one.pdb")

    def test_two_outputs_are_two_files(self):
        for words in (["surface", "one.pdb", "--csv", "a.csv", "--csv-residues", "./a.csv"],
                      ["render", "one.pdb", *SMALL, "-o", "a.png", "--save-camera", str(self.folder / "a.png")],
                      ["export", "ply", "one.pdb", "-o", "a.ply", "--save-scene", "a.ply"]):
            with self.subTest(words=words):
                done = self.run_program(*words, *ON_CPU)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertFalse([name for name in os.listdir(self.folder) if name.startswith("a.")])

    def test_names_that_nobody_typed_count_too(self):
        """These are the name of a picture without -o, values of --set, and the unfinished table of many molecules."""
        self.assertEqual(self.run_program("render", "one.pdb", *SMALL, "-o", "one.png").returncode, 0)
        picture = (self.folder / "one.png").read_bytes()
        self.check_kept(self.run_program("render", "one.pdb", "--scene", "one.png", *SMALL, "--force"), "one.png", picture)
        large = ["--size", "200x150", "--samples", "1", "--color", "bfactor", "--force", *ON_CPU]
        for words in (["--legend-file", "run.png"], ["--set", "legend.file=run.png"],
                      ["--frames", "0-1", "-o", "f_#.png", "--set", "legend.file=f_1.png"]):
            done = self.run_program("render", "run.pdb", *large, *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("name the same file", done.stderr)
        self.assertFalse([*self.folder.glob("f_*"), *self.folder.glob("run.png")])
        shutil.copy(self.folder / "one.pdb", self.folder / "sum.csv.part")
        done = self.run_program("surface", "one.pdb", "sum.csv.part", "--csv-summary", "sum.csv", "--force")
        self.check_kept(done, "sum.csv.part", INPUTS["one.pdb"].encode())

    def test_a_record_replaces_a_link_not_what_it_leads_to(self):
        (self.folder / "notes.txt").write_text("mine")
        os.symlink("notes.txt", self.folder / "record.jsonl")
        done = self.run_program("preview", "one.pdb", "--commands", "quit.json", "--serve", "--record", "record.jsonl", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "notes.txt").read_text(), "mine")

    def test_replacing_other_files_works(self):
        (self.folder / "old.png").write_text("old")
        self.assertEqual(self.run_program("render", "one.pdb", *SMALL, "-o", "old.png", "--force").returncode, 0)
        self.assertNotEqual((self.folder / "old.png").read_bytes(), b"old")


class ScenesOfOthers(Workplace):
    def setUp(self):
        super().setUp()
        self.inner = self.folder / "inner"
        self.inner.mkdir()
        shutil.copy(self.folder / "one.pdb", self.inner)

    def scene(self, **sections):
        text = {"meniscus_scene": 1, "molecule": {"file": "one.pdb"}, "image": {"size": "32x24", "samples": 1}, **sections}
        (self.inner / "evil.json").write_text(json.dumps(text))
        return self.inner / "evil.json"

    def refused(self, done, place, advice):
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, rf"evil\.json: scene: {re.escape(place)} .*{advice}.*--trust-scene")

    def test_they_choose_no_place_to_write(self):
        before = sorted(self.folder.rglob("*"))
        for path in (str(self.folder / "x.png"), "../x.png", "sub/x.png", "a/../../x.png"):
            done = self.run_program("render", "--scene", self.scene(output={"file": path}), "--force")
            self.refused(done, "output.file", "-o FILE")
            done = self.run_program("render", "--scene", self.scene(legend={"file": path}), "-o", "y.png", "--force")
            self.refused(done, "legend.file", "--legend-file FILE")
        self.assertEqual([p for p in sorted(self.folder.rglob("*")) if p.name != "evil.json"], before)

    def test_they_replace_nothing(self):
        (self.inner / "mine.png").write_text("mine")
        done = self.run_program("render", "--scene", self.scene(output={"file": "mine.png"}), "--force")
        self.refused(done, "output.file", "-o FILE")
        self.assertEqual((self.inner / "mine.png").read_text(), "mine")

    def test_they_name_no_file_elsewhere(self):
        hidden = self.folder / "one.pdb"
        cases = [("molecule", "file"), ("molecule", "radii_file"), ("frames", "trajectory"), ("camera", "from"), ("camera", "path"),
                 ("annotations", "curve")]
        for path in (str(hidden), "../one.pdb", "./x/../../one.pdb"):
            for section, key in cases:
                sections = {section: {"file": "one.pdb", key: path} if section == "molecule" else {key: path}}
                with self.subTest(section=section, key=key, path=path):
                    done = self.run_program("render", "--scene", self.scene(**sections), "-o", "a.png")
                    self.refused(done, f"{section}.{key}", "outside of the scene's folder")
            for key in ("color_by_file", "color_map_file", "map_file"):
                done = self.run_program("render", "--scene", self.scene(objects=[{key: path}]), "-o", "a.png")
                self.refused(done, f"objects[0].{key}", "outside of the scene's folder")
            for command in (["surface"], ["pockets"], ["export", "ply", "-o", "a.ply"], ["preview", "--serve"]):
                done = self.run_program(*command, "--scene", self.scene(molecule={"file": path}))
                self.refused(done, "molecule.file", "outside of the scene's folder")

    def test_what_is_named_on_the_command_line_counts(self):
        scene = self.scene(molecule={"file": "../one.pdb"}, camera={"from": "../camera.json"}, output={"file": "../x.png"})
        done = self.run_program("render", "one.pdb", "--scene", scene, "--camera", "camera.json", "-o", "a.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.run_program("render", "--scene", scene, "--trust-scene")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "x.png").read_bytes())

    def test_a_plain_name_beside_the_scene_is_written_once(self):
        scene = self.scene(output={"file": "x.png"})
        self.assertEqual(self.run_program("render", "--scene", scene).returncode, 0)
        self.assertTrue((self.inner / "x.png").exists())
        self.assertEqual(self.run_program("render", "--scene", scene).returncode, 6)

    def test_pictures_with_scenes_are_no_better(self):
        """The text of the scene in a picture is replaced."""
        self.assertEqual(self.run_program("render", "one.pdb", *SMALL, "-o", "inner/a.png").returncode, 0)
        picture = (self.inner / "a.png").read_bytes()
        self.assertIn(b'"file": "one.pdb"', picture)
        (self.inner / "evil.png").write_bytes(picture.replace(b'"file": "one.pdb"', b'"file": "/tm/x.p"'))
        done = self.run_program("render", "--scene", self.inner / "evil.png", "-o", "b.png")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("outside of the scene's folder", done.stderr)

    def test_a_picture_without_a_scene_says_so(self):
        self.assertEqual(self.run_program("render", "one.pdb", *SMALL, "--no-provenance", "-o", "a.png").returncode, 0)
        done = self.run_program("render", "--scene", "a.png", "-o", "b.png")
        self.assertEqual(done.returncode, 3)
        self.assertIn("a.png: is a picture that carries no scene", done.stderr)


    def test_their_json_means_one_thing(self):
        for text, what in (('{"meniscus_scene": 1, "molecule": {"file": "one.pdb", "file": "two.pdb"}}', "'file' appears twice"),
                           ('{"meniscus_scene": 1, "molecule": {"file": "one.pdb"}, "molecule": {}}', "'molecule' appears twice"),
                           ('{"meniscus_scene": 1, "molecule": {"file": "one.pdb"}, "objects": [{"color": "a", "color": "b"}]}',
                            "'color' appears twice"),
                           (r'{"meniscus_scene": 1, "molecule": {"file": "one.pdb\u0000.x"}}', "contains a NUL"),
                           (r'{"meniscus_scene": 1, "molecule": {"file\u0000": "one.pdb"}}', "contains a NUL")):
            (self.inner / "evil.json").write_text(text)
            done = self.run_program("render", "--scene", self.inner / "evil.json", "-o", "a.png")
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(what, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)

    def test_they_make_no_files_with_misleading_names(self):
        for name in ("-o.png", "--force.png", ".hidden.png", "a\n.png", "a\x1b[2J.png", "a\u202egnp.png"):
            for section, key in (("output", "file"), ("legend", "file")):
                done = self.run_program("render", "--scene", self.scene(**{section: {key: name}}), *([] if section == "output" else ["-o", "y.png"]))
                self.refused(done, f"{section}.{key}", "the name of an output must not begin")
        self.assertEqual(sorted(os.listdir(self.inner)), ["evil.json", "one.pdb"])

    def test_standard_input_is_no_file_of_theirs(self):
        for sections in ({"molecule": {"file": "-"}}, {"camera": {"from": "-"}}, {"molecule": {"file": "one.pdb", "radii_file": "-"}}):
            for trust in ([], ["--trust-scene"]):
                self.scene(**sections)
                done = self.run_program("render", "--scene", "evil.json", "-o", "a.png", *trust, folder=self.inner)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn('is "-", standard input', done.stderr)


class NamesInBytes(Workplace):
    """Names that are not UTF-8, or that reverse the direction of a line."""

    def setUp(self):
        super().setUp()
        self.name = b"a\xff.pdb".decode(errors="surrogateescape")
        shutil.copy(self.folder / "one.pdb", self.folder / self.name)

    def run_program(self, *words, **more):
        return super().run_program(*words, errors="surrogateescape", **more)

    def test_a_scene_that_could_not_be_read_again_is_not_written(self):
        for words in (["render", self.name, *SMALL, "-o", "b.png", "--save-scene", "s.json"],
                      ["export", "ply", self.name, "-o", "b.ply", "--save-scene", "s.json"],
                      ["render", "one.pdb", *SMALL, "-o", "b.png", "--title", self.name, "--save-scene", "s.json"],
                      ["pockets", self.name, "--figure", "s.json"]):
            done = self.run_program(*words, *ON_CPU)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, r"--(save-scene|figure): a scene is UTF-8, which \S+ 'a\\xff.pdb' is not\n\Z")
            self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(("b.", "s."))])

    def test_a_picture_carries_no_such_scene_and_says_so(self):
        done = self.run_program("render", self.name, *SMALL, "-o", "b.png", *ON_CPU)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("note: the picture carries no scene: a scene is UTF-8"), 1)
        self.assertNotIn(b"meniscus_scene", (self.folder / "b.png").read_bytes())
        for words in (["-o", "c.png", "--no-provenance"], ["--frames", "0", "-o", "c_#.png"]):
            self.assertNotIn("carries no scene", self.run_program("render", self.name, *SMALL, *words, *ON_CPU).stderr)
        done = self.run_program("render", "one.pdb", *SMALL, "-o", self.name.replace(".pdb", ".png"), *ON_CPU)
        self.assertNotIn("carries no scene", done.stderr)

    def test_tables_and_terminals_escape_them_alike(self):
        turned = "b\u202e\n.pdb"
        shutil.copy(self.folder / "one.pdb", self.folder / turned)
        done = self.run_program("surface", self.name, turned, "--csv-summary", "sum.csv", *ON_CPU)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = (self.folder / "sum.csv").read_bytes().decode().splitlines()
        self.assertEqual([row.split(",")[0] for row in rows[1:]], [r"a\xff.pdb", r"b\xe2\x80\xae\x0a.pdb"])
        for command in ("info", "surface"):
            done = self.run_program(command, turned)
            self.assertNotIn("\u202e", done.stdout + done.stderr)
            self.assertIn(r"b\xe2\x80\xae\x0a.pdb", done.stdout + done.stderr)


class SameBytes(Workplace):
    """Commands run twice, with another clock and another number of threads."""

    COMMANDS = [
        *[["render", "one.pdb", *SMALL, "-o", "a." + ending] for ending in ("png", "jpg", "webp", "tif", "exr")],
        ["render", "one.pdb", *SMALL, "--aovs", "-o", "b.exr"], ["render", "run.pdb", "--frames", "all", *SMALL, "-o", "a_#.exr"],
        ["render", "run.pdb", "--frames", "all", "--size", "64x48", "--samples", "1", "-o", "a.mp4"],
        ["render", "run.pdb", "--frames", "all", "--size", "64x48", "--samples", "1", "-o", "a.gif"],
        ["render", "one.pdb", *SMALL, "-o", "c.png", "--save-camera", "c.json", "--save-scene", "d.json"],
        *[["export", "mesh", "one.pdb", "-o", "a." + ending, "--tolerance", "0.3"]
          for ending in ("stl", "3mf", "obj", "off", "glb", "vtp", "ply", "smesh", "dms", "py", "usda", "usdz")],
        ["export", "blender", "one.pdb", "-o", "a.mns"], ["export", "blender", "run.pdb", "--frames", "all", "-o", "run"],
        ["export", "povray", "one.pdb", "-o", "povray"], ["export", "mitsuba", "one.pdb", "-o", "mitsuba"],
        ["export", "pbrt", "one.pdb", "-o", "pbrt"], ["export", "atoms", "one.pdb", "-o", "a.atoms"],
        ["export", "vdb", "one.pdb", "-o", "a.vdb", "--voxel", "1"], ["export", "page", "one.pdb", "-o", "a.html"],
        ["export", "mesh", "run.pdb", "--frames", "all", "-o", "b.usda", "--density", "1"],
        ["surface", "one.pdb", "--csv", "a.csv", "--csv-residues", "b.csv", "--gradients", "c.csv"],
        ["surface", "run.pdb", "--frames", "all", "--csv-series", "d.csv", "--csv-cavities", "e.csv", "--plot", "a.svg"],
        ["pockets", "one.pdb", "--csv", "f.csv", "--figure", "f.json", "--ligand", "none"],
    ]

    def made(self, threads, **environment):
        place = self.folder / f"with {threads}"
        place.mkdir()
        for name in INPUTS:
            shutil.copy(self.folder / name, place)
        for words in self.COMMANDS:
            done = self.run_program(*words, *ON_CPU, "--threads", threads, folder=place, env={**os.environ, **environment})
            self.assertEqual(done.returncode, 0, (words, done.stderr))
        return {str(path.relative_to(place)): path.read_bytes() for path in sorted(place.rglob("*")) if path.is_file()}

    def test_clock_and_threads_change_nothing(self):
        first = self.made(1)
        time.sleep(1.1)  # dates in files have whole seconds
        second = self.made(3)
        self.assertEqual(first.keys(), second.keys())
        self.assertEqual([name for name in first if first[name] != second[name]], [])
        dated = self.made(2, SOURCE_DATE_EPOCH="1700000000")
        self.assertEqual([name for name in first if first[name] != dated[name]],
                         [name for name in first if name.endswith((".exr", ".tif"))])
        self.assertIn(b"2023:11:14 22:13:20", dated["a.exr"])


if __name__ == "__main__":
    unittest.main()
