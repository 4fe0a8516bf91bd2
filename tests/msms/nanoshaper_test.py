# SPDX-License-Identifier: BSD-3-Clause
"""meniscus-nanoshaper with configurations of its clients, and its files by place, like clients read them."""

import collections
import json
import math
import pathlib
import unittest

from msms_run import BUILD, TOXIN, UBIQUITIN, Folder, run

# As TABI-PB writes it, but for the smallest cavity: one of a probe of 1.4 Å has 11.5 Å³ at least.
CONFIGURATION = """Grid_scale = {scale}
Grid_perfil = 90
XYZR_FileName = molecule.xyzr
Build_epsilon_maps = false
Build_status_map = false
Save_Mesh_MSMS_Format = true
Compute_Vertex_Normals = true
Surface = ses
Smooth_Mesh = true
Skin_Surface_Parameter = 0.45
Cavity_Detection_Filling = {fill}
Conditional_Volume_Filling_Value = 20
Keep_Water_Shaped_Cavities = false
Probe_Radius = 1.4
Accurate_Triangulation = true
Triangulation = true
Check_duplicated_vertices = true
Save_PovRay = false
"""

Mesh = collections.namedtuple("Mesh", "positions normals atoms triangles")


def rows(path, width):
    """Reads rows like propermab: two lines are thrown away, and the third is the number of rows, which follow."""
    lines = path.read_text().splitlines()
    found = [line.split() for line in lines[3:]]
    assert len(found) == int(lines[2]) and {len(row) for row in found} == {width}, path
    return found


def read_mesh(folder):
    vertices, faces = rows(folder / "triangulatedSurf.vert", 9), rows(folder / "triangulatedSurf.face", 5)
    return Mesh([tuple(map(float, row[:3])) for row in vertices], [tuple(map(float, row[3:6])) for row in vertices],
                [int(row[7]) for row in vertices], [tuple(int(word) - 1 for word in row[:3]) for row in faces])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def area_and_volume(mesh):
    area = volume = 0.0
    for triangle in mesh.triangles:
        a, b, c = (mesh.positions[corner] for corner in triangle)
        normal = cross(minus(b, a), minus(c, a))
        area += math.sqrt(dot(normal, normal)) / 2
        volume += dot(a, normal) / 6
    return area, volume


def shells(mesh):
    """Returns the connected parts of the mesh."""
    parent = list(range(len(mesh.positions)))

    def root(vertex):
        while parent[vertex] != vertex:
            parent[vertex] = parent[parent[vertex]]
            vertex = parent[vertex]
        return vertex

    for a, b, c in mesh.triangles:
        parent[root(a)] = root(b)
        parent[root(b)] = root(c)
    return len({root(vertex) for vertex in range(len(parent))})


class NanoShaper(Folder):
    def shape(self, pdb=UBIQUITIN, scale=2.0, fill="false"):
        self.molecule(pdb, name="molecule.xyzr")
        (self.folder / "surfaceConfiguration.prm").write_text(CONFIGURATION.format(scale=scale, fill=fill))
        self.good(BUILD / "meniscus-nanoshaper", cwd=self.folder)
        return read_mesh(self.folder)

    def exact(self):
        told = self.good(BUILD / "meniscus", "surface", self.folder / "molecule.xyzr", "--json", "--quiet").stdout
        return json.loads(told)

    def test_what_a_client_reads_is_the_surface(self):
        mesh, exact = self.shape(scale=3.0), self.exact()
        area, volume = area_and_volume(mesh)
        self.assertAlmostEqual(area / exact["area"], 1, delta=0.01)
        self.assertAlmostEqual(volume / exact["volume"], 1, delta=0.01)
        edges = collections.Counter((triangle[k], triangle[k - 2]) for triangle in mesh.triangles for k in range(3))
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges))
        self.assertEqual(len({*mesh.positions}), len(mesh.positions))
        with_the_normals = 0
        for triangle in mesh.triangles:
            a, b, c = (mesh.positions[corner] for corner in triangle)
            with_the_normals += dot(cross(minus(b, a), minus(c, a)), mesh.normals[triangle[0]]) > 0
        self.assertGreater(with_the_normals, 0.98 * len(mesh.triangles))
        self.assertTrue(all(abs(dot(normal, normal) - 1) < 0.005 for normal in mesh.normals))

    def test_every_line_is_as_in_the_sources_of_nanoshaper(self):
        """Each line has the format of fprintf in Surface::saveMesh, versions 0.8.1 and 1.5, but no date in line 1."""
        mesh = self.shape(scale=1.0)
        first = r"# File created by NanoShaper version \d\S* .*"
        vert = (self.folder / "triangulatedSurf.vert").read_text().split("\n")
        self.assertRegex(vert[0], first)
        self.assertEqual(vert[1:3], ["#vertex", str(len(mesh.positions))])
        for line, position, normals, atom in zip(vert[3:], mesh.positions, mesh.normals, mesh.atoms):
            self.assertEqual(line, "%9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %7d %7d %2d " % (*position, *normals, 0, atom, 0))
        face = (self.folder / "triangulatedSurf.face").read_text().split("\n")
        self.assertRegex(face[0], first)
        self.assertEqual(face[1:3], ["#faces", str(len(mesh.triangles))])
        for line, corners in zip(face[3:], mesh.triangles):
            self.assertEqual(line, "%6d %6d %6d %2d %6d" % (*(corner + 1 for corner in corners), 1, 1))

    def test_spheres_are_those_that_the_probe_touches(self):
        mesh = self.shape(scale=1.0)
        spheres = [tuple(map(float, line.split())) for line in (self.folder / "molecule.xyzr").read_text().splitlines()]
        for position, atom in zip(mesh.positions, mesh.atoms):
            offset = minus(position, spheres[atom - 1][:3])
            self.assertTrue(-0.01 < math.sqrt(dot(offset, offset)) - spheres[atom - 1][3] < 1.4)

    def test_the_scale_of_the_grid_is_a_density(self):
        for scale in (1.0, 2.0):
            mesh = self.shape(scale=scale)
            self.assertAlmostEqual(len(mesh.positions) / self.exact()["area"] / (1.5 * scale**2), 1, delta=0.15)

    def test_small_cavities_are_filled_if_asked(self):
        filled, whole = (self.shape(TOXIN, scale=1.0, fill=fill) for fill in ("true", "false"))
        cavities = [part["volume"] for part in self.exact()["components"] if part["kind"] == "cavity"]
        small, large = ([volume for volume in cavities if (volume < 20) == is_small] for is_small in (True, False))
        self.assertTrue(small and large)
        self.assertEqual((shells(whole), shells(filled)), (1 + len(cavities), 1 + len(large)))
        self.assertGreater(area_and_volume(filled)[1], area_and_volume(whole)[1])

    def test_the_template_of_pbj(self):
        """The template has blanks at ends of lines, numbers with leading zeros, a path, and no end of the last line."""
        path = self.molecule()
        text = CONFIGURATION.format(scale="02.0 ", fill="false").replace("molecule.xyzr", f"{path} ")
        (self.folder / "surfaceConfiguration.prm").write_text(
            text.replace("Surface = ses", "Surface = ses ") + "Self_Intersections_Grid_Coefficient = 2")
        self.good(BUILD / "meniscus-nanoshaper", cwd=self.folder)
        self.assertGreater(len(read_mesh(self.folder).triangles), 10_000)

    def test_the_parameters_of_vmd(self):
        """VMD names the file of its parameters; it reads both files of MSMS behind three lines, by scanf."""
        path, base = self.molecule(), self.folder / "vmdns.u0.664."
        path.rename(f"{base}xyzr")
        pathlib.Path(f"{base}prm").write_text(f"""Operative_Mode = normal
Pocket_Radius_Small = 1.4
Pocket_Radius_Big = 3.0
Surface = ses
Grid_scale = 2.0
XYZR_FileName = {base}xyzr
Probe_Radius = 1.4
Skin_Surface_Parameter = 0.45
Blobbyness = -2.5
Compute_Vertex_Normals = true
Save_Mesh_MSMS_Format = true
Vertex_Atom_Info = true
Grid_perfil = 70.0
Build_epsilon_maps = false
Build_status_map = true
Smooth_Mesh = true
Triangulation = true
Max_Probes_Self_Intersections = 5000
Self_Intersections_Grid_Coefficient = 5.0
Accurate_Triangulation = true
Root_FileName = {base}
Max_skin_patches_per_auxiliary_grid_2d_cell = 2000
""")
        self.good(BUILD / "meniscus-nanoshaper", f"{base}prm", cwd="/")
        made = {width: rows(pathlib.Path(f"{base}triangulatedSurf.{kind}"), width) for kind, width in (("vert", 9), ("face", 5))}
        count = len(pathlib.Path(f"{base}xyzr").read_text().splitlines())
        self.assertEqual({int(word) for row in made[5] for word in row[:3]}, set(range(1, len(made[9]) + 1)))
        self.assertTrue(all(1 <= int(row[7]) <= count for row in made[9]))

    def test_another_file_may_be_named(self):
        self.shape()
        (self.folder / "surfaceConfiguration.prm").rename(self.folder / "other.prm")
        (self.folder / "triangulatedSurf.vert").unlink()
        self.good(BUILD / "meniscus-nanoshaper", "other.prm", cwd=self.folder)
        self.assertGreater(len(read_mesh(self.folder).triangles), 1000)

    def test_every_key_is_honoured_refused_or_named(self):
        """Keys for results other than our files are refused; keys unknown to NanoShaper are named."""
        self.molecule(name="molecule.xyzr")
        least = "XYZR_FileName = molecule.xyzr\nGrid_scale = 0.5\n"
        both = {"triangulatedSurf.vert", "triangulatedSurf.face", "triangulatedSurf.off"}
        refused = ("Operative_Mode = pockets", "Operative_Mode = membfit", "Surface = pockets", "Surface = skin",
                   "Surface = blobby", "Surface = mesh", "Save_Mesh_PLY_Format = true", "Triangulation = false",
                   "Save_Cavities = true", "Save_Status_map = true", "Save_eps_maps = true", "Save_bgps = true",
                   "Save_PovRay = true", "Tri2Balls = true")
        allowed = ("Operative_Mode = normal", "Surface = ses", "Save_Mesh_PLY_Format = false", "Triangulation = true",
                   "Save_Cavities = false", "Smooth_Mesh = false", "Max_ses_patches_per_auxiliary_grid_cell = 250;",
                   "Grid_perfill = 70", "Pocket_Radius_Big = 3.0", "Number_thread = 32", "Blobbyness = -2.5")
        for line in refused + allowed:
            with self.subTest(line):
                (self.folder / "surfaceConfiguration.prm").write_text(least + line + "\n")
                done = run(BUILD / "meniscus-nanoshaper", cwd=self.folder)
                made = {path.name for path in self.folder.glob("triangulated*")}
                if line in refused:
                    self.assertEqual((done.returncode, made, done.stderr.count("\n")), (3, set(), 1))
                    self.assertIn(f"prm:3: {line.split()[0]} is '{line.split()[-1]}'; give", done.stderr)
                else:
                    self.assertEqual((done.returncode, made, done.stderr), (0, both, ""))
                for name in made:
                    (self.folder / name).unlink()
        (self.folder / "surfaceConfiguration.prm").write_text(least + "Probe_radius = 3\n")
        done = run(BUILD / "meniscus-nanoshaper", cwd=self.folder)
        self.assertEqual(done.returncode, 0)
        self.assertIn("warning: surfaceConfiguration.prm: 'Probe_radius' is not a key of NanoShaper", done.stderr)

    def test_files_are_those_that_the_client_reads(self):
        """VMD gives names a prefix of its own; other clients need OFF, the default form of NanoShaper."""
        mesh = self.shape(scale=1.0)
        settings = self.folder / "surfaceConfiguration.prm"
        as_msms = settings.read_text()
        for path in self.folder.glob("triangulated*"):
            path.rename(self.folder / f"first_{path.name}")
        (self.folder / "tmp").mkdir()
        settings.write_text(as_msms.replace("MSMS_Format = true", "MSMS_Format = false") + "Root_FileName = tmp/vmdns.7.\n")
        self.good(BUILD / "meniscus-nanoshaper", cwd=self.folder)
        self.assertEqual([path.name for path in (self.folder / "tmp").iterdir()], ["vmdns.7.triangulatedSurf.off"])
        lines = (self.folder / "tmp/vmdns.7.triangulatedSurf.off").read_text().split("\n")
        self.assertRegex("|".join(lines[:3]), r"^OFF\|# File created by NanoShaper version \d\S* .*\|$")
        count, triangles, edges = map(int, lines[3].split())
        self.assertEqual((count, triangles, edges), (len(mesh.positions), len(mesh.triangles), 0))
        numbers = list(map(float, " ".join(lines[4:]).split()))
        self.assertEqual([tuple(numbers[3 * n:3 * n + 3]) for n in range(count)], mesh.positions)
        rows = [tuple(map(int, numbers[3 * count + 4 * n:3 * count + 4 * n + 4])) for n in range(triangles)]
        self.assertEqual(rows, [(3, *triangle) for triangle in mesh.triangles])
        settings.write_text(as_msms + "Root_FileName = tmp/other_\n")
        self.good(BUILD / "meniscus-nanoshaper", cwd=self.folder)
        for kind in ("vert", "face"):
            self.assertEqual((self.folder / f"tmp/other_triangulatedSurf.{kind}").read_text(),
                             (self.folder / f"first_triangulatedSurf.{kind}").read_text())

    def test_faults_are_told_with_their_line_and_write_nothing(self):
        self.molecule(name="molecule.xyzr")
        good = CONFIGURATION.format(scale=2, fill="false")
        cases = {
            good.replace("= ses", "= skin"): (3, "prm:8: Surface is 'skin'; give ses"),
            good.replace("Grid_scale = 2", "Grid_scale = two"): (3, "prm:1: Grid_scale is 'two'; give a number from 0.1 to 20"),
            good.replace("Radius = 1.4", "Radius = -1"): (3, "Probe_Radius is '-1'"),
            good.replace("Filling = false", "Filling = maybe"): (3, "true or false"),
            good.replace("XYZR_FileName", "XYZ"): (3, "has no XYZR_FileName"),
            good.replace("molecule.xyzr", "none.xyzr"): (3, "none.xyzr"),
            good + "words\n": (3, "is not of the form"),
        }
        for text, (code, message) in cases.items():
            (self.folder / "surfaceConfiguration.prm").write_text(text)
            before = sorted(self.folder.iterdir())
            done = run(BUILD / "meniscus-nanoshaper", cwd=self.folder)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertEqual(sorted(self.folder.iterdir()), before)
        for words, code in ((("a", "b"), 2), (("--scale",), 2), (("none.prm",), 3), (("--help",), 0)):
            done = run(BUILD / "meniscus-nanoshaper", *words, cwd=self.folder)
            self.assertEqual(done.returncode, code, done.stderr)


if __name__ == "__main__":
    unittest.main()
