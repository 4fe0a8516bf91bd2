#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The visible parts of a picture, and errors before work begins."""

import json
import math
import struct
import subprocess
import unittest

import OpenImageIO

import molecule_case

SMALL = ["--size", "96x72", "--samples", "1", "--device", "cpu"]


def pdb(atoms):
    """Returns the text of atoms, each (name, residue, chain, residue number, position in Å)."""
    return molecule_case.pdb([("HETATM" if residue == "LIG" else "ATOM", f" {name:<3}", residue, chain, number, place, name[0])
                              for name, residue, chain, number, place in atoms])


def slab(z=0.0, chain="A", rows=4):
    """Returns carbon atoms on a grid across the z axis."""
    return [("CA", "ALA", chain, row * rows + column + 1, (3.0 * column, 3.0 * row, z))
            for row in range(rows) for column in range(rows)]


class Workplace(molecule_case.MoleculeCase):
    def setUp(self):
        super().setUp()
        self.write("slab.pdb", pdb(slab()))

    def made(self, *words):
        """Returns the standard error stream of a program that must succeed."""
        return super().made(*words).stderr

    def refused(self, code, said, *words):
        """Runs a program that must fail, and leave all files unchanged."""
        before = {path: path.stat().st_mtime_ns for path in self.folder.rglob("*") if path.is_file()}
        done = self.run_program(*words)
        self.assertEqual((done.returncode, said in done.stderr), (code, True), f"{said}: {done.stderr}")
        after = {path: path.stat().st_mtime_ns for path in self.folder.rglob("*") if path.is_file()}
        self.assertEqual(after, before)
        return done.stderr

    def picture(self, name):
        """Returns the names of the picture's channels, and their values."""
        file = OpenImageIO.ImageInput.open(str(self.folder / name))
        values = file.read_image(OpenImageIO.FLOAT)
        names = list(file.spec().channelnames)
        file.close()
        return names, values

    def pixels(self, name):
        return self.picture(name)[1]

    def scene(self, name, **sections):
        self.write(name, json.dumps({"meniscus_scene": 1, "molecule": {"file": "slab.pdb"}, **sections}))
        return name


class BeforeWork(Workplace):
    """Errors that options and sizes alone determine are reported before the first output, and before anything long."""

    def setUp(self):
        super().setUp()
        models = "".join(f"MODEL {n:8d}\n{pdb(slab()).replace('END', 'ENDMDL')}" for n in range(1, 5))
        self.write("run.pdb", models + "END\n")
        self.still = self.scene("still.json", image={"size": "64x48", "samples": 1})

    def test_a_later_scene_of_a_film(self):
        """Each scene has another fault, and the scene before it is valid."""
        wrong = {"no room for all labels": {"annotations": {"labels": ["resid 1=" + 60 * "w", "resid 2=" + 60 * "v"]}},
                 "--title": {"annotations": {"title": 200 * "w"}}, "--scale-bar": {"annotations": {"scale_bar": 1e5}},
                 "nothing to explain": {"objects": [{"color": "red"}], "legend": {"shown": True}},
                 "nothing beside it": {"objects": [{"representation": "surface", "shown": False}]},
                 "--label": {"annotations": {"labels": ["resname XYZ=x"]}}}
        for said, sections in wrong.items():
            second = self.scene("second.json", **sections)
            with self.subTest(said):
                err = self.refused(3 if said == "--label" else 2, said, "film", self.still, second, "-o", "o_###.png", "--hold", "0.1",
                                   "--transition", "0.1", "-q")
                self.assertIn("slab.pdb" if said == "--label" else "second.json: ", err)

    def test_a_later_frame_of_a_run(self):
        """The camera goes so near that the bar no longer fits."""
        camera = {"position": [4, 4, 300], "target": [4, 4, 0], "up": [0, 1, 0], "projection": "orthographic", "height": 300}
        keys = [{"frame": 0, "camera": camera}, {"frame": 3, "camera": {**camera, "height": 6}}]
        self.write("path.json", json.dumps({"keys": keys}))
        self.refused(2, "--scale-bar", "render", "run.pdb", "--frames", "all", "--camera-path", "path.json", "--scale-bar", "20", "-o",
                     "f_#.png", *SMALL)

    def test_names_and_formats_of_films(self):
        for words, said in ((["-o", "f.mp4", "--codec", "gif"], "--codec gif"), (["-o", "f.mp4", "--size", "63x47"], "even numbers"),
                            (["-o", "f.png"], "would replace the one before"), (["-o", "f.mp4", "--only", "1"], "--only"),
                            (["-o", "f.mp4", "--background", "transparent"], "keeps no transparency"),
                            (["-o", "f.mov", "--background", "transparent", "--codec", "h264"], "keeps no transparency")):
            with self.subTest(said):
                err = self.refused(2, said, "render", "run.pdb", "--frames", "all", *words)
                self.assertNotIn("frames; this run has", err)  # nothing was read
                if "--only" not in words:
                    err = self.refused(2, said, "film", self.still, self.still, *words)
                    self.assertNotIn("surface on", err)

    def test_a_later_picture_that_is_there(self):
        self.write("f_2.png", "mine")
        self.refused(6, "f_2.png", "render", "run.pdb", "--frames", "all", "-o", "f_#.png", *SMALL)
        self.refused(6, "f_2.png", "film", self.still, self.still, "-o", "f_#.png", "--hold", "0.1", "--transition", "0.1")

    def test_inputs_before_outputs(self):
        self.write("there.png", "mine")
        self.write("there.mp4", "mine")
        lost = self.scene("lost.json", molecule={"file": "no.pdb"})
        for words in (["render", "no.pdb", "-o", "there.png"], ["render", "slab.pdb", "--trajectory", "no.pdb", "-o", "there.mp4"],
                      ["surface", "no.pdb", "--csv", "there.png"], ["export", "ply", "no.pdb", "-o", "there.png"],
                      ["film", lost, self.still, "-o", "there.mp4"], ["panels", lost, self.still, "-o", "there.png"],
                      ["film", "no.png", self.still, "-o", "there.mp4"], ["render", "slab.pdb", "--color-by-file", "no.pdb", "-o", "there.png"]):
            with self.subTest(words):
                self.assertNotIn("exist", self.refused(3, "no.p", *words).replace("there is no such file", ""))

    def test_trajectories_need_a_topology(self):
        # This is the head of a CHARMM DCD file.
        head = struct.pack("<i4s20i", 84, b"CORD", 1, 0, 1, *17 * [0]) + struct.pack("<i", 84)
        (self.folder / "a.dcd").write_bytes(head + struct.pack("<ii80si", 84, 1, b" " * 80, 84) + struct.pack("<iii", 4, 1, 4))
        for output in ("b.mp4", "b.png"):
            self.assertIn("topology", self.refused(2, "a.dcd", "render", "a.dcd", "-o", output))
        self.refused(2, "--turntable", "render", "slab.pdb", "-o", "b.mp4")

    def test_a_turntable_is_a_film(self):
        said = self.made("render", "slab.pdb", "--turntable", "1", "--fps", "2", "-o", "f_#.png", *SMALL)
        self.assertIn("--repeat", said)
        self.assertEqual(len(list(self.folder.glob("f_*.png"))), 8)  # 4 s
        said = self.made("render", "run.pdb", "--model", "2", "--turntable", "1", "--fps", "1", "-o", "g_#.png", *SMALL)
        self.assertEqual(len(list(self.folder.glob("g_*.png"))), 4)
        self.refused(2, "--repeat", "export", "povray", "slab.pdb", "--turntable", "1", "-o", "scene")

    def test_a_film_has_the_size_of_a_screen(self):
        def size(name):
            done = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0", name],
                                  cwd=self.folder, capture_output=True, text=True, check=True)
            return done.stdout.strip()

        turn = ["render", "slab.pdb", "--turntable", "1", "--fps", "0.5", "--samples", "1", "--device", "cpu"]
        self.made(*turn, "-o", "a.mp4", "--save-scene", "a.json")
        self.made(*turn, "-o", "a.gif")
        self.made(*turn, "-o", "b.mp4", "--width", "128px")
        self.assertEqual([size(name) for name in ("a.mp4", "a.gif", "b.mp4")], ["1920,1080", "960,540", "128,96"])
        self.assertEqual(json.loads((self.folder / "a.json").read_text())["image"]["size"], "1920x1080")

    def test_one_ligand_of_several_is_looked_into(self):
        far = [("C1", "LIG", chain, 90, (4.5, 4.5 + y, 5.0)) for chain, y in (("L", 0.0), ("M", 40.0))]
        self.write("far.pdb", pdb(slab() + slab(z=10.0, chain="B") + far))
        look = ["render", "far.pdb", "--select", "polymer", "--sticks", "ligand", "--color", "grey", "--color", "ligand=red", *SMALL]
        said = self.made(*look, "--look-into", "ligand", "-o", "a.png", "--save-scene", "a.json")
        self.assertIn("'ligand' is at several places, the first two 40 Å apart, and the first is shown; name one, such as "
                      "'resid 90 and chain M'", said)
        self.made(*look, "--look-into", "chain L", "-o", "b.png")
        self.made("render", "--scene", "a.json", "-o", "c.png")
        self.assertTrue((self.pixels("a.png") == self.pixels("b.png")).all())
        self.assertTrue((self.pixels("a.png") == self.pixels("c.png")).all())
        self.assertIn("the picture has all of them", self.made(*look, "--zoom-to", "ligand", "-o", "d.png"))
        self.assertNotIn("places", self.made(*look, "--zoom-to", "polymer", "-o", "e.png"))

    def test_pictures_that_take_hours(self):
        huge = self.scene("huge.json", image={"size": "65535x65535", "samples": 1024})
        for words in (["render", "--scene", huge], ["film", huge, huge], ["panels", huge, huge]):
            with self.subTest(words):
                self.assertIn("4.4e+12 rays", self.refused(2, "--any-cost", *words, "-o", "o_#.png" if words[0] == "film" else "o.png"))
        self.assertNotIn("rays", self.refused(2, "--aovs", "render", "--scene", huge, "-o", "o.png", "--any-cost", "--aovs"))
        self.refused(2, "--any-cost", "render", "run.pdb", "--frames", "all", "--motion-blur", "256", "--samples", "64", "-o", "o_#.png")


class Scenes(Workplace):
    def test_a_picture_finds_its_molecule(self):
        """The molecule is searched in the picture's folder, then in the working folder."""
        (self.folder / "out").mkdir()
        self.made("render", "slab.pdb", "-o", "out/a.png", *SMALL)
        for n, words in enumerate((["film", "out/a.png", "out/a.png", "--hold", "0.04", "--transition", "0", "-o", "f_#.png"],
                                   ["panels", "out/a.png", "-o", "p.png"], ["render", "--scene", "out/a.png", "-o", "r.png"],
                                   ["export", "ply", "--scene", "out/a.png", "-o", "m.ply"], ["surface", "--scene", "out/a.png"])):
            with self.subTest(words):
                self.made(*words)
        self.assertEqual((self.folder / "r.png").read_bytes(), (self.folder / "out/a.png").read_bytes())
        self.write("out/slab.pdb", pdb(slab(rows=2)))
        self.assertIn("4 atoms", self.made("render", "--scene", "out/a.png", "-o", "near.png"))

    def test_who_asks_is_said(self):
        (self.folder / "out").mkdir()
        self.made("render", "slab.pdb", "-o", "out/a.png", *SMALL)
        (self.folder / "slab.pdb").unlink()
        for words in (["film", "out/a.png", "out/a.png", "-o", "f_#.png"], ["panels", "out/a.png", "-o", "p.png"],
                      ["render", "--scene", "out/a.png", "-o", "r.png"], ["preview", "--serve", "--scene", "out/a.png"]):
            with self.subTest(words):
                self.assertIn("slab.pdb'", self.refused(3, "out/a.png: scene: molecule.file", *words))


class Camera(Workplace):
    def rim(self, name):
        """Returns the largest opacity along the border of the picture, and of the whole picture."""
        alpha = self.pixels(name)[:, :, 3]
        return max(alpha[0].max(), alpha[-1].max(), alpha[:, 0].max(), alpha[:, -1].max()), alpha.max()

    def check_framed(self, *words):
        for projection in ("perspective", "orthographic"):
            name = f"{projection}.png"
            self.made("render", *words, "--projection", projection, "--preset", "flat", "-o", name, "--force", *SMALL)
            self.assertEqual(self.rim(name), (0.0, 1.0), words)

    def test_objects_and_shapes_are_framed(self):
        far = [("C1", "LIG", "B", 1, (70.0, 5.0, 5.0)), ("C2", "LIG", "B", 1, (71.5, 5.0, 5.0))]
        self.write("far.pdb", pdb(slab() + slab(z=40.0, chain="C") + far))
        surface = '{"representation": "surface", "selection": "chain C", "kind": "sas", "probe": 6}'
        for words in (["--select", "chain A", "--sticks", "chain C"], ["--select", "chain A", "--object", surface],
                      ["--select", "chain A", "--spheres", "resname LIG"], ["--show", "chain A", "--sticks", "chain C"],
                      ["--hide-surface", "--select", "chain A", "--balls", "resname LIG"],
                      ["--show", "chain A", "--object", '{"representation": "spheres", "selection": "chain C"}']):
            with self.subTest(words):
                self.check_framed("far.pdb", *words)
        steps = [(1.0 - (2 * n + 1) / 60, 2.399963 * n) for n in range(60)]
        shell = [("CA", "ALA", "A", n + 1, (6 * (1 - z * z) ** 0.5 * math.cos(turn), 6 * (1 - z * z) ** 0.5 * math.sin(turn), 6 * z))
                 for n, (z, turn) in enumerate(steps)]
        self.write("shell.pdb", pdb(shell))
        self.check_framed("shell.pdb", "--cavities", "only", "--object", '{"representation": "surface", "selection": "all"}')

    def test_in_runs(self):
        models = "".join(f"MODEL {n:8d}\n" + pdb(slab() + [("C1", "LIG", "B", 1, (20.0 * n, 5.0, 5.0))]).replace("END", "ENDMDL")
                         for n in (1, 2, 3))
        self.write("run.pdb", models + "END\n")
        for n, words in enumerate((["--spheres", "resname LIG"], ["--zoom-to", "resname LIG", "--spheres", "resname LIG"])):
            self.made("render", "run.pdb", "--frames", "all", "--select", "chain A", *words, "--preset", "flat", "-o", f"{n}_#.png", *SMALL)
            for frame in range(3):
                if "--zoom-to" not in words:
                    self.assertEqual(self.rim(f"{n}_{frame}.png"), (0.0, 1.0), words)


class Cuts(Workplace):
    """Two atoms along the line of sight are drawn as spheres, sticks and balls next to a slab."""

    LOOK = ["--preset", "flat", "--view", "z", "--projection", "orthographic", "--background", "white", *SMALL]

    def setUp(self):
        super().setUp()
        pair = [("C1", "LIG", "B", 1, (4.5, 4.5, 7.0)), ("C2", "LIG", "B", 1, (4.5, 4.5, 8.4))]
        self.write("pair.pdb", pdb(slab() + pair))
        self.base = ["render", "pair.pdb", "--select", "chain A", "--color", "blue", *self.LOOK]

    def test_shapes_are_cut_if_asked(self):
        for kind in ("sticks", "balls", "spheres"):
            beside = [f"--{kind}", "resname LIG"]
            self.made(*self.base, "-o", "bare.png", "--force")
            whole = self.made(*self.base, *beside, "--clip", "z<4", "-o", "whole.png", "--force")
            self.assertIn("--clip-all", whole)
            self.assertNotIn("--clip-all", self.made(*self.base, *beside, "--clip", "z<20", "-o", "idle.png", "--force"))
            cut = self.made(*self.base, *beside, "--clip", "z<4", "--clip-all", "-o", "cut.png", "--force")
            self.assertNotIn("--clip-all", cut)
            self.assertTrue((self.pixels("cut.png") == self.pixels("bare.png")).all(), kind)
            self.assertFalse((self.pixels("whole.png") == self.pixels("bare.png")).all(), kind)

    def test_where_they_are_cut_they_are_solid(self):
        """A plane cuts two overlapping spheres: the section has the requested colour."""
        self.made("render", "pair.pdb", *SMALL, "--hide-surface", "--object", '{"representation": "spheres", "selection": "resname LIG", "color": "red"}',
                  "--clip", "z<7.6", "--clip-all", "--camera", json.dumps({"position": [4.5, 4.5, 40], "target": [4.5, 4.5, 0],
                  "up": [0, 1, 0], "projection": "orthographic", "height": 1.6}).replace(" ", ""), "-o", "caps.exr", "--aovs")
        names, values = self.picture("caps.exr")
        self.assertEqual(set(values[:, :, names.index("kind")].ravel()), {4.0})
        self.assertLess(abs(values[:, :, names.index("P.z")] - 7.6).max(), 1e-3)

    def test_exports_refuse(self):
        scene = self.scene("cut.json", objects=[{"clip": ["z<4"], "clip_all": True}, {"representation": "sticks", "selection": "chain A"}])
        for command in (["export", "povray"], ["export", "blender"], ["export", "page"], ["export", "pbrt"]):
            self.refused(2, "--clip-all", *command, "--scene", scene, "-o", "out")


class Seen(Workplace):
    """A wall of chain A has chain B behind it, and chain C is in the middle of a block."""

    def setUp(self):
        super().setUp()
        block = [("CA", "ALA", "C" if (x, y, z) == (2, 2, 2) else "A", 100 + 25 * x + 5 * y + z, (3.0 * x, 3.0 * y, 3.0 * z - 12.0))
                 for x in range(5) for y in range(5) for z in range(5)]
        behind = [("CA", "ALA", "B", 1, (6.0, 6.0, -16.0))]
        self.write("block.pdb", pdb(block + behind))
        self.base = ["render", "block.pdb", "--view", "z", "--size", "240x180", "--samples", "1", "--device", "cpu"]

    def turned(self, said, what):
        line = next(line for line in said.splitlines() if what in line and "no pixel" in line)
        words = line.split("; ")[1].split()
        return [word for word in words if word == "--turn" or word[0] in "xy" and word[1:].lstrip("-").isdigit()]

    def test_what_no_pixel_shows_is_said_with_the_turn_that_shows_it(self):
        for option, value in (("--color", "chain B=red"), ("--label", "chain B=here"), ("--patches", "chain B")):
            extra = ["--min-patch", "0"] if option == "--patches" else []
            said = self.made(*self.base, option, value, *extra, "-o", "a.png", "--force")
            turn = self.turned(said, option)
            self.assertIn(len(turn), (2, 4), said)
            self.assertNotIn("no pixel", self.made(*self.base, option, value, *extra, *turn, "-o", "b.png", "--force"))

    def test_what_is_seen_and_what_never_is(self):
        self.assertNotIn("no pixel", self.made(*self.base, "--color", "chain A=red", "--label", "chain A=here", "-o", "a.png"))
        self.assertIn("no side was found", self.made(*self.base, "--color", "chain C=red", "-o", "b.png"))
        # A rule that others overrule has no atoms left, and translucent parts are not mentioned.
        self.assertNotIn("no pixel", self.made(*self.base, "--color", "chain B=red", "--color", "all=blue", "-o", "c.png"))
        self.assertNotIn("no pixel", self.made(*self.base, "--color", "chain C=red", "--opacity", "0.4", "-o", "d.png"))

    def ring(self, *words):
        """Returns how much darker the middle of the mark is than its surroundings."""
        said = self.made(*self.base, "--label", *words, "--letter-size", "16", "--color", "white", "--preset", "flat",
                         "--background", "white", "--silhouettes", "0", "-o", "ring.png", "--force")
        picture = self.pixels("ring.png")[:, :, :3].mean(axis=2)
        return said, picture[89:91, 119:121].min()

    def test_marks_of_hidden_atoms_are_hollow(self):
        said, dark = self.ring("resid 160 or resid 164=m")  # both ends of the axis through the middle
        self.assertNotIn("no pixel", said)
        said, hollow = self.ring("chain C=m")
        self.assertIn("no pixel", said)
        self.assertLess(dark, 0.3)
        self.assertGreater(hollow, 0.9)


if __name__ == "__main__":
    unittest.main()
