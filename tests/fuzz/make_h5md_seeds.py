# SPDX-License-Identifier: BSD-3-Clause
"""Writes the seeds of H5MD from scratch into a folder; h5py is Debian's python3-h5py."""

import os
import sys

import h5py
import numpy as np


def write(path, vectors, offset=None):
    """Writes two atoms in three frames; `vectors`: the box is given as vectors of each frame, steps as an increment."""
    with h5py.File(path, "w", libver="earliest") as file:
        position = file.create_group("particles/all/position")
        value = position.create_dataset("value", data=np.arange(18, dtype="f4").reshape(3, 2, 3))
        value.attrs["unit"] = np.bytes_("nm")
        if vectors:
            step = position.create_dataset("step", data=10)
            step.attrs["offset"] = 5 if offset is None else offset
            position.create_dataset("time", data=np.array([0.0, 0.5, 1.0]))
            file.create_dataset("particles/all/box/edges/value", data=np.tile(np.eye(3) * 20, (3, 1, 1)))
        else:
            file.create_dataset("particles/all/box/edges", data=np.array([10.0, 20.0, 30.0]))


os.makedirs(sys.argv[1], exist_ok=True)
write(os.path.join(sys.argv[1], "edges.h5md"), False)
write(os.path.join(sys.argv[1], "vectors.h5md"), True)
if len(sys.argv) > 2:  # The second folder is for inputs that once failed.
    os.makedirs(sys.argv[2], exist_ok=True)
    write(os.path.join(sys.argv[2], "offset_of_many_numbers.h5md"), True, np.arange(1000))
    write(os.path.join(sys.argv[2], "step_beyond_64_bits.h5md"), True, np.int64(2**63 - 1))
