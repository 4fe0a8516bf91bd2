#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A picture is a run of one frame: a command makes the same of a model and of a frame that is this model."""

import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import OpenImageIO

PROGRAM = sys.argv.pop(1)
CAMERA = {"position": [4.0, 1.0, 60.0], "target": [4.0, 1.0, 0.0], "up": [0.0, 1.0, 0.0], "projection": "orthographic",
          "height": 16.0}


def models(count):
    """Returns five residues of two atoms; each model is a little longer than the one before."""
    lines = []
    for model in range(count):
        lines.append(f"MODEL     {model + 1:4d}")
        for n in range(10):
            name, element = (("N", "N"), ("CA", "C"))[n % 2]
            lines.append(f"ATOM  {n + 1:5d}  {name:<3} ALA A{n // 2 + 1:4d}    {n * (1.4 + 0.1 * model):8.3f}{n % 3:8.3f}"
                         f"{0.2 * n:8.3f}  1.00 10.00          {element:>2}")
        lines.append("ENDMDL")
    return "\n".join(lines + ["END", ""])


def pairs(count, apart=None):
    """Returns two slabs, chains A and B, which touch except in the model `apart`; B slides and leans out."""
    lines = []
    for model in range(count):
        lines.append(f"MODEL     {model + 1:4d}")
        for n in range(24):
            chain, (layer, row, column) = "AB"[n // 12], (n // 12, n % 12 // 4, n % 4)
            x, y, z = 2.6 * column + 0.3 * model * layer, 2.7 * row, (33.3 if model == apart else 3.3) * layer + 0.1 * model * layer * column
            lines.append(f"ATOM  {n + 1:5d}  CA  ALA {chain}{n % 12 + 1:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00 10.00           C")
        lines.append("ENDMDL")
    return "\n".join(lines + ["END", ""])


def shells(count):
    """Returns atoms on a sphere, around a cavity; in the second model they are scattered and enclose nothing."""
    lines = []
    for model in range(count):
        lines.append(f"MODEL     {model + 1:4d}")
        radius = 30.0 if model == 1 else 5.0 + 0.2 * model
        for n in range(60):
            z = 1.0 - (2 * n + 1) / 60
            around, turn = radius * (1.0 - z * z) ** 0.5, 2.399963 * n
            lines.append(f"ATOM  {n + 1:5d}  CA  ALA A{n + 1:4d}    {around * math.cos(turn):8.3f}{around * math.sin(turn):8.3f}"
                         f"{radius * z:8.3f}  1.00 10.00           C")
        lines.append("ENDMDL")
    return "\n".join(lines + ["END", ""])


#: Chain A has two places: unchanged, and turned half around z, 40 Å to the side.
ASSEMBLY = """REMARK 350 BIOMOLECULE: 1
REMARK 350 APPLY THE FOLLOWING TO CHAINS: A
REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000
REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000
REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000
REMARK 350   BIOMT1   2 -1.000000  0.000000  0.000000       40.00000
REMARK 350   BIOMT2   2  0.000000 -1.000000  0.000000        2.00000
REMARK 350   BIOMT3   2  0.000000  0.000000  1.000000        0.00000
"""


class RunsLikePictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "run.pdb").write_text(models(3))

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def pixels(self, name):
        picture = OpenImageIO.ImageInput.open(str(self.folder / name))
        return picture.read_image("uint8")

    def test_meshes(self):
        for ending in ("ply", "obj", "glb"):
            printed = self.run_program("export", "mesh", "run.pdb", "--frames", "all", "-o", f"m_##.{ending}", "-q")
            self.assertEqual(printed.split(), [f"m_{n:02}.{ending}" for n in range(3)])
            for n in range(3):
                self.run_program("export", "mesh", "run.pdb", "--model", str(n + 1), "-o", f"one.{ending}", "-q", "--force")
                self.assertEqual((self.folder / f"m_{n:02}.{ending}").read_bytes(), (self.folder / f"one.{ending}").read_bytes())

    def test_a_mesh_of_each_frame_needs_a_name_of_its_own(self):
        done = subprocess.run([PROGRAM, "export", "mesh", "run.pdb", "--frames", "all", "-o", "m.ply"], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("m_#####.ply", done.stderr)

    def test_labels_follow_their_atoms(self):
        words = ["--camera", json.dumps(CAMERA), "--size", "160x120", "--samples", "1", "--label", "resid 5=End", "-q"]
        self.run_program("render", "run.pdb", "--frames", "all", "-o", "f_#.png", *words)
        for n in range(3):
            self.run_program("render", "run.pdb", "--model", str(n + 1), "-o", f"one_{n}.png", *words)
            self.assertTrue((self.pixels(f"f_{n}.png") == self.pixels(f"one_{n}.png")).all(), n)
        self.assertFalse((self.pixels("one_0.png") == self.pixels("one_2.png")).all())

    def test_a_camera_that_moves_is_saved_as_a_path(self):
        size = ["--size", "80x60", "--samples", "1", "-q"]
        for extent in ([], ["--extent", "visible", "--device", "software"]):
            moving = ["--frames", "2,0,1", "--turntable", "0.5", "--follow", "resid 5", *size, *extent]
            self.run_program("render", "run.pdb", *moving, "-o", "f_#.png", "--save-camera", "path.json", "--force")
            keys = json.loads((self.folder / "path.json").read_text())["keys"]
            self.assertEqual([key["frame"] for key in keys], [0, 1, 2])
            self.assertNotEqual(keys[0]["camera"], keys[1]["camera"])
            self.run_program("render", "run.pdb", "--frames", "2,0,1", *size, *extent, "-o", "g_#.png", "--camera-path", "path.json",
                             "--save-camera", "again.json", "--force")
            self.assertEqual((self.folder / "again.json").read_text(), (self.folder / "path.json").read_text())
            for n in range(3):
                self.assertTrue((self.pixels(f"f_{n}.png") == self.pixels(f"g_{n}.png")).all(), n)

    def test_frames_without_room_for_labels_are_made_and_told(self):
        words = ["--camera", json.dumps(CAMERA), "--size", "160x120", "--samples", "1"]
        crowd = ["--label-size", "40px"] + [word for n in range(1, 6) for word in ("--label", f"resid {n}=A long name")]
        alone = subprocess.run([PROGRAM, "render", "run.pdb", "-o", "one.png", *words, *crowd], cwd=self.folder, capture_output=True,
                               text=True)
        self.assertEqual(alone.returncode, 2, alone.stderr)
        self.assertIn("no room for all labels", alone.stderr)
        self.run_program("render", "run.pdb", "--frames", "all", "-o", "bare_#.png", "-q", *words)
        for output in ("f_#.png", "f.mp4"):
            done = subprocess.run([PROGRAM, "render", "run.pdb", "--frames", "all", "-o", output, *words, *crowd], cwd=self.folder,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("3 of the pictures lack their labels (first: frame 0)", done.stderr)
        for n in range(3):
            self.assertTrue((self.pixels(f"f_{n}.png") == self.pixels(f"bare_{n}.png")).all(), n)

    def test_objects(self):
        beside = json.dumps({"representation": "surface", "selection": "resid 4-5", "color": "red"})
        words = ["--select", "resid 1-3", "--object", beside, "--camera", json.dumps(CAMERA), "-q"]
        self.run_program("export", "blender", "run.pdb", "--frames", "all", "-o", "blender", *words)
        for n in range(3):
            self.assertIn(b"object 1", (self.folder / f"blender/surface_{n:05}.mns").read_bytes())
        self.run_program("export", "mitsuba", "run.pdb", "--frames", "all", "-o", "mitsuba", *words)
        self.run_program("export", "mitsuba", "run.pdb", "--model", "2", "-o", "one", *words)
        shapes = [(self.folder / path).read_text().count("<shape") for path in ("mitsuba/surface_00001.xml", "one/surface.xml")]
        self.assertEqual(shapes[0], shapes[1])
        self.assertGreater(shapes[0], 1)

    def check_meshes(self, *words):
        """The mesh of each frame is that of its model."""
        self.run_program("export", "mesh", *words, "--frames", "all", "-o", "mesh_#.ply", "-q", "--force")
        for n in range(3):
            self.run_program("export", "mesh", *words, "--model", str(n + 1), "-o", "one.ply", "-q", "--force")
            self.assertEqual((self.folder / f"mesh_{n}.ply").read_bytes(), (self.folder / "one.ply").read_bytes(), n)

    def test_an_interface_opens_in_each_frame(self):
        (self.folder / "pair.pdb").write_text(pairs(3))
        self.check_meshes("pair.pdb", "--interface", "A:B", "--color-range", "0:20")
        size = ["--interface", "A:B", "--size", "160x120", "--samples", "1", "-q"]
        camera = ["--camera", json.dumps({**CAMERA, "position": [0.0, 0.0, 60.0], "target": [0.0, 0.0, 0.0], "height": 30.0})]
        words = size + camera + ["--color-range", "0:20"]
        self.run_program("render", "pair.pdb", "--frames", "all", "-o", "f_#.png", *words)
        for n in range(3):
            self.run_program("render", "pair.pdb", "--model", str(n + 1), "-o", f"one_{n}.png", *words)
            self.assertTrue((self.pixels(f"f_{n}.png") == self.pixels(f"one_{n}.png")).all(), n)
        self.assertFalse((self.pixels("one_0.png") == self.pixels("one_2.png")).all())
        # All frames have one scale, up to the largest number of any, and one camera that shows the pages of all.
        self.run_program("render", "pair.pdb", "--frames", "2", "-o", "alone_#.png", *size)
        self.run_program("render", "pair.pdb", "--model", "3", "-o", "alone.png", *size)
        self.assertTrue((self.pixels("alone_2.png") == self.pixels("alone.png")).all())
        self.run_program("render", "pair.pdb", "--frames", "all", "-o", "g_#.png", *size)
        # The workers of a bundle get both.
        self.run_program("farm", "bundle", "bundle", "--engine", "make", "--chunk-frames", "1", "--", "render", "pair.pdb",
                         "--frames", "all", *size[:-1])
        self.assertIn("--color-range", (self.folder / "bundle/bundle.json").read_text())
        self.run_program("work", "bundle")
        for n in range(3):
            self.assertEqual(self.pixels(f"g_{n}.png")[:, [0, 1, -2, -1], 3].max(), 0, n)
            self.assertTrue((self.pixels(f"g_{n}.png") == self.pixels(f"bundle/images/frame_{n:05}.png")).all(), n)

    def test_a_frame_whose_sides_do_not_touch_fails_alone(self):
        (self.folder / "pair.pdb").write_text(pairs(3, apart=1))
        done = subprocess.run([PROGRAM, "render", "pair.pdb", "--frames", "all", "-o", "f_#.png", "--interface", "A:B", "--size",
                               "80x60", "--samples", "1"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("do not touch", done.stderr)
        self.assertEqual(sorted(path.name for path in self.folder.glob("f_*.png")), ["f_0.png", "f_2.png"])

    def test_assemblies(self):
        """Copies follow the motions of each frame, as atoms or as one surface in two places."""
        (self.folder / "twice.pdb").write_text(ASSEMBLY + models(3))
        wide = {**CAMERA, "position": [20.0, 1.0, 60.0], "target": [20.0, 1.0, 0.0], "height": 36.0}
        shown = []
        for kind, words in ("atoms", []), ("exact", ["--instances", "exact"]):
            options = ["twice.pdb", "--assembly", "1", *words]
            self.check_meshes(*options)
            size = [*options, "--size", "160x120", "-q"]
            view = [*size, "--camera", json.dumps(wide)]
            self.run_program("render", "--frames", "all", "-o", f"{kind}_#.png", *view)
            for n in range(3):
                self.run_program("render", "--model", str(n + 1), "-o", f"{kind}_one_{n}.png", *view)
                self.assertTrue((self.pixels(f"{kind}_{n}.png") == self.pixels(f"{kind}_one_{n}.png")).all(), (kind, n))
            self.run_program("render", "--frames", "2", "-o", f"{kind}_alone_#.png", *size)
            self.run_program("render", "--model", "3", "-o", f"{kind}_alone.png", *size)
            self.assertTrue((self.pixels(f"{kind}_alone_2.png") == self.pixels(f"{kind}_alone.png")).all(), kind)
            shown.append(self.pixels(f"{kind}_2.png"))
            self.run_program("export", "blender", "--frames", "all", "-o", f"blender_{kind}", *view)
            self.run_program("export", "pbrt", "--frames", "2", "-o", f"pbrt_{kind}", *view)
            self.run_program("export", "pbrt", "--model", "3", "-o", f"pbrt_{kind}_one", *view)
            texts = [(self.folder / path).read_text() for path in (f"pbrt_{kind}/surface_00002.pbrt", f"pbrt_{kind}_one/surface.pbrt")]
            self.assertEqual(texts[0].count("ObjectInstance"), texts[1].count("ObjectInstance"))
            self.run_program("export", "povray", "--frames", "all", "-o", f"povray_{kind}", *view)
            placed = (self.folder / f"povray_{kind}/surface_geometry_00002.inc").read_text().count("object{object_1")
            self.assertEqual(placed, 2 if kind == "exact" else 0)
        self.assertTrue((shown[0] == shown[1]).all())
        sizes = [(self.folder / f"blender_{kind}/surface_00000.mns").stat().st_size for kind in ("atoms", "exact")]
        self.assertLess(sizes[1], sizes[0])
        areas = [self.run_program("surface", "twice.pdb", "--assembly", "1", "--frames", "all", *words, "--csv-series", "-", "-q")
                 for words in ([], ["--instances", "separate"])]
        self.assertEqual(areas[0], areas[1])

    def test_pockets(self):
        """Meshes and scenes are those of the models, and a scene shows its frame alone; a frame may have none."""
        (self.folder / "shells.pdb").write_text(shells(3))
        words = ["pockets", "shells.pdb", "--min-volume", "1", "-q"]
        self.run_program(*words, "--frames", "all", "--mesh", "mesh_#.ply", "--figure", "figure_#.json")
        for n in (0, 2):
            self.run_program(*words, "--model", str(n + 1), "--mesh", "one.ply", "--force")
            self.assertEqual((self.folder / f"mesh_{n}.ply").read_bytes(), (self.folder / "one.ply").read_bytes(), n)
            scene = json.loads((self.folder / f"figure_{n}.json").read_text())
            self.assertEqual(scene["frames"]["frames"], n)
            self.assertIn("=#", scene["objects"][0]["color"][1])
        self.assertFalse((self.folder / "mesh_1.ply").exists())
        self.run_program("render", "--scene", "figure_2.json", "--trust-scene", "-o", "p_#.png", "--size", "80x60", "-q")
        self.assertTrue((self.folder / "p_2.png").exists())

    def test_a_surface_that_is_hidden(self):
        words = ["--hide-surface", "--sticks", "all", "--camera", json.dumps(CAMERA), "-q"]
        self.run_program("export", "blender", "run.pdb", "--frames", "0-1", "-o", "blender", *words)
        self.run_program("export", "blender", "run.pdb", "--frames", "0-1", "-o", "both", *words[1:])
        hidden, both = (self.folder / f"{name}/surface_00001.mns" for name in ("blender", "both"))
        self.assertLess(hidden.stat().st_size, both.stat().st_size)

    def test_a_legend_beside_a_bundle(self):
        """The legend is written when the bundle is made, as the command itself writes it; workers do not write it."""
        words = ["render", "run.pdb", "--frames", "all", "--color", "radial", "--size", "480x360", "--samples", "1"]
        self.run_program(*words, "-o", "f_#.png", "--legend-file", "legend.png", "-q")
        bundle = ["farm", "bundle", "bundle", "--engine", "make", "--chunk-frames", "1", "--", *words, "--legend-file", "beside.png"]
        self.run_program(*bundle)
        self.assertTrue((self.pixels("legend.png") == self.pixels("beside.png")).all())
        self.assertNotIn("legend", (self.folder / "bundle/bundle.json").read_text())
        self.run_program("work", "bundle")
        self.assertTrue((self.pixels("f_2.png") == self.pixels("bundle/images/frame_00002.png")).all())
        self.run_program(*bundle)  # this finds nothing to do
        done = subprocess.run([PROGRAM, *bundle[:2], "other", *bundle[3:]], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertFalse((self.folder / "other").exists())

    def test_views_without_the_whole_surface(self):
        """Colours, selections, labels and the output of --stats are those of each frame."""
        words = ["--extent", "visible", "--device", "software", "--camera", json.dumps(CAMERA), "--size", "160x120", "--samples", "1",
                 "--color", "radial", "--color-range", "0:9", "--select", "within 7.6 of resid 1", "--label", "name CA=C"]
        done = subprocess.run([PROGRAM, "render", "run.pdb", "--frames", "all", "-o", "f_#.png", "--stats", "-q", *words],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        kept = re.findall(r"frame (\d+)\n.* of (\d+) atoms can matter", done.stderr)
        for n in range(3):
            self.run_program("render", "run.pdb", "--model", str(n + 1), "-o", f"one_{n}.png", "-q", *words)
            self.assertTrue((self.pixels(f"f_{n}.png") == self.pixels(f"one_{n}.png")).all(), n)
        self.assertEqual([number for number, _ in kept], ["0", "1", "2"])
        self.assertGreater(int(kept[0][1]), int(kept[2][1]))
        # Layers need components and atoms of the file, which a view lacks, in a run as in a picture.
        for choice in ("--frames", "1", "-o", "a_#.exr"), ("--model", "1", "-o", "a.exr"):
            done = subprocess.run([PROGRAM, "render", "run.pdb", *choice, "--extent", "visible", "--aovs"], cwd=self.folder,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--aovs needs the complete surface", done.stderr)

    def check_frames(self, run, models):
        """Compares pictures of a run with those of each model by the words of its frame."""
        size = ["--camera", json.dumps(CAMERA), "--size", "160x120", "--samples", "1", "-q", "--force"]
        self.run_program("render", "run.pdb", "--frames", "all", "-o", "f_#.png", *size, *run)
        for n, words in enumerate(models):
            self.run_program("render", "run.pdb", "--model", str(n + 1), "-o", f"one_{n}.png", *size, *words)
            self.assertTrue((self.pixels(f"f_{n}.png") == self.pixels(f"one_{n}.png")).all(), n)
        self.assertFalse((self.pixels("one_0.png") == self.pixels("one_2.png")).all())

    def test_numbers_of_a_file_where_atoms_come_and_go(self):
        """All frames have one scale, that of all numbers."""
        color = ["--color", "file", "--sticks", "within 4 of resid 2", "--color-by-file"]
        rows = [[f"{n},{(n + 3 * frame) % 7}\n" for n in range(1, 11)] for frame in range(3)]
        (self.folder / "moving.csv").write_text(
            "frame,index,score\n" + "".join(f"{frame},{row}" for frame in range(3) for row in rows[frame]))
        for frame in range(3):
            (self.folder / f"at_{frame}.csv").write_text("index,score\n" + "".join(rows[frame]))
        self.check_frames([*color, "moving.csv"], [[*color, f"at_{n}.csv", "--color-range", "0:6"] for n in range(3)])

    def test_comments_name_the_atoms_of_each_frame(self):
        words = ["export", "povray", "run.pdb", "--comments", "--select", "within 7.6 of resid 1", "-q", "--camera", json.dumps(CAMERA)]
        self.run_program(*words, "--frames", "all", "-o", "povray")
        for n in range(3):
            self.run_program(*words, "--model", str(n + 1), "-o", f"one_{n}")
            run, one = ({line for line in (self.folder / path).read_text().splitlines() if line.startswith("// ") and " ALA " in line}
                        for path in (f"povray/surface_geometry_{n:05}.inc", f"one_{n}/surface_geometry.inc"))
            self.assertGreater(len(one), 10)
            self.assertEqual(run, one, n)
        # Objects next to the surface have names, too.
        self.run_program("export", "povray", "run.pdb", "--comments", "--select", "resid 1", "--object", '{"selection": "resid 2-5"}',
                         "-o", "beside", "-q")
        self.assertIn("ALA 5", (self.folder / "beside/surface_object_1.inc").read_text())

    def test_layers_in_a_bundle(self):
        self.run_program("farm", "bundle", "bundle", "--engine", "make", "--chunk-frames", "1", "--", "render", "run.pdb",
                         "--frames", "0-1", "--size", "40x30", "--samples", "1", "--aovs")
        self.run_program("work", "bundle")
        picture = OpenImageIO.ImageInput.open(str(self.folder / "bundle/images/frame_00001.exr"))
        self.assertIn("Z", picture.spec().channelnames)


if __name__ == "__main__":
    unittest.main()
