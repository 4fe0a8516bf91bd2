# SPDX-License-Identifier: BSD-3-Clause
"""mesh_readers_test.py PROGRAM [BLENDER]: mesh files in other programs. ADMesh, TetGen, meshio, Assimp, PyMOL and Blender read
what `meniscus export mesh` writes, and find the triangles, the bounds, the volume and the colours of the PLY file, nothing
open, nothing that meets itself; VTP, DMS and the numbers of GLB, which none of these reads, are read here."""

import importlib.util
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile
from unittest import mock
from xml.etree import ElementTree

import numpy as np

MOLECULE = "/usr/share/freesasa/test-data/1ubq.pdb"  # a molecule with two cavities
ENSEMBLE = "/usr/share/freesasa/test-data/1d3z.pdb"
PROGRAM = None
BLENDER = None
WORDS = ["--tolerance", "0.1", "--color", "residue", "--device", "cpu", "-q"]
EXTRA = ["--attributes", "usual,mean_curvature,gaussian_curvature,smooth_mean_curvature,hydrophobicity,entity,charge"]


def export(path, *words, code=0):
    done = subprocess.run([PROGRAM, "export", "mesh", *words, "-o", str(path)], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return done


def read_ply(path):
    """Returns vertices, as a structured array, and triangles."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().splitlines()
    count = {words[1]: int(words[2]) for words in map(str.split, header) if words[0] == "element"}
    types = {"float": "<f4", "uchar": "u1"}
    row = np.dtype([(words[2], types[words[1]]) for words in map(str.split, header)
                    if words[0] == "property" and len(words) == 3])
    vertices = np.frombuffer(data, row, count["vertex"], end)
    faces = np.frombuffer(data, np.dtype([("n", "u1"), ("v", "<i4", 3)]), count["face"], end + vertices.nbytes)
    assert end + vertices.nbytes + faces.nbytes == len(data)
    return vertices, faces["v"]


def positions_of(vertices):
    return np.stack([vertices[k] for k in "xyz"], axis=1)


def volume_of(positions, triangles):
    a, b, c = (positions[triangles[:, k]].astype(float) for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def open_edges(triangles):
    directed = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]).astype(np.int64)
    there = directed[:, 0] << 32 | directed[:, 1]
    back = directed[:, 1] << 32 | directed[:, 0]
    return len(np.setxor1d(there, back)) + len(there) - len(np.unique(there))


def read_glb(path):
    data = path.read_bytes()
    magic, version, length, json_length, json_type = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, length, json_type) == (b"glTF", 2, len(data), b"JSON")
    scene = json.loads(data[20:20 + json_length])
    size, kind = struct.unpack_from("<I4s", data, 20 + json_length)
    assert kind == b"BIN\0" and 28 + json_length + size == length
    binary = data[28 + json_length:]

    def array(number):
        accessor = scene["accessors"][number]
        view = scene["bufferViews"][accessor["bufferView"]]
        columns = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        kind = {5126: "<f4", 5125: "<u4", 5123: "<u2"}[accessor["componentType"]]
        return np.frombuffer(binary, kind, accessor["count"] * columns, view["byteOffset"]).reshape(-1, columns)
    return scene, array


def read_vtp(path):
    data = path.read_bytes()
    start = data.index(b"<AppendedData")
    root = ElementTree.fromstring(data[:start] + b"</VTKFile>")
    first = data.index(b"_", start) + 1
    arrays = {}
    for entry in root.iter("DataArray"):
        if entry.get("format") != "appended":
            continue
        at = first + int(entry.get("offset"))
        size, = struct.unpack_from("<Q", data, at)
        block = data[at + 8:at + 8 + size]
        types = {"Float32": "<f4", "Int32": "<i4", "UInt32": "<u4", "UInt8": "u1"}
        if entry.get("type") == "String":
            arrays[entry.get("Name")] = block.split(b"\0")[:-1]
        else:
            columns = int(entry.get("NumberOfComponents"))
            arrays[entry.get("Name")] = np.frombuffer(block, types[entry.get("type")]).reshape(-1, columns)
    return root, arrays


def usd_rows(text, name):
    """Returns the values of an attribute of the only mesh, in a run for each frame."""
    found = re.search(rf"\[\] {name} = (\[.*?\])", text) or re.search(rf"\[\] {name}\.timeSamples = {{(.*?)}}", text, re.S)
    rows = re.findall(r"\[(.*?)\]", found[1])
    columns = rows[0].count(",", 0, rows[0].find(")")) + 1 if rows[0].startswith("(") else 1
    return [np.array(re.sub(r"[(),]", " ", row).split(), dtype=float).reshape(-1, columns) for row in rows]


def write_capsid(path, molecule=MOLECULE):
    """Writes a molecule as an assembly of three copies: in its own place, turned by 90° about z, and turned by 120°
    about the diagonal. Returns their matrices."""
    places = np.array([np.eye(4)] * 3)
    places[1][:3] = [[0, -1, 0, 60], [1, 0, 0, -5], [0, 0, 1, 0]]
    places[2][:3] = [[0, 0, 1, -70.5], [1, 0, 0, 0], [0, 1, 0, 12]]
    remarks = ["REMARK 350 BIOMOLECULE: 1", "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A"]
    for n, place in enumerate(places):
        remarks += [f"REMARK 350   BIOMT{k + 1}{n + 1:4}" + "".join(f"{x:10.6f}" for x in place[k, :3]) +
                    f"{place[k, 3]:15.5f}" for k in range(3)]
    path.write_text("\n".join(remarks) + "\n" + pathlib.Path(molecule).read_text())
    return places


COPIES = ["--assembly", "1", "--instances", "separate"]


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.room.name)
        export(cls.folder / "a.ply", MOLECULE, *WORDS, *EXTRA)
        cls.vertices, cls.triangles = read_ply(cls.folder / "a.ply")
        cls.positions = positions_of(cls.vertices)
        cls.volume = volume_of(cls.positions, cls.triangles)

    @classmethod
    def tearDownClass(cls):
        cls.room.cleanup()

    def export(self, name, *words, code=0):
        path = self.folder / name
        words = words or (MOLECULE, *WORDS)
        export(path, *words, "--force", code=code)
        return path

    def tool(self, *words):
        done = subprocess.run([str(w) for w in words], capture_output=True, text=True, cwd=self.folder)
        return done.stdout + done.stderr


class Contents(Case):
    def test_the_mesh_is_closed_and_has_no_flat_triangle(self):
        self.assertEqual(open_edges(self.triangles), 0)
        for positions in (self.positions, np.round(self.positions, 3)):
            a, b, c = (positions[self.triangles[:, k]] for k in range(3))
            self.assertGreater(np.linalg.norm(np.cross(b - a, c - a), axis=1).min(), 0)

    def test_welding_takes_what_three_decimals_cannot_tell(self):
        """At this tolerance some vertices must be welded, and the program reports them."""
        done = export(self.folder / "fine.stl", MOLECULE, "--tolerance", "0.02", "--device", "cpu")
        self.assertIn("welded: ", done.stderr)
        rows = np.frombuffer((self.folder / "fine.stl").read_bytes()[84:],
                             np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")]))
        steps = np.round(rows["x"].astype(float) * 1000).astype(np.int64)
        cross = np.cross(steps[:, 1] - steps[:, 0], steps[:, 2] - steps[:, 0])
        self.assertTrue((cross != 0).any(axis=1).all())
        for k in range(3):
            self.assertTrue((steps[:, k] != steps[:, k - 1]).any(axis=1).all())

    def test_curvature_of_convex_and_concave_patches_is_that_of_their_spheres(self):
        v = self.vertices
        convex, concave = v["ses_kind"] == 0, v["ses_kind"] == 2
        np.testing.assert_allclose(v["mean_curvature"][convex], 1 / v["vdw_radii"][convex], rtol=1e-6)
        np.testing.assert_allclose(v["mean_curvature"][concave], -1 / 1.4, rtol=1e-6)
        np.testing.assert_allclose(v["gaussian_curvature"][concave], 1 / 1.96, rtol=1e-6)
        self.assertTrue((v["gaussian_curvature"][v["ses_kind"] == 1] < 1e-3).mean() > 0.99)

    def test_residues_have_their_hydropathy_and_atoms_without_charge_none(self):
        self.assertTrue(np.isnan(self.vertices["charge"]).all())
        self.assertEqual(set(self.vertices["entity"]), {0.0})
        self.assertLess({-4.5, 4.5, -3.5}, set(np.round(self.vertices["hydrophobicity"], 3)))

    def test_stl(self):
        data = self.export("a.stl").read_bytes()
        self.assertFalse(data.startswith(b"solid"))
        self.assertIn(b"1 Angstrom is 1", data[:80])
        rows = np.frombuffer(data[84:], np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")]))
        self.assertEqual(struct.unpack_from("<I", data, 80)[0], len(self.triangles))
        np.testing.assert_array_equal(rows["x"], self.positions[self.triangles])

    def test_3mf(self):
        with zipfile.ZipFile(self.export("a.3mf")) as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual(archive.namelist(), ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"])
            model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
        core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
        material = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"
        self.assertEqual(model.get("unit"), "millimeter")
        palette = [c.get("color") for c in model.iter(material + "color")]
        places = np.array([[float(v.get(k)) for k in "xyz"] for v in model.iter(core + "vertex")], dtype=np.float32)
        np.testing.assert_array_equal(places, self.positions)
        wanted = ["#%02X%02X%02X" % tuple(self.vertices[v][c] for c in ("red", "green", "blue"))
                  for v in range(len(self.vertices))]
        for triangle, corners in zip(model.iter(core + "triangle"), self.triangles):
            self.assertEqual([int(triangle.get(k)) for k in ("v1", "v2", "v3")], list(corners))
            self.assertEqual([palette[int(triangle.get(k))] for k in ("p1", "p2", "p3")], [wanted[v] for v in corners])

    def test_glb(self):
        scene, array = read_glb(self.export("a.glb", MOLECULE, *WORDS, *EXTRA, "--scale", "0.01"))
        self.assertEqual(scene["asset"]["extras"]["meters_per_angstrom"], 0.01)
        primitive = scene["meshes"][0]["primitives"][0]
        attributes = primitive["attributes"]
        np.testing.assert_allclose(array(attributes["POSITION"]), 0.01 * self.positions, atol=1e-7)
        np.testing.assert_array_equal(array(primitive["indices"]).reshape(-1, 3), self.triangles)
        np.testing.assert_array_equal(array(attributes["_MEAN_CURVATURE"])[:, 0], self.vertices["mean_curvature"])
        self.assertTrue(np.isfinite(array(attributes["_CHARGE"])).all())
        light = array(attributes["COLOR_0"])[:, 0] / 65535
        srgb = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
        np.testing.assert_allclose(255 * srgb, self.vertices["red"], atol=0.1)

    def test_usd(self):
        """Text and archive are equal; a run is one file, whose frames have the values of their PLY files."""
        text = self.export("a.usda", MOLECULE, *WORDS, *EXTRA, "--scale", "0.1").read_text()
        self.assertIn('metersPerUnit = 1\n    upAxis = "Y"\n', text)
        points, = usd_rows(text, "points")
        np.testing.assert_allclose(points, 0.1 * self.positions, rtol=1e-6, atol=1e-6)
        np.testing.assert_array_equal(usd_rows(text, "faceVertexIndices")[0].reshape(-1, 3), self.triangles)
        np.testing.assert_array_equal(usd_rows(text, "primvars:mean_curvature")[0].astype(np.float32)[:, 0],
                                      self.vertices["mean_curvature"])
        self.assertFalse(usd_rows(text, "primvars:charge")[0].any())
        with zipfile.ZipFile(self.export("a.usdz", MOLECULE, *WORDS, *EXTRA, "--scale", "0.1")) as archive:
            self.assertIsNone(archive.testzip())
            entry, = archive.infolist()
            self.assertEqual(archive.read(entry).decode(), text)
            self.assertEqual(entry.compress_type, zipfile.ZIP_STORED)
            data = (self.folder / "a.usdz").read_bytes()
            self.assertEqual(data.index(b"#usda") % 64, 0)
        self.assertEqual(self.export("a.usd", MOLECULE, *WORDS, *EXTRA, "--scale", "0.1").read_text(), text)
        run = ("/usr/share/freesasa/test-data/1d3z.pdb", "--frames", "0-4:2", "--density", "0.2", "--device", "cpu", "-q")
        self.export("run_#.ply", *run)
        text = self.export("run.usda", *run, "--fps", "10").read_text()
        self.assertIn("startTimeCode = 1\n    endTimeCode = 3\n    timeCodesPerSecond = 10\n", text)
        frames = usd_rows(text, "points")
        self.assertEqual(len(frames), 3)
        for place, frame in enumerate((0, 2, 4)):
            vertices, triangles = read_ply(self.folder / f"run_{frame}.ply")
            np.testing.assert_allclose(frames[place], positions_of(vertices), rtol=1e-6, atol=1e-6)
            np.testing.assert_array_equal(usd_rows(text, "faceVertexIndices")[place].reshape(-1, 3), triangles)
            self.assertEqual(usd_rows(text, "velocities")[place].shape, frames[place].shape)
        self.export("run_#.glb", *run)
        self.assertEqual(sorted(path.name for path in self.folder.glob("run_*.glb")), ["run_0.glb", "run_2.glb", "run_4.glb"])
        self.export("run.glb", *run, code=2)
        self.export("run.usda", *run, "--only", "2", code=2)

    def test_copies_share_a_mesh_and_stand_where_they_are(self):
        wanted = write_capsid(self.folder / "capsid.pdb")
        wanted[:, :3, 3] *= 0.1
        words = (str(self.folder / "capsid.pdb"), *WORDS, *COPIES)
        scene, array = read_glb(self.export("copies.glb", *words, "--scale", "0.1"))
        mesh, = scene["meshes"]
        np.testing.assert_allclose(array(mesh["primitives"][0]["attributes"]["POSITION"]), 0.1 * self.positions, atol=1e-6)
        found = {"glb": []}
        for node in scene["nodes"]:
            self.assertEqual(node["mesh"], 0)
            x, y, z, w = node["rotation"]
            place = np.eye(4)
            place[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
            place[:3, 3] = node["translation"]
            found["glb"].append(place)
        text = self.export("copies.usda", *words, "--scale", "0.1").read_text()
        np.testing.assert_allclose(usd_rows(text, "points")[0], 0.1 * self.positions, rtol=1e-6, atol=1e-6)
        self.assertEqual(text.count("instanceable = true\n        prepend references = </molecule/prototypes/surface>"), 3)
        found["usda"] = [np.array(re.sub("[(),]", " ", rows).split(), dtype=float).reshape(4, 4).T
                         for rows in re.findall(r"matrix4d xformOp:transform = (.*)", text)]
        core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
        with zipfile.ZipFile(self.export("copies.3mf", *words, "--scale", "0.1")) as archive:
            model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
        self.assertEqual(len(list(model.iter(core + "object"))), 1)
        found["3mf"] = []
        for item in model.iter(core + "item"):
            place = np.eye(4)
            place[:3] = np.array(item.get("transform").split(), dtype=float).reshape(4, 3).T
            found["3mf"].append(place)
        for ending, places in found.items():
            with self.subTest(ending):
                np.testing.assert_allclose(places, wanted, atol=1e-6)

    def test_copies_of_a_run_move_as_the_molecule(self):
        write_capsid(self.folder / "moving.pdb", ENSEMBLE)
        words = ("--frames", "0-2", "--density", "0.2", "--device", "cpu", "-q")
        alone = self.export("alone.usda", ENSEMBLE, *words).read_text()
        text = self.export("moving.usda", str(self.folder / "moving.pdb"), *words, *COPIES).read_text()
        for name in ("points", "velocities"):
            for of_copy, of_molecule in zip(usd_rows(text, name), usd_rows(alone, name), strict=True):
                np.testing.assert_array_equal(of_copy, of_molecule)
        self.assertEqual((text.count("instanceable"), text.count("matrix4d xformOp:transform = ")), (3, 3))

    def test_copies_that_differ_are_meshes_of_their_own(self):
        """Colours by place, numbers of the whole, and formats without instances make copies differ."""
        write_capsid(self.folder / "capsid.pdb")
        words = (str(self.folder / "capsid.pdb"), "--tolerance", "0.1", "--device", "cpu", "-q", *COPIES)
        (self.folder / "x.dx").write_text(
            "object 1 class gridpositions counts 2 2 2\norigin -200 -200 -200\ndelta 400 0 0\ndelta 0 400 0\n"
            "delta 0 0 400\nobject 2 class gridconnections counts 2 2 2\nobject 3 class array type double rank 0 items 8 "
            "data follows\n-1 -1 -1 -1 1 1 1 1\n")
        for more in (("--color-map-file", str(self.folder / "x.dx"), "--color-range=-1:1"), ("--attributes", "open_sky")):
            scene, _ = read_glb(self.export("apart.glb", *words, *more))
            indices = scene["accessors"][scene["meshes"][0]["primitives"][0]["indices"]]["count"]
            self.assertAlmostEqual(indices / 9, len(self.triangles), delta=0.01 * len(self.triangles))
            self.assertEqual([set(node) for node in scene["nodes"]], [{"name", "mesh"}])
        vertices, triangles = read_ply(self.export("apart.ply", *words))
        self.assertAlmostEqual(volume_of(positions_of(vertices), triangles), 3 * self.volume, delta=0.5)

    def test_materials_take_colors_and_opacity_of_the_mesh(self):
        opaque = self.export("look.usda").read_text()
        self.assertTrue("rel material:binding = </molecule/looks/surface>" in opaque)
        self.assertTrue('string inputs:varname = "displayColor"' in opaque)
        self.assertEqual(opaque.count("pacity"), 1)  # opacity of the glass look
        self.assertEqual(re.findall(r'^        "(\w+)" \{$', opaque, re.M), ["figure", "matte", "plastic", "metal", "glass"])
        scene = {"meniscus_scene": 1, "look": {"shininess": 14, "specular": 0.25}}
        (self.folder / "look.json").write_text(json.dumps(scene))
        words = (MOLECULE, *WORDS, "--opacity", "resid 1-20=0.25", "--scene", str(self.folder / "look.json"))
        text = self.export("look.usda", *words).read_text()
        self.assertTrue("rel material:binding = </molecule/looks/translucent>" in text)
        self.assertTrue("float inputs:roughness = 0.595" in text)  # the fourth root of 2 / (14 + 2)
        self.assertTrue("float inputs:ior = 3\n" in text)  # An index of 3 reflects a quarter.
        of_residue = np.where(self.vertices["res_id"] <= 20, 0.25, 1.0)
        np.testing.assert_allclose(usd_rows(text, "primvars:displayOpacity")[0][:, 0], of_residue)
        scene, array = read_glb(self.export("look.glb", *words))
        primitive = scene["meshes"][0]["primitives"][0]
        material = scene["materials"][primitive["material"]]
        self.assertEqual((material["alphaMode"], material["extensions"]), ("BLEND", {"KHR_materials_ior": {"ior": 3.0}}))
        np.testing.assert_allclose(array(primitive["attributes"]["COLOR_0"])[:, 3] / 65535, of_residue, atol=1e-5)
        done = export(self.folder / "look.stl", *(word for word in words if word != "-q"), "--force")
        self.assertIn("note: --opacity: STL, binary files store no opacity", done.stderr)

    def test_vtp(self):
        root, arrays = read_vtp(self.export("a.vtp", MOLECULE, *WORDS, *EXTRA))
        np.testing.assert_array_equal(arrays["points"], self.positions)
        np.testing.assert_array_equal(arrays["connectivity"].reshape(-1, 3), self.triangles)
        np.testing.assert_array_equal(arrays["offsets"][:, 0], 3 * np.arange(1, len(self.triangles) + 1))
        np.testing.assert_array_equal(arrays["gaussian_curvature"][:, 0], self.vertices["gaussian_curvature"])
        atoms = [line for line in pathlib.Path(MOLECULE).read_text().splitlines() if line.startswith("ATOM")]
        for v in range(0, len(self.vertices), 97):
            line = atoms[int(self.vertices["atom_index"][v])]
            self.assertEqual(arrays["atom_name"][v].decode(), line[12:16].strip())
            self.assertEqual(arrays["residue_name"][v].decode(), line[17:20].strip())
            self.assertEqual(arrays["chain"][v].decode(), line[21])
        self.assertEqual(len(np.unique(arrays["component"])), 3)

    def test_dms(self):
        lines = self.export("a.dms").read_text().splitlines()
        atoms = [line for line in lines if line.endswith(" A")]
        dots = [line for line in lines if not line.endswith(" A")]
        self.assertEqual(len(atoms), 602)
        self.assertEqual(atoms[0], "MET    1    N  27.340   24.430    2.614 A")
        self.assertEqual(len(dots), len(self.vertices))
        self.assertEqual({line[40:43] for line in dots}, {"SC0", "SR0", "SS0"})
        a, b, c = (self.positions[self.triangles[:, k]].astype(float) for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        self.assertAlmostEqual(sum(float(line.split()[7]) for line in dots), area, delta=0.001 * area)
        for line in dots[::50]:
            self.assertAlmostEqual(math.hypot(*map(float, line.split()[8:11])), 1, delta=0.002)

    def test_objects(self):
        """Outer surface and cavities are separate, in one file or in one each; the bodies of 3MF are outward."""
        words = (MOLECULE, *WORDS, "--by", "component")
        scene, array = read_glb(self.export("parts.glb", *words))
        names = [mesh["name"] for mesh in scene["meshes"]]
        self.assertEqual(names, ["component 0", "component 1 (cavity)", "component 2 (cavity)"])
        self.assertEqual([node["mesh"] for node in scene["nodes"]], [0, 1, 2])
        text = self.export("parts.obj", *words).read_text()
        self.assertEqual(re.findall(r"^o (.*)$", text, re.M), ["component_0", "component_1__cavity_", "component_2__cavity_"])
        export(self.folder / "part_##.stl", *words)
        sizes = []
        for n in (1, 2, 3):
            data = (self.folder / f"part_{n:02}.stl").read_bytes()
            rows = np.frombuffer(data[84:], np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")]))
            x = rows["x"].reshape(-1, 3)
            sizes.append(volume_of(x, np.arange(len(x)).reshape(-1, 3)))
        self.assertGreater(sizes[0], 0)
        self.assertLess(max(sizes[1:]), 0)
        self.assertAlmostEqual(sum(sizes), self.volume, delta=0.1)
        core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
        with zipfile.ZipFile(self.export("parts.3mf", *words)) as archive:
            model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
        for body, size in zip(model.iter(core + "object"), sizes):
            x = np.array([[float(v.get(k)) for k in "xyz"] for v in body.iter(core + "vertex")])
            t = np.array([[int(v.get(k)) for k in ("v1", "v2", "v3")] for v in body.iter(core + "triangle")])
            self.assertAlmostEqual(volume_of(x, t), abs(size), delta=0.01)
        self.assertEqual(len(list(model.iter(core + "item"))), 3)

    def test_density_and_even(self):
        area = float(re.search(r'"area": ([0-9.]+)', subprocess.run(
            [PROGRAM, "surface", MOLECULE, "--json", "--device", "cpu", "-q"], capture_output=True, text=True).stdout)[1])
        for density in (0.2, 1.0):
            path = self.export("even.ply", MOLECULE, "--density", str(density), "--device", "cpu", "-q")
            vertices, triangles = read_ply(path)
            self.assertEqual(open_edges(triangles), 0)
            self.assertAlmostEqual(len(vertices) / area, density, delta=0.2 * density)
        path = self.export("even.ply", MOLECULE, "--even", "--tolerance", "0.1", "--device", "cpu", "-q")
        self.assertLess(len(read_ply(path)[1]), 0.8 * len(self.triangles))

    def test_a_camera_makes_near_things_finer(self):
        """Without --tolerance the mesh is within half a pixel at each point, and the program says so."""
        camera = self.folder / "near.json"
        middle = self.positions.mean(axis=0)
        camera.write_text(json.dumps({"position": [float(middle[0]), float(middle[1]), float(middle[2] + 40)],
                                      "target": [float(x) for x in middle], "up": [0, 1, 0],
                                      "projection": "perspective", "vertical_fov": 50}))
        done = export(self.folder / "near.ply", MOLECULE, "--even", "--camera", str(camera), "--size", "400x400",
                      "--device", "cpu")
        self.assertIn("within 0.5 pixels", done.stderr)
        vertices, triangles = read_ply(self.folder / "near.ply")
        x = positions_of(vertices)
        length = np.linalg.norm(x[triangles[:, 0]] - x[triangles[:, 1]], axis=1)
        depth = middle[2] + 40 - x[triangles[:, 0], 2]
        near, far = np.median(length[depth < np.quantile(depth, 0.2)]), np.median(length[depth > np.quantile(depth, 0.8)])
        self.assertGreater(far, 1.15 * near)

    def test_what_does_not_fit_is_one_line(self):
        for words, name, what, code in (
                ((MOLECULE,), "a.xyz", "--format", 2),
                ((MOLECULE,), "a.usdc", "usdcat '", 2),
                ((MOLECULE, "--density", "0.001"), "a.stl", "--density", 2),
                ((MOLECULE, "--density", "1", "--tolerance", "0.1"), "a.stl", "--tolerance", 2),
                ((MOLECULE, "--attributes", "curves"), "a.ply", "'curves' is not an attribute", 2),
                ((MOLECULE, "--scale", "0"), "a.stl", "--scale", 2),
                ((MOLECULE, "--scale", "2", "--unit", "nanometer"), "a.stl", "--unit", 2),
                ((MOLECULE, "--density", "1", "--show", "resid 1-10"), "a.stl", "--select", 2),
                ((MOLECULE, "--by", "component"), "a.smesh", "--by", 2),
                ((MOLECULE,), "nowhere/a.stl", "nowhere", 6),
                (("/nowhere/a.pdb",), "a.stl", "/nowhere/a.pdb", 3)):
            with self.subTest(words=words, name=name):
                done = export(self.folder / name, *words, "--device", "cpu", "-q", "--force", code=code)
                self.assertIn(what, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_file_that_is_there_stays_unless_forced(self):
        path = self.folder / "there.glb"
        path.write_text("mine")
        export(path, MOLECULE, *WORDS, code=6)
        self.assertEqual(path.read_text(), "mine")

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full")
    def test_no_half_file_where_there_is_no_room(self):
        for ending in ("stl", "3mf", "obj", "off", "glb", "vtp", "smesh", "dms", "ply", "py", "usda", "usdz"):
            with self.subTest(ending):
                path = self.folder / f"full.{ending}"
                done = subprocess.run(["sh", "-c", 'ulimit -f 100; trap "" XFSZ; exec "$@"', "sh", PROGRAM, "export",
                                       "mesh", MOLECULE, "--tolerance", "0.03", "--device", "cpu", "-q", "-o", str(path)],
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 6, done.stderr)
                self.assertEqual([p for p in self.folder.iterdir() if "full" in p.name], [])


@unittest.skipUnless(shutil.which("admesh"), "admesh is not installed")
class Admesh(Case):
    def test_nothing_to_mend(self):
        said = self.tool("admesh", self.export("a.stl"))
        number = {name.strip(): values.split()[0] for name, values in re.findall(r"^([A-Z][A-Za-z ]+?) *: +(.*)$", said, re.M)}
        self.assertEqual(int(number["Number of facets"]), len(self.triangles))
        self.assertEqual(int(number["Number of parts"]), 3)
        for fault in ("Total disconnected facets", "Edges fixed", "Facets removed", "Facets reversed", "Backwards edges",
                      "Normals fixed"):
            self.assertEqual(int(number[fault]), 0, fault)
        self.assertEqual(int(re.search(r"Degenerate facets +: +(\d+)", said)[1]), 0)
        self.assertAlmostEqual(float(re.search(r"Volume +: +([0-9.]+)", said)[1]), self.volume, delta=1e-4 * self.volume)


@unittest.skipUnless(shutil.which("tetgen"), "tetgen is not installed")
class Tetgen(Case):
    def test_no_two_triangles_meet(self):
        for words in ((), ("--even",)):
            path = self.export("a.smesh", MOLECULE, *WORDS, *words)
            self.assertIn("No faces are intersecting", self.tool("tetgen", "-d", path))

    def test_it_fills_the_solid_and_leaves_the_cavities(self):
        for words in (("--tolerance", "0.2"), ("--density", "1")):
            path = self.export("b.smesh", MOLECULE, *words, "--device", "cpu", "-q")
            said = self.tool("tetgen", "-pQAz", path)
            points = np.array([line.split()[1:4] for line in (self.folder / "b.1.node").read_text().splitlines()[1:]
                               if not line.startswith("#")], dtype=float)
            rows = np.array([line.split() for line in (self.folder / "b.1.ele").read_text().splitlines()[1:]
                             if not line.startswith("#")], dtype=float).astype(int)
            a, b, c, d = (points[rows[:, k]] for k in range(1, 5))
            filled = np.abs(np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a))).sum() / 6
            vertices, triangles = read_ply(self.export("b.ply", MOLECULE, *words, "--device", "cpu", "-q"))
            self.assertAlmostEqual(filled, volume_of(positions_of(vertices), triangles), delta=0.01, msg=said)
            self.assertEqual(set(rows[:, 5]), {1})  # the region of the outer component


@unittest.skipUnless(importlib.util.find_spec("meshio"), "python3-meshio is not installed")
class Meshio(Case):
    def test_it_reads_four_formats(self):
        import meshio
        for ending in ("stl", "obj", "off", "ply"):
            with self.subTest(ending):
                mesh = meshio.read(self.export("m." + ending))
                self.assertEqual(len(mesh.points), len(self.vertices))
                triangles = mesh.cells_dict["triangle"]
                self.assertEqual(open_edges(triangles), 0)
                # meshio makes points of six dimensions from vertices with colours.
                self.assertAlmostEqual(volume_of(mesh.points[:, :3], triangles), self.volume, delta=0.01)


@unittest.skipUnless(shutil.which("assimp"), "assimp-utils is not installed")
class Assimp(Case):
    def test_it_reads_six_formats(self):
        for ending in ("stl", "obj", "off", "ply", "glb", "3mf"):
            with self.subTest(ending):
                said = self.tool("assimp", "info", self.export("m." + ending))
                self.assertEqual(int(re.search(r"^Faces: +(\d+)", said, re.M)[1]), len(self.triangles), said)
                for word, wanted in (("Minimum", self.positions.min(axis=0)), ("Maximum", self.positions.max(axis=0))):
                    found = re.search(word + r" point +\(([^)]+)\)", said)[1].split()
                    np.testing.assert_allclose([float(x) for x in found], wanted, atol=1e-4)

    def test_it_finds_the_objects(self):
        for ending in ("obj", "glb", "3mf"):
            path = self.export("p." + ending, MOLECULE, *WORDS, "--by", "component")
            said = self.tool("assimp", "info", path)
            self.assertEqual(int(re.search(r"^Meshes: +(\d+)", said, re.M)[1]), 3, said)


@unittest.skipUnless(importlib.util.find_spec("pymol"), "python3-pymol is not installed")
class Pymol(Case):
    def said_by(self, text):
        script = self.folder / "in_pymol.py"
        script.write_text("from pymol import cmd\n" + text)
        return self.tool(sys.executable, "-m", "pymol", "-cq", script)

    def test_a_script_shows_each_object(self):
        path = self.export("parts.py", MOLECULE, *WORDS, "--by", "component")
        said = self.said_by(f"""
cmd.load({str(path)!r})
cmd.sync()
print("FOUND", cmd.get_names(), [list(map(list, cmd.get_extent(name))) for name in cmd.get_names()])
""")
        names, extents = map(json.loads, re.search(r"FOUND (\[.*?\]) (.*)", said.replace("'", '"')).groups())
        self.assertEqual(names, ["meniscus_1", "meniscus_2", "meniscus_3"])
        np.testing.assert_allclose(extents[0], [self.positions.min(axis=0), self.positions.max(axis=0)], atol=1e-3)

    def corners(self, *words):
        """Returns the corners that a script loads: color, normal and position of each, each behind its sign."""
        from pymol import cmd
        with mock.patch.object(cmd, "load_cgo") as load_cgo:
            exec(self.export("whole.py", MOLECULE, *words).read_text(), {})
        (shape, name, state), = (call.args for call in load_cgo.call_args_list)
        self.assertEqual((name, state), ("meniscus_1", 1))
        return np.array(shape[2:-1]).reshape(-1, 3, 12)

    def test_triangles_have_the_colors_of_their_atoms(self):
        rows = self.corners(*WORDS)
        np.testing.assert_allclose(rows[:, :, 9:], self.positions[self.triangles], atol=1e-6)
        of_corners = np.stack([self.vertices[c] for c in ("red", "green", "blue")], axis=1)[self.triangles]
        inside = (of_corners == of_corners[:, :1]).all(axis=(1, 2))  # Elsewhere the colors of corners blend.
        self.assertLess(0.2, inside.mean())
        np.testing.assert_allclose(rows[inside][:, :, 1:4], of_corners[inside] / 255, atol=1e-6)
        self.assertTrue((rows[:, :, 1:4] == rows[:, :1, 1:4]).all())
        self.assertLess(len(np.unique(rows[:, 0, 1:4], axis=0)), 77)

    def test_colors_of_a_map_change_within_triangles(self):
        low, high = self.positions.min(axis=0) - 3, self.positions.max(axis=0) + 3
        step = " ".join(map(str, high - low)).split()
        values = " ".join(str(x) for x in (-1, 1) for _ in range(4))
        (self.folder / "a.dx").write_text(
            f"object 1 class gridpositions counts 2 2 2\norigin {low[0]} {low[1]} {low[2]}\ndelta {step[0]} 0 0\n"
            f"delta 0 {step[1]} 0\ndelta 0 0 {step[2]}\nobject 2 class gridconnections counts 2 2 2\n"
            f"object 3 class array type double rank 0 items 8 data follows\n{values}\n")
        rows = self.corners("--color-map-file", str(self.folder / "a.dx"), "--color-range=-1:1", "--tolerance", "0.3", "-q")
        self.assertGreater((rows[:, :, 1:4] != rows[:, :1, 1:4]).any(axis=(1, 2)).mean(), 0.5)

    def test_ply_as_text_comes_in_and_a_hundred_times_as_large_before_3(self):
        path = self.export("text.ply", MOLECULE, *WORDS, "--format", "ply-ascii")
        said = self.said_by(f"""
cmd.load({str(path)!r}, "a")
print("FOUND", [cmd.get_version()[1], *map(list, cmd.get_extent("a"))])
""")
        version, *found = json.loads(re.search("FOUND (.*)", said)[1])
        found = np.array(found) / (100 if version < 3 else 1)
        np.testing.assert_allclose(found, [self.positions.min(axis=0), self.positions.max(axis=0)], atol=1e-3)

    def test_ply_as_text_holds_what_the_binary_one_does(self):
        lines = self.export("text.ply", MOLECULE, *WORDS, *EXTRA, "--format", "ply-ascii").read_text().splitlines()
        names = [line.split()[2] for line in lines if line.startswith("property") and "list" not in line]
        self.assertEqual(tuple(names), self.vertices.dtype.names)
        first = lines.index("end_header") + 1
        rows = np.array([line.split() for line in lines[first:first + len(self.vertices)]], dtype=float)
        for column, name in enumerate(names):
            np.testing.assert_array_equal(rows[:, column].astype(self.vertices[name].dtype), self.vertices[name])
        triangles = np.array([line.split() for line in lines[first + len(self.vertices):]], dtype=int)
        np.testing.assert_array_equal(triangles[:, 1:], self.triangles)


class Blender(Case):
    def test_its_importers(self):
        if not BLENDER:
            self.skipTest("blender is not installed")
        for ending in ("stl", "obj", "ply", "glb"):
            self.export("b." + ending)
        script = pathlib.Path(__file__).with_name("inside_blender_import.py")
        said = self.tool(BLENDER, "-b", "--factory-startup", "--python-exit-code", "9", "--python", script, "--", self.folder)
        found = json.loads(re.search(r"^FOUND (.*)$", said, re.M)[1]) if "FOUND" in said else self.fail(said[-2000:])
        for ending, mesh in found.items():
            with self.subTest(ending):
                self.assertEqual(mesh["triangles"], len(self.triangles))
                self.assertEqual(mesh["vertices"], len(self.vertices))
                self.assertEqual(mesh["open_edges"], 0)
                self.assertAlmostEqual(mesh["volume"], self.volume, delta=0.02)
                if ending != "stl":
                    wanted = [float(self.vertices[c].astype(float).mean() / 255) for c in ("red", "green", "blue")]
                    np.testing.assert_allclose(mesh["color"], wanted, atol=0.01)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if len(sys.argv) > 1 and sys.argv[1].startswith("/"):
        BLENDER = sys.argv.pop(1)
    unittest.main()
