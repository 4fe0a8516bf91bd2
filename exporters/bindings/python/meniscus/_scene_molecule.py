# SPDX-License-Identifier: BSD-3-Clause
"""The values of a scene that draw a Structure, which a temporary file holds."""
from __future__ import annotations

import os
import re
from typing import Any

import numpy as np

from . import _header as header
from ._molecule_file import WHOLE, column_of
from ._structure import Structure


def _radii_of(structure: Structure) -> list[str]:
    """Returns the overrides that give atoms the radii which the library would not give them."""
    own, usual = np.asarray(structure.radii), np.asarray(column_of(structure._library_object(), header.STRUCTURE_RADII))
    return [f"index {' '.join(map(str, np.flatnonzero((own == radius) & (own != usual))))}={radius!r}"
            for radius in np.unique(own[own != usual]).tolist()]


def values_of(structure: Structure, folder: str) -> dict[str, Any]:
    """Writes a molecule to a folder, and returns the values of a scene that use all of its atoms with their radii."""
    stem = re.sub(r"[^\w.-]", "_", os.path.basename(structure.file).split(".")[0]) or "molecule"
    path = os.path.join(folder, stem + ".cif")
    overrides = _radii_of(structure)
    structure.write(path, replace=True)
    values = {"file": path, **WHOLE, "model": "all" if len(set(structure.models.tolist())) > 1 else None,
              "altloc": "all" if (structure.altlocs != "").any() else None, "radius": overrides or None}
    return {name: value for name, value in values.items() if value is not None}
