# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the analytic patches of a surface."""
from __future__ import annotations

from typing import NamedTuple

from ._types import Indices, Rows


class Patches(NamedTuple):
    """The analytic patches of a surface. convex, toroidal, concave and planes are structured arrays, whose rows
    meniscus.h describes; contacts and cuts are arrays of indices, (k,), to which these rows refer.

    >>> patches = meniscus.surface([[0, 0, 0], [3, 0, 0]], 1.7).patches
    >>> len(patches.convex), len(patches.toroidal), len(patches.concave)
    (2, 1, 0)
    >>> patches.toroidal["atom"].tolist()
    [[0, 1]]
    >>> patches
    <meniscus.Patches: 2 convex, 1 toroidal, 0 concave>"""
    convex: Rows
    toroidal: Rows
    concave: Rows
    planes: Rows
    contacts: Indices
    cuts: Indices

    def __repr__(self) -> str:
        return (f"<meniscus.Patches: {len(self.convex)} convex, {len(self.toroidal)} toroidal, {len(self.concave)} "
                "concave>")
