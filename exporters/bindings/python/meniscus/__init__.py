# SPDX-License-Identifier: BSD-3-Clause
"""Exact solvent-excluded surfaces of molecules: files or arrays in, arrays out.

    import meniscus
    s = meniscus.surface(meniscus.read("1ubq.cif"))   # atoms and radii as the program takes them
    s = meniscus.surface(xyz, radii, probe=1.4)       # Å
    s.area, s.volume, s.atom_areas, s.distance(points), s.mesh().vertices, s.render()
    s.update(next_xyz)                                # the next frame, same radii
    meniscus.Scene("1ubq.cif", color="chain", legend=True).render()    # the picture of `meniscus render`

All numbers are in Å, Å² and Å³. Arrays that belong to a surface or a mesh are read-only views of the library's own
memory, which lives as long as any view of it does, whatever becomes of the object that gave it. Examples of a class go
on in those of its members.
"""
from __future__ import annotations

try:
    import numpy as _numpy
except ImportError as _error:
    _why = str(_error).strip().splitlines()[0]
    raise ImportError(f"meniscus needs numpy ({_why}): python -m pip install numpy") from _error
del _numpy

from ._errors import (CapacityError, Error, GpuError, InputError, InternalError, NotClosedError, OutputError,
                      UsageError)
from ._library import library_path, version
from ._mesh import Mesh
from ._page import Page, page
from ._picture import Camera, Picture
from ._pockets import Pocket
from ._scene import Property, Scene, properties
from ._structure import Structure, radii_of, read
from ._surface import Patches, Surface, surface
from ._widget import Picked, Widget, widget
from ._adapters import (frames, from_ase, from_biopython, from_biotite, from_gemmi, from_mdanalysis, from_mdtraj,
                        from_openmm, from_prody, from_rdkit, series)

__all__ = [
    "Camera", "CapacityError", "Error", "GpuError", "InputError", "InternalError", "Mesh", "NotClosedError",
    "OutputError", "Page", "Patches", "Picked", "Picture", "Pocket", "Property", "Scene", "Structure", "Surface",
    "UsageError", "Widget", "frames", "from_ase", "from_biopython", "from_biotite", "from_gemmi", "from_mdanalysis",
    "from_mdtraj", "from_openmm", "from_prody", "from_rdkit", "library_path", "page", "properties", "radii_of", "read",
    "series", "surface", "version", "widget",
]


def __getattr__(name: str) -> str:
    if name == "__version__":  # that of the library, which is opened when it is first needed
        return version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
