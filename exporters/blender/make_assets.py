# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes an asset library with every look in every colouring as a material, and every colouring as a node group.

    blender -b --factory-startup --python-exit-code 3 --python make_assets.py -- FOLDER [--scale 0.1]

FOLDER gets meniscus_assets.blend and the catalogue blender_assets.cats.txt, which must not exist yet. Add it under
Edit > Preferences > File Paths > Asset Libraries. --scale: Blender units per ångström, on which wax and glass depend.
"""

import argparse
import os
import sys
import uuid

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "addon"))
from meniscus_import import looks  # noqa: E402

BLEND, CATALOG = "meniscus_assets.blend", "blender_assets.cats.txt"
#: The identifiers of catalogues, which do not change when a catalogue is renamed.
NAMES = {
    "materials": uuid.uuid5(uuid.NAMESPACE_URL, "meniscus/materials"),
    "colours": uuid.uuid5(uuid.NAMESPACE_URL, "meniscus/colours")}


def mark(item, catalog, text, *tags):
    item.asset_mark()
    item.use_fake_user = True
    item.asset_data.catalog_id = str(NAMES[catalog])
    item.asset_data.description = text
    for tag in ("Meniscus", *tags):
        item.asset_data.tags.new(tag)


def make(scale):
    for coloring, label in looks.COLORINGS.items():
        mark(looks.coloring_group(coloring), "colours", f"Colours by attributes of a Meniscus surface: {label}", label)
        for look, name in looks.LOOKS.items():
            mark(looks.material(look, coloring, scale), "materials", f"{name}, coloured by {label}", name, label)


def main(words):
    parser = argparse.ArgumentParser(prog="make_assets.py")
    parser.add_argument("folder")
    parser.add_argument("--scale", type=float, default=0.1)
    options = parser.parse_args(words)
    if not 1e-6 < options.scale < 1e6:
        parser.error(f"--scale: {options.scale} is not between 0.000001 and 1000000")
    paths = [os.path.join(options.folder, name) for name in (BLEND, CATALOG)]
    for path in paths:
        if os.path.exists(path):
            parser.error(f"{path} is already there")
    os.makedirs(options.folder, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    make(options.scale)
    with open(paths[1], "x", encoding="utf-8") as file:
        file.write("# Catalogues of an asset library of Blender\nVERSION 1\n\n")
        for name, number in NAMES.items():
            file.write(f"{number}:Meniscus/{name.capitalize()}:Meniscus-{name.capitalize()}\n")
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(paths[0]), compress=True)
    print(paths[0])


main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
