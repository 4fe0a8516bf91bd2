# SPDX-License-Identifier: BSD-3-Clause
"""Type aliases of signatures: arrays, and the words of options."""
from __future__ import annotations

import os
from typing import Any, Literal, TypedDict, Union

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Bytes = NDArray[np.uint8]
Indices = NDArray[np.uint32]
Numbers = NDArray[np.int32]
Texts = NDArray[np.str_]
Rows = NDArray[np.void]  # a structured array
AnyArray = NDArray[Any]

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

Kind = Literal["ses", "sas", "vdw"]
Device = Literal["cpu", "auto", "gpu", "software"]
Projection = Literal["perspective", "orthographic"]
Quantity = Literal["area", "volume", "sas_area", "sas_volume"]
MeshFormat = Literal["stl", "3mf", "obj", "off", "glb", "vtp", "smesh", "dms", "ply", "ply-ascii", "py", "usda", "usdz"]
PocketKind = Literal["cavity", "pocket", "tunnel"]
RadiiSet = Literal["bondi", "united", "protor", "martini2", "martini3", "file"]
Hydrogens = Literal["auto", "keep", "drop"]
UnknownElement = Literal["halt", "guess", "skip"]


class SurfaceOptions(TypedDict, total=False):
    """The keyword arguments of surface()."""
    probe: float
    kind: Kind
    device: Device
    threads: int
    verify: bool
