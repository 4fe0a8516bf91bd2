# SPDX-License-Identifier: BSD-3-Clause
"""The .mns reader of the Blender add-on under plain Python: arguments PROGRAM ADDON_FOLDER."""

import os
import sys
import tempfile
import unittest

PROGRAM, ADDON = sys.argv[1], sys.argv[2]
sys.path[:0] = [os.path.join(ADDON, "meniscus_import"), os.path.dirname(os.path.abspath(__file__))]

import numpy as np  # noqa: E402

import mns_reader  # noqa: E402
import samples  # noqa: E402


class Reader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.files = {name: samples.export(PROGRAM, cls.folder.name, name) for name in samples.MOLECULES}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_meshes_are_closed_outward_and_measure_what_the_header_says(self):
        for path in self.files.values():
            surface = mns_reader.read(path).objects[0]
            mesh = surface.header["mesh"]
            self.assertTrue(mns_reader.is_closed(surface["mesh.triangle"]))
            volume = mns_reader.signed_volume(surface["mesh.position"], surface["mesh.triangle"])
            self.assertAlmostEqual(volume / mesh["volume"], 1.0, places=5)
            self.assertAlmostEqual(volume / surface.header["volume"], 1.0, delta=0.03)
            self.assertAlmostEqual(mesh["area"] / surface.header["area"], 1.0, delta=0.03)
            self.assertEqual(len(surface["mesh.triangle"]), mesh["triangles"])
            for index, part in enumerate(surface.header["components"]):
                rows = surface["mesh.triangle"][surface["mesh.component"] == index]
                euler = len(np.unique(rows)) - len(rows) * 3 // 2 + len(rows)
                self.assertEqual(euler, part["euler"])

    def test_the_components_are_those_of_the_molecules(self):
        kinds = {name: [part["kind"] for part in mns_reader.read(path).objects[0].header["components"]]
                 for name, path in self.files.items()}
        self.assertEqual(kinds["pair"], ["outer"])
        self.assertEqual(kinds["drops"], ["outer", "outer"])
        self.assertEqual(kinds["cage"], ["outer", "cavity"])

    def test_arrays_are_aligned(self):
        for path in self.files.values():
            with open(path, "rb") as file:
                data = file.read()
            surface = mns_reader.read(path).objects[0]
            for name in surface.arrays:
                self.assertEqual(samples.array_place(data, name)[0] % 64, 0, name)

    def test_vertices_lie_on_the_analytic_patches(self):
        surface = mns_reader.read(self.files["triple"]).objects[0]
        origin = np.array(surface.header["mesh"]["origin"])
        probe = surface.header["probe_radius"]
        position = surface["mesh.position"].astype(float) + origin
        seen = set()
        for triangle, kind, patch in zip(surface["mesh.triangle"], surface["mesh.kind"], surface["mesh.patch"]):
            x = position[triangle]
            if kind == 0:
                atom = surface["convex.atom"][patch]
                distance = np.linalg.norm(x - surface["atom.center"][atom], axis=1)
                np.testing.assert_allclose(distance, surface["atom.radius"][atom], atol=2e-6)
            elif kind == 1:
                offset = x - surface["toroidal.center"][patch]
                height = offset @ surface["toroidal.axis"][patch]
                out = np.linalg.norm(offset - height[:, None] * surface["toroidal.axis"][patch], axis=1)
                tube = np.hypot(out - surface["toroidal.radius_sweep"][patch][0], height)
                np.testing.assert_allclose(tube, probe, atol=2e-6)
            else:
                distance = np.linalg.norm(x - surface["concave.center"][patch], axis=1)
                np.testing.assert_allclose(distance, probe, atol=2e-6)
            seen.add(int(kind))
        self.assertEqual(seen, {0, 1, 2})

    def test_damaged_files_are_refused_with_a_reason(self):
        with open(self.files["pair"], "rb") as file:
            good = file.read()
        for name, (data, word) in samples.damaged_files(good).items():
            path = os.path.join(self.folder.name, "bad.mns")
            with open(path, "wb") as file:
                file.write(data)
            if name == "not_closed":  # the reader takes it; the import refuses it
                self.assertFalse(mns_reader.is_closed(mns_reader.read(path).objects[0]["mesh.triangle"]))
                continue
            with self.assertRaises(mns_reader.MnsError, msg=name) as caught:
                mns_reader.read(path)
            self.assertIn(word, str(caught.exception), name)
            self.assertIn("bad.mns", str(caught.exception), name)

    def test_version_1_is_one_object(self):
        with open(self.files["triple"], "rb") as file:
            data = file.read()
        path = os.path.join(self.folder.name, "old.mns")
        with open(path, "wb") as file:
            file.write(samples.as_version_1(data))
        old, new = mns_reader.read(path), mns_reader.read(self.files["triple"])
        self.assertEqual((len(old.objects), len(new.objects)), (1, 1))
        np.testing.assert_array_equal(old.objects[0].copies, [np.eye(4)[:3]])
        self.assertEqual(set(old.objects[0].arrays), set(new.objects[0].arrays) - {"atom.index"})
        for name, array in old.objects[0].arrays.items():
            np.testing.assert_array_equal(array, new.objects[0][name])
        self.assertEqual(old.objects[0].header["mesh"]["volume"], new.objects[0].header["mesh"]["volume"])

    def test_objects_and_copies(self):
        with open(self.files["triple"], "rb") as file:
            data = file.read()
        path = os.path.join(self.folder.name, "two.mns")
        with open(path, "wb") as file:
            file.write(samples.as_two_objects(data))
        objects = mns_reader.read(path).objects
        self.assertEqual([surface.name for surface in objects], ["A", "B"])
        self.assertEqual([len(surface.copies) for surface in objects], [2, 1])
        np.testing.assert_array_equal(objects[0].copies[1], np.reshape(samples.QUARTER_TURN, (3, 4)))
        for name, bad in samples.bad_copies(data).items():
            with open(path, "wb") as file:
                file.write(bad)
            with self.assertRaises(mns_reader.MnsError, msg=name) as caught:
                mns_reader.read(path)
            self.assertIn("cop", str(caught.exception), name)

    def test_an_existing_file_is_kept_unless_forced(self):
        import subprocess
        path = self.files["pair"]
        done = subprocess.run([PROGRAM, "export", "blender", path.replace(".mns", ".xyzr"), "-o", path],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 6, done.stderr)

    def test_the_ply_holds_the_same_closed_mesh(self):
        import subprocess
        target = os.path.join(self.folder.name, "triple.ply")
        subprocess.run([PROGRAM, "export", "ply", os.path.join(self.folder.name, "triple.xyzr"), "-o", target,
                        "--device", "cpu"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        with open(target, "rb") as file:
            header, body = file.read().split(b"end_header\n", 1)
        lines = header.decode("ascii").splitlines()
        counts = [int(line.split()[2]) for line in lines if line.startswith("element")]
        fields, in_vertex = [], False
        for line in lines:
            in_vertex = line.startswith("element vertex") or (in_vertex and not line.startswith("element"))
            if in_vertex and line.startswith("property"):
                fields.append((line.split()[2], {"float": "<f4", "uchar": "u1"}[line.split()[1]]))
        vertices = np.frombuffer(body, np.dtype(fields), counts[0])
        rows = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts[1], vertices.nbytes)
        self.assertEqual(len(body), vertices.nbytes + rows.nbytes)
        self.assertTrue((rows["n"] == 3).all())
        self.assertTrue(mns_reader.is_closed(rows["v"]))
        surface = mns_reader.read(self.files["triple"]).objects[0]
        self.assertEqual(counts, [len(surface["mesh.position"]), len(surface["mesh.triangle"])])
        xyz = np.stack([vertices[k] for k in "xyz"], axis=1)
        self.assertAlmostEqual(mns_reader.signed_volume(xyz, rows["v"]), surface.header["mesh"]["volume"], places=2)
        length = np.sqrt(sum(vertices["n" + k].astype(float) ** 2 for k in "xyz"))
        np.testing.assert_allclose(length, 1.0, atol=1e-6)
        self.assertIn("b_factor", vertices.dtype.names)


class FakeItems(list):
    def foreach_set(self, name, values):
        self.set = {**getattr(self, "set", {}), name: values}


class NewMesh:
    """What compat touches of a mesh of Blender 4.1 and later: no auto smooth."""

    def __init__(self):
        self.polygons, self.calls = FakeItems([0, 0]), []

    def shade_smooth(self):
        self.calls.append("smooth")

    def normals_split_custom_set(self, normals):
        self.calls.append(("corners", len(normals)))

    def normals_split_custom_set_from_vertices(self, normals):
        self.calls.append(("vertices", len(normals)))


class OldMesh(NewMesh):
    use_auto_smooth, auto_smooth_angle = False, 0.5


class Compat(unittest.TestCase):
    """The branches for other versions than the installed one, on stand-ins."""

    def test_normals_come_last_and_smoothing_before_them(self):
        import compat
        mesh = NewMesh()
        compat.set_smooth_with_normals(mesh, np.zeros((6, 3)))
        compat.set_smooth_with_vertex_normals(mesh, np.zeros((4, 3)))
        self.assertEqual(mesh.calls, ["smooth", ("corners", 6), "smooth", ("vertices", 4)])
        mesh = OldMesh()
        compat.set_smooth_with_normals(mesh, np.zeros((6, 3)))
        self.assertEqual(mesh.calls, [("corners", 6)])
        self.assertTrue(mesh.use_auto_smooth)
        self.assertGreater(mesh.auto_smooth_angle, 3.14)

    def test_renamed_sockets_are_found(self):
        import compat

        class Node:
            inputs = {"Specular IOR Level": 1}

        self.assertEqual(compat.principled_input(Node, "Specular", "Specular IOR Level"), 1)
        self.assertIsNone(compat.principled_input(Node, "Sheen Tint"))

    def test_triangles_when_loop_total_is_read_only(self):
        import compat

        class ReadOnly(FakeItems):
            def add(self, count):
                self.count = count

            def foreach_set(self, name, values):
                if name == "loop_total":
                    raise AttributeError(name)
                super().foreach_set(name, values)

        mesh = NewMesh()
        mesh.loops, mesh.polygons = ReadOnly(), ReadOnly()
        compat.set_triangles(mesh, np.array([[0, 1, 2], [2, 1, 3]], dtype=np.uint32))
        self.assertEqual((mesh.loops.count, mesh.polygons.count), (6, 2))
        self.assertEqual(list(mesh.polygons.set["loop_start"]), [0, 3])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
