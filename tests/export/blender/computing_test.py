# SPDX-License-Identifier: BSD-3-Clause
"""The computing part of the Blender add-on, under plain Python: files of atoms, molecules, library, program,
wording."""

import os
import re
import subprocess
import sys
import threading
import time
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import samples  # noqa: E402
from computing_case import ADDON, PACKAGE, PROGRAM, Quiet, WithFolder  # noqa: E402
from meniscus_import import mesh_arrays, mns_reader  # noqa: E402
from meniscus_import.computing import atoms, engines, jobs, preparation, preparation_table, request  # noqa: E402


def colors_by_library():
    return [color for color, _ in preparation_table.SCHEMES if not request.Request(color=color).needs_program()]


class AtomFiles(WithFolder):
    def test_atoms_are_those_of_the_surface(self):
        found = atoms.read(self.atoms(self.molecule(), "--color", "element"))
        np.testing.assert_array_equal(found.atoms.positions, [row[:3] for row in samples.MOLECULES["triple"]])
        np.testing.assert_array_equal(found.atoms.radii, [1.7, 1.55, 1.52])
        np.testing.assert_array_equal(found.atoms.index, [0, 1, 2])
        self.assertEqual(found.numbers, [])
        exported = mns_reader.read(samples.export(PROGRAM, self.folder, "triple", "--color", "element")).objects[0]
        np.testing.assert_array_equal(found.atoms.colors, exported["atom.color"])

    def test_frames_are_those_of_the_run(self):
        every = ["--select", "resi 1-15", "--color", "residue"]
        found = atoms.read(self.atoms(samples.UBIQUITIN, *every, "--frames", "1-5:2"))
        self.assertEqual(found.numbers, [1, 3, 5])
        for place, number in enumerate(found.numbers, 1):
            model = atoms.read(self.atoms(samples.UBIQUITIN, *every, "--model", str(number + 1)))
            np.testing.assert_allclose(found.frame(place).positions, model.atoms.positions, atol=1e-5)
            np.testing.assert_array_equal(found.frame(place).radii, model.atoms.radii)
        self.assertGreater(np.abs(found.frame(1).positions - found.frame(2).positions).max(), 0.1)

    def test_copies_are_atoms_of_their_own(self):
        path = os.path.join(self.folder, "two.pdb")
        with open(path, "w", encoding="ascii") as file:
            file.write(samples.TWO_COPIES)
            file.write("ATOM      1  CA  ALA A   1       1.000   2.000   3.000  1.00  0.00           C\nEND\n")
        found = atoms.read(self.atoms(path, "--assembly", "1", "--instances", "exact"))
        np.testing.assert_allclose(found.atoms.positions, [[1, 2, 3], [21, 2, 3]], atol=1e-6)

    def test_what_is_no_file_of_atoms_says_why(self):
        good = self.atoms(self.molecule())
        surface = samples.export(PROGRAM, self.folder, "pair")
        with self.assertRaisesRegex(mns_reader.MnsError, "holds no atoms"):
            atoms.read(surface)
        with self.assertRaisesRegex(mns_reader.MnsError, "holds atoms"):
            mns_reader.read(good)
        with open(good, "rb") as file:
            data = file.read()
        header, _ = samples.header_of(data)
        short = {**header, "frames": [1, 2]}
        lost = {**header, "arrays": [entry for entry in header["arrays"] if entry["name"] != "atom.radius"]}
        for text, bad in (("frame.position", samples.with_header(data, short)), ("atom.radius", samples.with_header(data, lost)),
                          ("finite", samples.patched(data, "atom.center", "d", float("nan"))), ("checksum", data[:-1] + b"x")):
            with open(good, "wb") as file:
                file.write(bad)
            with self.assertRaisesRegex(mns_reader.MnsError, text):
                atoms.read(good)


class Molecules(WithFolder):
    """Files that the library reads give the same molecules as the program's output of them."""

    def setUp(self):
        super().setUp()
        self.library = engines.find_tools(PACKAGE).library
        charged = os.path.join(self.folder, "charged.pqr")
        with open(charged, "w", encoding="ascii") as file:
            for number, (residue, charge) in enumerate([("ASP", -0.5), ("LIG", 0.8), ("U", 0.0)], 1):
                file.write(f"ATOM {number} CA {residue} {number} {4 * number}.0 0.5 1.0 {charge} 1.7\n")
        chains = os.path.join(self.folder, "chains.pdb")
        with open(chains, "w", encoding="ascii") as file:
            for number, element in enumerate(("C", "FE", "SE", "LI") * 4):
                file.write(f"HETATM{number + 1:5}  {element:2}  LIG {'SRQPONMLKJIHGFED'[number]}{number:4}    {4.0 * number:8.3f}   1.000   2.000"
                           f"  1.00{number:6.2f}          {element:>2}\n")
        self.files = (samples.UBIQUITIN, "/usr/share/freesasa/test-data/1a0q.pdb", chains, charged, self.molecule())

    def by_program(self, file, *options):
        path = os.path.join(self.folder, "given.atoms")
        said = subprocess.run([PROGRAM, "export", "atoms", file, "-o", path, "--force", *options], capture_output=True, text=True)
        return atoms.read(path) if said.returncode == 0 else None

    def test_atoms_are_those_of_the_program_in_all_colours(self):
        refused = []
        for file in self.files:
            for color in colors_by_library():
                wanted, asked = self.by_program(file, "--color", color), request.Request(file=file, color=color)
                if wanted is None:
                    refused.append((os.path.basename(file), color))
                    with self.assertRaisesRegex(self.library.InputError, "to colour by|choose another"):
                        atoms.read_molecule(self.library, asked)
                    continue
                found = atoms.read_molecule(self.library, asked).atoms
                for name in ("positions", "radii", "index"):
                    np.testing.assert_array_equal(getattr(found, name), getattr(wanted.atoms, name), f"{file} {name}")
                np.testing.assert_allclose(found.colors, wanted.atoms.colors, atol=1e-6, err_msg=f"{file} {color}")
                self.assertEqual(found.numbers.keys(), wanted.atoms.numbers.keys(), file)
                for name, values in wanted.atoms.numbers.items():
                    np.testing.assert_array_equal(found.numbers[name], values, f"{file} {name}")
                self.assertEqual((found.chain_names, found.names, found.source), (wanted.atoms.chain_names, wanted.atoms.names, wanted.atoms.source))
                np.testing.assert_allclose(found.kind_colors or [], wanted.atoms.kind_colors or [], atol=1e-6)
        self.assertIn(("1d3z.pdb", "charge"), refused)
        self.assertNotIn(("charged.pqr", "charge"), refused)

    def test_frames_are_the_models_of_the_file(self):
        found = atoms.read_molecule(self.library, request.Request(file=samples.UBIQUITIN, selection="resi 1-15", frames="1-5:2", place=1))
        self.assertEqual(found.numbers, [1, 3, 5])
        for place, number in enumerate(found.numbers, 1):
            model = self.by_program(samples.UBIQUITIN, "--select", "resi 1-15", "--model", str(number + 1))
            np.testing.assert_array_equal(found.frame(place).positions, model.atoms.positions)
        every = atoms.read_molecule(self.library, request.Request(file=samples.UBIQUITIN, place=1))
        self.assertEqual(every.numbers, list(range(10)))

    def test_prepared_molecules_are_those_of_the_program(self):
        """Each field of the panel, changed alone, acts like the program's option and changes some molecule."""
        odd = os.path.join(self.folder, "odd.pdb")
        with open(odd, "w", encoding="ascii") as file:
            file.write(samples.TWO_COPIES)
            atom = "%-6s%5d %-4s%s%3s A%4d    %8.3f   0.000   0.000%6.2f  0.00          %2s\n"
            for values in (("ATOM", 1, " CA", "A", "ALA", 1, 0.0, 0.3, "C"), ("ATOM", 2, " CA", "B", "ALA", 1, 1.0, 0.7, "C"),
                           ("ATOM", 3, " HA", " ", "ALA", 1, 0.5, 1.0, "H"), ("HETATM", 4, " O", " ", "HOH", 2, 5.0, 1.0, "O"),
                           ("HETATM", 5, "ZN", " ", "ZN", 3, 9.0, 1.0, "ZN")):
                file.write(atom % values)
            file.write("END\n")
        seen = set()
        usual = atoms.read_molecule(self.library, request.Request(file=odd)).atoms
        for name, value in (("altloc", "first"), ("altloc", "A"), ("assembly", "1"), ("hydrogens", "drop"), ("hydrogens", "keep"),
                            ("radii", "united"), ("keep_water", True), ("keep_ions", True), ("model", "2")):
            file = samples.UBIQUITIN if name == "model" else odd
            pairs = preparation.changed_fields(preparation.ROWS, lambda other, n=name, v=value: v if other == n else preparation.default_of(
                next(row for row in preparation.ROWS if preparation.name_of(row) == other)))
            self.assertEqual(pairs, ((name, value),))
            found = atoms.read_molecule(self.library, request.Request(file=file, preparation=pairs)).atoms
            wanted = self.by_program(file, *preparation.program_words(pairs, False)).atoms
            for key in ("positions", "radii"):
                np.testing.assert_array_equal(getattr(found, key), getattr(wanted, key), f"{name} {value}")
            before = usual if file == odd else atoms.read_molecule(self.library, request.Request(file=file)).atoms
            if before.positions.shape != found.positions.shape or not np.array_equal(before.positions, found.positions) or \
                    not np.array_equal(before.radii, found.radii):
                seen.add(name)
        self.assertEqual(seen, {preparation.name_of(row) for row in preparation.OF_MOLECULE})

    def test_frames_that_cannot_be_are_refused(self):
        for asked, words in (({"frames": "8-12"}, "Frames: there is no frame 12; there are 10, 0 to 9"), ({"frames": "x"}, "Frames: 'x'"),
                             ({"selection": "within 4 of resi 1"}, "frame 1 has other atoms than the first")):
            with self.assertRaisesRegex(mns_reader.MnsError, words):
                atoms.read_molecule(self.library, request.Request(file=samples.UBIQUITIN, place=1, **asked)).frame(2)


class Engines(WithFolder):
    def setUp(self):
        super().setUp()
        self.tools = engines.find_tools(PACKAGE, PROGRAM)
        self.assertIsNotNone(self.tools.library, self.tools.missing)
        self.alone = engines.Tools(None, self.tools.program, "taken away")

    def asked(self, **options):
        return request.Request(**{"file": self.molecule(), **options})

    def test_prepared_frames_are_those_of_the_program(self):
        wanted = request.Request(file=samples.UBIQUITIN, selection="resi 1-15", frames="0-4", place=3,
                                 preparation=(("superpose", "name CA"), ("smooth", 3)))
        found = engines.read_atoms(self.tools, wanted, self.folder, Quiet())
        target = self.atoms(samples.UBIQUITIN, "--select", "resi 1-15", "--frames", "0-4", "--superpose", "name CA", "--smooth", "3")
        np.testing.assert_array_equal(found.frame(3).positions, atoms.read(target).frame(3).positions)
        plain = engines.read_atoms(self.tools, request.Request(file=samples.UBIQUITIN, selection="resi 1-15", frames="0-4", place=3),
                                   self.folder, Quiet())
        self.assertGreater(np.abs(found.frame(3).positions - plain.frame(3).positions).max(), 0.1)
        self.assertNotEqual(wanted.key(), request.Request(file=samples.UBIQUITIN, selection="resi 1-15", frames="0-4", place=3).key())
        alone = engines.Tools(self.tools.library, None, "")
        engines.forget()
        with self.assertRaisesRegex(engines.EngineError, "Superpose needs the program meniscus"):
            engines.read_atoms(alone, wanted, self.folder, Quiet())

    def test_faults_of_prepared_molecules_name_the_fields(self):
        for pairs, word in (((("assembly", "7"),), "Assembly"), ((("altloc", "??"),), "Altloc"), ((("radii", "none"),), "Radii"),
                            ((("model", "99"),), "Model")):
            for tools in (self.tools, self.alone):
                engines.forget()
                with self.assertRaises(engines.EngineError, msg=pairs) as caught:
                    engines.compute(tools, request.Request(file=samples.UBIQUITIN, preparation=pairs), None, self.folder, Quiet())
                self.assertIn(word.lower(), str(caught.exception).lower(), pairs)
                self.assertNotIn("--", str(caught.exception))

    def test_library_and_program_give_the_same_surface(self):
        for kind in request.KINDS:
            wanted = self.asked(kind=kind, probe=1.2)
            one, other = (engines.compute(tools, wanted, None, self.folder, Quiet()) for tools in (self.tools, self.alone))
            for key in ("area", "volume"):
                self.assertEqual(one.header[key], other.header[key], (kind, key))
            for name in ("mesh.triangle", "mesh.atom", "mesh.kind", "mesh.component", "mesh.patch", "mesh.sharp_corner", "atom.color"):
                np.testing.assert_array_equal(one[name], other[name], f"{kind} {name}")
            np.testing.assert_allclose(one["mesh.position"] + one.header["mesh"]["origin"],
                                       other["mesh.position"] + other.header["mesh"]["origin"], atol=2e-6)
            np.testing.assert_allclose(one["mesh.normal"], other["mesh.normal"], atol=1e-6)
            for name in ("mesh.mean_curvature", "mesh.gaussian_curvature", "atom.area", "atom.accessible_area"):
                np.testing.assert_allclose(one[name], other[name], rtol=1e-5, atol=1e-5, err_msg=f"{kind} {name}")
            self.assertTrue(mns_reader.is_closed(one["mesh.triangle"]))

    def test_names_go_from_the_file_to_the_surface(self):
        wanted = self.asked(file=samples.UBIQUITIN, selection="resi 1-4")
        one, other = (engines.compute(tools, wanted, None, self.folder, Quiet()) for tools in (self.tools, self.alone))
        for key in ("atom_names", "residue_names", "chain_names"):
            self.assertEqual(one.header[key], other.header[key])
        for name in ("atom.name_id", "atom.residue_name_id", "atom.entity"):
            np.testing.assert_array_equal(one[name], other[name], name)
        self.assertEqual(mesh_arrays.names_of(one)["res_name_id"], ["GLN", "ILE", "MET", "PHE"])

    def test_proxies_by_program_and_library_are_the_same(self):
        one, other = (engines.compute(tools, self.asked(density=1.0), None, self.folder, Quiet()) for tools in (self.tools, self.alone))
        for name in ("mesh.triangle", "mesh.atom", "mesh.kind"):
            np.testing.assert_array_equal(one[name], other[name], name)
        np.testing.assert_allclose(one["mesh.mean_curvature"], other["mesh.mean_curvature"], atol=1e-5)

    def test_curvatures_of_a_proxy_are_those_of_patches(self):
        """Triangles of a proxy reach over borders of patches, but its vertices lie on the surface."""
        found = engines.compute(self.tools, self.asked(density=4.0), None, self.folder, Quiet())
        mean, gaussian = found["mesh.mean_curvature"].astype(float), found["mesh.gaussian_curvature"]
        spheres = np.array([1 / 1.7, 1 / 1.55, 1 / 1.52, -1 / 1.4])
        of_sphere = np.abs(mean[:, None] - spheres).min(axis=1) < 1e-6
        self.assertGreater(of_sphere.mean(), 0.5)
        np.testing.assert_allclose(gaussian[of_sphere], mean[of_sphere] ** 2, rtol=1e-5)
        place = found["mesh.position"].astype(float) + found.header["mesh"]["origin"]
        balls = np.array(samples.MOLECULES["triple"])
        off = np.abs(np.linalg.norm(place[:, None] - balls[:, :3], axis=2) - balls[:, 3])
        on_atom = off.min(axis=1) < 1e-5
        self.assertGreater(on_atom.mean(), 0.3)
        same = np.isclose(mean, 1.0 / balls[off.argmin(axis=1), 3], atol=1e-5)
        np.testing.assert_array_equal(same[~on_atom], False)
        self.assertGreater(same[on_atom].mean(), 0.99)
        # One principal curvature of a torus is the curvature of the probe.
        root = np.sqrt(np.maximum(mean[~of_sphere] ** 2 - gaussian[~of_sphere], 0.0))
        low = mean[~of_sphere] - root
        high = mean[~of_sphere] + root
        self.assertLess(np.minimum(np.abs(low + 1 / 1.4), np.abs(high + 1 / 1.4)).max(), 1e-3)

    def test_frames_too(self):
        wanted = self.asked(file=samples.UBIQUITIN, selection="resi 1-4", frames="1-5:2", place=2)
        one, other = (engines.compute(tools, wanted, None, self.folder, Quiet()) for tools in (self.tools, self.alone))
        self.assertAlmostEqual(one.header["area"] / other.header["area"], 1.0, places=6)  # Positions have single precision.
        still = engines.compute(self.alone, self.asked(file=samples.UBIQUITIN, selection="resi 1-4"), None, self.folder, Quiet())
        self.assertNotAlmostEqual(one.header["area"] / still.header["area"], 1.0, places=4)

    def test_what_is_missing_is_said(self):
        nothing = engines.find_tools(self.folder, os.path.join(self.folder, "no_program"))
        self.assertIsNone(nothing.library)
        self.assertIsNone(nothing.program)
        with self.assertRaisesRegex(engines.EngineError, "needs the program"):
            engines.compute(nothing, self.asked(), None, self.folder, Quiet())
        given = atoms.Atoms(np.zeros((1, 3)), np.ones(1), np.ones((1, 3)), np.zeros(1, np.uint32))
        with self.assertRaisesRegex(engines.EngineError, "need libmeniscus"):
            engines.compute(self.alone, self.asked(file=""), given, self.folder, Quiet())
        trajectory = self.asked(trajectory=samples.UBIQUITIN, frames="all", place=1)
        with self.assertRaisesRegex(engines.EngineError, "a trajectory needs the program meniscus.*Molecular Nodes"):
            engines.compute(engines.Tools(self.tools.library, None), trajectory, None, self.folder, Quiet())
        for tools in (self.tools, self.alone):
            with self.assertRaisesRegex(engines.EngineError, "chain Q"):
                engines.compute(tools, self.asked(selection="chain Q"), None, self.folder, Quiet())
        with self.assertRaisesRegex(engines.EngineError, "probe"):
            engines.compute(self.tools, self.asked(probe=1e9), None, self.folder, Quiet())
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(("atoms_", "surface_"))], [])

    def test_a_program_that_nobody_waits_for_ends(self):
        slow = os.path.join(self.folder, "slow")
        with open(slow, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nexec sleep 60\n")
        os.chmod(slow, 0o755)
        task = jobs.Task("a", "k", lambda task: engines.compute(engines.Tools(None, slow), self.asked(), None, self.folder, task))
        thread = threading.Thread(target=task.run)
        began = time.monotonic()
        thread.start()
        time.sleep(0.2)
        task.cancel()
        thread.join(10)
        self.assertLess(time.monotonic() - began, 10)
        self.assertTrue(task.finished.is_set())
        self.assertIsNone(task.result)
        self.assertIsNone(task.error)

    def test_keys_tell_what_matters(self):
        base = self.asked()
        same = [self.asked(color="element"), self.asked()]
        other = [self.asked(probe=1.5), self.asked(kind="SAS"), self.asked(selection="all"), self.asked(tolerance=0.1), self.asked(place=1), self.asked(color="chain")]
        self.assertEqual({each.key() for each in same}, {base.key()})
        self.assertEqual(len({each.key() for each in other} | {base.key()}), len(other) + 1)
        before = base.key()
        with open(base.file, "a", encoding="ascii") as file:
            file.write("9 9 9 1\n")
        self.assertNotEqual(base.key(), before)


class Wording(WithFolder):
    """Messages name the panel's fields in place of the program's options."""

    def test_fields_are_those_of_the_panel(self):
        with open(os.path.join(ADDON, "meniscus_import", "settings.py"), encoding="utf-8") as file:
            labels = set(re.findall(r'name="([^"]+)"', file.read())) | set(map(preparation.label_of, preparation.ROWS))
        self.assertEqual(set(engines.FIELDS.values()) - labels, set())
        said = "".join(subprocess.run([PROGRAM, *command, "--help-all"], capture_output=True, text=True, check=True).stdout
                       for command in (("export", "atoms"), ("export", "blender"), ("export", "mesh")))
        for option in engines.FIELDS:
            self.assertRegex(said, rf"{option}\b")

    def test_no_text_of_the_program_keeps_an_option(self):
        """Every literal of the sources that names an option is translated."""
        root = os.path.dirname(os.path.dirname(os.path.dirname(ADDON)))
        texts = []
        for folder in ("core", "app", "exporters"):
            for at, _, names in os.walk(os.path.join(root, folder)):
                for name in names:
                    if name.endswith((".cpp", ".h")):
                        with open(os.path.join(at, name), encoding="utf-8") as file:
                            texts += re.findall(r'"((?:[^"\\\n]|\\.)*--[a-z](?:[^"\\\n]|\\.)*)"', file.read())
        self.assertGreater(len(texts), 500)
        for text in texts:
            self.assertNotRegex(engines.for_panel(text), r"(?<![\w/-])--[a-z]", text)

    def test_options_become_fields_and_others_say_what_they_are(self):
        cases = {"--select: a selection is missing": "Selection: a selection is missing",
                 "select them by --trajectory-atoms": "select them by Trajectory's atoms",
                 "a.pdb: add --trajectory with a file": "a.pdb: add Trajectory with a file",
                 "add --keep-water or --keep-ions to use them": "add Keep water or Keep ions to use them",
                 "--trim and --show cut more":
                     '"trim" and "show" cut more (trim, show: options of the program meniscus that this panel does not have)',
                 "/x/my--run.pdb: has no atoms": "/x/my--run.pdb: has no atoms"}
        for text, wanted in cases.items():
            self.assertEqual(engines.for_panel(text), wanted)

    def test_what_the_library_says_is_worded_too(self):
        self.assertEqual(str(engines.EngineError("out of memory; use --probe or less")), "out of memory; use Probe or less")

    def test_what_goes_wrong_is_said_in_fields(self):
        tools = engines.find_tools(PACKAGE, PROGRAM)
        short = os.path.join(self.folder, "short.xyz")
        with open(short, "w", encoding="ascii") as file:
            file.write("2\n\nC 0 0 0\nC 2 0 0\n")
        water = os.path.join(self.folder, "water.pdb")
        with open(water, "w", encoding="ascii") as file:
            file.write("HETATM    1  O   HOH A   1       1.000   2.000   3.000  1.00  0.00           O\nEND\n")
        cases = (({"selection": "chain ("}, "Selection"), ({"file": samples.UBIQUITIN, "frames": "7-3", "place": 1}, "Frames"),
                 ({"file": samples.UBIQUITIN, "trajectory": short, "frames": "all", "place": 1}, "Trajectory's atoms"),
                 ({"file": water}, "Keep water"), ({"color": "bfactor"}, "Colour"))
        for asked, word in cases:
            for each in (tools, engines.Tools(None, tools.program)):
                with self.assertRaises(engines.EngineError) as caught:
                    engines.compute(each, request.Request(**{"file": self.molecule(), **asked}), None, self.folder, Quiet())
                self.assertIn(word, str(caught.exception))
                self.assertNotRegex(str(caught.exception), r"--[a-z]")

    def test_atoms_of_a_trajectory_can_be_chosen(self):
        """The trajectory holds only a part of the file's atoms."""
        run = os.path.join(self.folder, "part.xyz")
        with open(run, "w", encoding="ascii") as file:
            for shift in (0.0, 1.0):
                file.write(f"2\n\nC 0 0 0\nC {3.9 + shift} 0 0\n")
        asked = request.Request(file=self.molecule(), trajectory=run, trajectory_atoms="index 0 1", selection="index 0 1", frames="all", place=2)
        found = engines.compute(engines.find_tools(PACKAGE, PROGRAM), asked, None, self.folder, Quiet())
        np.testing.assert_allclose(found["atom.center"], [[0, 0, 0], [4.9, 0, 0]], atol=1e-5)


if __name__ == "__main__":
    unittest.main()
