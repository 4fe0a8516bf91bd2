# SPDX-License-Identifier: BSD-3-Clause
"""Inside Blender: imports b.stl, b.obj, b.ply and b.glb of a folder, and prints the resulting meshes as JSON."""

import json
import pathlib
import sys

import bmesh
import bpy
import numpy

if not hasattr(numpy, "bool"):  # Debian's glTF importer of Blender 3.4 is older than its numpy
    numpy.bool = bool

folder = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
anew = bpy.app.version >= (4, 2, 0)
importers = {"stl": bpy.ops.wm.stl_import if anew else bpy.ops.import_mesh.stl, "obj": bpy.ops.wm.obj_import,
             "ply": bpy.ops.wm.ply_import if anew else bpy.ops.import_mesh.ply, "glb": bpy.ops.import_scene.gltf}
found = {}
for ending, importer in importers.items():
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    importer(filepath=str(folder / f"b.{ending}"))
    mesh = next(o for o in bpy.data.objects if o.type == "MESH").data
    shape = bmesh.new()
    shape.from_mesh(mesh)
    found[ending] = {"vertices": len(mesh.vertices), "triangles": len(mesh.polygons),
                     "open_edges": sum(not edge.is_manifold for edge in shape.edges),
                     "volume": shape.calc_volume(signed=True)}
    if mesh.color_attributes:
        layer = mesh.color_attributes[0]
        colors = [0.0] * (4 * len(layer.data))
        layer.data.foreach_get("color_srgb", colors)
        if layer.domain == "CORNER":  # Colours of corners are read once for each vertex.
            loops = {loop.vertex_index: n for n, loop in enumerate(mesh.loops)}
            rows = [colors[4 * n:4 * n + 3] for n in loops.values()]
        else:
            rows = [colors[n:n + 3] for n in range(0, len(colors), 4)]
        found[ending]["color"] = [sum(row[k] for row in rows) / len(rows) for k in range(3)]
print("FOUND", json.dumps(found))
