#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A chain of an assembly means the same in every option that takes a selection: `chain B` all copies, `chain B-2` one.
The options are those whose help has EXPR, so a new option must be tried here."""

import itertools
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
ALL, EACH, ONE = "chain B", "chain B-1 or chain B-2 or chain B-3", "chain B-2"
RENDER = ["render", "{file}", "--assembly", "1", "-o", "{out}.png", "--size", "150x150", "--samples", "1", "--device", "cpu", "--view", "z"]

# Words of a command that show the effect of an option with {}; --instances leaves out the first of them.
PICTURES = {
    "--color": ["--color", "grey", "--color", "{}=red"], "--opacity": ["--opacity", "{}=0.2"], "--show": ["--show", "{}"],
    "--patches": ["--patches", "{}", "--min-patch", "0"], "--zoom-to": ["--zoom-to", "{}"],
    "--clip": ["--clip", "through {}", "--view", "y"], "--label": ["--label", "{}=name"], "--look-into": ["--look-into", "{}"],
    "--radius": ["--radius", "{}=3"], "--select": ["--select", "{}"], "--sticks": ["--opacity", "0.1", "--sticks", "{}"],
    "--balls": ["--opacity", "0.1", "--balls", "{}"], "--spheres": ["--opacity", "0.1", "--spheres", "{}"],
    "--tube": ["--opacity", "0.1", "--tube", "{}"], "--bases": ["--opacity", "0.1", "--bases", "{}"],
    "--glycans": ["--opacity", "0.1", "--glycans", "{}"], "--hydrogen-bonds": ["--opacity", "0.1", "--hydrogen-bonds", "{}"],
    "--distance": ["--opacity", "0.1", "--distance", "chain A-1 to {}"], "--interface": ["--interface", "chain A-2:{}"],
    "--object": ["--opacity", "0.1", "--object", '{"representation": "sticks", "selection": "{}"}'],
}
COMMANDS = {option: RENDER + words for option, words in PICTURES.items()}
COMMANDS["--follow"] = [word.replace("{out}", "{out}_#") for word in RENDER] + ["--frames", "all", "--follow", "{}"]
COMMANDS["--look-into"] = [word for word in COMMANDS["--look-into"] if word not in ("--view", "z")]
COMMANDS["--ligand"] = ["pockets", "{file}", "--assembly", "1", "--ligand", "{}", "--json"]
# These options mean atoms of a trajectory, before there are copies, or are refused with --assembly.
BEFORE_COPIES = {"--trajectory-atoms", "--superpose", "--center", "--superpose-on", "--context"}
# Copies as instances cannot be drawn by these options.
NOT_OF_INSTANCES = {"--sticks", "--balls", "--spheres", "--tube", "--bases", "--glycans", "--object", "--interface", "--hydrogen-bonds", "--distance"}


def turn(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return numpy.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def remark(rotations, chains):
    lines = ["REMARK 350 BIOMOLECULE: 1", f"REMARK 350 APPLY THE FOLLOWING TO CHAINS: {chains}"]
    for number, rotation in enumerate(rotations, 1):
        lines += [f"REMARK 350   BIOMT{row + 1}{number:4d}" + "".join(f"{x:10.6f}" for x in rotation[row]) + f"{0.0:15.5f}"
                  for row in range(3)]
    return lines


def ring(names, residue, chain, number, place):
    return [(name, residue, chain, number, place[0] + 1.4 * math.cos(math.pi * n / 3), place[1] + 1.4 * math.sin(math.pi * n / 3), place[2])
            for n, name in enumerate(names.split())]


def atoms(moved=0.0):
    """Returns peptide A, away from the axis, and chain B next to it: a peptide, a base, a sugar and an oxygen."""
    found = []
    for chain, y in (("A", 0.0), ("B", 4.6)):
        for n in range(4):
            for name, dx, dz in (("N", 0.0, 0.0), ("CA", 1.2, 0.6), ("C", 2.4, 0.0), ("O", 2.4, -1.2)):
                found.append((name, "ALA", chain, n + 1, 24.0 + 3.6 * n + dx, y + (moved if chain == "B" else 0.0), dz))
    found += ring("N1 C2 N3 C4 C5 C6", "U", "B", 9, (28.0, 13.0 + moved, 0.0))
    found += ring("C1 C2 C3 C4 C5 O5", "NAG", "B", 10, (35.0, 13.0 + moved, 0.0))
    found.append(("O1", "LGA", "B", 11, 37.2, 4.6 + moved, -4.0))
    return [f"ATOM  {serial:5d}  {name:<3} {residue:>3} {chain}{number:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00 20.00          {name[0]:>2}"
            for serial, (name, residue, chain, number, x, y, z) in enumerate(found, 1)]


def trimer():
    lines = remark([turn(0), turn(120), turn(240)], "A, B")
    for model in range(2):
        lines += [f"MODEL     {model + 1:4d}", *atoms(2.0 * model), "ENDMDL"]
    return "\n".join(lines + ["END", ""])


def capsid():
    """Returns the 60 rotations of an icosahedron, whose six axes are alike; the first is not the identity."""
    phi = (1 + math.sqrt(5)) / 2

    def about(axis, angle):
        x, y, z = numpy.array(axis) / numpy.linalg.norm(axis)
        cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return numpy.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    generators = [about((0, 1, phi), 2 * math.pi / 5), about((1, 1, 1), 2 * math.pi / 3)]
    group = [numpy.eye(3)]
    for element in group:  # the list grows meanwhile
        for generator in generators:
            made = generator @ element
            if all(numpy.abs(made - known).max() > 1e-6 for known in group):
                group.append(made)
    assert len(group) == 60
    place = [f"ATOM  {n + 1:5d}  CA  ALA A{n + 1:4d}    {30.0 + 3 * n:8.3f}{9.0 - n * n:8.3f}{7.0 * n:8.3f}  1.00 20.00           C"
             for n in range(3)]
    return "\n".join(remark(group[7:] + group[:7], "A") + place + ["END", ""])


class Copies(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "trimer.pdb").write_text(trimer())
        (self.folder / "capsid.pdb").write_text(capsid())
        self.count = itertools.count()

    def call(self, words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=100)
        if code is not None:
            self.assertEqual(done.returncode, code, f"{words}\n{done.stderr}")
        return done

    def results(self, words, selection, *more):
        """Returns the pixels of all pictures, or the tables, that the words make."""
        out = f"r{next(self.count)}"
        done = self.call([word.replace("{file}", "trimer.pdb").replace("{out}", out).replace("{}", selection) for word in words] + list(more))
        found = [json.loads(done.stdout)["left_out"]] if "--json" in words else []
        for path in sorted(self.folder.glob(out + "*")):
            image = OpenImageIO.ImageInput.open(str(path))
            found.append(numpy.asarray(image.read_image("uint8")).astype(int))
            image.close()
        self.assertTrue(found)
        return found

    @staticmethod
    def same(a, b):
        return len(a) == len(b) and all(numpy.array_equal(x, y) if isinstance(x, numpy.ndarray) else x == y for x, y in zip(a, b))

    def test_every_option_with_a_selection_is_here(self):
        found = set()
        for command in ("surface", "pockets", "render", "preview", "panels", "film", "morph", "info", "export povray", "export blender",
                        "export mesh", "export atoms", "export page", "export vdb", "export mitsuba", "export pbrt"):
            text = self.call([*command.split(), "--help-all"], None).stdout
            for line in re.findall(r"^ +(?:-\w,)?(--[a-z-]+(?: [^\n]*(?:\n {20,}[^\n]*)*)?)", text, re.M):
                if re.search(r"\bEXPR\b", line):
                    found.add(line.split()[0])
        self.assertGreater(len(found), 20)
        self.assertEqual(found - set(COMMANDS) - BEFORE_COPIES, set())
        self.assertEqual((set(COMMANDS) | BEFORE_COPIES) - found - {"--object"}, set())

    def test_a_chain_means_all_its_copies_and_its_number_one(self):
        for option, words in COMMANDS.items():
            with self.subTest(option=option):
                every = self.results(words, ALL)
                self.assertTrue(self.same(every, self.results(words, EACH)), f"{ALL} is not {EACH}")
                self.assertFalse(self.same(every, self.results(words, ONE)), f"{ALL} is {ONE}")

    def test_instances_are_chosen_alike(self):
        for option in PICTURES:
            if option in NOT_OF_INSTANCES:
                continue
            with self.subTest(option=option):
                words = COMMANDS[option] + ([] if option == "--select" else ["--select", "all"])  # instances have no companions
                made, shared = self.results(words, ALL)[0], self.results(words, ALL, "--instances", "separate")[0]
                self.assertEqual(made.shape, shared.shape)
                if option != "--look-into":  # instances have the first place of each
                    self.assertLess((numpy.abs(made - shared).max(axis=2) > 8).mean(), 0.01)
                out = f"r{next(self.count)}"
                refused = self.call([w.replace("{file}", "trimer.pdb").replace("{out}", out).replace("{}", ONE) for w in words] +
                                    ["--instances", "separate"], None)
                self.assertTrue(refused.returncode != 0 or "no atom is selected" in refused.stderr, refused.stderr)
                self.assertRegex(refused.stderr, "copies|instances|no atom is selected")

    def test_symmetry_is_seen_alike_with_and_without_instances(self):
        for molecule, view in itertools.product(("trimer.pdb", "capsid.pdb"), ("symmetry", "-symmetry", "symmetry-side")):
            with self.subTest(molecule=molecule, view=view):
                cameras = []
                for more in ([], ["--instances", "separate"]):
                    self.call(["render", molecule, "--assembly", "1", "--bare", "--view", view, "-o", "s.png", "--size", "80x60", "--samples", "1",
                               "--device", "cpu", "--save-camera", "c.json", "--force", *more])
                    cameras.append(json.loads((self.folder / "c.json").read_text()))
                for name in ("position", "target", "up"):
                    numpy.testing.assert_allclose(cameras[0][name], cameras[1][name], atol=1e-4, err_msg=name)

    def test_chains_of_copies_are_named_once_in_legends(self):
        for more in ([], ["--instances", "separate"]):
            self.call(["export", "povray", "trimer.pdb", "--assembly", "1", "--color", "chain", "-o", "s.pov", "--force", *more])
            colors = [json.loads(path.read_text()).get("colors") for path in self.folder.rglob("*objects.json")]
            self.assertEqual([entry["name"] for entry in colors[0]["classes"]], ["A", "B"])

    def test_copies_in_a_map_have_the_colors_of_their_places(self):
        """Copies share a surface in files of other programs only if they look alike."""
        (self.folder / "x.dx").write_text(
            "object 1 class gridpositions counts 2 2 2\norigin -100 -100 -100\ndelta 200 0 0\ndelta 0 200 0\ndelta 0 0 200\n"
            "object 2 class gridconnections counts 2 2 2\nobject 3 class array type double rank 0 items 8 data follows\n"
            "-1 -1 -1 -1 1 1 1 1\n")
        for format, path, mark in (("blender", "", None), ("mitsuba", "/surface.xml", b'type="instance"'),
                                   ("povray", "/surface_geometry.inc", b"\nobject{object_"), ("mvs", "", b'"instances"')):
            found = []
            for colors in (["--color", "chain"], ["--color-map-file", "x.dx", "--color-range=-1:1"]):
                out = f"{format}{len(found)}" + {"blender": ".mns", "mvs": ".mvsx"}.get(format, "")
                self.call(["export", format, "trimer.pdb", "--assembly", "1", "--instances", "separate", *colors, "--device", "cpu",
                           *(["--tolerance", "0.5"] if format != "povray" else []), "-o", out])
                content = (self.folder / (out + path)).read_bytes()
                if format == "mvs":
                    with zipfile.ZipFile(self.folder / out) as archive:
                        content = archive.read("index.mvsj")
                if format == "blender":  # each copy has a matrix
                    length = struct.unpack_from("<Q", content, 16)[0]
                    found.append(sum(len(each["copies"]) for each in json.loads(content[64:64 + length])["objects"]))
                else:
                    found.append(content.count(mark))
            with self.subTest(format):
                self.assertGreater(found[0], found[1], found)
                self.assertLessEqual(found[1], 1)


if __name__ == "__main__":
    unittest.main()
