# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of what the real package molecularnodes made: its attributes and units, its selections, its trajectories and models.

scripts/check/newer_blenders.sh runs it, where that package is installed beside bpy."""

import importlib.metadata
import inspect
import json
import os
import subprocess
import sys
import unittest

import addon_utils
import bpy
import numpy as np

FOLDER, ADDON, HERE, BLENDER, PROGRAM = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, HERE)
import molecularnodes  # noqa: E402
import samples  # noqa: E402

from meniscus_import import attributes, computed, molecular_nodes  # noqa: E402

ONE = "/usr/share/freesasa/test-data/1ubq.pdb"


def load(path):
    """Returns the object of a file's molecule, without solvent."""
    if hasattr(molecularnodes, "Molecule"):
        return molecularnodes.Molecule.load(path).object
    return molecularnodes.parse(path).create_object(name=os.path.basename(path).split(".")[0], style=None)


def trajectory(path):
    import MDAnalysis

    kind = getattr(molecularnodes.entities, "Trajectory", None)
    if kind is None:  # Since 520 every molecule has frames, which show as the timeline reaches them.
        return load(path)
    made = kind(MDAnalysis.Universe(path, path))
    if "create_object" not in inspect.signature(kind).parameters:  # Versions before 4.5 leave it to the caller.
        made.create_object(name="run")
    return made.object


def area_of(positions, radii):
    """Returns the area as the program prints it."""
    path = os.path.join(FOLDER, "balls.xyzr")
    with open(path, "w", encoding="ascii") as file:
        for (x, y, z), radius in zip(positions, radii):
            file.write(f"{x:.9g} {y:.9g} {z:.9g} {radius:.9g}\n")
    said = subprocess.run([PROGRAM, "surface", path, "--json", "-q", "--device", "cpu"], check=True, capture_output=True, text=True).stdout
    return json.loads(said)["area"]


def stands(item):
    values = np.empty(3 * len(item.data.vertices), dtype=np.float32)
    item.data.vertices.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64)


class MolecularNodes(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        molecularnodes.register()
        addon_utils.enable("meniscus_import", default_set=True)
        preferences = bpy.context.preferences.addons[computed.__package__].preferences
        preferences.package, preferences.program = os.environ["MENISCUS_PACKAGE"], PROGRAM
        self.assertNotEqual(computed.working().describe_tools()["library"], "", computed.working().describe_tools())

    def surface_of(self, atoms, **options):
        bpy.context.view_layer.objects.active = atoms
        self.assertEqual(bpy.ops.object.meniscus_from_atoms(wait=True, **options), {"FINISHED"})
        return bpy.context.view_layer.objects.active

    def test_its_atoms_units_and_attributes(self):
        atoms = load(ONE)
        item = self.surface_of(atoms)
        scale = item.meniscus.scale
        self.assertIn(round(scale, 6), (0.01, 0.1))
        radii = attributes.read(atoms.data, "vdw_radii", "FLOAT")[:, 0] / scale
        self.assertTrue(1.0 < radii.min() < radii.max() < 3.0)
        self.assertGreater(len(radii), 500)
        self.assertAlmostEqual(item["meniscus_area"] / area_of(stands(atoms) / scale, radii), 1.0, places=5)
        for attribute in atoms.data.attributes:
            if attribute.domain == "POINT" and attribute.data_type in attributes.TYPES and attribute.name != "position":
                self.assertIn(attribute.name, item.data.attributes)
        print(importlib.metadata.version("molecularnodes"), "scale", scale, sorted(a.name for a in atoms.data.attributes))

    def test_its_selections(self):
        atoms = load(ONE)
        self.assertIn("is_backbone", molecular_nodes.selections(atoms))
        item = self.surface_of(atoms, selection="is_backbone")
        chosen = attributes.read(atoms.data, "is_backbone", "BOOLEAN")[:, 0]
        scale = item.meniscus.scale
        radii = attributes.read(atoms.data, "vdw_radii", "FLOAT")[:, 0] / scale
        self.assertAlmostEqual(item["meniscus_area"] / area_of(stands(atoms)[chosen] / scale, radii[chosen]), 1.0, places=5)
        self.assertTrue(chosen[np.unique(attributes.read(item.data, "atom_index", "INT"))].all())

    def test_its_trajectory_is_followed(self):
        self.check_that_it_is_followed(trajectory(samples.UBIQUITIN))

    def check_that_it_is_followed(self, atoms):
        item = self.surface_of(atoms)
        scale, areas = item.meniscus.scale, []
        radii = attributes.read(atoms.data, "vdw_radii", "FLOAT")[:, 0] / scale
        for frame in (0, 3, 7, 3):
            bpy.context.scene.frame_set(frame)
            self.assertEqual(item["meniscus_error"], "")
            self.assertAlmostEqual(item["meniscus_area"] / area_of(stands(atoms) / scale, radii), 1.0, places=5, msg=frame)
            areas.append(round(item["meniscus_area"], 3))
        self.assertEqual((len(set(areas)), areas[1]), (3, areas[3]))

    def test_models_of_a_molecule_are_frames(self):
        atoms = load(samples.UBIQUITIN)
        frames = molecular_nodes.frames_of(atoms)
        if not hasattr(molecularnodes.entities, "Trajectory"):
            self.assertEqual(frames, [])
            return self.check_that_it_is_followed(atoms)
        self.assertEqual(len(frames), 10)
        item = self.surface_of(atoms)
        radii = attributes.read(atoms.data, "vdw_radii", "FLOAT")[:, 0] / item.meniscus.scale
        for frame in (1, 4, 10):
            bpy.context.scene.frame_set(frame)
            wanted = area_of(stands(frames[frame - 1]) / item.meniscus.scale, radii)
            self.assertAlmostEqual(item["meniscus_area"] / wanted, 1.0, places=5, msg=frame)


if not unittest.main(argv=["inside_molecular_nodes"], exit=False).result.wasSuccessful():
    sys.exit(1)
