# SPDX-License-Identifier: BSD-3-Clause
"""Scene files of Meniscus in Blender, and all of its colours: each entry of a scene is shown, or a message names it."""

import json
import os
import re
import subprocess
import sys
import unittest

import bpy
import numpy as np

sys.path.insert(0, sys.argv[sys.argv.index("--") + 3])
from computed_case import FOLDER, PROGRAM, UBIQUITIN, ComputedCase, measures, of_file, update, wanted  # noqa: E402

from meniscus_import import attributes, computed, scene_import  # noqa: E402
from meniscus_import.computing import preparation_table, request  # noqa: E402

SELECTION = "resi 1-12"
#: Scenes whose keys, but for molecule.file, are fields of the panel, with the options that say the same.
OF_PANEL = (
    ({}, []),
    ({"molecule": {"select": SELECTION}, "objects": [{"representation": "surface", "probe": 2.0, "color": "chain", "cavities": "drop"}]},
     ["--select", SELECTION, "--probe", "2", "--cavities", "drop"]),
    ({"molecule": {"select": SELECTION, "hydrogens": "keep", "radii": "united"}, "objects": [{"representation": "surface", "kind": "sas"}]},
     ["--select", SELECTION, "--hydrogens", "keep", "--radii", "united", "--surface", "sas"]),
    ({"molecule": {"select": SELECTION, "keep_water": True}, "mesh": {"density": 1.0},
      "objects": [{"representation": "surface", "color": ["chain", "resi 3=red"]}]}, ["--select", SELECTION, "--keep-water"]),
)


def vertices_of_faces(item):
    """Returns the mean colour of each face of a mesh whose colours blend between vertices."""
    return attributes.read(item.data, "Color", "FLOAT_COLOR")[:, :3]


class Scenes(ComputedCase):
    def setUp(self):
        super().setUp()
        self.folder = os.path.join(FOLDER, self.id())
        os.makedirs(self.folder)
        with open(UBIQUITIN, encoding="ascii") as file, open(os.path.join(self.folder, "a.pdb"), "w", encoding="ascii") as target:
            target.write(file.read())

    def scene(self, file="a.pdb", **sections):
        path = os.path.join(self.folder, "fig.json")
        molecule = {"file": file, **sections.pop("molecule", {})}
        with open(path, "w", encoding="utf-8") as target:
            json.dump({"meniscus_scene": 1, "molecule": molecule, **sections}, target)
        return path

    def read(self, path):
        """Imports a scene file and returns the new objects."""
        before = set(bpy.data.objects)
        result = bpy.ops.object.meniscus_from_scene(filepath=path, wait=True)
        self.assertEqual(result, {"FINISHED"})
        return [item for item in bpy.data.objects if item not in before]

    def refused(self, path, *words):
        before = set(bpy.data.objects)
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.object.meniscus_from_scene(filepath=path, wait=True)
        for word in (os.path.basename(path), *words):
            self.assertIn(word, str(caught.exception))
        self.assertEqual(set(bpy.data.objects), before)

    def test_what_the_panel_has_fields_for_becomes_a_surface_of_the_panel(self):
        for sections, options in OF_PANEL:
            (item,) = self.read(self.scene(**json.loads(json.dumps(sections))))
            self.assertEqual(item.meniscus.source, "FILE")
            (area, volume), *_ = wanted(os.path.join(self.folder, "a.pdb"), *options)
            self.assertAlmostEqual(measures(item)[0] / area, 1.0, places=6, msg=str(sections))
            self.assertAlmostEqual(measures(item)[1] / volume, 1.0, places=6, msg=str(sections))
        red = attributes.read(item.data, "res_id", "INT")[:, 0] == 3
        colors = vertices_of_faces(item)
        self.assertGreater(colors[red, 0].mean(), 0.7)
        self.assertLess(colors[red, 1].mean(), 0.2)
        self.assertGreater(colors[~red, 1].mean(), 0.2)

    def test_what_only_the_program_shows_comes_as_it_exports_it(self):
        """Cuts, sticks, transparent atoms and the camera come as `export blender --scene` writes them."""
        path = self.scene(molecule={"select": SELECTION}, camera={"view": "top"}, annotations={"labels": "resi 3=hello"}, objects=[
            {"representation": "surface", "clip": "x<30", "opacity": "resi 3=0.5"}, {"representation": "sticks", "selection": "resi 20-22"}])
        items = self.read(path)
        surfaces = [item for item in items if item.type == "MESH"]
        self.assertEqual(len(surfaces), 2)
        self.assertTrue(any("ses_cap" in item.data.attributes for item in surfaces))
        self.assertTrue(any("opacity" in item.data.attributes for item in surfaces))
        self.assertTrue(any(item.type == "CAMERA" for item in items))
        self.assertFalse([item for item in items if "meniscus_file" in item])

    def test_what_is_not_shown_is_named(self):
        path = self.scene(molecule={"select": SELECTION}, legend={"shown": True}, annotations={"labels": "resi 3=hello"}, look={"preset": "cover"})
        self.assertEqual(scene_import.read(path).unseen, ["legend.shown", "annotations.labels", "look.preset"])
        path = self.scene(molecule={"select": SELECTION}, legend={"shown": True}, annotations={"labels": "resi 3=hello"}, camera={"view": "top"},
                          look={"preset": "cover", "shadows": 0.5})
        said = subprocess.run([PROGRAM, "export", "blender", "--scene", path, "-o", os.path.join(self.folder, "a.mns")], check=True,
                              capture_output=True, text=True).stderr
        (line,) = [line for line in said.splitlines() if "ignores these values of the scene" in line]
        self.assertTrue(line.endswith("scene: look.preset, legend.shown, annotations.labels"), line)

    def test_every_key_of_a_scene_is_taken_or_named(self):
        """The schema is the one that the program prints."""
        schema = json.loads(subprocess.run([PROGRAM, "help", "--scene-schema"], check=True, capture_output=True, text=True).stdout)
        of_surface = schema["properties"]["objects"]["items"]["properties"]
        sections = {name: list(value.get("properties", ())) for name, value in schema["properties"].items() if name not in ("meniscus_scene", "objects", "superposed")}
        self.assertGreater(len(of_surface), 20)
        values = {"surface.kind": "sas", "surface.cavities": "only", "molecule.hydrogens": "keep", "molecule.keep_water": True, "molecule.keep_ions": True,
                  "frames.smooth": 3}
        for section, names in (*sections.items(), ("surface", list(of_surface))):
            for name in names:
                key = f"{section}.{name}"
                if key in ("molecule.file", "surface.representation"):
                    continue
                one = {name: values.get(key, "1")}
                given = {"objects": [{"representation": "surface", **one}]} if section == "surface" else {section: one}
                scene = scene_import.read(self.scene(**given))
                shown = len(scene.fields) > 2 or scene.fields["is_run"]
                self.assertEqual(shown + (key in scene.others) + (key in scene.unseen) + (key in scene_import.IDLE), 1, key)

    def test_scenes_that_are_none_are_refused(self):
        path = self.scene()
        for text, *words in (("{", "not a scene"), ("[]", "meniscus_scene"), ('{"meniscus_scene": 2}', "meniscus_scene"),
                             ('{"meniscus_scene": 1}', "molecule.file"), ('{"meniscus_scene": 1, "molecule": 3}', "molecule", "3"),
                             ('{"meniscus_scene": 1, "molecule": {"file": "a.pdb"}, "objects": [{"representation": "surface", "probe": "wide"}]}', "probe", "wide"),
                             ('{"meniscus_scene": 1, "molecule": {"file": "a.pdb", "hydrogens": "some"}}', "hydrogens", "some", "keep"),
                             ('{"meniscus_scene": 1, "molecule": {"file": "a.pdb", "keep_water": "x"}}', "keep_water", "true"),
                             ('{"meniscus_scene": 1, "molecule": {"file": {}}}', "molecule.file"),
                             ('{"meniscus_scene": 1, "molecule": {"file": "a.pdb", "moon": 1}}', "moon")):
            with open(path, "w", encoding="ascii") as file:
                file.write(text)
            self.refused(path, *words)
        path = self.scene(camera={"view": "top"})
        bpy.context.preferences.addons[computed.__package__].preferences.program = "/nowhere"
        self.refused(path, "camera.view", "not found")

    def test_the_panel_has_every_colour_of_the_program(self):
        listed = subprocess.run([PROGRAM, "colors"], check=True, capture_output=True, text=True).stdout
        item = of_file(UBIQUITIN, "PROXY", selection=SELECTION)
        offered = {row.identifier: row.value for row in item.meniscus.bl_rna.properties["color"].enum_items}
        self.assertEqual([offered[name] for name in ("element", "element-cpk", "chain", "residue", "bfactor", "occupancy", "hydrophobicity", "charge",
                                                     "radial", "kind")], list(range(10)), "numbers that files of 0.2.0 hold")
        self.assertEqual(len(set(offered.values())), len(offered))
        listed = listed[:listed.index("\n  red, #rrggbb")]
        schemes = [word for word, _ in preparation_table.SCHEMES]
        self.assertEqual(re.findall(r"^  ([a-z-]+) ", listed, re.M), schemes)
        self.assertEqual(set(offered), {*schemes, "own"})
        with open(os.path.join(self.folder, "numbers.csv"), "w", encoding="ascii") as file:
            file.write("chain,resid,grade\n" + "".join(f"A,{n},{1 + n % 9}\n" for n in range(1, 77)))
        item.meniscus.numbers = os.path.join(self.folder, "numbers.csv")
        refused = {"charge": "charge", "rmsf": "frames", "bead": "", "snfg": "", "copy": "", "model": ""}
        for scheme in schemes:
            item.meniscus.color = scheme
            done = update() if scheme not in refused else None
            if done is None:
                try:
                    done = update()
                except RuntimeError as error:
                    self.assertIn(refused[scheme], str(error))
                    continue
            self.assertEqual(done, {"FINISHED"}, scheme)
            self.assertGreater(len(item.data.polygons), 100, scheme)
        item.meniscus.color, item.meniscus.colors = "own", " ; "  # Blank colours act as if the field were empty.
        self.assertEqual(update(), {"FINISHED"})
        item.meniscus.colors = "#ff0000"
        self.assertFalse(request.Request(color=item.meniscus.written_color()).needs_program())
        self.assertEqual(update(), {"FINISHED"})
        np.testing.assert_allclose(vertices_of_faces(item), np.tile([1.0, 0.0, 0.0], (len(item.data.vertices), 1)), atol=1e-6)
        item.meniscus.colors = "no such colour"
        with self.assertRaisesRegex(RuntimeError, "no such colour"):
            update()


if not unittest.main(argv=["inside_scenes"], exit=False).result.wasSuccessful():
    sys.exit(1)
