# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a molecule, with one row for each atom, its single atoms, parts and tables, and radii of elements."""
from __future__ import annotations

import ctypes
import functools
import importlib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import AnyArray, Bytes, Floats, Indices, Numbers, Singles, Texts, listed, whole_number
from ._errors import InputError, UsageError, warn, wrong_type

#: The dtype of the rows of each column, and its number of columns. All other columns are texts.
NUMBERS: dict[int, Any] = {
    header.STRUCTURE_POSITIONS: (np.float64, 3), header.STRUCTURE_RADII: (np.float64,),
    header.STRUCTURE_ELEMENTS: (np.uint8,), header.STRUCTURE_INDICES: (np.uint32,),
    header.STRUCTURE_RESIDUE_NUMBERS: (np.int32,), header.STRUCTURE_RESIDUES: (np.uint32,),
    header.STRUCTURE_MODELS: (np.int32,), header.STRUCTURE_COPIES: (np.uint32,),
    header.STRUCTURE_CHARGES: (np.float32,), header.STRUCTURE_B_FACTORS: (np.float32,),
    header.STRUCTURE_OCCUPANCIES: (np.float32,), header.STRUCTURE_CLASSES: (np.uint8,),
    header.STRUCTURE_HYDROPATHIES: (np.float64,)}

#: The symbols of the elements by atomic number. Unknown elements have none.
SYMBOLS = np.array(("", *"""H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se
    Br Kr Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W
    Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn Nh
    Fl Mc Lv Ts Og""".split()))
CLASSES = np.array(["polymer", "ligand", "water", "ion", "unclassified"])


@functools.lru_cache(maxsize=None)
def _element(symbol: str) -> int:
    """Returns the atomic number of a symbol; 0 if no element has it."""
    number = ctypes.c_int32()
    lib.call("element_of_symbol", symbol.strip().encode(), ctypes.byref(number))
    return number.value


@functools.lru_cache(maxsize=None)
def _radius(element: int) -> float:
    radius = ctypes.c_double()
    lib.call("element_radius", element, ctypes.byref(radius), None)
    return radius.value


def atomic_numbers(elements: Any) -> AnyArray:
    """Returns the atomic numbers of symbols, or whole numbers as they are: (n,); 0 for symbols of no element."""
    values = np.asarray(elements)
    if values.dtype.kind in "iu":
        return values.astype(np.int64)
    distinct, places = np.unique(values.astype(np.str_), return_inverse=True)
    numbers = np.array([_element(str(symbol)) for symbol in distinct], dtype=np.int64)
    found: AnyArray = numbers[places.reshape(-1)] if len(numbers) else np.empty(0, np.int64)
    return found


def radii_of(elements: Iterable[Union[str, int]]) -> Floats:
    """Returns the van der Waals radii of elements in Å, (n,), by Bondi (1964, 1966) or Mantina et al. (2009); 2.0 for
    metals without a published value.

    elements: symbols or atomic numbers. Raises InputError for a symbol or number of no element.

    >>> meniscus.radii_of(["C", "Zn", 8]).tolist()
    [1.7, 1.39, 1.52]
    >>> meniscus.radii_of(["Qq"])
    Traceback (most recent call last):
        ...
    meniscus.InputError: atom 0: 'Qq' is not an element; give radii"""
    checked: list[Union[str, int]] = [
        element if isinstance(element, str) else whole_number(f"atom {n}: the element", element)
        for n, element in enumerate(listed("elements", elements, "symbols or atomic numbers"))]
    known: dict[Union[str, int], float] = {}
    for n, element in enumerate(checked):
        if element in known:
            continue
        number = _element(element) if isinstance(element, str) else element
        if number == 0:
            raise InputError(f"atom {n}: {str(element)!r} is not an element; give radii")
        known[element] = _radius(number)
    return np.array([known[element] for element in checked], dtype=np.float64)


if TYPE_CHECKING:
    _Array = np.ndarray[Any, Any]
else:
    _Array = np.ndarray


class _Column(_Array):
    """An array that raises TypeError when texts are compared with numbers, because numpy says that no row is equal."""

    def _checked(self, other: Any) -> AnyArray:
        kinds = [np.asarray(values).dtype.kind for values in (self, other)]
        if ("U" in kinds or "S" in kinds) and any(kind in "iufb" for kind in kinds):
            which = ("texts", "numbers") if kinds[0] in "US" else ("numbers", "texts")
            example = f" such as {self.flat[0].item()!r}" if self.size else ""
            raise wrong_type(f"the array has {which[0]}{example}, and is compared with {which[1]}: {other!r:.60}")
        return self.view(np.ndarray)

    def __eq__(self, other: Any) -> Any:
        return self._checked(other) == _plain(other)

    def __ne__(self, other: Any) -> Any:
        return self._checked(other) != _plain(other)

    def __reduce_ex__(self, protocol: Any) -> Any:  # pickles are plain arrays, which need no package
        return self.view(np.ndarray).__reduce_ex__(protocol)

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        plain = array.view(np.ndarray)  # results of functions are plain arrays
        return plain[()] if return_scalar or array.ndim == 0 else plain


class _Elements(_Column):
    """The symbols of elements. Comparing them with atomic numbers, which this array had before, still works."""

    def _numbers(self, other: Any) -> bool:
        if np.asarray(other).dtype.kind not in "iu":
            return False
        warn("elements are symbols such as 'C' now; compare atomic_numbers with numbers", DeprecationWarning)
        return True

    def __eq__(self, other: Any) -> Any:
        return np.asarray(atomic_numbers(self)) == _plain(other) if self._numbers(other) else super().__eq__(other)

    def __ne__(self, other: Any) -> Any:
        return np.asarray(atomic_numbers(self)) != _plain(other) if self._numbers(other) else super().__ne__(other)


def _plain(values: Any) -> Any:
    return values.view(np.ndarray) if isinstance(values, _Column) else values


class Columns:
    """The arrays of a Structure, which has a description of them."""

    __slots__ = ()

    def _column(self, column: int) -> AnyArray:
        raise NotImplementedError

    def _compared(self, column: int) -> AnyArray:
        """Returns a column that refuses comparisons with values of another kind."""
        return self._column(column).view(_Column)

    @property
    def positions(self) -> Floats:
        """The positions in Å, (n, 3).

        >>> molecule.positions[:2].tolist()
        [[3.1, 0.0, 0.0], [1.927, 2.428, 0.55]]"""
        return self._column(header.STRUCTURE_POSITIONS)

    @property
    def radii(self) -> Floats:
        """The van der Waals radii in Å.

        >>> molecule.radii[:4].tolist()
        [1.55, 1.7, 1.7, 1.52]"""
        return self._column(header.STRUCTURE_RADII)

    @property
    def elements(self) -> Texts:
        """The symbols of the elements, such as "C" and "Zn"; "" for unknown elements.

        >>> molecule.elements[:4].tolist()
        ['N', 'C', 'C', 'O']"""
        return SYMBOLS[self._column(header.STRUCTURE_ELEMENTS)].view(_Elements)

    @property
    def atomic_numbers(self) -> Bytes:
        """The atomic numbers; 0 for unknown elements.

        >>> molecule.atomic_numbers[:4].tolist()
        [7, 6, 6, 8]"""
        return self._compared(header.STRUCTURE_ELEMENTS)

    @property
    def indices(self) -> Indices:
        """The indices of the atoms among all atoms of the file, from 0, as in tables and meshes of the program.

        >>> molecule.indices[-3:].tolist()
        [61, 62, 63]"""
        return self._compared(header.STRUCTURE_INDICES)

    @property
    def names(self) -> Texts:
        """The names of the atoms, such as "CA".

        >>> molecule.names[:4].tolist()
        ['N', 'CA', 'C', 'O']"""
        return self._compared(header.STRUCTURE_NAMES)

    @property
    def residue_names(self) -> Texts:
        """The names of the residues, such as "ALA".

        >>> molecule.residue_names[::8].tolist()[:2]
        ['ALA', 'ALA']"""
        return self._compared(header.STRUCTURE_RESIDUE_NAMES)

    @property
    def chains(self) -> Texts:
        """The chains, such as "A"; "A-2" in the second copy of an assembly.

        >>> molecule.chains[[0, -1]].tolist()
        ['A', 'B']"""
        return self._compared(header.STRUCTURE_CHAINS)

    @property
    def segments(self) -> Texts:
        """The segment identifiers of molecular dynamics programs.

        >>> set(molecule.segments.tolist())
        {''}"""
        return self._compared(header.STRUCTURE_SEGMENTS)

    @property
    def residue_numbers(self) -> Numbers:
        """The residue numbers of the file.

        >>> molecule.residue_numbers[::8].tolist()
        [1, 3, 5, 7, 9, 11, 13, 15]"""
        return self._compared(header.STRUCTURE_RESIDUE_NUMBERS)

    @property
    def insertion_codes(self) -> Texts:
        """The letters after residue numbers; "" where there is none.

        >>> set(molecule.insertion_codes.tolist())
        {''}"""
        return np.char.strip(self._column(header.STRUCTURE_INSERTION_CODES)).view(_Column)

    @property
    def altlocs(self) -> Texts:
        """The letters of alternate locations; "" where there is none.

        >>> set(molecule.altlocs.tolist())
        {''}"""
        return np.char.strip(self._column(header.STRUCTURE_ALTLOCS)).view(_Column)

    @property
    def residues(self) -> Indices:
        """The indices of the residues in the file, from 0.

        >>> molecule.residues[::8].tolist()
        [0, 2, 4, 6, 8, 10, 12, 14]"""
        return self._compared(header.STRUCTURE_RESIDUES)

    @property
    def models(self) -> Numbers:
        """The numbers of the models, from 1.

        >>> set(molecule.models.tolist())
        {1}"""
        return self._compared(header.STRUCTURE_MODELS)

    @property
    def copies(self) -> Indices:
        """The indices of the copies in an assembly, from 0.

        >>> set(molecule.copies.tolist())
        {0}"""
        return self._compared(header.STRUCTURE_COPIES)

    @property
    def charges(self) -> Singles:
        """The partial charges in e; NaN where the file has none.

        >>> bool(np.isnan(molecule.charges).all())
        True"""
        return self._compared(header.STRUCTURE_CHARGES)

    @property
    def b_factors(self) -> Singles:
        """The B-factors in Å²; NaN where the file has none.

        >>> molecule.b_factors[:3].tolist()
        [0.0, 1.0, 2.0]"""
        return self._compared(header.STRUCTURE_B_FACTORS)

    @property
    def occupancies(self) -> Singles:
        """The occupancies, 0 to 1; NaN where the file has none.

        >>> molecule.occupancies[:3].tolist()
        [1.0, 1.0, 1.0]"""
        return self._compared(header.STRUCTURE_OCCUPANCIES)

    @property
    def classes(self) -> Texts:
        """The classes of the atoms: "polymer", "ligand", "water" or "ion"; "unclassified" if the format has none.

        >>> set(molecule.classes.tolist())
        {'polymer'}"""
        return CLASSES[self._column(header.STRUCTURE_CLASSES)].view(_Column)

    @property
    def hydropathies(self) -> Floats:
        """The hydropathies of the residues (Kyte & Doolittle 1982); NaN for residues that are not amino acids.

        >>> molecule.hydropathies[:3].tolist()
        [1.8, 1.8, 1.8]"""
        return self._compared(header.STRUCTURE_HYDROPATHIES)


class Atom(NamedTuple):
    """An atom of a Structure.

    row: its row in the structure. name, element, residue_name, residue_number, insertion_code, chain: as in the arrays
    of Structure. position: Å. radius: the van der Waals radius in Å.

    >>> atom = meniscus.read("helix.pdb")[1]
    >>> atom.name, atom.element, atom.residue_name, atom.residue_number, atom.chain, atom.radius
    ('CA', 'C', 'ALA', 1, 'A', 1.7)"""
    row: int
    name: str
    element: str
    residue_name: str
    residue_number: int
    insertion_code: str
    chain: str
    position: tuple[float, float, float]
    radius: float


def atoms_of(molecule: Columns, rows: Iterable[int]) -> Iterator[Atom]:
    """Yields atoms of a molecule."""
    chosen = list(rows)
    columns = [np.asarray(column)[chosen].tolist() for column in (
        molecule.names, molecule.elements, molecule.residue_names, molecule.residue_numbers, molecule.insertion_codes,
        molecule.chains, molecule.positions, molecule.radii)]
    for row, (name, element, residue, number, code, chain, (x, y, z), radius) in zip(chosen, zip(*columns)):
        yield Atom(row, name, element, residue, number, code, chain, (x, y, z), radius)


def groups_of(molecule: Columns, by: str) -> tuple[AnyArray, AnyArray]:
    """Returns the first row of each residue, chain or model in their order, and the number of the group of each atom.
    Raises UsageError for other words."""
    keys: dict[str, tuple[Any, ...]] = {"residue": (molecule.models, molecule.copies, molecule.residues),
                                        "chain": (molecule.models, molecule.chains), "model": (molecule.models,)}
    if by not in keys:
        raise UsageError(f"by is {by!r}, none of {', '.join(keys)}")
    codes = np.zeros(len(molecule.radii), np.int64)
    for key in keys[by]:
        distinct, places = np.unique(np.asarray(key), return_inverse=True)
        codes = np.unique(codes * len(distinct) + places.reshape(-1), return_inverse=True)[1].reshape(-1)
    first = np.unique(codes, return_index=True)[1]
    order = np.argsort(first)
    numbers = np.empty(len(order), np.int64)
    numbers[order] = np.arange(len(order))
    return first[order], numbers[codes] if len(codes) else codes


def parts_of(molecule: Columns, by: Literal["residue", "chain", "model"]) -> list[AnyArray]:
    """Returns the rows of each residue, chain or model."""
    first, group = groups_of(molecule, by)
    return np.split(np.argsort(group, kind="stable"), np.cumsum(np.bincount(group, minlength=len(first)))[:-1])


def frame_of(columns: dict[str, Any]) -> Any:
    """Returns a pandas.DataFrame. Raises ImportError if pandas is not installed."""
    try:
        pandas = importlib.import_module("pandas")
    except ImportError as error:
        raise ImportError(f"to_dataframe() needs pandas ({error}): python -m pip install pandas") from error
    return pandas.DataFrame({name: np.asarray(values) for name, values in columns.items()})


def dataframe_of(molecule: Columns) -> Any:
    """Returns a table of the atoms."""
    x, y, z = np.asarray(molecule.positions).T
    return frame_of({"index": molecule.indices, "name": molecule.names, "element": molecule.elements,
                     "residue_name": molecule.residue_names, "residue_number": molecule.residue_numbers,
                     "insertion_code": molecule.insertion_codes, "chain": molecule.chains, "model": molecule.models,
                     "class": molecule.classes, "x": x, "y": y, "z": z, "radius": molecule.radii,
                     "charge": molecule.charges, "b_factor": molecule.b_factors, "occupancy": molecule.occupancies})


def sums_of(molecule: Columns, by: str, values: dict[str, AnyArray]) -> AnyArray:
    """Returns a structured array with the sums of values of atoms for each residue, chain or model."""
    first, group = groups_of(molecule, by)
    keys: dict[str, Any] = {"model": molecule.models, "chain": molecule.chains}
    if by == "residue":
        keys.update(residue_name=molecule.residue_names, residue_number=molecule.residue_numbers,
                    insertion_code=molecule.insertion_codes)
    elif by == "model":
        del keys["chain"]
    columns = {name: np.asarray(column)[first] for name, column in keys.items()}
    columns["atoms"] = np.bincount(group, minlength=len(first))
    columns.update({name: np.bincount(group, of_atoms, len(first)) for name, of_atoms in values.items()})
    table = np.empty(len(first), [(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        table[name] = column
    return table
