# SPDX-License-Identifier: BSD-3-Clause
"""Molecules from files, read as the program reads them."""
from __future__ import annotations

import ctypes
import os
import warnings
from typing import Any, Iterable, Literal, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import file_name, flag, listed, number, positive, text, whole_number, word
from ._arrays import texts, view
from ._errors import InputError
from ._types import AnyArray, Bytes, Floats, Hydrogens, Indices, Numbers, Path, RadiiSet, Singles, Texts, UnknownElement

_NUMBERS: dict[int, Any] = {  # what a row is; other columns are texts
    header.STRUCTURE_POSITIONS: (np.float64, 3), header.STRUCTURE_RADII: (np.float64,), header.STRUCTURE_ELEMENTS: (np.uint8,),
    header.STRUCTURE_INDICES: (np.uint32,), header.STRUCTURE_RESIDUE_NUMBERS: (np.int32,),
    header.STRUCTURE_RESIDUES: (np.uint32,), header.STRUCTURE_MODELS: (np.int32,), header.STRUCTURE_COPIES: (np.uint32,),
    header.STRUCTURE_CHARGES: (np.float32,), header.STRUCTURE_B_FACTORS: (np.float32,),
    header.STRUCTURE_OCCUPANCIES: (np.float32,), header.STRUCTURE_CLASSES: (np.uint8,),
    header.STRUCTURE_HYDROPATHIES: (np.float64,)}
_HYDROGENS = {"auto": header.HYDROGENS_AUTO, "keep": header.HYDROGENS_KEEP, "drop": header.HYDROGENS_DROP}
_UNKNOWN_ELEMENTS = {"halt": header.UNKNOWN_HALT, "guess": header.UNKNOWN_GUESS, "skip": header.UNKNOWN_SKIP}


class _Report(NamedTuple):
    file: str
    format: str
    radii_set: str
    sentence: str
    atoms: int
    models: int


class Structure:
    """The atoms of a file that a surface is made of; read() makes it, and it never changes. Arrays have one row per atom,
    (n,) or (n, 3); of numbers they are read-only views.

    >>> molecule = meniscus.read("helix.pdb")
    >>> molecule
    <meniscus.Structure: helix.pdb, PDB: 65 atoms read; 1 water left out; 64 used>"""

    __slots__ = ("_columns", "_handle", "_report", "__weakref__")

    def __init__(self, handle: Optional[lib.Handle], report: _Report, columns: dict[int, AnyArray]) -> None:
        """columns: those that were looked at already; without a handle all."""
        self._handle, self._report, self._columns = handle, report, columns

    def _column(self, column: int) -> AnyArray:
        if column not in self._columns:
            assert self._handle is not None
            row = _NUMBERS.get(column)
            self._columns[column] = (view(self._handle, "structure_table", column, *row) if row else
                                     texts(self._handle, "structure_table", column))
        return self._columns[column]

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles hold what was read, so that the file is not needed again."""
        columns = range(header.STRUCTURE_POSITIONS, header.STRUCTURE_HYDROPATHIES + 1)
        return _unpacked, (self._report, {column: self._column(column) for column in columns})

    def __copy__(self) -> Structure:
        """Itself, for it never changes."""
        return self

    def __deepcopy__(self, memo: Any) -> Structure:
        return self

    # ---- what was read

    @property
    def file(self) -> str:
        """The path as given.

        >>> molecule.file
        'helix.pdb'"""
        return self._report.file

    @property
    def format(self) -> str:
        """"PDB", "mmCIF", ...

        >>> molecule.format
        'PDB'"""
        return self._report.format

    @property
    def radii_set(self) -> str:
        """"bondi", "united", "protor", "file", or files and overrides.

        >>> molecule.radii_set
        'bondi'"""
        return self._report.radii_set

    @property
    def report(self) -> str:
        """"5,684 atoms read; 215 water left out; 5,469 used".

        >>> molecule.report
        '65 atoms read; 1 water left out; 64 used'"""
        return self._report.sentence

    @property
    def model_count(self) -> int:
        """Models in the file, used or not.

        >>> molecule.model_count
        1"""
        return self._report.models

    @property
    def warnings(self) -> list[str]:
        """What is odd in the file, a sentence each.

        >>> molecule.warnings
        []"""
        return [str(row) for row in self._column(header.STRUCTURE_WARNINGS)]

    def __len__(self) -> int:
        return self._report.atoms

    def __repr__(self) -> str:
        return f"<meniscus.Structure: {self.file}, {self.format}: {self.report}>"

    # ---- atoms

    @property
    def positions(self) -> Floats:
        """(n, 3) Å.

        >>> molecule.positions[:2].tolist()
        [[3.1, 0.0, 0.0], [1.927, 2.428, 0.55]]"""
        return self._column(header.STRUCTURE_POSITIONS)

    @property
    def radii(self) -> Floats:
        """Å, van der Waals.

        >>> molecule.radii[:4].tolist()
        [1.55, 1.7, 1.7, 1.52]"""
        return self._column(header.STRUCTURE_RADII)

    @property
    def elements(self) -> Bytes:
        """Atomic numbers; 0 where it is unknown.

        >>> molecule.elements[:4].tolist()
        [7, 6, 6, 8]"""
        return self._column(header.STRUCTURE_ELEMENTS)

    @property
    def indices(self) -> Indices:
        """Places in the file, from 0, as the program's tables and meshes have them.

        >>> molecule.indices[-3:].tolist()
        [61, 62, 63]"""
        return self._column(header.STRUCTURE_INDICES)

    @property
    def names(self) -> Texts:
        """"CA".

        >>> molecule.names[:4].tolist()
        ['N', 'CA', 'C', 'O']"""
        return self._column(header.STRUCTURE_NAMES)

    @property
    def residue_names(self) -> Texts:
        """"ALA".

        >>> molecule.residue_names[::8].tolist()[:2]
        ['ALA', 'ALA']"""
        return self._column(header.STRUCTURE_RESIDUE_NAMES)

    @property
    def chains(self) -> Texts:
        """"A"; of the second copy in an assembly "A-2".

        >>> molecule.chains[[0, -1]].tolist()
        ['A', 'B']"""
        return self._column(header.STRUCTURE_CHAINS)

    @property
    def segments(self) -> Texts:
        """Segment identifiers of molecular dynamics programs.

        >>> set(molecule.segments.tolist())
        {''}"""
        return self._column(header.STRUCTURE_SEGMENTS)

    @property
    def residue_numbers(self) -> Numbers:
        """As the file has them.

        >>> molecule.residue_numbers[::8].tolist()
        [1, 3, 5, 7, 9, 11, 13, 15]"""
        return self._column(header.STRUCTURE_RESIDUE_NUMBERS)

    @property
    def insertion_codes(self) -> Texts:
        """A letter after the residue's number, or nothing.

        >>> set(molecule.insertion_codes.tolist())
        {''}"""
        return np.char.strip(self._column(header.STRUCTURE_INSERTION_CODES))

    @property
    def altlocs(self) -> Texts:
        """The letter of the alternate location, or nothing.

        >>> set(molecule.altlocs.tolist())
        {''}"""
        return np.char.strip(self._column(header.STRUCTURE_ALTLOCS))

    @property
    def residues(self) -> Indices:
        """Running number of the residue in the file, from 0.

        >>> molecule.residues[::8].tolist()
        [0, 2, 4, 6, 8, 10, 12, 14]"""
        return self._column(header.STRUCTURE_RESIDUES)

    @property
    def models(self) -> Numbers:
        """Which model of the file, from 1.

        >>> set(molecule.models.tolist())
        {1}"""
        return self._column(header.STRUCTURE_MODELS)

    @property
    def copies(self) -> Indices:
        """Which copy of an assembly, from 0.

        >>> set(molecule.copies.tolist())
        {0}"""
        return self._column(header.STRUCTURE_COPIES)

    @property
    def charges(self) -> Singles:
        """Partial charges in e; NaN where the file has none.

        >>> bool(np.isnan(molecule.charges).all())
        True"""
        return self._column(header.STRUCTURE_CHARGES)

    @property
    def b_factors(self) -> Singles:
        """Å²; NaN where the file has none.

        >>> molecule.b_factors[:3].tolist()
        [0.0, 1.0, 2.0]"""
        return self._column(header.STRUCTURE_B_FACTORS)

    @property
    def occupancies(self) -> Singles:
        """NaN where the file has none.

        >>> molecule.occupancies[:3].tolist()
        [1.0, 1.0, 1.0]"""
        return self._column(header.STRUCTURE_OCCUPANCIES)

    @property
    def classes(self) -> Texts:
        """"polymer", "ligand", "water", "ion"; "unclassified" where the format does not say.

        >>> set(molecule.classes.tolist())
        {'polymer'}"""
        words = np.array(["polymer", "ligand", "water", "ion", "unclassified"])
        return words[self._column(header.STRUCTURE_CLASSES)]

    @property
    def hydropathies(self) -> Floats:
        """(n,) of the residue (Kyte & Doolittle 1982); NaN where it is not an amino acid.

        >>> molecule.hydropathies[:3].tolist()
        [1.8, 1.8, 1.8]"""
        return self._column(header.STRUCTURE_HYDROPATHIES)

    def colors(self, scheme: str = "element") -> Singles:
        """(n, 3) sRGB in [0, 1], as the program colours atoms and as render() and save() take them. scheme: "chain",
        "bfactor" or another word of `meniscus colors` that means atoms by what the file says of them, a name such as "red",
        or "#rrggbb"; UsageError for others, InputError where a scheme is of numbers that no atom has, and for a structure
        from a pickle.

        >>> molecule.colors("red")[0].tolist()
        [1.0, 0.0, 0.0]
        >>> meniscus.surface(molecule).mesh(0.1).save("helix.ply", colors=molecule.colors("residue"))"""
        if self._handle is None:
            raise InputError("colors: of a structure that was read, not of one that was unpickled; read the file again")
        colors = np.empty((len(self), 3), np.float32)
        lib.call("structure_colors", self._handle.pointer, scheme.encode(), colors.ctypes.data)
        return colors


def _unpacked(report: _Report, columns: dict[int, AnyArray]) -> Structure:
    for column in columns.values():
        column.flags.writeable = False
    return Structure(None, report, columns)


def _opened(handle: lib.Handle) -> Structure:
    report = header.ReadReport(ctypes.sizeof(header.ReadReport))
    lib.call("structure_report", handle.pointer, ctypes.byref(report))
    return Structure(handle, _Report(os.fsdecode(report.file), report.format.decode(),
                                     report.radii_set.decode("utf-8", "replace"),
                                     report.sentence.decode("utf-8", "replace"), report.atoms, report.models), {})


def _overrides(radius: Union[Mapping[str, float], Iterable[str], None]) -> list[str]:
    if radius is None:
        return []
    if isinstance(radius, str):
        return [radius]
    if isinstance(radius, Mapping):
        return [f"{selection}={number('radius', value)!r}" for selection, value in radius.items()]
    return listed("radius", radius, "texts such as 'element Zn=1.1'")


def _list_of(given: Sequence[bytes]) -> Any:
    return (ctypes.c_char_p * len(given))(*given)


def read(path: Path, *, select: Optional[str] = None, assembly: Union[str, int, None] = None,
         model: Union[int, Literal["all"]] = 1, altloc: str = "best", hydrogens: Hydrogens = "auto",
         radii: Optional[RadiiSet] = None, radii_files: Union[Path, Sequence[Path]] = (),
         radius: Union[Mapping[str, float], Iterable[str], None] = None, keep_water: bool = False,
         keep_ions: bool = False, unknown_element: UnknownElement = "halt") -> Structure:
    """The atoms of a PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ or XYZR file, plain or packed with gzip, as
    the program takes them: polymers and ligands of the first model, of each residue the most occupied conformer, without water and free ions.
    What is odd in the file is a UserWarning.

    select: an expression, "chain A and resid 10-50". assembly: build this biological assembly. model: from 1, or "all"
    as one molecule. altloc: "best", "first", "all" or a letter. hydrogens: "keep", "drop", or as the radii need it.
    radii: "bondi", "united", "protor" or "file"; by default those of the file if it has any, else "bondi".
    radii_files: tables by residue and atom, before that set. radius: of what expressions select, Å, as in
    {"element Zn": 1.1}. unknown_element: what becomes of atoms of unknown element. InputError where the file
    cannot be read, UsageError where an option or an expression is not valid.

    >>> len(meniscus.read("helix.pdb", select="chain A", radius={"element N": 1.6}))
    32
    >>> meniscus.read("none.pdb")
    Traceback (most recent call last):
        ...
    meniscus.InputError: none.pdb: cannot be read: No such file or directory"""
    options = lib.default("read_options", header.ReadOptions())
    options.select, options.altloc = text("select", select), text("altloc", altloc)
    options.assembly = None if assembly is None else text("assembly", str(assembly))
    options.radii = text("radii", radii)
    options.model = 0 if isinstance(model, str) and model == "all" else positive("model", model)
    options.hydrogens = word("hydrogens", hydrogens, _HYDROGENS)
    options.unknown_element = word("unknown_element", unknown_element, _UNKNOWN_ELEMENTS)
    options.keep_water, options.keep_ions = flag("keep_water", keep_water), flag("keep_ions", keep_ions)
    files = ([radii_files] if isinstance(radii_files, (str, bytes, os.PathLike)) else
             listed("radii_files", radii_files, "files"))
    tables = _list_of([file_name("radii_files", file) for file in files])
    overrides = _list_of([text("radius", override) or b"" for override in _overrides(radius)])
    options.radii_files, options.radii_file_count = tables, len(tables)
    options.radius, options.radius_count = overrides, len(overrides)
    structure = _opened(lib.Handle("structure", "read", file_name("path", path), ctypes.byref(options)))
    for warning in structure.warnings:
        warnings.warn(f"{structure.file}: {warning}", stacklevel=2)
    return structure


def _element(symbol: str) -> int:
    number = ctypes.c_int32()
    lib.call("element_of_symbol", symbol.strip().encode(), ctypes.byref(number))
    return number.value


def _radius(element: int) -> float:
    radius = ctypes.c_double()
    lib.call("element_radius", element, ctypes.byref(radius), None)
    return radius.value


def radii_of(elements: Iterable[Union[str, int]]) -> Floats:
    """Å, one per symbol or atomic number: Bondi (1964, 1966), then Mantina et al. (2009), 2.0 for metals that neither
    has. InputError where a symbol is not an element's.

    >>> meniscus.radii_of(["C", "Zn", 8]).tolist()
    [1.7, 1.39, 1.52]
    >>> meniscus.radii_of(["Qq"])
    Traceback (most recent call last):
        ...
    meniscus.InputError: atom 0: 'Qq' is not an element; give radii"""
    given = listed("elements", elements, "symbols or atomic numbers")
    given = [element if isinstance(element, str) else whole_number(f"atom {n}: the element", element)
             for n, element in enumerate(given)]
    known: dict[Union[str, int], float] = {}
    for n, element in enumerate(given):
        if element in known:
            continue
        number = _element(element) if isinstance(element, str) else element
        if number == 0:
            raise InputError(f"atom {n}: {str(element)!r} is not an element; give radii")
        known[element] = _radius(number)
    return np.array([known[element] for element in given], dtype=np.float64)
