# SPDX-License-Identifier: BSD-3-Clause
"""The contract of docs/reference/msms-contract.md, row by row: command line, files, standard output, exit codes."""

import json
import math
import pathlib
import re
import resource
import shutil
import subprocess
import tempfile
import unittest

from msms_run import (ANALYTIC, BUILD, LYSOZYME, MSMS, NUMERIC, TOXIN, UBIQUITIN, Folder, run, scanned_vertices, table, triangles,
                      vertices)

ROOT = pathlib.Path(__file__).resolve().parents[2]
ONE = "0 0 0 1.7\n"
TWO = "0 0 0 1.7\n2 0 0 1.5\n"


def octahedron(a, radius=1.7):
    return "".join(f"{x} {y} {z} {radius}\n" for x, y, z in
                   ((a, 0, 0), (-a, 0, 0), (0, a, 0), (0, -a, 0), (0, 0, a), (0, 0, -a)))


CAGE = octahedron(3.2)  # The probe fits in, far from the outer balls.
CUT_CAGE = octahedron(3.6)  # probes inside and outside cut each other at eight windows


def volume_and_area(rows, corners):
    volume = area = 0.0
    for t in corners:
        a, b, c = (rows[n - 1].position for n in t.corners)
        u, v = ([q[k] - a[k] for k in range(3)] for q in (b, c))
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        volume += sum(a[k] * n[k] for k in range(3)) / 6
        area += math.sqrt(sum(x * x for x in n)) / 2
    return volume, area


class CommandLine(Folder):
    def test_without_input_it_says_so(self):
        done = self.refused(2)
        self.assertEqual(done.stderr, "MSMS: No input stream specified\n")
        self.assertEqual(done.stdout.split()[:2], ["MSMS", "2.6.1"])

    def test_help_is_on_standard_error_and_no_fault(self):
        for word in ("-h", "-help", "--help"):
            done = run(MSMS, word)
            self.assertEqual((done.returncode, done.stdout), (0, ""))
            self.assertIn("-all_components", done.stderr)

    def test_defaults(self):
        self.spheres(ONE)
        self.assertIn("PARAM  Probe_radius  1.500 density  1.000 hdensity  3.000\n", self.msms("-if", "in.xyzr").stdout)

    def test_abbreviations(self):
        self.spheres(TWO)
        words = {("-prob", "1.2"): "Probe_radius  1.200", ("-probe", "1e+00"): "Probe_radius  1.000",
                 ("-d", "2"): "density  2.000", ("-de", "2"): "density  2.000", ("-den", "2"): "density  2.000",
                 ("-dens", "2.5"): "density  2.500", ("-hd", "4"): "hdensity  4.000", ("-p", "1.1"): "Probe_radius  1.100"}
        for (option, value), told in words.items():
            self.assertIn(told, self.msms("-if", "in.xyzr", option, value).stdout)
        self.assertNotIn("ANALYTICAL", self.msms("-if", "in.xyzr", "-no_a").stdout)
        self.assertNotIn("ANALYTICAL", self.msms("-if", "in.xyzr", "-no").stdout)  # The first option that begins so is meant.
        self.assertNotIn("NUMERICAL", self.msms("-if", "in.xyzr", "-s", "ases").stdout)
        for ignored in (("-no_rest",), ("-no_r",), ("-no_rest_on_pbr",), ("-free_vertices",), ("-f",)):
            self.msms("-if", "in.xyzr", *ignored)

    def test_blanks_around_words_are_nothing(self):
        self.spheres(ONE)
        self.msms("-if ", " in.xyzr ", " -probe_radius", " 1.4", "-of ", "out")
        self.assertTrue((self.folder / "out.vert").exists())

    def test_extensions_are_appended(self):
        self.spheres(ONE)
        self.msms("-if", "in.xyzr", "-of", "x.out", "-af", "y.area")
        self.msms("-if", "in.xyzr", "-of", "x.vert", "-af", "z")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["in.xyzr", "x.out.face", "x.out.vert", "x.vert.face", "x.vert.vert", "y.area", "z.area"])

    def test_files_are_replaced(self):
        self.spheres(ONE)
        (self.folder / "out.vert").write_text("old")
        self.msms("-if", "in.xyzr", "-of", "out")
        self.assertGreater(len(vertices(self.folder / "out.vert")), 4)

    def test_wrong_usage_is_exit_2_and_writes_nothing(self):
        self.spheres(ONE)
        for words in (("-quiet",), ("-density",), ("-density", "fast"), ("-density", "0"), ("-density", "nan"),
                      ("-probe_radius", "-1"), ("-probe_radius", "inf"), ("-surface", "vdw"), ("stray",), ("-",),
                      ("-one_cavity", "0"), ("-one_cavity", "2", "1"), ("-one_cavity", "1", "-1"), ("-of", ""),
                      ("-xdr",), ("-sinetd",), ("-socketName", "x"), ("-socketPort", "70000"),
                      ("-all", "-one_cavity", "1", "1")):
            with self.subTest(words):
                done = self.refused(2, "-if", "in.xyzr", "-of", "out", *words)
                self.assertRegex(done.stderr, r"\Ameniscus-msms: error: [^\n]+\n\Z")

    def test_bad_input_is_exit_3_and_writes_nothing(self):
        for text in ("", "# nothing\n", "1 2 3\n", "a b c d\n", "0 0 0 -1\n", "0 0 nan 1\n", "0 0 1e9 1\n", "0 0 0 0\n",
                     "0 0 0 2000\n", "0 0 0 1 0 CA\n", "0 0 0 1\n1 2\n", "\0\0\0\0"):
            with self.subTest(text):
                self.spheres(text)
                done = self.refused(3, "-if", "in.xyzr", "-of", "out", "-af", "out")
                self.assertIn("in.xyzr", done.stderr)
        self.refused(3, "-if", "missing.xyzr", "-of", "out")
        self.assertIn("is PDB, not a list of spheres; convert it: meniscus-pdb_to_xyzr",
                      self.refused(3, "-if", str(UBIQUITIN), "-of", "out").stderr)
        self.refused(3, "-if", ".", "-of", "out")

    def test_outputs_that_cannot_be_written_are_exit_6(self):
        self.spheres(ONE)
        self.assertIn("its folder does not exist", self.refused(6, "-if", "in.xyzr", "-of", "no/out").stderr)
        self.refused(6, "-if", "in.xyzr", "-of", "out", "-af", "no/out")
        (self.folder / "out.face").mkdir()
        self.refused(6, "-if", "in.xyzr", "-of", "out")

    def test_no_room_is_exit_6_and_leaves_nothing(self):
        self.spheres(ONE)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))  # noqa: E731
        done = run(MSMS, "-if", "in.xyzr", "-of", "out", "-density", "20", cwd=self.folder, preexec_fn=limit)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["in.xyzr"])
        with open("/dev/full", "w") as full:
            self.assertEqual(subprocess.run([MSMS, "-if", "in.xyzr"], stdout=full, stderr=subprocess.DEVNULL,
                                            cwd=self.folder, check=False).returncode, 6)


class Input(Folder):
    def test_blank_lines_comments_and_free_format(self):
        self.spheres("# spheres\n\n  0 0 0 1.7\n\t2.0   0e0 0. 1.5\n")
        self.assertIn("INPUT  in.xyzr 2 spheres 0 collision only, radii  1.500 to  1.700\n",
                      self.msms("-if", "in.xyzr").stdout)

    def test_names_are_the_fifth_or_behind_a_one_the_sixth_field(self):
        for line, name in (("0 0 0 1.7 1 CA_GLY_1\n", "CA_GLY_1"), ("0 0 0 1.7 CA_GLY_1\n", "CA_GLY_1")):
            self.spheres(line)
            self.msms("-if", "in.xyzr", "-of", "out", "-af", "out")
            self.assertEqual({row.name for row in vertices(self.folder / "out.vert")}, {name})
            self.assertEqual((self.folder / "out.area").read_text().splitlines()[1].split()[3], name)

    def test_a_sphere_without_radius_keeps_its_number(self):
        self.spheres("0 0 0 1.7\n9 9 9 0\n2 0 0 1.5\n")
        self.msms("-if", "in.xyzr", "-of", "out", "-af", "out")
        self.assertEqual({row.sphere for row in vertices(self.folder / "out.vert")}, {1, 3})
        rows = [line.split() for line in (self.folder / "out.area").read_text().splitlines()[1:]]
        self.assertEqual([row[0] for row in rows], ["0", "1", "2"])
        self.assertEqual(rows[1][1:], ["0.000", "0.000"])

    def test_standard_input(self):
        done = run(MSMS, "-if", "-", input=ONE)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


    def test_without_hydrogens_the_others_keep_their_numbers(self):
        self.spheres("0 0 0 1.7\n1 0 0 1.2\n3 0 0 1.5\n3.9 0 0 1.20\n")
        self.msms("-if", "in.xyzr", "-of", "out", "-noh")
        self.assertEqual({row.sphere for row in vertices(self.folder / "out.vert")}, {1, 3})
        bare = (self.folder / "out.face").read_text()
        self.spheres("0 0 0 1.7\n3 0 0 1.5\n")
        self.msms("-if", "in.xyzr", "-of", "out")
        self.assertEqual((self.folder / "out.face").read_text().splitlines()[3:], bare.splitlines()[3:])
        self.spheres("0 0 0 1.2\n")
        self.assertIn("-noh leaves out", self.refused(3, "-if", "in.xyzr", "-of", "out", "-noh").stderr)


class Probes(Folder):
    """Spindles of large probes are long and thin; contact circles with few vertices once cut them short."""

    def test_meshes_are_closed_and_near_the_surface_for_every_probe(self):
        for pdb, options, probes in ((UBIQUITIN, ("-h",), ("0.5", "2", "5", "10")), (LYSOZYME, (), ("2.5", "7")),
                                     (TOXIN, (), ("3.4",))):
            self.spheres(run(BUILD / "meniscus-pdb_to_xyzr", *options, pdb).stdout)
            for probe in probes:
                with self.subTest(f"{pdb.name} {probe}"):
                    done = self.msms("-if", "in.xyzr", "-of", "out", "-probe_radius", probe)
                    rows, corners = vertices(self.folder / "out.vert"), triangles(self.folder / "out.face")
                    edges = {(t.corners[k], t.corners[k - 2]) for t in corners for k in range(3)}
                    self.assertEqual(len(edges), 3 * len(corners))
                    self.assertEqual(edges, {(b, a) for a, b in edges})
                    volume, area = volume_and_area(rows, corners)
                    told = table(done.stdout, NUMERIC)[0]
                    self.assertAlmostEqual(volume / told[2], 1, delta=0.05)
                    self.assertAlmostEqual(area / told[3], 1, delta=0.1)


    def test_the_density_holds_where_saddles_are_thin(self):
        """Probes of hundredths of an Å once gave 200,000 vertices for 95 balls, as many as their tubes are round."""
        rows = run(BUILD / "meniscus-pdb_to_xyzr", UBIQUITIN).stdout.splitlines(keepends=True)
        self.spheres("".join(rows[:95]))
        for probe in ("0.03", "0.01", "0.003"):
            for density in (1, 3, 10):
                with self.subTest(f"probe {probe}, density {density}"):
                    done = self.msms("-if", "in.xyzr", "-of", "out", "-probe_radius", probe, "-density", density)
                    points, corners = vertices(self.folder / "out.vert"), triangles(self.folder / "out.face")
                    edges = {(t.corners[k], t.corners[k - 2]) for t in corners for k in range(3)}
                    self.assertEqual(edges, {(b, a) for a, b in edges})
                    told = table(done.stdout, NUMERIC)[0]
                    self.assertLess(len(points), 3 * density * told[3])
                    volume, area = volume_and_area(points, corners)
                    # Between balls that nearly meet in creases, chords of a circle take much of a small volume.
                    self.assertAlmostEqual(volume / told[2], 1, delta=0.15 / density**0.5)
                    self.assertAlmostEqual(area / told[3], 1, delta=0.05)


class PdbToXyzr(Folder):
    def test_columns(self):
        rows = self.good(BUILD / "meniscus-pdb_to_xyzr", UBIQUITIN).stdout.splitlines()
        for row in rows:
            self.assertRegex(row, r"\A[ -]{0,3}[-\d]+\.\d{3} [ -]*\d+\.\d{3} [ -]*\d+\.\d{3} \d\.\d\d\Z")
        atoms = [line for line in UBIQUITIN.read_text().splitlines() if line.startswith(("ATOM", "HETATM"))]
        self.assertEqual(len(rows), len(atoms))
        for row, atom in zip(rows, atoms):
            self.assertEqual(row.split()[:3], [atom[30:38].strip(), atom[38:46].strip(), atom[46:54].strip()])

    def test_radii_are_published_ones(self):
        pdb = self.spheres("ATOM      1  N   ASN A  46      12.538   4.304  10.746  1.00  0.00           N\n"
                           "ATOM      2  CA  ASN A  46      12.000   5.304  11.746  1.00  0.00           C\n"
                           "ATOM      3  H   ASN A  46      11.000   5.304  11.746  1.00  0.00           H\n"
                           "ATOM      4  OXT ASN A  46      12.703   4.973  10.746  1.00  0.00           O\n", "n.pdb")
        united = self.good(BUILD / "meniscus-pdb_to_xyzr", pdb).stdout.splitlines()
        self.assertEqual([row.split()[3] for row in united], ["1.65", "1.87", "1.40"])  # Chothia 1976
        self.assertIn("12.703    4.973   10.746 1.40", united[-1])
        explicit = self.good(BUILD / "meniscus-pdb_to_xyzr", "-h", pdb).stdout.splitlines()
        self.assertEqual([row.split()[3] for row in explicit], ["1.55", "1.70", "1.20", "1.52"])  # Bondi 1964
        named = self.good(BUILD / "meniscus-pdb_to_xyzrn", pdb).stdout.splitlines()
        self.assertEqual(named[-1], "12.703000 4.973000 10.746000 1.400000 1 OXT_ASN_46")
        chains = self.good(BUILD / "meniscus-pdb_to_xyzrn", "-c", input=pdb.read_text()).stdout.splitlines()
        self.assertEqual(chains[-1], "12.703000 4.973000 10.746000 1.400000 1 OXT_ASN_46_A")

    def test_what_it_writes_is_read(self):
        for program, columns in (("meniscus-pdb_to_xyzr", 9), ("meniscus-pdb_to_xyzrn", 10)):
            self.molecule(program=program)
            self.msms("-if", "in.xyzr", "-of", "out")
            widths = {len(line.split()) for line in (self.folder / "out.vert").read_text().splitlines()[3:]}
            self.assertEqual(widths, {columns})

    def test_bad_input(self):
        for words, code in ((("missing.pdb",), 3), (("-x",), 2), (("a", "b"), 2)):
            done = run(BUILD / "meniscus-pdb_to_xyzr", *words, cwd=self.folder)
            self.assertEqual((done.returncode, done.stdout), (code, ""))
            self.assertTrue(done.stderr.startswith("pdb_to_xyzr: error: "))


@unittest.skipUnless(shutil.which("update-alternatives"), "update-alternatives is not installed")
class Alternatives(Folder):
    """The Debian package is installed and removed in a folder in place of /."""

    def script(self, name, word):
        text = (ROOT / f"scripts/package/debian/meniscus.{name}").read_text().replace("/usr/", f"{self.folder}/usr/")
        places = " ".join(f"--{what} {self.folder}/{what}" for what in ("altdir", "admindir")) + f" --log {self.folder}/log"
        self.good("sh", "-c", text.replace("update-alternatives", f"update-alternatives --quiet {places}"), name, word)

    def test_msms_and_its_helpers_come_and_go(self):
        bin_folder, pages = self.folder / "usr/bin", self.folder / "usr/share/man/man1"
        for folder in (bin_folder, pages, self.folder / "altdir", self.folder / "admindir"):
            folder.mkdir(parents=True)
        for name in ("msms", "pdb_to_xyzr", "pdb_to_xyzrn"):
            (bin_folder / f"meniscus-{name}").symlink_to(BUILD / f"meniscus-{name}")
        (pages / "meniscus-msms.1.gz").touch()
        self.script("postinst", "configure")
        self.assertIn("MSMS 2.6.1", run(bin_folder / "msms").stdout)
        self.assertEqual(len(self.good(bin_folder / "pdb_to_xyzr", UBIQUITIN).stdout.splitlines()[0].split()), 4)
        self.assertEqual(len(self.good(bin_folder / "pdb_to_xyzrn", UBIQUITIN).stdout.splitlines()[0].split()), 6)
        self.script("prerm", "upgrade")
        self.assertTrue((bin_folder / "msms").exists())
        self.script("prerm", "remove")
        self.assertEqual({path.name for path in bin_folder.iterdir()},
                         {"meniscus-msms", "meniscus-pdb_to_xyzr", "meniscus-pdb_to_xyzrn"})


class StandardOutput(Folder):
    LINES = [r"MSMS 2\.6\.1 started on \S+", r"Copyright .+", r"Compilation flags .*",
             r"INPUT  in\.xyzr 1 spheres 0 collision only, radii  1\.700 to  1\.700",
             r"PARAM  Probe_radius  1\.500 density  1\.000 hdensity  3\.000"]
    AREA = [r"ANALYTICAL SURFACE AREA :", re.escape(ANALYTIC), r"      0       1\.500( +\d+\.\d{3}){5}"]
    NUMBERS = [r"NUMERICAL VOLUMES AND AREA", re.escape(NUMERIC), r"       0      1\.50 +\d+\.\d{3} +\d+\.\d{3}",
               r"    Total ses_volume: +\d+\.\d{3}"]
    END = [r"MSMS terminated normally", r"Total Time real: \d+\.\d\d user: \d+\.\d\d sys: \d+\.\d\d"]

    def lines(self, expected, *words):
        self.spheres(ONE)
        told = self.msms("-if", "in.xyzr", *words).stdout.splitlines()
        self.assertEqual(len(told), len(expected), told)
        for line, pattern in zip(told, expected):
            self.assertRegex(line, rf"\A{pattern}\Z")
        return told

    def test_line_by_line(self):
        self.lines(self.LINES + self.AREA + self.NUMBERS + self.END)
        self.lines(self.LINES + self.NUMBERS + self.END, "-no_area")

    def test_with_ases_the_table_is_the_third_line_from_the_end(self):
        told = self.lines(self.LINES + self.AREA + self.END, "-surface", "ases")
        self.assertAlmostEqual(float(told[-3].split()[5]), 4 * math.pi * 1.7 ** 2, places=3)

    def test_numbers_of_one_sphere(self):
        self.spheres(ONE)
        done = self.msms("-if", "in.xyzr", "-probe_radius", "1.4")
        self.assertEqual(table(done.stdout, ANALYTIC), [[0, 1.4, 0, 0, 36.317, 36.317, 120.763]])
        self.assertEqual(table(done.stdout, NUMERIC), [[0, 1.4, 20.580, 36.317]])

    def test_numbers_are_those_of_meniscus(self):
        path = self.molecule(TOXIN)
        told = table(self.msms("-if", "in.xyzr", "-all", "-probe_radius", "1.4").stdout, ANALYTIC)
        exact = json.loads(self.good(BUILD / "meniscus", "surface", path, "--device", "cpu", "-q", "--json").stdout)
        contact_and_toric = sum(row[3] + row[4] for row in told)
        self.assertAlmostEqual(sum(row[5] for row in told) / exact["area"], 1, delta=0.02)
        self.assertGreaterEqual(sum(row[5] for row in told) + 0.01, exact["area"])
        self.assertGreater(contact_and_toric, 0)


class Components(Folder):
    def test_default_is_the_outside_alone(self):
        self.spheres(CAGE)
        done = self.msms("-if", "in.xyzr", "-of", "out", "-probe_radius", "1.4")
        self.assertEqual(len(table(done.stdout, ANALYTIC)), 1)
        self.assertNotIn("RS component", done.stdout)
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"in.xyzr", "out.vert", "out.face"})

    def test_all_components_have_files_rows_and_columns(self):
        for cage in (CAGE, CUT_CAGE):
            self.spheres(cage)
            done = self.msms("-if", "in.xyzr", "-of", "out", "-af", "out", "-all_components", "-probe_radius", "1.4")
            self.assertIn("    RS component 1 identified\n", done.stdout)
            self.assertEqual([row[0] for row in table(done.stdout, ANALYTIC)], [0, 1])
            outside, cavity = table(done.stdout, NUMERIC)
            self.assertGreater(outside[2], 0)
            self.assertLess(cavity[2], 0)
            total = float(re.search(r"Total ses_volume: *(\S+)", done.stdout)[1])
            self.assertAlmostEqual(total, outside[2] + cavity[2], places=2)
            for name, row in (("out", outside), ("out_1", cavity)):
                volume, area = volume_and_area(vertices(self.folder / f"{name}.vert"),
                                               triangles(self.folder / f"{name}.face"))
                self.assertGreater(volume * row[2], 0)
                self.assertAlmostEqual(area / row[3], 1, delta=0.2)
            titles, *rows = (line.split() for line in (self.folder / "out.area").read_text().splitlines())
            self.assertEqual(titles[1:], ["ses_0", "sas_0", "ses_1", "sas_1"])
            for column, row in ((1, outside), (3, cavity)):
                self.assertAlmostEqual(sum(float(fields[column]) for fields in rows), row[3], delta=0.01)

    def test_a_cavity_by_its_spheres(self):
        self.spheres(CUT_CAGE)
        everything = table(self.msms("-if", "in.xyzr", "-all", "-probe_radius", "1.4").stdout, ANALYTIC)
        for words in (("1", "0"), ("2", "0", "2"), ("3", "0", "2", "4")):
            told = table(self.msms("-if", "in.xyzr", "-probe_radius", "1.4", "-one_cavity", *words).stdout, ANALYTIC)
            self.assertEqual(told, [[0, *everything[1][1:]]])
        for words in (("2", "0", "1"), ("1", "6")):  # opposite ends, and a sphere that does not exist
            done = self.refused(3, "-if", "in.xyzr", "-of", "out", "-probe_radius", "1.4", "-one_cavity", *words)
            self.assertIn("find_first_rs_face", done.stderr)

    def test_clients_number_spheres_of_a_cavity_from_0(self):
        """PyVOL, SurfDock and others pass numpy.argmin's index among the rows that they wrote."""
        far = "".join(f"{float(line.split()[0]) + 40} {line.split(maxsplit=1)[1]}\n" for line in octahedron(3.6).splitlines())
        rows = (CAGE + far).splitlines()  # six spheres around one cavity, six around a larger one
        self.spheres(CAGE + far)
        everything = table(self.msms("-if", "in.xyzr", "-all", "-probe_radius", "1.4").stdout, ANALYTIC)
        large, small = (row for row in everything if row[5] < 100)
        for end, cavity in ((3.2, small), (43.6, large)):
            nearest = min(range(len(rows)), key=lambda n: abs(float(rows[n].split()[0]) - end))
            told = table(self.msms("-if", "in.xyzr", "-probe_radius", "1.4", "-one_cavity", "1", nearest).stdout, ANALYTIC)
            self.assertEqual(told, [[0, *cavity[1:]]])

    def test_those_of_lysozyme_beside_those_of_the_surface(self):
        """Sheets of the reduced surface belong to the solvent-accessible one; where two of them cross, they are one
        component of the solvent-excluded surface, and the crossing parts are cut off."""
        (self.folder / "in.xyzr").write_text(run(BUILD / "meniscus-pdb_to_xyzr", LYSOZYME).stdout)
        done = self.msms("-if", "in.xyzr", "-of", "out", "-all_components", "-probe_radius", "1.4", "-density", "1")
        analytic, numeric = table(done.stdout, ANALYTIC), table(done.stdout, NUMERIC)
        surfaces = {kind: json.loads(run(BUILD / "meniscus", "surface", self.folder / "in.xyzr", "--surface", kind, "--json",
                                         "-q", "--device", "cpu").stdout)["components"] for kind in ("sas", "ses")}
        self.assertEqual(len(analytic), 6)
        for row, sheet in zip(analytic, surfaces["sas"], strict=True):
            self.assertAlmostEqual(row[6], sheet["area"], delta=0.001)
        clouds = [[row.position for row in vertices(self.folder / name)]
                  for name in ("out.vert", *(f"out_{k}.vert" for k in range(1, 6)))]
        groups = [{k} for k in range(6)]
        for a in range(6):
            for b in range(a):
                if min(math.dist(p, q) for p in clouds[a] for q in clouds[b]) > 0.1:
                    continue
                joined = next(group for group in groups if a in group) | next(group for group in groups if b in group)
                groups = [group for group in groups if not group & joined] + [joined]
        self.assertEqual(sorted(map(sorted, groups)), [[0, 1, 5], [2], [3, 4]])
        groups.sort(key=lambda group: max(numeric[k][3] for k in group), reverse=True)
        for group, part in zip(groups, surfaces["ses"], strict=True):  # Both lists have falling areas.
            volume, area = (sum(numeric[k][column] for k in group) for column in (2, 3))
            if len(group) == 1:
                self.assertAlmostEqual(part["signed_volume"], volume, delta=0.001)
                self.assertAlmostEqual(part["area"], area, delta=0.001)
            else:
                self.assertGreater(part["signed_volume"], volume + 1.0)
                self.assertLess(part["area"], area - 1.0)


class Files(Folder):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = pathlib.Path(folder.name)
        spheres = cls.made / "in.xyzrn"
        spheres.write_text(run(BUILD / "meniscus-pdb_to_xyzrn", UBIQUITIN).stdout)
        cls.balls = [tuple(map(float, line.split()[:4])) for line in spheres.read_text().splitlines()]
        cls.done = run(MSMS, "-if", "in.xyzrn", "-of", "out", "-af", "out", "-probe_radius", "1.4", "-density", "3",
                       cwd=cls.made)
        assert cls.done.returncode == 0, cls.done.stderr
        cls.rows, cls.corners = vertices(cls.made / "out.vert"), triangles(cls.made / "out.face")

    def distance(self, row, sphere):
        *center, radius = self.balls[sphere - 1]
        return math.dist(row.position, center) - radius

    def test_headers(self):
        vert, face = ((self.made / f"out.{kind}").read_text().splitlines()[:3] for kind in ("vert", "face"))
        count = f" {len(self.balls):7d}  3.00  1.40"
        self.assertEqual(vert, ["# MSMS solvent excluded surface vertices for in.xyzrn", "#vertex #sphere density probe_r",
                                f"{len(self.rows):7d}{count}"])
        self.assertEqual(face, ["# MSMS solvent excluded surface faces for in.xyzrn", "#faces  #sphere density probe_r",
                                f"{len(self.corners):7d}{count}"])

    def test_rows_byte_by_byte(self):
        number, name = r"[ -]{0,7}\d+\.\d{3}", r"[^ ]+"
        for line in (self.made / "out.vert").read_text().splitlines()[3:]:
            self.assertRegex(line, rf"\A({number} ){{6}}[ -]*\d+ +\d+  [123] {name}\Z")
            self.assertEqual(len(line.rsplit(" ", 1)[0]), 6 * 10 + 8 + 8 + 2)
        for line in (self.made / "out.face").read_text().splitlines()[3:]:
            self.assertRegex(line, r"\A[ \d]{6} [ \d]{6} [ \d]{6}  [123] [ \d]{6}\Z")

    def test_without_header_there_are_rows_alone(self):
        self.spheres(ONE)
        self.msms("-if", "in.xyzr", "-of", "out", "-af", "out", "-no_header")
        self.assertEqual(len((self.folder / "out.vert").read_text().splitlines()), len(vertices(self.folder / "out.vert")))
        self.assertEqual(len((self.folder / "out.face").read_text().splitlines()), len(triangles(self.folder / "out.face")))
        self.assertEqual((self.folder / "out.area").read_text().splitlines()[0].split(), ["Atom#", "ses_0", "sas_0"])

    def test_clients_that_scan_see_the_same_vertices(self):
        self.assertEqual(len(scanned_vertices(self.made / "out.vert")), len(self.rows))

    def test_analytic_vertices_come_first_then_edges_then_insides(self):
        order = [0 if row.face == 0 else 1 if row.face < 0 else 2 for row in self.rows]
        self.assertEqual(order, sorted(order))
        self.assertEqual(set(order), {0, 1, 2})

    def test_levels(self):
        kind_of_face = {t.face: t.kind for t in self.corners}
        for row in self.rows:
            inside = {1: 1, 2: 3, 3: 2}[kind_of_face[row.face]] if row.face > 0 else 2
            self.assertEqual(row.level, inside)

    def test_faces_are_numbered_without_gaps_contact_faces_last(self):
        kinds = {}
        for t in self.corners:
            self.assertEqual(kinds.setdefault(t.face, t.kind), t.kind)
        numbers = sorted(kinds)
        self.assertLessEqual(numbers[-1] - len(numbers), 0.01 * len(numbers))  # Welding took some faces away.
        self.assertGreater(min(n for n in numbers if kinds[n] == 1), max(n for n in numbers if kinds[n] != 1))

    def test_vertices_inside_and_on_edges_belong_to_triangles_of_their_faces(self):
        faces = {}
        for t in self.corners:
            for corner in t.corners:
                faces.setdefault(corner, set()).add(t.face)
        for n, row in enumerate(self.rows, 1):
            if row.face > 0:
                self.assertEqual(faces[n], {row.face})
            elif row.face < 0:
                self.assertIn(-row.face, faces[n])

    def test_contact_triangles_lie_on_one_sphere(self):
        self.assertEqual({t.kind for t in self.corners}, {1, 2, 3})
        for t in self.corners:
            if t.kind == 1:
                rows = [self.rows[corner - 1] for corner in t.corners]
                self.assertEqual(len({row.sphere for row in rows}), 1)
                for row in rows:
                    self.assertLess(abs(self.distance(row, row.sphere)), 0.002)

    def test_spheres_are_the_closest(self):
        near = {}
        for n, ball in enumerate(self.balls, 1):
            near.setdefault(tuple(math.floor(x / 5) for x in ball[:3]), []).append(n)
        wrong = 0
        for row in self.rows:
            cell = [math.floor(x / 5) for x in row.position]
            around = [n for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                      for n in near.get((cell[0] + dx, cell[1] + dy, cell[2] + dz), [])]
            wrong += self.distance(row, row.sphere) > min(self.distance(row, n) for n in around) + 0.002
        self.assertLessEqual(wrong, 0.002 * len(self.rows))  # An atom that the probe does not touch may be nearest.

    def test_names_are_those_of_the_spheres(self):
        names = [line.split()[5] for line in (self.made / "in.xyzrn").read_text().splitlines()]
        for row in self.rows:
            self.assertEqual(row.name, names[row.sphere - 1])

    def test_closed_and_wound_counter_clockwise_from_the_solvent(self):
        edges = {}
        for t in self.corners:
            for k in range(3):
                edge = (t.corners[k], t.corners[(k + 1) % 3])
                self.assertNotIn(edge, edges)
                edges[edge] = t
        for a, b in edges:
            self.assertIn((b, a), edges)
        volume, area = volume_and_area(self.rows, self.corners)
        told = table(self.done.stdout, NUMERIC)[0]
        self.assertAlmostEqual(volume / told[2], 1, delta=0.02)
        self.assertAlmostEqual(area / told[3], 1, delta=0.03)

    def test_no_two_corners_of_a_triangle_coincide(self):
        for t in self.corners:
            self.assertEqual(len({self.rows[corner - 1].position for corner in t.corners}), 3)

    def test_areas_of_spheres(self):
        titles, *rows = (line.split() for line in (self.made / "out.area").read_text().splitlines())
        self.assertEqual(titles, ["Atom#", "ses_0", "sas_0"])
        self.assertEqual([int(row[0]) for row in rows], list(range(len(self.balls))))
        told = table(self.done.stdout, ANALYTIC)[0]
        for column, total in ((1, told[5]), (2, told[6])):
            self.assertAlmostEqual(sum(float(row[column]) for row in rows), total, delta=0.0005 * len(rows))

    def test_density_is_vertices_per_area(self):
        self.molecule()
        area = table(self.done.stdout, ANALYTIC)[0][5]
        for density, most in ((1.0, 1.5), (3.0, 1.25), (10.0, 1.15), (30.0, 1.15)):
            self.msms("-if", "in.xyzr", "-of", "d", "-probe_radius", "1.4", "-density", density)
            self.assertAlmostEqual(math.log(len(vertices(self.folder / "d.vert")) / (density * area)), 0,
                                   delta=math.log(most), msg=f"density {density}")


if __name__ == "__main__":
    unittest.main()
