# SPDX-License-Identifier: BSD-3-Clause
"""Exact solvent-excluded surfaces of molecules, computed from files or arrays.

    import meniscus
    s = meniscus.surface(meniscus.read("1ubq.cif"))   # the atoms and radii that the program uses
    s = meniscus.surface(xyz, radii, probe=1.4)       # Å
    s.area, s.volume, s.atom_areas, s.distance(points), s.mesh().vertices, s.render()
    s.update(next_xyz)                                # the next frame, with the same radii
    meniscus.Scene("1ubq.cif", color="chain", legend=True).render()    # as `meniscus render`

All numbers are in Å, Å² and Å³. Arrays of a surface or a mesh are read-only views of the library's memory, which is
freed when the object and all views of it are deleted. The examples of a class are continued by those of its members.
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
from ._columns import Atom, radii_of
from ._library import library_path, version
from ._mesh import Mesh
from ._page import Page, page
from ._patches import Patches, Pocket
from ._picture import Camera, Picture
from ._read import read
from ._scene import Property, Scene, properties
from ._structure import Structure
from ._surface import Surface
from ._widget import Picked, Widget, widget
from ._computed import Buried, buried, frames, series, surface
from ._adapters import (from_ase, from_biopython, from_biotite, from_gemmi, from_mdanalysis, from_mdtraj, from_openmm,
                        from_prody, from_rdkit)

__all__ = [
    "Atom", "Buried", "Camera", "CapacityError", "Error", "GpuError", "InputError", "InternalError", "Mesh",
    "NotClosedError", "OutputError", "Page", "Patches", "Picked", "Picture", "Pocket", "Property", "Scene", "Structure",
    "Surface", "UsageError", "Widget", "buried", "frames", "from_ase", "from_biopython", "from_biotite", "from_gemmi",
    "from_mdanalysis", "from_mdtraj", "from_openmm", "from_prody", "from_rdkit", "library_path", "page", "properties",
    "radii_of", "read", "series", "surface", "version", "widget"]


def _look_for_the_other_project() -> None:
    """Warns if the project that has the name and the import name meniscus on PyPI is installed in the same folder: pip
    replaces files of one with files of the other without a word."""
    from glob import escape, glob
    from os import path
    from ._errors import warn
    if glob(path.join(escape(path.dirname(__path__[0])), "meniscus-*.dist-info")):
        warn("the package meniscus, which is another project, is installed beside meniscus-ses, and the files of one "
             "replace those of the other: pip uninstall meniscus meniscus-ses, then install the one that you need")


_look_for_the_other_project()


def __getattr__(name: str) -> str:
    if name == "__version__":  # the version of the library, which is loaded when it is first used
        return version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
