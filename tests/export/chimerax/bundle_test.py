# SPDX-License-Identifier: BSD-3-Clause
"""bundle_test.py BUNDLE: the bundle with stand-ins for the few classes of ChimeraX that it uses. ChimeraX itself is not here."""

import importlib.util
import inspect
import pathlib
import sys
import tomllib
import types
import unittest
from unittest import mock

import meniscus
import numpy as np

BUNDLE = pathlib.Path(sys.argv.pop(1))


class Atoms:
    """Stands for chimerax.atomic.Atoms with the few properties that the bundle uses."""

    def __init__(self, structures, xyz, radii, colors, in_chains):
        self.structures, self.coords, self.radii, self.colors, self.in_chains = structures, xyz, radii, colors, in_chains

    def __len__(self):
        return len(self.coords)

    def filter(self, mask):
        kept = np.flatnonzero(mask)
        return Atoms([self.structures[n] for n in kept], self.coords[kept], self.radii[kept], self.colors[kept],
                     self.in_chains[kept])

    @property
    def by_structure(self):
        for structure in dict.fromkeys(self.structures):
            yield structure, self.filter(np.array([other is structure for other in self.structures]))


class Model:
    def __init__(self, name, session):
        self.name, self.children = name, []

    def add(self, models):
        self.children += models

    def set_geometry(self, vertices, normals, triangles):
        self.vertices, self.normals, self.triangles = vertices, normals, triangles


class UserError(Exception):
    pass


registered = {}
modules = {
    "chimerax": {}, "chimerax.core": {}, "chimerax.core.toolshed": {"BundleAPI": object},
    "chimerax.core.models": {"Surface": Model}, "chimerax.core.errors": {"UserError": UserError},
    "chimerax.core.commands": {"CmdDesc": types.SimpleNamespace, "NonNegativeFloatArg": "number", "PositiveFloatArg": "number",
                               "register": lambda name, about, function, logger: registered.update({name: (about, function)})},
    "chimerax.atomic": {"AtomsArg": "atoms", "all_atoms": lambda session: session.atoms},
}
for name, contents in modules.items():
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(contents)
spec = importlib.util.spec_from_file_location("bundle", BUNDLE / "src/__init__.py", submodule_search_locations=[str(BUNDLE / "src")])
bundle = importlib.util.module_from_spec(spec)
sys.modules["bundle"] = bundle
spec.loader.exec_module(bundle)


class Bundle(unittest.TestCase):
    def setUp(self):
        self.structures = [Model("one", None), Model("two", None)]
        xyz = np.array([[0, 0, 0], [1.5, 0, 0], [2.5, 1.2, 0], [9, 0, 0], [20, 0, 0], [21.5, 0, 0]], dtype=float)
        radii = np.array([1.7, 1.7, 1.5, 1.4, 1.7, 1.6], dtype=np.float32)
        colors = np.array([[10 * n, 255 - n, n, 255] for n in range(6)], dtype=np.uint8)
        in_chains = np.array([True, True, True, False, True, True])
        self.atoms = Atoms([self.structures[0]] * 4 + [self.structures[1]] * 2, xyz, radii, colors, in_chains)
        self.lines = []
        logger = types.SimpleNamespace(info=lambda text, is_html: self.lines.append(text))
        self.session = types.SimpleNamespace(atoms=self.atoms, logger=logger)
        bundle.bundle_api.register_command(None, types.SimpleNamespace(name="meniscus", synopsis="s"), None)
        self.description, self.command = registered["meniscus"]

    def test_its_words_are_those_of_the_function(self):
        parameters = inspect.signature(self.command).parameters
        words = [word for word, _ in self.description.optional + self.description.keyword]
        self.assertEqual(["session", *words], list(parameters))
        self.assertEqual([name for name, p in parameters.items() if p.kind == p.KEYWORD_ONLY],
                         [word for word, _ in self.description.keyword])
        project = tomllib.loads((BUNDLE / "pyproject.toml").read_text())
        self.assertEqual(list(project["tool"]["chimerax"]["command"]), ["meniscus"])
        self.assertEqual(self.description.synopsis, "s")

    def test_each_structure_has_a_model_of_its_atoms_in_chains(self):
        models = self.command(self.session, tolerance=0.05)
        self.assertEqual([structure.children for structure in self.structures], [[models[0]], [models[1]]])
        for model, first, last in zip(models, (0, 4), (3, 6)):
            exact = meniscus.surface(self.atoms.coords[first:last], self.atoms.radii[first:last].astype(float))
            a, b, c = (model.vertices[model.triangles[:, k]].astype(float) for k in range(3))
            self.assertAlmostEqual(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, exact.volume, delta=0.03 * exact.volume)
            self.assertEqual(len(model.vertices), len(model.vertex_colors))
            mesh = exact.mesh(0.05)
            np.testing.assert_array_equal(model.vertex_colors[::3], self.atoms.colors[first:last][mesh.triangle_atoms])
            np.testing.assert_allclose(np.linalg.norm(model.normals, axis=1), 1, atol=1e-5)
        self.assertIn("3 atoms, probe 1.4 Å: solvent-excluded area", self.lines[0])

    def test_atoms_outside_of_chains_count_where_there_are_no_others(self):
        water = self.atoms.filter(~self.atoms.in_chains)
        model, = self.command(self.session, water, probe_radius=0.0)
        self.assertAlmostEqual(np.abs(np.linalg.norm(model.vertices - water.coords, axis=1) - 1.4).max(), 0, places=5)

    def test_what_cannot_be_is_said_in_a_sentence(self):
        self.atoms.coords[0] = np.nan
        with self.assertRaisesRegex(UserError, "atom"):
            self.command(self.session)
        with self.assertRaisesRegex(UserError, "there are no atoms"):
            self.command(self.session, self.atoms.filter(np.zeros(6, dtype=bool)))
        with mock.patch.dict(sys.modules, {"meniscus": None}), self.assertRaisesRegex(UserError, "pip install meniscus_ses"):
            self.command(self.session)

    def test_sessions_find_the_class_of_the_model(self):
        model, = self.command(self.session, self.atoms.filter(self.atoms.radii > 1.65))[:1]
        self.assertIs(bundle.bundle_api.get_class(type(model).__name__), type(model))
        self.assertIsNone(bundle.bundle_api.get_class("Other"))


if __name__ == "__main__":
    unittest.main()
