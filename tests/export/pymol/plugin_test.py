# SPDX-License-Identifier: BSD-3-Clause
"""plugin_test.py PLUGIN: the plugin's commands in PyMOL without a window, against the package itself."""

import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from unittest import mock

import meniscus
import numpy as np

try:
    from pymol import CmdException, cmd
except ImportError:
    print("skipped: PyMOL is not in this Python; Debian's python3-pymol has it")
    sys.exit(77)

PLUGIN = sys.argv.pop(1)
UBIQUITIN = pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb")  # a protein with water

spec = importlib.util.spec_from_file_location("meniscus_plugin", PLUGIN)
plugin = importlib.util.module_from_spec(spec)
spec.loader.exec_module(plugin)


def said_by(command):
    """Returns the output of a line of PyMOL's command language."""
    text = io.StringIO()
    with redirect_stdout(text):
        cmd.do(command, echo=0)
    return text.getvalue()


def atoms(selection):
    """Returns positions and radii."""
    rows = []
    cmd.iterate_state(1, selection, "rows.append((x, y, z, vdw))", space={"rows": rows})
    return np.array(rows)[:, :3], np.array(rows)[:, 3]


def column(name, selection):
    values = []
    cmd.iterate(selection, f"values.append({name})", space={"values": values})
    return np.array(values)


class Plugin(unittest.TestCase):
    def setUp(self):
        cmd.reinitialize()
        cmd.load(str(UBIQUITIN), "ubi")
        self.exact = meniscus.surface(*atoms("ubi and polymer"))

    def test_the_surface_has_the_extent_of_the_library_s_and_leaves_out_water(self):
        self.assertIn("meniscus shows 1 state\n", said_by("meniscus ubi"))
        vertices = self.exact.mesh(0.1).vertices
        found = np.array(cmd.get_extent("meniscus"))
        np.testing.assert_allclose(found, [vertices.min(axis=0), vertices.max(axis=0)], atol=1e-4)

    def test_each_state_has_its_own(self):
        for state, angle in ((2, 40), (3, 80)):
            cmd.create("ubi", "ubi", 1, state)
            cmd.rotate("x", angle, "ubi", state, camera=0)
        plugin.meniscus("ubi", tolerance=0.5)
        self.assertEqual(cmd.count_states("meniscus"), 3)
        extents = []
        for state in (1, 2, 3):
            plugin.meniscus("ubi", state=state, tolerance=0.5, name="one")
            extents.append(cmd.get_extent("one"))
        extents = np.array(extents)
        self.assertGreater(np.abs(extents[0] - extents[1]).max(), 1)
        self.assertGreater(np.abs(extents[1] - extents[2]).max(), 1)
        together = np.array([extents[:, 0].min(axis=0), extents[:, 1].max(axis=0)])
        np.testing.assert_allclose(cmd.get_extent("meniscus"), together, atol=1e-4)

    def test_each_triangle_has_the_color_of_its_atom(self):
        cmd.alter("ubi and resi 1-30", "chain = 'B'")
        of_atoms = plugin.atoms_of("ubi", "all", 1)
        mesh = plugin.surface_of(of_atoms, 1.4).mesh(0.3)
        colors = plugin.colors_of(of_atoms.keys, "ubi", "chain")
        self.assertEqual(len(np.unique(colors, axis=0)), 2)
        cgo = plugin.cgo_of(mesh, colors)
        rows = np.array(cgo[2:-1]).reshape(-1, 28)
        np.testing.assert_allclose(rows[:, 1:4], colors[mesh.triangle_atoms], atol=1e-6)
        for corner in range(3):
            np.testing.assert_allclose(rows[:, 9 + 8 * corner:12 + 8 * corner], mesh.vertices[mesh.triangles[:, corner]],
                                       atol=1e-4)
        normals = rows[:, 4:].reshape(-1, 8)[:, 1:4]
        np.testing.assert_allclose(normals[mesh.sharp_corners], mesh.sharp_normals, atol=1e-6)

    def test_colors_are_those_of_pymol(self):
        cmd.color("red", "ubi and resi 1-30")
        keys = plugin.atoms_of("ubi", "all", 1).keys
        own = plugin.colors_of(keys, "ubi", "atom")
        self.assertEqual((own == (1, 0, 0)).all(axis=1).sum(), cmd.count_atoms("ubi and polymer and resi 1-30"))
        cmd.color("atomic", "ubi")
        np.testing.assert_allclose(plugin.colors_of(keys, "ubi", "element"), plugin.colors_of(keys, "ubi", "atom"))
        self.assertEqual(np.unique(plugin.colors_of(keys, "ubi", "blue"), axis=0).tolist(), [[0, 0, 1]])
        self.assertIn("color=nonsense is neither", said_by("meniscus ubi, color=nonsense"))
        self.assertEqual(cmd.get_names(), ["ubi"])

    def test_of_a_part_it_keeps_the_triangles_of_its_atoms(self):
        plugin.meniscus("ubi and resi 1-10", tolerance=0.2, name="part")
        plugin.meniscus("ubi and resi 1-10", tolerance=0.2, name="alone", context="selection")
        mesh = self.exact.mesh(0.2)
        part = column("resv", "ubi and polymer") <= 10
        vertices = mesh.vertices[np.unique(mesh.triangles[part[mesh.triangle_atoms]])]
        np.testing.assert_allclose(cmd.get_extent("part"), [vertices.min(axis=0), vertices.max(axis=0)], atol=1e-4)
        self.assertGreater(np.abs(np.array(cmd.get_extent("part")) - cmd.get_extent("alone")).max(), 0.2)
        self.assertIn("context=none is neither", said_by("meniscus ubi, context=none"))

    def test_probe_and_radii_are_those_of_pymol(self):
        cmd.set("solvent_radius", 1.8)
        cmd.alter("ubi and elem C", "vdw = 2.1")
        found = plugin.meniscus_area("ubi")
        expected = meniscus.surface(*atoms("ubi and polymer"), 1.8)
        self.assertAlmostEqual(found["ses"], expected.area, places=3)
        self.assertAlmostEqual(plugin.meniscus_area("ubi", probe="1.0")["sas"],
                               meniscus.surface(*atoms("ubi and polymer"), 1.0).atom_sas_areas.sum(), places=3)

    def test_areas_are_printed_and_written_into_b_and_q(self):
        text = said_by("meniscus_area ubi, b=ses, q=sas")
        sas = meniscus.surface(*atoms("ubi and polymer"), kind="sas")
        self.assertIn(f"SES {self.exact.area:.2f} A^2, {self.exact.volume:.2f} A^3; SAS {sas.area:.2f} A^2, {sas.volume:.2f} A^3",
                      text)
        np.testing.assert_allclose(column("b", "ubi and polymer"), self.exact.atom_areas, atol=1e-4)
        np.testing.assert_allclose(column("q", "ubi and polymer"), self.exact.atom_sas_areas, atol=1e-4)
        self.assertEqual(column("b", "ubi and solvent").any(), False)

    def test_areas_of_a_part_count_what_the_rest_buries(self):
        part = "ubi and polymer and resi 1-10"
        within = self.exact.atom_areas[column("resv", "ubi and polymer") <= 10].sum()
        self.assertIn(f"{cmd.count_atoms(part)} atoms of the selection: SES {within:.2f} A^2", said_by(f"meniscus_area {part}"))
        alone = plugin.meniscus_area(part, context="selection")
        self.assertAlmostEqual(alone["ses"], meniscus.surface(*atoms(part)).area, places=3)
        self.assertIn("volume is neither ses nor sas", said_by("meniscus_area ubi, b=volume"))

    def test_pockets_are_those_of_the_library(self):
        text = said_by("meniscus_pockets ubi, min_volume=15")
        expected = self.exact.pockets(min_volume=15)
        self.assertGreater(len(expected), 1)
        self.assertIn(f"meniscus_pockets: {len(expected)} in pocket\n", text)
        for place, pocket in enumerate(expected, 1):
            self.assertIn(f" pocket_{place}: {pocket.kind}, {pocket.volume:.1f} A^3, {pocket.area:.1f} A^2", text)
            low, high = np.array(cmd.get_extent(f"pocket_{place}"))
            np.testing.assert_allclose((low, high), (pocket.probes.min(axis=0) - 1.4, pocket.probes.max(axis=0) + 1.4),
                                       atol=0.15)
        said_by("meniscus_pockets ubi, min_volume=1000")  # The older pockets go.
        self.assertEqual([name for name in cmd.get_names() if name.startswith("pocket_")], [])

    def test_names_of_molecules_are_safe(self):
        said_by("meniscus ubi, tolerance=0.5")
        said_by("meniscus ubi, tolerance=0.5")  # The second surface replaces the first.
        self.assertEqual(cmd.get_names(), ["ubi", "meniscus"])
        self.assertIn("ubi is a object:molecule already", said_by("meniscus ubi, name=ubi"))
        self.assertGreater(cmd.count_atoms("ubi"), 600)

    def test_what_cannot_be_is_said_in_a_sentence(self):
        self.assertIn("PyMOL's surfaces leave out all atoms of 'solvent', as they do with hetero atoms; take them in by: "
                      "flag ignore, solvent, clear", said_by("meniscus solvent"))
        self.assertIn("'resn XYZ' selects no atoms", said_by("meniscus_area resn XYZ"))
        self.assertIn("probe: -1 Å is negative", said_by("meniscus ubi, probe=-1"))
        self.assertIn("tolerance", said_by("meniscus ubi, tolerance=0").splitlines()[0])
        self.assertIn("large_probe", said_by("meniscus_pockets ubi, large_probe=1").splitlines()[0])
        self.assertIn("no atoms in this state", said_by("meniscus_area ubi, state=7"))
        with mock.patch.dict(sys.modules, {"meniscus": None}), self.assertRaisesRegex(CmdException, "-m pip install meniscus_ses"):
            plugin.meniscus("ubi")

    def test_names_of_users_do_not_break_it(self):
        """`run` shares one namespace with scripts and with typed commands."""
        said_by(f"run {PLUGIN}")
        said_by("import meniscus")
        said_by("show = name = states = None")
        self.assertIn("shows 1 state", said_by("meniscus ubi, tolerance=0.5"))

    def test_a_script_loads_it_as_users_do(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "a.png"
            said_by(f"run {PLUGIN}")
            said_by("meniscus ubi, tolerance=0.3")
            cmd.hide("everything", "ubi")
            cmd.bg_color("white")
            cmd.ray(80, 60)
            cmd.png(str(picture))
            self.assertGreater(picture.stat().st_size, 1000)  # An empty picture has about 200.


if __name__ == "__main__":
    unittest.main()
