# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and files with meshes."""
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import zlib

import numpy as np

from package_case import PROGRAM, chain, cloud
import meniscus


class Pictures(unittest.TestCase):
    def test_render_and_png(self):
        s = meniscus.surface([[0, 0, 0]], 2.0)
        self.render_and_png(s, "cpu")
        try:
            s.render(size="8x8", device="software")
        except meniscus.GpuError as error:  # This package came from a wheel.
            self.assertIn("made without epoxy", str(error))
        else:
            self.render_and_png(s, "software")

    def render_and_png(self, s, device):
        camera = s.camera(1.0, "orthographic")
        camera.height = 8.0
        picture = s.render(size="100x100", preset="classic", camera=camera, colors=(1, 0, 0), device=device)
        pixels = picture.pixels
        self.assertEqual(pixels.shape, (100, 100, 4))
        self.assertTrue(np.shares_memory(np.asarray(picture), pixels))
        np.testing.assert_array_equal(np.asarray(picture), pixels)
        self.assertAlmostEqual(pixels[..., 3].sum() / 255, math.pi * 25**2, delta=20)
        self.assertLess(pixels[50, 50, 1], 30)  # Green comes from the highlight alone.
        opaque = s.render(width=100, height=100, camera=camera, colors=[[0, 1, 0]], background="#0000ff", device=device)
        self.assertEqual(opaque.pixels[0, 0].tolist(), [0, 0, 255, 255])
        file = picture.png()
        self.assertTrue(file.startswith(b"\x89PNG\r\n\x1a\n"))
        rows = np.frombuffer(zlib.decompress(file[file.index(b"IDAT") + 4:-16]), np.uint8).reshape(100, 401)
        np.testing.assert_array_equal(rows[:, 1:].reshape(100, 100, 4), pixels)
        with self.assertRaisesRegex(meniscus.InputError, "colors has the shape"):
            s.render(size="10x10", colors=np.zeros((2, 3)), device=device)
        for name, value, said in (("samples", 0, "samples: '0' is not a whole number from 1 to 1024"),
                                  ("sample", 1, "did you mean samples"), ("view", "top", "view: a picture of a surface"),
                                  ("preset", "ghost", "preset: ghost draws atoms")):
            with self.assertRaisesRegex(meniscus.UsageError, said):
                s.render(device=device, **{name: value})

    def test_scenes_hold_values_by_name_and_key(self):
        scene = meniscus.Scene(pathlib.Path("a.pdb"), depth_cue=0.5, silhouettes="7pt", keep_water=True,
                               label=["resid 1=one", "resid 2=two"], samples=np.int64(4))
        self.assertEqual((scene.file, scene["look.depth_cue"], scene.silhouettes), ("a.pdb", 0.5, "7pt"))
        self.assertEqual((scene.keep_water, scene.samples, scene.preset), (True, 4, None))
        self.assertEqual(scene.label, ["resid 1=one", "resid 2=two"])
        scene.label, scene["depth_cue"], scene.keep_water = "resid 3=three", None, False
        self.assertEqual((scene.label, scene.depth_cue, scene.keep_water), (["resid 3=three"], None, None))
        again = meniscus.Scene.parse(scene.json())
        self.assertEqual((again.json(), again.silhouettes), (scene.json(), "7pt"))
        self.assertIs(scene.set(depth_cue=0.1), scene)
        self.assertIn("silhouettes", dir(scene))
        self.assertFalse(hasattr(scene, "shape"))
        self.assertIn("a.pdb", repr(scene))
        for name, value, error, said in (("depth_cue", 2, meniscus.UsageError, "depth_cue: '2' is not a number from 0 to 1"),
                                         ("depth_cues", 1, meniscus.UsageError, "did you mean depth_cue?"),
                                         ("depth_cue", 1j, meniscus.InputError, "neither a text nor a number"),
                                         ("select", "a\0", meniscus.InputError, "has a zero in it")):
            with self.assertRaisesRegex(error, re.escape(said)):
                scene[name] = value
        self.assertRaisesRegex(meniscus.InputError, "not JSON", meniscus.Scene.parse, "{")
        self.assertRaisesRegex(meniscus.UsageError, "no molecule", meniscus.Scene().render, "cpu")
        named = {p.name: p for p in meniscus.properties()}
        self.assertEqual((named["depth_cue"].key, named["depth_cue"].highest), ("look.depth_cue", 1.0))
        self.assertEqual(named["surface"].words, ["ses", "sas", "vdw"])

    def test_messages_name_values_and_not_options_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "two.xyz"
            path.write_text("2\n\nC 0 0 0\nO 1.2 0 0\n")
            for values, said in (({"color": "bfactor"}, "choose another color"),
                                 ({"color": "rmsf"}, "color=rmsf measures fluctuations over frames; add frames=all"),
                                 ({"scale_bar": "500"}, "scale_bar: 500 Å would be"),
                                 ({"color": "file"}, "file needs color_by_file=FILE"),
                                 ({"zoom_to": "resid 9"}, "zoom_to='resid 9': selects none"),
                                 ({"label": "resid 9=x"}, "label='resid 9': none of the 2 atoms"),
                                 ({"surface": "vdw", "probe": 2}, "leave probe or surface=vdw out")):
                with self.subTest(**values):
                    with self.assertRaises(meniscus.Error) as refused:
                        meniscus.Scene(path, size="80x60", **values).render("cpu")
                    self.assertIn(said, str(refused.exception))
                    self.assertNotIn("--", str(refused.exception))
        self.assertNotIn("@", "".join(p.help + p.initial for p in meniscus.properties()))
        self.assertIn("with look_into", {p.name: p for p in meniscus.properties()}["depth_cue"].help)

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_a_scene_is_drawn_as_the_program_draws_it(self):
        with tempfile.TemporaryDirectory() as folder:
            lines = ("ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N  \n"
                     "ATOM      2  CA  GLY B   2       3.987   2.839   0.000  1.00 25.00           C  \nEND\n")
            (pathlib.Path(folder) / "a.pdb").write_text(lines)
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(meniscus.Scene(os.path.join(folder, "a.pdb"), size="240x180", color="chain", legend=True,
                                           background="white").json(folder))
            subprocess.run([PROGRAM, "render", "-q", "--device", "cpu", "--scene", str(path), "-o", f"{folder}/a.png"], check=True)
            try:
                import OpenImageIO
            except ImportError:
                self.skipTest("OpenImageIO for Python is not installed")
            theirs = OpenImageIO.ImageInput.open(f"{folder}/a.png").read_image("uint8")
            np.testing.assert_array_equal(meniscus.Scene.read(path).render("cpu").pixels[..., :3], theirs)

    def test_a_preset_draws_what_its_values_draw(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.pdb"
            path.write_text("".join(f"ATOM  {n:5}  CA  ALA A{n:4}    {3.0 * n:8.3f}   0.000{2.0 * (n % 2):8.3f}  1.00 10.00           C  \n"
                                    for n in range(1, 9)))
            scene = meniscus.Scene(path, size="80x60", tube_radius=0.9)
            scene.preset = "ghost"
            self.assertEqual((scene.preset, scene.opacity), ("ghost", None))
            again = meniscus.Scene.parse(scene.json())
            self.assertEqual(again.preset, "ghost")
            theirs = meniscus.Scene(path, size="80x60", tube_radius=0.9, opacity=0.15, film_opacity=True, tube="polymer").render("cpu")
            for one in (scene, again):
                np.testing.assert_array_equal(one.render("cpu").pixels, theirs.pixels)
            with self.assertRaisesRegex(meniscus.UsageError, "'gost' is not one of publication, .*, ghost, goodsell, pocket, ribbon"):
                scene.preset = "gost"

    def test_nothing_fades_where_a_surface_is_seen_through(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.pdb"
            path.write_text("".join(f"ATOM  {n:5}  C   ALA A{n:4}    {3.0 * n:8.3f}   0.000{4.0 * n:8.3f}  1.00 10.00           C  \n" for n in range(1, 9)))

            def drawn(**values):
                return meniscus.Scene(path, size="80x60", background="white", view="y", **values).render("cpu").pixels.astype(int)

            usual = drawn(opacity="0.4")
            np.testing.assert_array_equal(usual, drawn(opacity="0.4", depth_cue=0))
            self.assertGreater(abs(usual - drawn(opacity="0.4", depth_cue=0.35)).max(), 2)
            self.assertGreater(abs(drawn() - drawn(depth_cue=0)).max(), 2)

    def test_notebooks_show_it(self):
        self.assertTrue(meniscus.surface(*chain(6))._repr_png_().startswith(b"\x89PNG"))
        self.assertIn("6 atoms", repr(meniscus.surface(*chain(6))))


class MeshFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.xyz, self.radii = cloud(40, 7)
        self.surface = meniscus.surface(self.xyz, self.radii)

    def bytes_of(self, mesh, name, **options):
        mesh.save(self.folder / name, **options)
        return (self.folder / name).read_bytes()

    @unittest.skipUnless(PROGRAM, "MENISCUS_PROGRAM is not set")
    def test_the_program_writes_the_same_bytes(self):
        lines = "".join(f"{x!r} {y!r} {z!r} {r!r}\n" for (x, y, z), r in zip(self.xyz.tolist(), self.radii.tolist()))
        mesh = self.surface.mesh(0.05)
        even = self.surface.mesh(0.1, even=True)
        for made, name, *words in ((mesh, "a.stl", "--tolerance", "0.05"), (mesh, "a.off", "--tolerance", "0.05"),
                                   (mesh, "a.smesh", "--tolerance", "0.05"), (even, "b.stl", "--even", "--tolerance", "0.1")):
            path = self.folder / ("program_" + name)
            subprocess.run([PROGRAM, "export", "mesh", "-q", "--device", "cpu", "-", "-o", str(path), *words], input=lines,
                           text=True, check=True, capture_output=True)
            self.assertEqual(self.bytes_of(made, name), path.read_bytes(), name)

    def test_every_format(self):
        mesh = self.surface.mesh(density=1.0)
        begins = {"stl": b"Meniscus", "3mf": b"PK", "obj": b"#", "off": b"OFF", "glb": b"glTF", "vtp": b"<?xml",
                  "smesh": b"#", "dms": b"  -    1", "ply": b"ply"}
        for ending, first in begins.items():
            content = self.bytes_of(mesh, "mesh." + ending)
            self.assertEqual(content[:len(first)], first, ending)
            self.assertEqual(self.bytes_of(mesh, "named_" + ending, format=ending), content)
        self.assertEqual(len(self.bytes_of(mesh, "again.STL")), 84 + 50 * len(mesh.triangles))

    def test_colors_attributes_and_scale(self):
        mesh = self.surface.mesh(0.2)

        def columns(mesh, name, **options):
            content = self.bytes_of(mesh, name, **options)
            head, rows = content.split(b"end_header\n", 1)
            types = {"float": "<f4", "uchar": "u1", "int": "<i4"}
            lines = [line.split() for line in head.decode().split("element face")[0].splitlines()]
            row = np.dtype([(line[2], types[line[1]]) for line in lines if line[0] == "property"])
            count = int(next(line[2] for line in lines if line[:2] == ["element", "vertex"]))
            return np.frombuffer(rows, row, count)

        table = columns(mesh, "a.ply", attributes="all", scale=0.1)
        self.assertEqual(table.dtype.names[9:], ("vdw_radii", "atom_index", "ses_kind", "ses_component", "mean_curvature",
                                                 "gaussian_curvature", "smooth_mean_curvature",
                                                 "smooth_gaussian_curvature", "atom_area", "accessible_area",
                                                 "patch_area"))
        np.testing.assert_allclose(table["vdw_radii"], self.radii[table["atom_index"].astype(int)], rtol=1e-6)
        np.testing.assert_allclose(table["atom_area"], self.surface.atom_areas[table["atom_index"].astype(int)], rtol=1e-5)
        np.testing.assert_allclose(table["accessible_area"], self.surface.atom_sas_areas[table["atom_index"].astype(int)],
                                   rtol=1e-5)
        places = np.stack([table[axis] for axis in "xyz"], axis=1) * 10.0
        np.testing.assert_allclose(self.surface.distance(places), 0.0, atol=1e-4)
        one = columns(mesh, "b.ply", colors=(1, 0, 0), attributes="none")
        self.assertEqual(one.dtype.names[9:], ())
        self.assertTrue((one["red"] == 255).all() and (one["green"] == 0).all())
        self.assertEqual(columns(mesh, "c.ply").dtype.names[9:], ("vdw_radii", "atom_index", "ses_kind", "ses_component"))
        table = columns(meniscus.surface(self.xyz, self.radii, kind="sas").mesh(0.2), "d.ply")
        np.testing.assert_allclose(table["vdw_radii"], self.radii[table["atom_index"].astype(int)], rtol=1e-6)
        apart = meniscus.surface([[0, 0, 0], [20, 0, 0]], [1.7, 1.2]).mesh(density=1.0)
        table = columns(apart, "e.ply", colors=[[0.2, 0.4, 0.6], [1, 0, 0]])
        for atom, color in enumerate(((51, 102, 153), (255, 0, 0))):
            at = table["atom_index"] == atom
            self.assertGreater(at.sum(), 10)
            self.assertTrue(((table["x"][at] > 10) == atom).all())
            self.assertTrue((np.stack([table[c][at] for c in ("red", "green", "blue")], axis=1) == color).all())

    def test_a_mesh_is_that_of_its_frame(self):
        mesh = self.surface.mesh(0.1)
        before = self.bytes_of(mesh, "before.vtp", attributes="all")
        self.surface.update(self.xyz + 0.3)
        self.assertEqual(self.bytes_of(mesh, "after.vtp", attributes="all"), before)

    def test_what_cannot_be(self):
        mesh = self.surface.mesh(0.3)
        mesh.save(self.folder / "there.stl")
        for wanted, error, sentence in (
                (lambda: mesh.save(self.folder / "there.stl"), meniscus.OutputError, "there.stl"),
                (lambda: mesh.save(self.folder / "no" / "folder.stl"), OSError, "folder.stl"),
                (lambda: mesh.save(self.folder / "mesh.xyz"), meniscus.UsageError, "xyz.* does not end like a mesh file"),
                (lambda: mesh.save(self.folder / "mesh"), meniscus.UsageError, "does not end like a mesh file"),
                (lambda: mesh.save(self.folder / "a.stl", format="step"), meniscus.UsageError, "format is 'step'"),
                (lambda: mesh.save(self.folder / "a.ply", attributes="b_factor"), meniscus.UsageError, "bare atoms"),
                (lambda: mesh.save(self.folder / "a.ply", attributes="mass"), meniscus.UsageError, "not an attribute"),
                (lambda: mesh.save(self.folder / "a.ply", scale=0.0), meniscus.InputError, "scale is 0"),
                (lambda: mesh.save(self.folder / "a.ply", scale=math.nan), meniscus.InputError, "scale is nan"),
                (lambda: mesh.save(self.folder / "a.ply", colors=(2, 0, 0)), meniscus.InputError, "atom 0 is 2; it has to be 0 to 1"),
                (lambda: mesh.save(self.folder / "a.ply", colors=np.full((40, 3), -1.0)), meniscus.InputError,
                 "colour of atom 0 is -1"),
                (lambda: mesh.save(self.folder / "a.ply", colors=np.zeros((3, 3))), meniscus.InputError, "the shape"),
                (lambda: mesh.save("a\0.ply"), ValueError, "zero"),
                (lambda: self.surface.mesh(density=0.1).save(self.folder / "a.dms", format="dms", scale=1e9),
                 meniscus.InputError, "scale")):
            with self.assertRaisesRegex(error, sentence):
                wanted()
        self.assertEqual([path.name for path in self.folder.iterdir()], ["there.stl"])
        mesh.save(self.folder / "there.stl", replace=True)
