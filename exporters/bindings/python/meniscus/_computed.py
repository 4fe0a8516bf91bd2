# SPDX-License-Identifier: BSD-3-Clause
"""Computes surfaces of molecules, of arrays and of all frames of runs, and what atoms bury of each other."""
from __future__ import annotations

import copy
import importlib
import os
from typing import TYPE_CHECKING, Any, Iterator, NamedTuple, Optional, overload

import numpy as np

from ._arguments import Device, Floats, Kind, Rows
from ._arrays import is_content
from ._errors import InputError, wrong_type
from ._library import about_file
from ._read import first_of, models_of, structure_of
from ._sources import TAKEN_BY, Source, is_molecule, opened, package_of
from ._structure import Structure
from ._surface import Surface

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._arguments import SurfaceOptions


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


def _surfaces(source: Source, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields a new surface for each frame of the source. radii: None for those of the elements."""
    last = surface(first_of(source, radii), **options)
    yield last
    for positions in source.frames:
        last = copy.copy(last).update(positions)
        yield last


def _of_models(models: list[Structure], radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields the surface of each molecule. Those with the radii of the one before share its computer."""
    last = None
    for model in models:
        wanted = model.radii if radii is None else radii
        if last is None or len(last) != len(model):
            last = surface(model, wanted, **options)
        else:
            last = copy.copy(last).update(model.positions, wanted)
            last._structure = model
        yield last


def _of_molecules(molecules: Any, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields the surface of each conformer of each molecule of RDKit, which may have different atoms."""
    for n, molecule in enumerate(molecules):
        if molecule is None:
            raise InputError(f"molecule {n} is None; RDKit could not read it")
        yield from _surfaces(opened(molecule, "rdkit", True), radii, options)


def _of_run(path: Any, topology: Any, radii: Optional[Any], options: SurfaceOptions) -> Iterator[Surface]:
    """Yields the surface of each frame of a trajectory file, which MDAnalysis reads: that of the atoms that read() would
    use."""
    try:
        analysis: Any = importlib.import_module("MDAnalysis")
    except ImportError as error:
        raise ImportError(f"frames() of a trajectory with a topology needs MDAnalysis ({error}): python -m pip install "
                          "MDAnalysis") from error
    for name, file in (("source", path), ("topology", topology)):
        if not os.path.exists(file):
            raise about_file(InputError, f"{name}: {os.fsdecode(file)}: No such file or directory", os.fsdecode(file))
    universe = analysis.Universe(os.fspath(topology), os.fspath(path))
    rows, part = first_of(opened(universe, "MDAnalysis", True), 1.0)._usual()
    last: Any = None
    for _ in universe.trajectory:
        positions = universe.atoms.positions[rows]
        last = (surface(part._moved(positions), radii, **options) if last is None else
                copy.copy(last).update(positions))
        yield last


def frames(source: Any, *, topology: Any = None, radii: Optional[Any] = None,
           **options: Unpack[SurfaceOptions]) -> Iterator[Surface]:
    """Yields the surface of each frame of a source: the frames of a trajectory, the models of a structure or the
    conformers of a molecule that a from_...() function takes; a list of ase.Atoms; a list or an SDMolSupplier of
    molecules of RDKit; or the models of a file that read() reads, such as the poses of an SDF file. The surfaces are
    independent of each other, and each has its `structure`.

    topology: the path of a topology, if source is that of a trajectory such as "run.xtc". Then MDAnalysis reads both,
    and the atoms are those that read() would use. radii: van der Waals radii in Å, (n,) or one for all atoms; None for
    those of the elements. options: those of surface(). Raises InputError for other sources, and the errors of read(),
    surface() and the from_...() functions.

    >>> [round(s.area, 2) for s in meniscus.frames("models.pdb", kind="vdw")]
    [1796.57, 1972.7]
    >>> import Bio.PDB
    >>> structure = Bio.PDB.PDBParser().get_structure("two", "models.pdb")
    >>> [round(s.area, 2) for s in meniscus.frames(structure, kind="vdw")]
    [1796.57, 1972.7]"""
    if topology is not None:
        return _of_run(source, topology, radii, options)
    if isinstance(source, (str, bytes, os.PathLike)) or is_content(source):
        return _of_models(models_of(source), radii, options)
    package = package_of(source)
    if not package:
        raise wrong_type(f"a {type(source).__module__}.{type(source).__qualname__} has no frames that can be read; "
                         f"supported are files, and molecules of {', '.join(TAKEN_BY)}")
    if package == "rdkit" and hasattr(source, "__getitem__"):
        return _of_molecules(source, radii, options)
    return _surfaces(opened(source, package, True), radii, options)


def series(source: Any, *, topology: Any = None, radii: Optional[Any] = None, **options: Unpack[SurfaceOptions]) -> Rows:
    """Returns a structured array with a row for each frame of what frames() takes: area (Å²), volume (Å³), components,
    cavities, cavity_area (Å²) and cavity_volume (Å³, positive); for kind "ses" also sas_area (Å²). pandas.DataFrame()
    takes it. Only one surface is in memory at a time. Errors are those of frames().

    >>> meniscus.series("models.pdb")["area"].round(2).tolist()
    [1508.98, 1867.1]"""
    rows = []
    for s in frames(source, topology=topology, radii=radii, **options):
        parts = s.components
        cavities = parts[parts["kind"] == 1]
        row = {"area": s.area, "volume": s.volume, "components": len(parts), "cavities": len(cavities),
               "cavity_area": cavities["area"].sum(), "cavity_volume": -cavities["volume"].sum()}
        if s.kind == "ses":
            row["sas_area"] = s.atom_sas_areas.sum()
        rows.append(row)
    names = list(rows[0]) if rows else ["area", "volume", "components", "cavities", "cavity_area", "cavity_volume"]
    kinds = [(name, np.int64 if name in ("components", "cavities") else np.float64) for name in names]
    return np.array([tuple(row.values()) for row in rows], dtype=kinds)
