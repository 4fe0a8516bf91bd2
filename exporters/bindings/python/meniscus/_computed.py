# SPDX-License-Identifier: BSD-3-Clause
"""Computes surfaces of molecules and of arrays, and what atoms bury of each other."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, overload

import numpy as np

from ._errors import InputError, wrong_type
from ._packages import structure_of
from ._sources import is_molecule
from ._structure import Structure
from ._surface import Surface
from ._types import Device, Floats, Kind

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@overload
def surface(xyz: Structure, radii: Optional[Any] = None, probe: float = 1.4, *, kind: Kind = "ses",
            device: Device = "cpu", threads: int = 0, verify: bool = False) -> Surface: ...
@overload
def surface(xyz: ArrayLike, radii: Any, probe: float = 1.4, *, kind: Kind = "ses", device: Device = "cpu",
            threads: int = 0, verify: bool = False) -> Surface: ...


def surface(xyz: Any, radii: Optional[Any] = None, probe: float = 1.4, *, kind: Kind = "ses", device: Device = "cpu",
            threads: int = 0, verify: bool = False) -> Surface:
    """Computes the surface of a molecule, or of atoms with positions and radii.

    xyz: a Structure, a molecule of another package that a from_...() function takes, or positions in Å, (n, 3). radii:
    van der Waals radii in Å, (n,) or one for all atoms; None for those of the molecule. probe: the radius of the probe,
    0.001 to 100 Å. Values with a unit of OpenMM, pint, astropy or unyt are converted. A UserWarning says if positions
    look like nanometres.

    kind: "ses" (solvent-excluded), "sas" (solvent-accessible) or "vdw" (van der Waals, without a probe). device: "cpu",
    "gpu", "software" (GL on the CPU), or "auto", a hardware GPU if one works, else the CPU. threads: the number of CPU
    threads; 0 for all. verify: whether the surface is also computed on the other device, and compared.

    Raises InputError for impossible atoms, UsageError for invalid options, NotClosedError if the surface would not be
    closed, GpuError if the device needs GL and there is none, and CapacityError if memory does not suffice.

    >>> round(meniscus.surface([[0, 0, 0], [3, 0, 0]], [1.7, 1.52], probe=1.4).area, 2)
    60.71
    >>> meniscus.surface(meniscus.read("helix.pdb"), kind="sas")
    <meniscus.Surface: sas of 64 atoms, 1721.07 Å², 3726.61 Å³, 1 component>
    >>> meniscus.surface([[0, 0, 0]], -1.7)
    Traceback (most recent call last):
        ...
    meniscus.InputError: the radius of atom 0 is -1.7 Å; it has to be above 0, or leave the atom out"""
    if is_molecule(xyz):
        xyz = structure_of(xyz, radii)
    if isinstance(xyz, Structure):
        return Surface(xyz.positions, xyz.radii if radii is None else radii, probe, kind, device, threads, verify, xyz)
    if isinstance(xyz, (str, bytes, os.PathLike)):
        raise wrong_type(f"{xyz!r} is a path; meniscus.read() reads molecules: surface(meniscus.read(path))")
    if radii is None:
        raise wrong_type("radii are missing; give one for each atom, or one for all (radii_of() has those of elements)")
    return Surface(xyz, radii, probe, kind, device, threads, verify)


class Buried(NamedTuple):
    """The solvent-accessible areas in Å² that two parts of a molecule bury of each other.

    structure: the atoms of both parts, in the order of the molecule. in_second: True for the atoms of the second part,
    (n,). areas: the area that each atom loses, (n,), which is 0 or more.

    >>> helix = meniscus.read("helix.pdb")
    >>> buried = meniscus.buried(helix, "chain A", "chain B")
    >>> buried
    <meniscus.Buried: 113.35 and 113.15 Å² of 32 and 32 atoms>
    >>> round(buried.total, 2)
    226.5"""
    structure: Structure
    in_second: Any
    areas: Floats

    @property
    def total(self) -> float:
        """The area that both parts lose together in Å². Half of it is often called the area of the interface.

        >>> round(buried.total / 2, 2)
        113.25"""
        return float(self.areas.sum())

    @property
    def interface(self) -> Structure:
        """The atoms that lose more than 0.01 Å².

        >>> sorted(set(buried.interface.chains.tolist()))
        ['A', 'B']"""
        return self.structure[self.areas > 0.01]

    def __repr__(self) -> str:
        second = np.asarray(self.in_second)
        return (f"<meniscus.Buried: {self.areas[~second].sum():.2f} and {self.areas[second].sum():.2f} Å² of "
                f"{(~second).sum()} and {second.sum()} atoms>")


def buried(molecule: Structure, first: Any, second: Any, probe: float = 1.4, *, device: Device = "cpu",
           threads: int = 0) -> Buried:
    """Returns the solvent-accessible area that two parts of a molecule bury of each other: the exact areas of each part
    alone, without those of both together. The program has the same with --select and --context.

    molecule: a Structure. first, second: selections such as "chain A", masks or indices, without a common atom. probe,
    device, threads: as for surface(). Raises InputError for parts that have a common atom.

    >>> helix = meniscus.read("helix.pdb")
    >>> meniscus.buried(helix, "chain A", helix.chains == "B").areas.shape
    (64,)"""
    if not isinstance(molecule, Structure):
        raise wrong_type(f"molecule is of the type {type(molecule).__name__}, not a meniscus.Structure")
    parts = [molecule._mask(part) for part in (first, second)]
    if (parts[0] & parts[1]).any():
        atom = int(np.flatnonzero(parts[0] & parts[1])[0])
        raise InputError(f"atom {atom} is in both parts; give parts without a common atom")
    both = parts[0] | parts[1]
    whole, areas = molecule[both], np.zeros(len(molecule))
    for part, sign in ((parts[0], 1.0), (parts[1], 1.0), (both, -1.0)):
        of_part = surface(molecule[part], probe=probe, kind="sas", device=device, threads=threads)
        areas[part] += sign * of_part.atom_areas
    return Buried(whole, parts[1][both], np.maximum(areas[both], 0.0))
