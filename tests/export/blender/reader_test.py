# SPDX-License-Identifier: BSD-3-Clause
"""The .mns reader of the Blender add-on under plain Python: arguments PROGRAM ADDON_FOLDER."""

import json
import os
import struct
import subprocess
import sys
import tempfile
import types
import unittest

PROGRAM, ADDON = sys.argv[1], sys.argv[2]
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
package = sys.modules["meniscus_import"] = types.ModuleType("meniscus_import")  # The add-on is loaded without Blender.
package.__path__ = [os.path.join(ADDON, "meniscus_import")]

import numpy as np  # noqa: E402

import samples  # noqa: E402
from meniscus_import import mns_reader  # noqa: E402


class Reader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.files = {name: samples.export(PROGRAM, cls.folder.name, name) for name in samples.MOLECULES}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_charges_and_hydropathies_where_atoms_have_them(self):
        source, target = (os.path.join(self.folder.name, name) for name in ("three.pqr", "three.mns"))
        with open(source, "w", encoding="ascii") as file:
            file.write("ATOM 1 CA ALA A 1 0.0 0.0 0.0 -0.25 1.7\nATOM 2 CA ARG A 2 4.0 0.0 0.0 0.75 1.7\n"
                       "ATOM 3 C1 LIG A 3 8.0 0.0 0.0 0.5 1.7\n")
        subprocess.run([PROGRAM, "export", "blender", source, "--select", "all", "-o", target, "--device", "cpu", "-q"], check=True, stdout=subprocess.DEVNULL)
        surface = mns_reader.read(target).objects[0]
        np.testing.assert_allclose(surface["atom.charge"], [-0.25, 0.75, 0.5])
        np.testing.assert_allclose(surface["atom.hydrophobicity"], [1.8, -4.5, 0.0], rtol=1e-6)
        bare = mns_reader.read(self.files["triple"]).objects[0]
        self.assertIsNone(bare.get("atom.charge"))
        self.assertIsNone(bare.get("atom.hydrophobicity"))

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *words, "--device", "cpu", "--force"], capture_output=True, text=True, check=False)

    def residues(self, name, *options):
        """Returns the only surface of a .mns file of five residues of ubiquitin."""
        target = os.path.join(self.folder.name, name + ".mns")
        done = self.run_program("export", "blender", samples.UBIQUITIN, "--select", "resi 1-5", "--tolerance", "0.2", "-o", target, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return mns_reader.read(target).objects[0]

    def test_numbers_of_the_surface_are_those_of_export_mesh(self):
        surface = self.residues("all", "--attributes", "all")
        ply = os.path.join(self.folder.name, "all.ply")
        done = self.run_program("export", "mesh", samples.UBIQUITIN, "--select", "resi 1-5", "--tolerance", "0.2", "--attributes", "all", "-o", ply)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(ply, "rb") as file:
            header, body = file.read().split(b"end_header\n", 1)
        head = [line.split() for line in header.decode("ascii").split("element face")[0].splitlines()]
        fields = [(line[2], {"float": "<f4", "uchar": "u1"}[line[1]]) for line in head if line[0] == "property"]
        rows = np.frombuffer(body, np.dtype(fields), next(int(line[2]) for line in head if line[:2] == ["element", "vertex"]))
        place = surface["mesh.position"].astype(np.float64) + surface.header["mesh"]["origin"]
        there = np.stack([rows[axis] for axis in "xyz"], axis=1).astype(np.float64)
        nearest = np.concatenate([((part[:, None] - there) ** 2).sum(axis=2).argmin(axis=1) for part in np.array_split(place, 20)])
        same = np.linalg.norm(place - there[nearest], axis=1) < 1e-4  # Other vertices were welded.
        self.assertGreater(same.mean(), 0.95)
        atom = np.full(len(place), len(surface["atom.radius"]))
        np.minimum.at(atom, surface["mesh.triangle"].ravel(), np.repeat(surface["mesh.atom"], 3))
        of_atoms = {"atom_area": "area", "accessible_area": "accessible_area", "buried_area": "buried_area", "entity": "entity",
                    "b_factor": "b_factor", "res_id": "res_id", "hydrophobicity": "hydrophobicity", "atomic_number": "atomic_number"}
        found = {name: surface[f"mesh.{name}"] for name in ("mean_curvature", "gaussian_curvature", "smooth_mean_curvature",
                                                            "smooth_gaussian_curvature")}
        found |= {name: surface[f"atom.{array}"][atom] for name, array in of_atoms.items()}
        for name, values in found.items():
            wanted = rows[name][nearest[same]]
            known = np.isfinite(wanted)  # A .mns file has 0 for an unknown value.
            close = np.isclose(values[same][known], wanted[known], rtol=1e-4, atol=1e-4)
            # Averages differ a little on a mesh whose vertices were welded.
            self.assertGreater(close.mean(), 0.9 if name.startswith("smooth") else 0.999, name)
            self.assertGreater(known.mean(), 0.99, name)
        # A vertex has one of its patches, a triangle has its own. Pieces too small for a triangle are missing.
        self.assertLess(np.abs(np.unique(rows["patch_area"])[:, None] - surface["mesh.patch_area"]).min(axis=1).max(), 1e-4)
        pieces = set(zip(surface["mesh.kind"].tolist(), surface["mesh.patch"].tolist(), surface["mesh.patch_area"].tolist()))
        self.assertAlmostEqual(sum(area for *_, area in pieces) / surface.header["area"], 1.0, delta=0.005)

    def test_areas_add_up_and_curvatures_are_those_of_spheres(self):
        surface = self.residues("usual")
        self.assertAlmostEqual(surface["atom.area"].sum(dtype=np.float64) / surface.header["area"], 1.0, places=6)
        said = self.run_program("surface", samples.UBIQUITIN, "--select", "resi 1-5", "--surface", "sas", "--json", "-q").stdout
        self.assertAlmostEqual(surface["atom.accessible_area"].sum(dtype=np.float64) / json.loads(said)["area"], 1.0, places=6)
        kinds = {}
        for triangle, kind in zip(surface["mesh.triangle"], surface["mesh.kind"]):
            for vertex in triangle:
                kinds.setdefault(vertex, set()).add(int(kind))
        for kind, curvature in ((0, 1.0 / surface["atom.radius"]), (2, np.array([-1.0 / 1.4]))):
            inner = [vertex for vertex, around in kinds.items() if around == {kind}]
            self.assertGreater(len(inner), 20)
            mean = surface["mesh.mean_curvature"][inner].astype(np.float64)
            self.assertLess(np.abs(mean[:, None] - curvature).min(axis=1).max(), 1e-6)
            np.testing.assert_allclose(surface["mesh.gaussian_curvature"][inner], mean ** 2, rtol=1e-5)
        self.assertIsNone(surface.get("mesh.smooth_mean_curvature"))
        self.assertIsNone(surface.get("atom.buried_area"))

    def test_names_are_places_in_lists(self):
        surface = self.residues("names", "--attributes", "none")
        self.assertEqual([name for name in surface.arrays if "curvature" in name or name.endswith("area")], [])
        residues, atoms = surface.header["residue_names"], surface.header["atom_names"]
        self.assertEqual(residues, ["MET", "GLN", "ILE", "PHE", "VAL"])
        self.assertEqual([residues[n] for n in surface["atom.residue_name_id"]],
                         [residues[n - 1] for n in surface["atom.res_id"]])
        self.assertEqual(atoms[surface["atom.name_id"][0]], "N")
        self.assertEqual(len(set(atoms)), len(atoms))
        self.assertIsNone(mns_reader.read(self.files["triple"]).objects[0].get("atom.name_id"))

    def test_names_of_a_foreign_file_stay_data(self):
        """Quotes, backslashes and Python code in names are only data."""
        source, target = (os.path.join(self.folder.name, name) for name in ("foreign.pdb", "foreign.mns"))
        with open(source, "w", encoding="ascii") as file:
            for number, (name, residue) in enumerate((("'\"\\n", "'+x"), ("{0}%", "\"\"\"")), 1):
                file.write("HETATM%5d %-4s %3s A%4d    %8.3f%8.3f%8.3f  1.00  0.00           C\n" % (number, name, residue, number, 4.0 * number, 0, 0))
        self.assertEqual(self.run_program("export", "blender", source, "-o", target).returncode, 0)
        surface = mns_reader.read(target).objects[0]
        self.assertEqual(surface.header["atom_names"], ["'\"\\n", "{0}%"])
        self.assertEqual(surface.header["residue_names"], ["'+x", "\"\"\""])

    def test_what_attributes_cannot_be_had_is_said(self):
        target = os.path.join(self.folder.name, "part.mns")
        words = ["export", "blender", samples.UBIQUITIN, "--select", "resi 1-5", "--tolerance", "0.2", "-o", target, "--clip", "depth>0.5"]
        done = self.run_program(*words, "--attributes", "smooth_mean_curvature")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--clip", done.stderr)
        done = self.run_program(*words, "--attributes", "all")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no smooth curvature is written", done.stderr)
        surface = mns_reader.read(target).objects[0]
        self.assertIsNone(surface.get("mesh.smooth_mean_curvature"))
        self.assertTrue((surface["mesh.patch_area"][surface["mesh.kind"] == mns_reader.CAP] == 0).all())
        done = self.run_program(*words, "--attributes", "nonsense")
        self.assertIn("'nonsense' is not an attribute", done.stderr)

    def test_the_same_command_writes_the_same_bytes(self):
        files = []
        for name in ("one", "two"):
            self.residues(name, "--attributes", "all")
            with open(os.path.join(self.folder.name, name + ".mns"), "rb") as file:
                files.append(file.read())
        self.assertEqual(*files)

    def test_arrays_of_numbers_must_fit(self):
        with open(self.files["triple"], "rb") as file:
            data = file.read()
        path = os.path.join(self.folder.name, "bad.mns")
        for name in ("mesh.mean_curvature", "atom.area"):
            header, _ = samples.header_of(data)
            next(array for array in header["arrays"] if array["name"] == "0/" + name)["rows"] -= 1
            with open(path, "wb") as file:
                file.write(samples.with_header(data, header))
            with self.assertRaisesRegex(mns_reader.MnsError, name):
                mns_reader.read(path)

    def test_meshes_are_closed_outward_and_measure_what_the_header_says(self):
        for path in self.files.values():
            surface = mns_reader.read(path).objects[0]
            mesh = surface.header["mesh"]
            self.assertTrue(mns_reader.is_closed(surface["mesh.triangle"]))
            volume = samples.signed_volume(surface["mesh.position"], surface["mesh.triangle"])
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

    def test_caps_close_what_is_cut(self):
        """One case is half of a shell around a cavity that is open in the cap, the other a slab of a ring of atoms."""
        cases = {"cage": (["z<0.3"], 2), "triple": (["y<2.0", "y>0.5"], 4)}
        for name, (planes, borders) in cases.items():
            whole = mns_reader.read(self.files[name]).objects[0]
            with tempfile.TemporaryDirectory() as folder:
                path = samples.export(PROGRAM, folder, name, *(word for plane in planes for word in ("--clip", plane)),
                                      "--cap-hatching", "0.5", "--cap-color", "#102030")
                surface = mns_reader.read(path).objects[0]
                with open(path, "rb") as file:
                    self.assertEqual(struct.unpack_from("<I", file.read(), 8)[0], 4)
            self.assertTrue(mns_reader.is_closed(surface["mesh.triangle"]))
            cap = surface["mesh.kind"] == mns_reader.CAP
            points = surface["mesh.position"].astype(np.float64) + surface.header["mesh"]["origin"]
            given = np.array(surface.header["caps"]["planes"])
            self.assertEqual(len(given), len(planes))
            for normal in given:
                self.assertLess((points @ normal[:3] - normal[3]).max(), 1e-4)
            normals = np.cross(*(points[surface["mesh.triangle"][cap][:, k]] - points[surface["mesh.triangle"][cap][:, 0]] for k in (1, 2)))
            areas = np.linalg.norm(normals, axis=1)
            planes_of = given[surface["mesh.cap_plane"][cap]]
            self.assertGreater(areas.sum(), 2.0)
            large = areas > 1e-6
            np.testing.assert_allclose(normals[large] / areas[large, None], planes_of[large, :3], atol=1e-3)
            volume = samples.signed_volume(surface["mesh.position"], surface["mesh.triangle"])
            self.assertAlmostEqual(volume / surface.header["mesh"]["volume"], 1.0, places=5)
            self.assertTrue(0.2 * whole.header["volume"] < volume < 0.9 * whole.header["volume"])
            # The rim consists of the edges between cap and surface.
            t = surface["mesh.triangle"]
            edges = {}
            for triangle, is_cap in zip(t, cap):
                for k in range(3):
                    edges.setdefault(frozenset((triangle[k], triangle[(k + 1) % 3])), set()).add(bool(is_cap))
            self.assertGreater(sum(kinds == {True, False} for kinds in edges.values()), 10 * borders)
            np.testing.assert_allclose(surface.header["caps"]["color"], np.array([16, 32, 48]) / 255, atol=1e-6)
            self.assertEqual(surface.header["caps"]["hatching"]["distance"], 0.5)
            for axis, plane in zip(surface.header["caps"]["hatching"]["across"], given):
                self.assertAlmostEqual(np.dot(axis, plane[:3]), 0.0, places=9)
                self.assertAlmostEqual(np.linalg.norm(axis), 1.0, places=9)

    def test_what_is_said_of_caps_must_make_sense(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(samples.export(PROGRAM, folder, "cage", "--clip", "z<0.3", "--cap-hatching", "2"), "rb") as file:
                data = file.read()
            header, _ = samples.header_of(data)
            path = os.path.join(folder, "bad.mns")
            for name, caps in (("no planes", {"planes": []}), ("text", {"planes": ["z"]}), ("color", {**header["caps"], "color": [1]}),
                               ("hatching", {**header["caps"], "hatching": {"distance": 0}}), ("nothing", None), ("few", {"planes": [[0, 0, 1]]})):
                with open(path, "wb") as file:
                    file.write(samples.with_header(data, {**header, "caps": caps}, 3))
                with self.assertRaises(mns_reader.MnsError, msg=name):
                    mns_reader.read(path)
            last = next(array for array in header["arrays"] if array["name"] == "0/mesh.cap_plane")["rows"] - 1
            with open(path, "wb") as file:
                file.write(samples.patched(data, "mesh.cap_plane", "I", 7, last))
            with self.assertRaises(mns_reader.MnsError):
                mns_reader.read(path)

    def test_arrays_are_aligned(self):
        for path in self.files.values():
            with open(path, "rb") as file:
                data = file.read()
            surface = mns_reader.read(path).objects[0]
            for name in surface.arrays:
                self.assertEqual(samples.array_place(data, name)[0] % 64, 0, name)

    def test_packed_arrays_are_the_plain_ones(self):
        path = os.path.join(self.folder.name, "plain.mns")
        for packed in self.files.values():
            with open(packed, "rb") as file:
                data = file.read()
            with open(path, "wb") as file:
                file.write(samples.plain(data))
            self.assertLess(len(data), 0.7 * os.path.getsize(path), packed)
            there, here = mns_reader.read(packed).objects[0], mns_reader.read(path).objects[0]
            self.assertEqual(set(there.arrays), set(here.arrays))
            for name, array in there.arrays.items():
                self.assertEqual((array.dtype, array.tobytes()), (here[name].dtype, here[name].tobytes()), name)
                self.assertFalse(len(array) and array.flags.writeable, name)

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
            if name == "not_closed":  # The reader accepts it, and the import refuses it.
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
        self.assertAlmostEqual(samples.signed_volume(xyz, rows["v"]), surface.header["mesh"]["volume"], places=2)
        length = np.sqrt(sum(vertices["n" + k].astype(float) ** 2 for k in "xyz"))
        np.testing.assert_allclose(length, 1.0, atol=1e-6)
        self.assertIn("b_factor", vertices.dtype.names)


unittest.main(argv=sys.argv[:1])
