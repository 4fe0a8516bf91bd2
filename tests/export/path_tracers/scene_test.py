# SPDX-License-Identifier: BSD-3-Clause
"""Scenes for Mitsuba and pbrt: whole, closed, equal to the surface, and free of text from molecule files: PROGRAM."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from scene_files import mitsuba_scene, pbrt_scene  # noqa: E402

PROGRAM = sys.argv[1]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
ENDING = {"mitsuba": "xml", "pbrt": "pbrt"}


def atom_line(number, x, y, z, chain="A", element="C", residue="UNK"):
    return (f"HETATM{number:5d}  {element}   {residue} {chain}{number:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00"
            f"           {element}\n")


def view_ray(camera, aspect, x, y):
    """Returns the view's ray through a point of the picture, origin and direction; x and y: -1 to 1, right and up."""
    eye, up = np.array(camera["position"]), np.array(camera["up"])
    forward = np.array(camera["target"]) - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    if camera["projection"] == "orthographic":
        half = camera["height"] / 2
        return eye + x * aspect * half * right + y * half * up, forward
    tangent = np.tan(np.radians(camera["vertical_fov"]) / 2)
    direction = forward + x * aspect * tangent * right + y * tangent * up
    return eye, direction / np.linalg.norm(direction)


def pbrt_ray(statements, x, y):
    """Returns the ray that pbrt-v4 makes (Pharr, Jakob and Humphreys 2023, sections 3.9.3 "Look-At", 5.2 "Projective
    cameras"): left-handed axes, the window of the screen at distance 1 stretched to the angle."""
    (_, scale, _), (_, look, _), (_, (kind,), parameters) = statements[:3]
    eye, at, up = np.reshape(look, (3, 3))
    forward = (at - eye) / np.linalg.norm(at - eye)
    right = np.cross(up / np.linalg.norm(up), forward)
    right /= np.linalg.norm(right)
    world_from_look = np.stack([right, np.cross(forward, right), forward], 1)
    x0, x1, y0, y1 = parameters["screenwindow"]
    screen = np.array([(x0 + x1) / 2 + x * (x1 - x0) / 2, (y0 + y1) / 2 + y * (y1 - y0) / 2])
    back = world_from_look @ np.diag(1 / np.array(scale))
    if kind == "orthographic":
        return eye + back @ [*screen, 0], back @ [0, 0, 1]
    direction = back @ [*(screen * np.tan(np.radians(parameters["fov"]) / 2)), 1]
    return eye, direction / np.linalg.norm(direction)


def volume(mesh):
    a, b, c = (mesh.positions[mesh.triangles[:, k]].astype(float) for k in range(3))
    return float((np.cross(a, b) * c).sum() / 6)


class Scenes(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def written(self, renderer, molecule, *options, name="scene"):
        """Exports scenes and returns their paths."""
        folder = self.folder / f"{name}-{renderer}"
        self.run_program("export", renderer, molecule, "-o", folder, "--size", "320x240", "-q", *options)
        return sorted(folder.glob(f"*.{ENDING[renderer]}"))

    def mitsuba(self, molecule, *options, name="scene"):
        (path,) = self.written("mitsuba", molecule, *options, name=name)
        subprocess.run(["xmllint", "--noout", "--nonet", path], check=True)
        return mitsuba_scene(path)

    def pbrt(self, molecule, *options, name="scene"):
        (path,) = self.written("pbrt", molecule, *options, name=name)
        return pbrt_scene(path)

    def molecule(self, text, name="molecule.pdb"):
        path = self.folder / name
        path.write_text(text)
        return path

    @staticmethod
    def origin_of(path):
        said = re.search(r"those here plus \(([^)]*)\)", path.read_text())
        return np.array([float(word) for word in said.group(1).split(", ")])

    def test_meshes_enclose_the_volume_of_the_surface(self):
        said = json.loads(self.run_program("surface", UBIQUITIN, "--json", "-q").stdout)
        whole = said["volume"]
        _, meshes = self.mitsuba(UBIQUITIN, "--color", "element", "--tolerance", 0.02)
        self.assertEqual(list(meshes), ["surface_1.ply"])
        mesh = meshes["surface_1.ply"]
        self.assertAlmostEqual(volume(mesh) / whole, 1, delta=2e-3)
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)
        self.assertEqual(len(np.unique(mesh.colors, axis=0)), 4)
        # The three corners of a triangle have one colour: colours change along edges.
        corner = mesh.colors[mesh.triangles]
        self.assertTrue((corner == corner[:, :1]).all())
        # Normals follow the surface near each triangle, at cusps too; slivers say little.
        a, b, c = (mesh.positions[mesh.triangles[:, k]].astype(float) for k in range(3))
        faces = np.cross(b - a, c - a)
        large = np.linalg.norm(faces, axis=1) > 0.01
        faces = faces[large] / np.linalg.norm(faces[large], axis=1)[:, None]
        cosine = np.min([(faces * mesh.normals[corner]).sum(1) for corner in mesh.triangles[large].T], 0)
        self.assertLess((cosine < np.cos(np.radians(30))).mean(), 0.001)
        _, parts = self.pbrt(UBIQUITIN, "--color", "element", "--tolerance", 0.02)
        self.assertEqual(len(parts), 4)
        self.assertEqual(sum(len(part.triangles) for part in parts.values()), len(mesh.triangles))
        self.assertAlmostEqual(sum(volume(part) for part in parts.values()), volume(mesh), delta=1e-2)
        self.assertTrue(all(part.colors is None for part in parts.values()))

    def test_meshes_of_pbrt_have_one_colour_of_8_bits(self):
        options = ["--color", "bfactor", "--tolerance", 0.3]
        _, meshes = self.mitsuba(UBIQUITIN, *options)
        statements, parts = self.pbrt(UBIQUITIN, *options)
        colors = np.array([p["reflectance"] for n, _, p in statements if n == "MakeNamedMaterial"])
        exact = np.unique(meshes["surface_1.ply"].colors, axis=0)
        self.assertEqual((len(parts), len(np.unique(colors, axis=0))), (len(colors), len(colors)))
        self.assertLess(len(colors), len(exact))

        def srgb(linear):
            return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)

        np.testing.assert_allclose(255 * srgb(colors), np.round(255 * srgb(colors)), atol=1e-3)
        self.assertEqual({tuple(c) for c in np.round(255 * srgb(exact))}, {tuple(c) for c in np.round(255 * srgb(colors))})

    def test_half_a_pixel_is_the_default(self):
        count = [len(self.mitsuba(UBIQUITIN, *options, name=f"s{n}")[1]["surface_1.ply"].triangles)
                 for n, options in enumerate([(), ("--tolerance-pixels", 0.5), ("--tolerance-pixels", 2),
                                              ("--tolerance", 0.2)])]
        self.assertEqual(count[0], count[1])
        self.assertGreater(count[0], 1.5 * count[2])
        said = self.run_program("export", "mitsuba", UBIQUITIN, "-o", self.folder / "said", "--tolerance", 0.2)
        self.assertIn("within 0.2 Å", said.stderr)

    def test_untouched_atoms_are_spheres(self):
        places = {"C": (0.125, 0, 0), "O": (20, 1, 2)}
        text = "".join(atom_line(1, *place, element=element, residue="LIG") for element, place in places.items())
        path = self.molecule(text + "".join(atom_line(1, x, 0, 0, residue="LIG") for x in (40, 41.5)))
        (scene,) = self.written("mitsuba", path, "--color", "element")
        root, meshes = mitsuba_scene(scene)
        spheres = [e for e in root.iter("shape") if e.get("type") == "sphere"]
        self.assertEqual((len(spheres), len(meshes)), (2, 1))
        centers = [[float(s.find("point").get(axis)) for axis in "xyz"] for s in spheres] + self.origin_of(scene)
        np.testing.assert_allclose(centers, [[0.125, 0, 0], [20, 1, 2]], rtol=0, atol=1e-12)
        self.assertEqual([float(s.find("float").get("value")) for s in spheres], [1.7, 1.52])
        self.assertGreater(meshes["surface_1.ply"].positions[:, 0].min() + self.origin_of(scene)[0], 38)
        statements, parts = self.pbrt(path, "--color", "element")
        self.assertEqual([p["radius"] for n, v, p in statements if n == "Shape" and v == ["sphere"]], [1.7, 1.52])
        self.assertEqual(len(parts), 1)

    def test_sticks_are_spheres_and_cylinders(self):
        root, meshes = self.mitsuba(UBIQUITIN, "--hide-surface", "--sticks", "resname LYS", "--tube", "chain A")
        kinds = [e.get("type") for e in root.iter("shape")]
        self.assertEqual(len(meshes), 1)
        self.assertEqual(kinds.count("ply") + kinds.count("sphere") + kinds.count("cylinder"), len(kinds))
        statements, _ = self.pbrt(UBIQUITIN, "--hide-surface", "--sticks", "resname LYS", "--tube", "chain A")
        shapes = [v[0] for n, v, p in statements if n == "Shape"]
        for theirs, ours in (("sphere", "sphere"), ("cylinder", "cylinder")):
            self.assertGreater(kinds.count(theirs), 60)
            self.assertEqual(kinds.count(theirs), shapes.count(ours))
        # Both scenes place the same cylinders.
        ends = [[float(p.get(axis)) for p in e.findall("point") for axis in "xyz"] for e in root.iter("shape")
                if e.get("type") == "cylinder"]
        halves = np.reshape(ends, (-1, 2, 2, 3))
        np.testing.assert_array_equal(halves[:, 0, 1], halves[:, 1, 0])
        np.testing.assert_allclose(halves[:, 0, 1], (halves[:, 0, 0] + halves[:, 1, 1]) / 2, atol=1e-12)
        placed = [(m[1], s[2]) for m, s in zip(statements, statements[1:]) if s[0] == "Shape" and s[1] == ["cylinder"]]
        for (x0, y0, z0, x1, y1, z1), (matrix, parameters) in zip(ends, placed):
            matrix = np.reshape(matrix, (4, 4)).T
            np.testing.assert_allclose(np.linalg.det(matrix[:3, :3]), 1, atol=1e-12)
            np.testing.assert_allclose(matrix @ [0, 0, 0, 1], [x0, y0, z0, 1], atol=1e-12)
            np.testing.assert_allclose(matrix @ [0, 0, parameters["zmax"], 1], [x1, y1, z1, 1], atol=1e-12)

    def test_copies_are_placed_not_repeated(self):
        biomt = "".join(f"REMARK 350   BIOMT{row} {n:3d} {m[0]:9.6f} {m[1]:9.6f} {m[2]:9.6f} {m[3]:14.5f}\n"
                        for n, rows in ((1, ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))),
                                        (2, ((0, -1, 0, 30), (1, 0, 0, 5), (0, 0, 1, 7))))
                        for row, m in enumerate(rows, 1))
        path = self.molecule("REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n" + biomt +
                             atom_line(1, 1, 2, 3) + atom_line(2, 2.5, 2, 3))
        (scene,) = self.written("mitsuba", path, "--assembly", 1, "--instances", "exact")
        root, meshes = mitsuba_scene(scene)
        self.assertEqual(len(meshes), 1)
        matrices = [np.array([float(w) for w in e.get("value").split()]).reshape(4, 4) for e in root.iter("matrix")]
        self.assertEqual(len(matrices), 2)
        self.assertEqual(root.find("integrator").get("type"), "volpath")  # "path" crashes with instances
        origin = self.origin_of(scene)
        for matrix, awaited in zip(matrices, ([1, 2, 3], [28, 6, 10])):
            at = matrix @ np.append(np.array([1, 2, 3]) - origin, 1)
            np.testing.assert_allclose(at[:3] + origin, awaited, atol=1e-9)
        statements, parts = self.pbrt(path, "--assembly", 1, "--instances", "exact")
        self.assertEqual(len(parts), 1)
        placed = [m[1] for m, s in zip(statements, statements[1:]) if s[0] == "ObjectInstance"]
        for theirs, ours in zip(placed, matrices):
            np.testing.assert_array_equal(np.reshape(theirs, (4, 4)).T, ours)

    def test_camera_is_that_of_the_view(self):
        for projection in "perspective", "orthographic":
            for size in "320x240", "120x200":
                camera, name = self.folder / f"{projection}{size}.json", projection + size
                view = ["--view", "front", "--turn", "z20", "--size", size, "--tolerance", 0.5]
                (path,) = self.written("mitsuba", UBIQUITIN, "--projection", projection, "--save-camera", camera, *view, name=name)
                said, (root, _) = json.loads(camera.read_text()), mitsuba_scene(path)
                origin, sensor = self.origin_of(path), root.find("sensor")
                mesh = mitsuba_scene(path)[1]["surface_1.ply"]
                aspect = int(size.split("x")[0]) / int(size.split("x")[1])
                look = sensor.find("transform/lookat")
                eye, at = (np.array([float(w) for w in look.get(what).split(",")]) for what in ("origin", "target"))
                np.testing.assert_allclose(eye + origin, said["position"], rtol=0, atol=1e-9)
                np.testing.assert_allclose(at - eye, view_ray(said, 1, 0, 0)[1], atol=1e-9)
                far = float(sensor.find("float[@name='far_clip']").get("value"))
                self.assertGreater(far, np.linalg.norm(mesh.positions - eye, axis=1).max())
                self.assertEqual(sensor.get("type"), projection)
                if projection == "perspective":
                    self.assertEqual(float(sensor.find("float[@name='fov']").get("value")), said["vertical_fov"])
                else:
                    self.assertAlmostEqual(float(sensor.find("transform/scale").get("x")), said["height"] / 2 * aspect)
                statements, _ = self.pbrt(UBIQUITIN, "--camera", camera, *view[4:], name=name)
                self.assertEqual([n for n, _, _ in statements[:3]], ["Scale", "LookAt", "Camera"])
                for x, y in (0, 0), (1, 1), (-1, 1), (0.3, -0.7):
                    ours, theirs = view_ray(said, aspect, x, y), pbrt_ray(statements, x, y)
                    np.testing.assert_allclose(theirs[0] + origin, ours[0], atol=1e-9)
                    np.testing.assert_allclose(theirs[1], ours[1], atol=1e-9)

    def test_materials_opacity_and_cuts(self):
        for material in "matte", "plastic", "glass", "wax":
            options = ["--material", material, "--tolerance", 0.5, "--opacity", "0.25", "--sticks", "resid 1-5", "--clip", "depth>0.4",
                       "--cap-color", "red", "--object",
                       '{"representation": "surface", "selection": "resid 10-20", "color": "blue"}']
            root, meshes = self.mitsuba(UBIQUITIN, *options, name=material)
            self.assertEqual(len(meshes), 2)
            self.assertTrue(any((mesh.colors[:, 0] > 1.5 * mesh.colors[:, 1]).any() for mesh in meshes.values()))
            masks = [e for e in root.iter("bsdf") if e.get("type") == "mask"]
            self.assertEqual([e.find("float").get("value") for e in masks], ["0.25"])
            statements, _ = self.pbrt(UBIQUITIN, *options, name=material)
            self.assertIn(0.25, {p.get("alpha") for n, v, p in statements if v == ["plymesh"]})
            medium = [n for n, _, _ in statements if n == "MediumInterface"]
            self.assertEqual(bool(medium), material == "glass")
            theirs = {"matte": "diffuse", "plastic": "principled", "glass": "dielectric", "wax": "principled"}[material]
            self.assertEqual({e.get("type") for e in root.iter("bsdf")} - {"twosided", "mask"}, {"diffuse", theirs})
            ours = {"matte": "diffuse", "plastic": "coateddiffuse", "glass": "dielectric", "wax": "subsurface"}[material]
            self.assertEqual({p["type"] for n, _, p in statements if n == "MakeNamedMaterial"}, {"diffuse", ours})
            self.assertEqual(root.find("medium") is not None, material == "glass")

    def test_frames_have_their_numbers(self):
        path = self.molecule("".join(f"MODEL {n + 1}\n{atom_line(1, n, 0, 0)}{atom_line(2, n + 1.5, 0, 0)}ENDMDL\n" for n in range(4)))
        for renderer, read in ("mitsuba", mitsuba_scene), ("pbrt", pbrt_scene):
            scenes = self.written(renderer, path, "--frames", "1-3:2", "--sticks", "all")
            self.assertEqual([s.stem for s in scenes], ["surface_00001", "surface_00003"])
            first, last = (read(scene)[1] for scene in scenes)
            self.assertEqual((list(first), list(last)), (["surface_00001_1.ply"], ["surface_00003_1.ply"]))
            moved = last["surface_00003_1.ply"].positions - first["surface_00001_1.ply"].positions
            np.testing.assert_allclose(moved, np.broadcast_to([2, 0, 0], moved.shape), atol=1e-5)
            self.assertEqual(*(self.origin_of(scene).tolist() for scene in scenes))

    def test_what_colors_mean_is_measured_over_the_run(self):
        path = self.molecule("".join(
            f"MODEL {n + 1}\n{atom_line(1, 0, 0, 0)}{atom_line(2, 1.5 + n, 0, 0)}{atom_line(3, -1.5 - n, 0, 0)}ENDMDL\n" for n in range(3)))
        for renderer in ENDING:
            run = [scene.read_text() for scene in self.written(renderer, path, "--frames", "all", "--color", "rmsf", name="rmsf")]
            self.assertEqual(len(run), 3)
        by_frame = {}
        for frames in "all", "1":  # Atoms lie at most 1.5, 2.5 and 3.5 Å from their middle.
            for scene in self.written("mitsuba", path, "--frames", frames, "--color", "radial", name=f"radial_{frames}"):
                (mesh,) = mitsuba_scene(scene)[1].values()
                by_frame[frames, scene.stem] = {tuple(color) for color in mesh.colors}
        first, middle, last = (by_frame["all", f"surface_{n:05}"] for n in range(3))
        self.assertEqual([len(colors) for colors in (first, middle, last)], [2, 2, 2])
        self.assertEqual([len(first & middle), len(middle & last), len(first & last)], [1, 1, 1])  # the middle atom
        self.assertEqual(by_frame["1", "surface_00001"], last)  # Both have the two ends of the map.

    def test_nothing_of_the_molecule_file_is_in_a_scene(self):
        path = self.molecule(atom_line(1, 0, 0, 0, chain='"', residue="</s") + atom_line(2, 1.5, 0, 0, chain="]", residue="--&"),
                             name='"--Include.pdb')
        for renderer in ENDING:
            (scene,) = self.written(renderer, path, "--by", "chain", "--color", "chain", name='a"&b')
            text = scene.read_text()
            for word in "</s\"", "--&", "Include", 'a"&b':
                self.assertNotIn(word, text)
            (mitsuba_scene if renderer == "mitsuba" else pbrt_scene)(scene)

    def test_what_is_there_stays_unless_forced(self):
        for renderer in ENDING:
            (scene,) = self.written(renderer, UBIQUITIN, "--tolerance", 0.5)
            before = {path.name: path.read_bytes() for path in scene.parent.iterdir()}
            again = ["export", renderer, UBIQUITIN, "-o", scene.parent, "--size", "320x240", "-q", "--tolerance", 0.5]
            self.run_program(*again, "--color", "red", code=6)
            self.assertEqual({path.name: path.read_bytes() for path in scene.parent.iterdir()}, before)
            self.run_program(*again, "--force")
            self.assertEqual({path.name: path.read_bytes() for path in scene.parent.iterdir()}, before)

    def test_what_cannot_be_shown_is_refused(self):
        (self.folder / "map.dx").write_text("no map")
        for renderer in ENDING:
            for options, code, word in (
                    (["--film-opacity"], 2, "--film-opacity"), (["--clip", "x<0", "--cap-hatching", "1"], 2, "--cap-hatching"),
                    (["--material", "gold"], 2, "gold"), (["--hide-surface"], 2, "no part of the surface is shown"),
                    (["--turntable", "1"], 2, "--frames"), (["--tolerance", "-1"], 2, "--tolerance"),
                    (["--frames", "all", "--hide-surface"], 2, "no part of the surface is shown")):
                with self.subTest(renderer=renderer, options=options):
                    said = self.run_program("export", renderer, UBIQUITIN, "-o", self.folder / "none", "-q", *options, code=code)
                    self.assertIn(word, said.stderr)
                    self.assertEqual(said.stderr.count("\n"), 1, said.stderr)
                    self.assertFalse((self.folder / "none").exists())
        said = self.run_program("export", "mitsuba", UBIQUITIN, "-o", self.folder / "none", "-q", "--color-map-file", self.folder / "map.dx",
                                "--color-range=-5:5", "--clip", "x<0", code=2)
        self.assertIn("--cap-color", said.stderr)
        said = self.run_program("export", "pbrt", UBIQUITIN, "-o", self.folder / "none", "-q", "--color-map-file", self.folder / "map.dx", "--color-range=-5:5",
                                code=2)
        self.assertIn("export mitsuba", said.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
