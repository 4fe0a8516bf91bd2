# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces that Blender computes, in Blender: how they are made and measured. Arguments behind "--": FOLDER ADDON HERE BLENDER PROGRAM."""

import json
import os
import subprocess
import sys
import unittest

import addon_utils
import bpy
import numpy as np

FOLDER, ADDON, HERE, BLENDER, PROGRAM = sys.argv[sys.argv.index("--") + 1:]
PACKAGE = os.environ["MENISCUS_PACKAGE"]
sys.path.insert(0, HERE)
from meniscus_import import computed  # noqa: E402

TRIPLE = os.path.join(FOLDER, "triple.xyzr")
CAGE = os.path.join(FOLDER, "cage.xyzr")
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"


def start_anew():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("meniscus_import", default_set=True)
    name = computed.__package__
    preferences = bpy.context.preferences.addons[name].preferences
    preferences.package, preferences.program = PACKAGE, PROGRAM


def of_file(path=TRIPLE, detail="FINE", **options):
    assert bpy.ops.object.meniscus_from_file(filepath=path, wait=True, detail=detail, **options) == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def update():
    return bpy.ops.object.meniscus_update(wait=True)


def wanted(*arguments):
    """Returns area and volume as the program prints them, a pair per line."""
    said = subprocess.run([PROGRAM, "surface", *arguments, "--json", "-q", "--device", "cpu"], check=True, capture_output=True, text=True).stdout
    try:
        lines = [json.loads(said)]
    except ValueError:
        lines = [json.loads(line) for line in said.splitlines()]
    return [(line["area"], line["volume"]) for line in lines]


def measures(item):
    return item["meniscus_area"], item["meniscus_volume"]


def positions(mesh):
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


class ComputedCase(unittest.TestCase):
    def setUp(self):
        start_anew()
        self.assertNotEqual(computed.working().describe_tools()["library"], "", computed.working().describe_tools())
