# SPDX-License-Identifier: BSD-3-Clause
"""A volume map that varies as smoothly as potentials do at their grids, for comparisons of pictures."""

import numpy as np


def write_dx(path, count=41, step=1.5, corner=(0.0, 0.0, -15.0)):
    """Writes an OpenDX map with `count` points a side, `step` Å apart, that starts at the corner."""
    x, y, z = (corner[axis] + step * np.arange(count) for axis in range(3))
    values = 4.0 * np.sin(x / 6.0)[:, None, None] * np.cos(y / 5.0)[None, :, None] + 0.05 * z[None, None, :]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"object 1 class gridpositions counts {count} {count} {count}\norigin {corner[0]} {corner[1]} {corner[2]}\n")
        for axis in range(3):
            file.write("delta " + " ".join(str(step if k == axis else 0.0) for k in range(3)) + "\n")
        file.write(f"object 2 class gridconnections counts {count} {count} {count}\n")
        file.write(f"object 3 class array type double rank 0 items {count ** 3} data follows\n")
        flat = ["%.6e" % value for value in values.ravel()]
        file.write("\n".join(" ".join(flat[n:n + 3]) for n in range(0, len(flat), 3)) + "\n")
