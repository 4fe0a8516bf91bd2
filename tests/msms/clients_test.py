# SPDX-License-Identifier: BSD-3-Clause
"""Programs that call MSMS, unmodified, with meniscus-msms in its place: Biopython, OpenStructure, Jmol, PyMOL, PyVOL; the
words and readers of others that no package has; and a client of the server, as VMD is one."""

import glob
import importlib.util
import math
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import sys
import time
import unittest

from msms_run import ANALYTIC, BUILD, MSMS, TOXIN, UBIQUITIN, Folder, run, scanned_vertices, table, triangles, vertices


def has(module):
    return importlib.util.find_spec(module) is not None


class WithMsmsInPath(Folder):
    """Programs find meniscus-msms under the name that they look for."""

    def setUp(self):
        super().setUp()
        programs = self.folder / "bin"
        programs.mkdir()
        for name in ("msms", "pdb_to_xyzr", "pdb_to_xyzrn"):
            (programs / name).symlink_to(BUILD / f"meniscus-{name}")
        self.environment = {**os.environ, "PATH": f"{programs}:/usr/bin:/bin", "HOME": str(self.folder)}

    def script(self, text):
        path = self.folder / "script.py"
        path.write_text(text)
        done = run(sys.executable, "-B", path, env=self.environment, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()


@unittest.skipUnless(has("Bio"), "python3-biopython is not installed")
class Biopython(WithMsmsInPath):
    def test_residue_depth(self):
        told = self.script(f"""
from Bio.PDB import PDBParser
from Bio.PDB.ResidueDepth import ResidueDepth
model = PDBParser(QUIET=True).get_structure("x", "{UBIQUITIN}")[0]
for _, (residue, ca) in ResidueDepth(model):
    print(residue, ca)
""")
        depths = [float(x) for x in told]
        self.assertEqual(len(depths), 2 * 76)
        self.assertTrue(all(1.0 < depth < 12.0 for depth in depths))
        self.assertGreater(max(depths[::2]), 5.0)  # the core of ubiquitin
        self.assertLess(min(depths[::2]), 2.5)


@unittest.skipUnless(glob.glob("/usr/lib/python3/dist-packages/ost/bindings/msms.py"), "python3-ost is not installed")
class OpenStructure(WithMsmsInPath):
    def test_areas_volumes_and_surfaces(self):
        told = self.script(f"""
import sys
from ost import io
from ost.bindings import msms
entity = io.LoadPDB("{UBIQUITIN}")
for atom in entity.atoms: atom.radius = 1.8
print("version", msms.GetVersion())
ses, sas = msms.CalculateSurfaceArea(entity, density=1, radius=1.5, attach_asa="asa", attach_esa="esa")
print("area", ses[0], sas[0], sum(a.GetFloatProp("asa") for a in entity.atoms), sum(a.GetFloatProp("esa") for a in entity.atoms))
print("volume", msms.CalculateSurfaceVolume(entity))
print("all", len(msms.CalculateSurfaceArea(entity, all_surf=True)[0]))
for every in (False, True): print("surfaces", len(msms.CalculateSurface(entity, all_surf=every)))
""")
        words = iter(told)
        values = {}
        for word in words:
            if word in ("version", "volume", "all"):
                values[word] = next(words)
            elif word == "area":
                values[word] = [float(next(words)) for _ in range(4)]
            elif word == "surfaces":
                values.setdefault(word, []).append(int(next(words)))
        self.assertEqual(values["version"], "2.6.1")
        ses, sas, atoms_sas, atoms_ses = values["area"]
        self.assertAlmostEqual(sas, atoms_sas, delta=1)
        self.assertAlmostEqual(ses, atoms_ses, delta=1)
        self.assertGreater(float(values["volume"]), 8000)
        self.assertEqual(values["surfaces"], [1, int(values["all"])])


@unittest.skipUnless(shutil.which("java") and pathlib.Path("/usr/share/jmol/JmolData.jar").exists(), "jmol is not installed")
class Jmol(WithMsmsInPath):
    def test_isosurface(self):
        self.molecule()
        self.msms("-if", "in.xyzr", "-of", "out", "-density", "1")
        script = self.folder / "s.spt"
        script.write_text(f'load "{UBIQUITIN}";\nisosurface s1 "{self.folder}/out.vert";\nshow isosurface;\n')
        done = run("java", "-Djava.awt.headless=true", "-jar", "/usr/share/jmol/JmolData.jar", "-n", "-s", script,
                   env=self.environment, cwd=self.folder)
        told = done.stdout + done.stderr
        self.assertIn(str(len(vertices(self.folder / "out.vert"))), told)
        self.assertNotRegex(told, r"(?i)exception|error reading")


@unittest.skipUnless(has("pymol"), "python3-pymol is not installed")
class PyMol(WithMsmsInPath):
    """Its plug-ins read both files, draw the triangles as an object and read its extent."""

    def test_triangles_are_shown(self):
        self.molecule()
        self.msms("-if", "in.xyzr", "-of", "out")
        told = self.script(f"""
import sys
sys.path.insert(0, "{pathlib.Path(__file__).resolve().parent}")
sys.argv = ["", "{BUILD}"]
import pathlib
from msms_run import vertices, triangles
import pymol2
from pymol.cgo import BEGIN, END, NORMAL, TRIANGLES, VERTEX
rows, corners = vertices(pathlib.Path("out.vert")), triangles(pathlib.Path("out.face"))
cgo = [BEGIN, TRIANGLES]
for t in corners:
    for corner in t.corners:
        cgo += [NORMAL, *rows[corner - 1].normal, VERTEX, *rows[corner - 1].position]
cgo.append(END)
with pymol2.PyMOL() as pymol:
    pymol.cmd.load("{UBIQUITIN}", "m")
    pymol.cmd.load_cgo(cgo, "surface")
    for name in ("m and polymer", "surface"):
        low, high = pymol.cmd.get_extent(name)
        print(*low, *high)
    print("objects", *pymol.cmd.get_names())
""")
        place = told.index("objects")
        numbers = [float(x) for x in told[place - 12:place]]
        molecule, surface = numbers[:6], numbers[6:]
        for axis in range(3):
            self.assertTrue(0.8 < molecule[axis] - surface[axis] < 6)
            self.assertTrue(0.8 < surface[axis + 3] - molecule[axis + 3] < 6)


@unittest.skipUnless(has("pyvol"), "bio-pyvol is not installed; scripts/check/more_mesh_readers.sh does it")
class PyVol(WithMsmsInPath):
    def test_surfaces_of_both_probes_and_a_cavity(self):
        """PyVOL's defaults are probes of 1.4 Å and of 3.4 Å, which separates pockets from the outside."""
        self.molecule(TOXIN)
        told = self.script("""
import warnings; warnings.simplefilter("ignore")
import numpy
from pyvol.spheres import Spheres
spheres = Spheres(xyzr=numpy.loadtxt("in.xyzr"))
for probe in (1.4, 3.4):
    surface, = spheres.calculate_surface(probe_radius=probe)
    print(surface.mesh.is_watertight, surface.mesh.volume)
parts = spheres.calculate_surface(probe_radius=1.4, all_components=True, min_volume=0)
print(len(parts), all(part.mesh.is_watertight for part in parts))
# an atom that lines a cavity; PyVOL numbers it from 0
cavity = min(parts, key=lambda part: abs(part.mesh.volume - 100))
atom = int(numpy.argmin(numpy.linalg.norm(spheres.xyz - cavity.mesh.vertices[0], axis=1) - spheres.r))
found, = spheres.calculate_surface(probe_radius=1.4, cavity_atom=atom)
print(found.mesh.volume, cavity.mesh.volume)
""")
        small, large = float(told[1]), float(told[3])
        self.assertEqual((told[0], told[2], told[5]), ("True", "True", "True"))
        self.assertTrue(70_000 < small < large < 110_000, told)
        self.assertGreater(int(told[4]), 10)
        self.assertAlmostEqual(float(told[6]), float(told[7]), places=3)


class Conventions(Folder):
    """Programs pass these words to msms, and read its files like this."""

    def read(self, name="out", header=3):
        """Returns rows like readers that take the count from the third line (header=3), or that expect no header."""
        read = []
        for ending, width in (("vert", (9, 10)), ("face", (5,))):
            lines = (self.folder / f"{name}.{ending}").read_text().rstrip().split("\n")
            if header:  # Fortran takes four numbers from the third line, and passes over empty ones before it
                self.assertTrue(all(lines[:2]))
                count, *others = map(float, lines[2].split())
                self.assertEqual((count, len(others)), (len(lines) - header, 3))
            read.append([line.split() for line in lines[header:]])
            self.assertTrue({len(row) for row in read[-1]} <= set(width))
        positions = [tuple(map(float, row[:3])) for row in read[0]]
        corners = [tuple(int(word) - 1 for word in row[:3]) for row in read[1]]
        edges = {(corner[k], corner[k - 2]) for corner in corners for k in range(3)}
        self.assertTrue(all((b, a) in edges for a, b in edges))  # The surface is closed.
        self.assertEqual({corner for row in corners for corner in row}, set(range(len(positions))))
        return read

    def test_masif(self):
        """Names of vertices are the keys of areas; surfaces serve learning and design, also in SurfDock."""
        lines = self.molecule(program="meniscus-pdb_to_xyzrn").read_text().splitlines()
        names = [f"A_{line.split()[-1]}_Green" for line in lines]
        self.spheres("".join(" ".join([*line.split()[:4], "1", name]) + "\n" for line, name in zip(lines, names)), "in.xyzrn")
        self.msms("-density", "3.0", "-hdensity", "3.0", "-probe", "1.5", "-if", "in.xyzrn", "-of", "out", "-af", "out")
        rows, _ = self.read()
        areas = {row[3]: float(row[1]) for row in map(str.split, (self.folder / "out.area").read_text().splitlines()[1:])}
        self.assertEqual(set(areas), set(names))
        self.assertTrue({row[9] for row in rows} <= set(areas))

    def rows(self, pdb=UBIQUITIN):
        """Returns four numbers per sphere."""
        return [tuple(map(float, line.split()[:4])) for line in self.molecule(pdb).read_text().splitlines()]

    def test_pygbe(self):
        """PyGBe's recipe takes columns of a PQR by awk, which makes blanks of the last line; hydrogens may have radius
        0; no headers. Inner cavities need one more word; a Stern layer has larger spheres and a small probe."""
        spheres = self.rows(TOXIN)
        self.spheres("".join(f"{x:.3f} {y:.3f} {z:.3f} {r:.4f}\n{x:.3f} {y:.3f} {z + 1:.3f} 0.0000\n" for x, y, z, r in spheres)
                     + "   \n", "protein.xyzr")
        for words in ((), ("-all_components",)):
            self.msms("-if", "protein.xyzr", "-of", "protein1", "-prob", "1.4", "-d", "2", "-no_header", *words)
            rows, _ = self.read("protein1", header=0)
            self.assertEqual({int(row[7]) % 2 for row in rows}, {1})  # Vertices belong to the first of each two spheres.
        self.read("protein1_1", header=0)
        self.spheres("".join(f"{x:5.5f} {y:5.5f} {z:5.5f} {r + 2:5.5f}\n" for x, y, z, r in spheres), "protein.stern")
        self.msms("-if", "protein.stern", "-of", "protein1_stern", "-prob", "0.5", "-d", "2", "-no_header")
        self.read("protein1_stern", header=0)

    def test_pbj(self):
        """Columns are separated by tabulators."""
        self.spheres("".join(f"{x:.3f}\t{y:.3f}\t{z:.3f}\t{r:.4f}\n" for x, y, z, r in self.rows()), "tabs.xyzr")
        self.msms("-if", self.folder / "tabs.xyzr", "-of", self.folder / "out", "-p", "1.4", "-d", "2.0", "-no_header")
        self.read(header=0)

    def test_tabi_pb_and_mibpb(self):
        """Versions before NanoShaper, in C and in Fortran, write all digits of a number, some with exponents, and five
        characters of density."""
        spheres = self.rows()
        (self.folder / "data").mkdir()
        for form, words in (("%f %f %f %f\n", ("-de", "10.00")), ("  %.17E        %.15f        %.16f     %.17f     \n", ("-de", "1    "))):
            self.spheres("".join(form % sphere for sphere in spheres), "data/x.xyzr")
            self.msms("-if", "data/x.xyzr", "-prob", "1.4", *words, "-of", "data/x")
            rows, faces = self.read("data/x")
            self.assertGreater(len(rows) / float(words[1]), 2_000)
            self.assertTrue(all(int(word) for row in rows for word in row[7:9]) and all(int(row[3]) in (1, 2, 3) for row in faces))

    def test_vmd_by_files(self):
        """VMD does so on Windows, and where VMDMSMSUSEFILE is set: a name with points in it, nine numbers by scanf."""
        spheres = self.rows()
        self.spheres("".join("%f %f %f %f\n" % sphere for sphere in spheres), "vmdmsms.u0.478")
        name = self.folder / "vmdmsms.u0.478"
        self.msms("-if", name, "-of", name, "-probe_radius", "1.500", "-density", "1.500", "-no_area", "-no_header")
        rows, _ = self.read(name.name, header=0)
        self.assertEqual([" ".join(row) for row in rows], [" ".join(row) for row in scanned_vertices(self.folder / f"{name.name}.vert")])
        self.assertTrue(all(1 <= int(row[7]) <= len(spheres) for row in rows))

    def test_bcl(self):
        """The client reads areas alone, and gives the ending."""
        self.molecule()
        self.msms("-if", "in.xyzr", "-af", "in.area", "-probe_radius", "1.399")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["in.area", "in.xyzr"])

    def test_pyvol(self):
        """PyVOL uses a large probe on a protein of several chains, and looks for certain names with all components."""
        self.molecule(TOXIN)
        self.msms("-if", "in.xyzr", "-of", "out", "-probe_radius", "3.4", "-no_area", "-noh")
        self.read()
        self.msms("-if", "in.xyzr", "-of", "all", "-probe_radius", "1.4", "-no_area", "-noh", "-all_components")
        for path in sorted(self.folder.glob("all_*.face")):
            self.read(path.stem)


class Server(Folder):
    """A client that acts like VMD."""

    def connect(self, *words):
        for _ in range(20):
            with socket.socket() as probe:
                probe.bind(("127.0.0.1", 0))
                port = probe.getsockname()[1]
            server = subprocess.Popen([MSMS, "-no_area", "-socketPort", str(port), *words], stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE, text=True)
            for _ in range(100):
                try:
                    client = socket.create_connection(("127.0.0.1", port), timeout=60)
                    return server, client
                except ConnectionRefusedError:
                    if server.poll() is not None:
                        break
                    time.sleep(0.05)
            server.kill()
            server.communicate()
        self.fail("no server")

    @staticmethod
    def line(stream):
        return stream.readline().decode()

    def ask(self, balls, probe=1.5, density=2.0):
        server, client = self.connect()
        with client, client.makefile("rb") as stream:
            greeting = self.line(stream)
            self.assertTrue(greeting.endswith("\n") and len(greeting) <= 255)
            client.sendall(struct.pack("2f3i", probe, density, 0, 1, len(balls)))
            for ball in balls:
                client.sendall(struct.pack("4fi", *ball, 0))
            self.assertEqual(self.line(stream), "MSMS RCF\n")
            faces, count = struct.unpack("2i", stream.read(8))
            corners = list(struct.iter_unpack("5i", stream.read(20 * faces)))
            rows = list(struct.iter_unpack("6f", stream.read(24 * count)))
            atoms = [n for n, in struct.iter_unpack("i", stream.read(4 * count))]
            self.assertEqual(self.line(stream), "MSMS END\n")
            self.assertEqual(stream.read(), b"")
        out, err = server.communicate(timeout=60)
        self.assertEqual((server.returncode, err), (0, ""))
        return corners, rows, atoms

    def test_the_surface_is_that_of_the_files(self):
        path = self.molecule()
        balls = [tuple(map(float, line.split())) for line in path.read_text().splitlines()]
        corners, rows, atoms = self.ask(balls)
        self.msms("-if", "in.xyzr", "-of", "out", "-density", "2")
        files = triangles(self.folder / "out.face")
        self.assertAlmostEqual(len(files), len(corners), delta=0.002 * len(files))  # Floats move ties.
        self.assertEqual({kind for *_, kind, _ in corners}, {1, 2, 3})
        self.assertTrue(all(0 <= n < len(rows) for row in corners for n in row[:3]))
        for (nx, ny, nz, x, y, z), atom in zip(rows, atoms):
            self.assertAlmostEqual(math.hypot(nx, ny, nz), 1, places=4)
            *center, radius = balls[atom]
            self.assertLess(math.dist(center, (x, y, z)) - radius, 2.0)

    def test_clients_that_break_off_or_send_nonsense_end_it(self):
        good = struct.pack("2f3i", 1.5, 1.0, 0, 1, 1)
        for sent in (b"", good, good + b"\0" * 7, struct.pack("2f3i", float("nan"), 1.0, 0, 1, 1),
                     struct.pack("2f3i", 1.5, -1.0, 0, 1, 1), struct.pack("2f3i", 1.5, 1.0, 0, 1, -5),
                     struct.pack("2f3i", 1.5, 1.0, 0, 1, 2**31 - 1), good + struct.pack("4fi", 0, 0, float("inf"), 1, 0),
                     good + struct.pack("4fi", 0, 0, 0, -1, 0), good + struct.pack("4fi", 0, 0, 0, 0, 0)):
            with self.subTest(sent):
                server, client = self.connect()
                with client:
                    client.sendall(sent)
                    client.shutdown(socket.SHUT_WR)
                    _, err = server.communicate(timeout=60)
                self.assertEqual(server.returncode, 3, err)
                self.assertIn("-socketPort", err)

    def test_nobody_else_can_come_in(self):
        server, client = self.connect()
        try:
            port = client.getpeername()[1]
            with open("/proc/net/tcp") as table_of_sockets:
                local = {line.split()[1] for line in table_of_sockets.readlines()[1:] if line.split()[3] == "0A"}
            self.assertIn(f"0100007F:{port:04X}", local)
            self.assertNotIn(f"00000000:{port:04X}", local)
        finally:
            client.close()
            server.communicate(timeout=60)

    def test_a_port_that_is_taken(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            done = run(MSMS, "-socketPort", taken.getsockname()[1])
        self.assertEqual(done.returncode, 2)
        self.assertIn("is not available", done.stderr)


if __name__ == "__main__":
    unittest.main()
