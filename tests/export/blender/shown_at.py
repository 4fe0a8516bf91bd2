# SPDX-License-Identifier: BSD-3-Clause
"""What an object shows at some times; as a script, the object "run" of a file in a Blender without the add-on: arguments behind "--"
FILE.blend RESULT.npz TIME..."""

import sys

import bpy
import numpy as np


def state(item, times):
    """Returns arrays by words that name them and the time."""
    found = {}
    for time in times:
        whole = int(float(time) // 1)
        bpy.context.scene.frame_set(whole, subframe=float(time) - whole)
        graph = bpy.context.evaluated_depsgraph_get()
        mesh = item.evaluated_get(graph).data
        places = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.vertices.foreach_get("co", places)
        found["co " + time] = places
        for name, field, columns in (("velocity", "vector", 3), ("mine", "value", 1), ("res_name_id", "value", 1)):
            if name in mesh.attributes:
                values = np.empty(columns * len(mesh.attributes[name].data), dtype=np.float32 if name in ("velocity", "mine") else np.int32)
                mesh.attributes[name].data.foreach_get(field, values)
                found[name + " " + time] = values
        found["place " + time] = np.array(item.evaluated_get(graph).matrix_world)
        if len(mesh.polygons):
            found["materials " + time] = np.array([material.name for material in mesh.materials])
    return found


if __name__ == "__main__":
    path, target, *asked = sys.argv[sys.argv.index("--") + 1:]
    assert not hasattr(bpy.types.Object, "meniscus")
    bpy.ops.wm.open_mainfile(filepath=path)
    np.savez(target, **state(bpy.data.objects["run"], asked))
