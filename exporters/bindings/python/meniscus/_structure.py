# SPDX-License-Identifier: BSD-3-Clause
"""Molecules: arrays of atoms, from files, from other packages or from arrays of the caller."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, Optional, Union, overload

import numpy as np

from . import _header as header
from . import _library as lib
from ._arguments import AnyArray, Floats, Path, Singles, number
from ._arrays import Report, WHOLE, column_of, handle_of, real_array, renamed, report_of
from ._columns import (NUMBERS, SYMBOLS, Atom, Columns, atomic_numbers, atoms_of, dataframe_of, parts_of,
                       radii_of)
from ._errors import InputError, also, wrong_type
from ._written import cif_of, written

#: The parameters of Structure() and their columns.
_GIVEN = {"radii": header.STRUCTURE_RADII, "names": header.STRUCTURE_NAMES,
          "residue_names": header.STRUCTURE_RESIDUE_NAMES, "residue_numbers": header.STRUCTURE_RESIDUE_NUMBERS,
          "insertion_codes": header.STRUCTURE_INSERTION_CODES, "chains": header.STRUCTURE_CHAINS,
          "segments": header.STRUCTURE_SEGMENTS, "altlocs": header.STRUCTURE_ALTLOCS,
          "models": header.STRUCTURE_MODELS, "charges": header.STRUCTURE_CHARGES,
          "b_factors": header.STRUCTURE_B_FACTORS, "occupancies": header.STRUCTURE_OCCUPANCIES}
_UNCLASSIFIED = 4


class Structure(Columns):
    """The atoms of a molecule: of a file, from read(); of another package, from the from_...() functions; or of arrays.
    It never changes, and all threads may use it at once. Arrays have one row per atom, (n,) unless their description
    has another shape; they are read-only.

    positions: (n, 3) Å. elements: symbols or atomic numbers, (n,); None or "" where they are guessed from the names, as
    read() does. radii: van der Waals radii in Å, (n,) or one for all atoms; None for those of the elements; {"C": 1.8}
    for others of some elements; or a set of read() such as "protor". The other
    arrays, (n,), may be None: names, residue_names, residue_numbers, insertion_codes, chains, segments, altlocs, models
    (from 1), charges in e, b_factors in Å² and occupancies. name: the name of the molecule, which messages have. Raises
    InputError for impossible shapes and values, and for atoms without element and radius.

    A part of a molecule is a Structure, too: molecule[mask], molecule[10:20] or molecule[[3, 5]]. molecule[3] and
    iterations give an Atom.

    >>> molecule = meniscus.read("helix.pdb")
    >>> molecule
    <meniscus.Structure: helix.pdb, PDB: 65 atoms read; 1 water atom left out; 64 used>
    >>> molecule[molecule.elements == "C"]
    <meniscus.Structure: 32 of 64 atoms of helix.pdb>
    >>> molecule[1].name, len(molecule[:8])
    ('CA', 8)
    >>> meniscus.Structure([[0, 0, 0], [3, 0, 0]], ["C", "O"])
    <meniscus.Structure: 2 atoms>"""

    __slots__ = ("_columns", "_count", "_handle", "_report", "_source", "__weakref__")

    _columns: dict[int, AnyArray]  # the columns that are known already
    _count: int
    _handle: Optional[lib.Handle]
    _report: Report
    _source: Optional[tuple[Structure, Any]]  # the molecule of which this is a part, and the rows

    def __init__(self, positions: Any, elements: Any = None, *, radii: Any = None, names: Any = None,
                 residue_names: Any = None, residue_numbers: Any = None, insertion_codes: Any = None,
                 chains: Any = None, segments: Any = None, altlocs: Any = None, models: Any = None,
                 charges: Any = None, b_factors: Any = None, occupancies: Any = None, name: str = "") -> None:
        xyz = real_array(positions, "positions", 1)
        if xyz.ndim != 2 or xyz.shape[1] != 3:
            raise InputError(f"positions has the shape {xyz.shape}; it has to be (n, 3)")
        given = {"radii": radii, "names": names, "residue_names": residue_names, "residue_numbers": residue_numbers,
                 "insertion_codes": insertion_codes, "chains": chains, "segments": segments, "altlocs": altlocs,
                 "models": models, "charges": charges, "b_factors": b_factors, "occupancies": occupancies}
        self._count, self._handle, self._source = len(xyz), None, None
        radii_set = radii if isinstance(radii, str) else "bondi" if radii is None else "arrays"
        self._report = Report(name, "arrays", radii_set, f"{len(xyz)} atoms", 1)
        self._columns = {header.STRUCTURE_POSITIONS: np.array(xyz, np.float64)}
        for key, values in given.items():
            by_rule = key == "radii" and isinstance(values, (str, Mapping))
            self._columns[_GIVEN[key]] = _checked(key, _GIVEN[key], None if by_rule else values, len(xyz))
        self._set_residues(residue_names is None)
        self._set_elements(elements)
        if radii is None or isinstance(radii, (str, Mapping)):
            self._columns[header.STRUCTURE_RADII] = self._radii_by(radii)
        for column in self._columns.values():
            column.flags.writeable = False

    @classmethod
    def _of(cls, report: Report, count: int, columns: dict[int, AnyArray], handle: Optional[lib.Handle] = None,
            source: Optional[tuple[Structure, Any]] = None) -> Structure:
        structure = cls.__new__(cls)
        structure._report, structure._count, structure._columns = report, count, columns
        structure._handle, structure._source = handle, source
        return structure

    @classmethod
    def _read(cls, handle: lib.Handle, name: Optional[str] = None) -> Structure:
        """Returns the molecule of a handle. name: what `file` is, if not the path."""
        report, count = report_of(handle)
        return cls._of(report if name is None else report._replace(file=name), count, {}, handle)

    def _set_residues(self, without: bool) -> None:
        """Counts the residues: a new one begins where the model, chain, segment, number, insertion code or name changes.

        without: whether the atoms have no residues, so that they have no class."""
        columns, new = self._columns, np.zeros(self._count, bool)
        for key in (header.STRUCTURE_MODELS, header.STRUCTURE_CHAINS, header.STRUCTURE_SEGMENTS,
                    header.STRUCTURE_RESIDUE_NUMBERS, header.STRUCTURE_INSERTION_CODES, header.STRUCTURE_RESIDUE_NAMES):
            new[1:] |= columns[key][1:] != columns[key][:-1]
        columns[header.STRUCTURE_RESIDUES] = np.cumsum(new).astype(np.uint32)
        columns[header.STRUCTURE_INDICES] = np.arange(self._count, dtype=np.uint32)
        columns[header.STRUCTURE_COPIES] = np.zeros(self._count, np.uint32)
        columns[header.STRUCTURE_WARNINGS] = np.empty(0, np.str_)
        if without:
            columns[header.STRUCTURE_CLASSES] = np.full(self._count, _UNCLASSIFIED, np.uint8)

    def _set_elements(self, elements: Any) -> None:
        """Sets the atomic numbers. The library guesses those that are missing, if the atoms have names."""
        columns, names = self._columns, self._columns[header.STRUCTURE_NAMES]
        numbers = np.zeros(self._count, np.int64) if elements is None else _numbers_of(elements, self._count)
        columns[header.STRUCTURE_ELEMENTS] = numbers.astype(np.uint8)
        missing = np.flatnonzero(numbers == 0)
        if not len(missing) or not (names != "").any():
            return
        try:
            handle = self._reread(**WHOLE)
        except InputError:  # because all are virtual sites
            return
        found = np.array(column_of(handle, header.STRUCTURE_INDICES), np.int64)
        columns[header.STRUCTURE_ELEMENTS] = np.zeros(self._count, np.uint8)
        columns[header.STRUCTURE_ELEMENTS][found] = column_of(handle, header.STRUCTURE_ELEMENTS)
        columns[header.STRUCTURE_WARNINGS] = np.array(
            [str(text) for text in column_of(handle, header.STRUCTURE_WARNINGS) if "element" in str(text)], np.str_)

    def _radii_by(self, rule: Union[None, str, Mapping[str, float]]) -> Floats:
        """Returns radii by element, of a set of read(), or by element with those of a mapping instead."""
        numbers = self._columns[header.STRUCTURE_ELEMENTS]
        if isinstance(rule, str):
            handle = self._reread(**WHOLE, radii=rule)
            if report_of(handle)[1] == self._count:
                return np.array(column_of(handle, header.STRUCTURE_RADII))
        if numbers.all():
            found = radii_of([*map(int, numbers)])
            for symbol, radius in (rule or {}).items() if not isinstance(rule, str) else ():
                found[numbers == atomic_numbers([symbol])[0]] = number("radii", radius)
            return found
        missing, names = np.flatnonzero(numbers == 0), self._columns[header.STRUCTURE_NAMES]
        n = int(missing[0])
        if not (names != "").any():
            raise InputError("some atoms have no element; give radii")
        raise InputError(f"{len(missing)} of {self._count} atoms have no element, and no name that tells it (first: atom "
                         f"{n}, {str(names[n])!r} in {self._columns[header.STRUCTURE_RESIDUE_NAMES][n]} "
                         f"{self._columns[header.STRUCTURE_RESIDUE_NUMBERS][n]}); give radii, or leave such particles out")

    # ---- the library's object

    def _column(self, column: int) -> AnyArray:
        if column not in self._columns:
            if self._source is not None:
                whole, rows = self._source
                values = whole._column(column) if column == header.STRUCTURE_WARNINGS else whole._column(column)[rows]
                values.flags.writeable = False
            elif self._handle is not None:
                values = column_of(self._handle, column)
            else:
                values = self._found(column)
            self._columns[column] = values
        return self._columns[column]

    def _found(self, column: int) -> AnyArray:
        """Returns the classes or the hydropathies that the library finds. Virtual sites have none."""
        empty = np.nan if column == header.STRUCTURE_HYDROPATHIES else _UNCLASSIFIED
        values = np.full(self._count, empty, NUMBERS[column][0])
        try:
            handle = self._reread(**WHOLE)
            values[np.asarray(column_of(handle, header.STRUCTURE_INDICES), np.int64)] = column_of(handle, column)
        except InputError:  # because all are virtual sites
            pass
        values.flags.writeable = False
        return values

    def _text(self, classes: Optional[AnyArray] = None) -> str:
        """Returns the molecule as mmCIF. classes: rows of CLASSES; None for atoms without a class. Raises InputError if
        there are no atoms."""
        if self._count == 0:
            raise InputError("there are no atoms")
        if classes is None:
            classes = np.full(self._count, _UNCLASSIFIED, np.uint8)
        elements = SYMBOLS[self._column(header.STRUCTURE_ELEMENTS)]
        return cif_of(self._column, classes, elements, os.path.basename(self.file))

    def _reread(self, **options: Any) -> lib.Handle:
        """Returns the library's object of the atoms, which it reads from a temporary file. options: those of read()."""
        is_classified = header.STRUCTURE_CLASSES in self._columns or self._source or self._handle
        text = self._text(np.asarray(self._column(header.STRUCTURE_CLASSES)) if is_classified else None)
        with tempfile.TemporaryDirectory(prefix="meniscus-") as folder:
            path = os.path.join(folder, f"{os.path.basename(self.file).split('.')[0] or 'molecule'}.cif")
            with open(path, "w", encoding="utf-8", errors="surrogateescape") as file:
                file.write(text)
            with renamed(path, self.file or "the molecule"):
                return handle_of(path, **options)

    def _library_object(self) -> lib.Handle:
        """Returns the library's object of these atoms, in this order. Raises InputError if it does not take all."""
        if self._handle is None:
            handle = self._reread(**WHOLE)
            count = report_of(handle)[1]
            if count != self._count:
                raise InputError(f"{self._count - count} of {self._count} atoms are virtual sites, which have no surface; "
                                 "leave them out")
            self._handle = handle
        return self._handle

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles have all columns. Unpickling does not read the file again."""
        columns = range(header.STRUCTURE_POSITIONS, header.STRUCTURE_HYDROPATHIES + 1)
        return _unpacked, (self._report, self._count, {column: np.asarray(self._column(column)) for column in columns})

    def __copy__(self) -> Structure:
        """Returns this object, because it never changes."""
        return self

    def __deepcopy__(self, memo: Any) -> Structure:
        return self

    # ---- the file

    @property
    def file(self) -> str:
        """The path that was passed to read(), the name of a file object, or the name of a molecule of arrays.

        >>> molecule.file
        'helix.pdb'"""
        return self._report.file

    @property
    def format(self) -> str:
        """The format of the file, such as "PDB" or "mmCIF"; "arrays" for a molecule of arrays or of another package.

        >>> molecule.format
        'PDB'"""
        return self._report.format

    @property
    def radii_set(self) -> str:
        """The set of radii: "bondi", "united", "protor" or "file", with files and overrides; "arrays" for given radii.

        >>> molecule.radii_set
        'bondi'"""
        return self._report.radii_set

    @property
    def report(self) -> str:
        """A sentence about the atoms that were read, left out and used.

        >>> molecule.report
        '65 atoms read; 1 water atom left out; 64 used'"""
        return self._report.sentence

    @property
    def model_count(self) -> int:
        """The number of models in the file, both used and unused.

        >>> molecule.model_count
        1"""
        return self._report.models

    @property
    def warnings(self) -> list[str]:
        """Sentences about unusual things in the file.

        >>> molecule.warnings
        []"""
        return [str(row) for row in self._column(header.STRUCTURE_WARNINGS)]

    def __len__(self) -> int:
        return self._count

    def __repr__(self) -> str:
        whole = self if self._source is None else self._source[0]
        if whole._count != self._count:
            of = f" of {self.file}" if self.file else ""
            return f"<meniscus.Structure: {self._count} of {whole._count} atoms{of}>"
        if self.format == "arrays":
            many = "s" * (self._count != 1)
            return f"<meniscus.Structure: {self._count} atom{many}{' of ' * bool(self.file)}{self.file}>"
        return f"<meniscus.Structure: {self.file}, {self.format}: {self.report}>"

    # ---- parts

    @overload
    def __getitem__(self, key: Union[int, np.integer[Any]]) -> Atom: ...
    @overload
    def __getitem__(self, key: Union[slice, Sequence[int], AnyArray]) -> Structure: ...

    def __getitem__(self, key: Any) -> Union[Atom, Structure]:
        """Returns the atom of an index, or the part of a mask, a slice or an array of indices."""
        if isinstance(key, str):
            raise wrong_type(f"{key!r} is a text; molecule.select({key!r}) selects atoms")
        if isinstance(key, (int, np.integer)) and not isinstance(key, (bool, np.bool_)):
            if not -self._count <= key < self._count:
                raise also(InputError, (IndexError,), f"there is no atom {key}; there are {self._count}")
            return next(atoms_of(self, [int(key) % self._count]))
        try:
            rows = np.arange(self._count)[np.asarray(key, np.int64) if isinstance(key, list) and not key else key]
        except IndexError as error:
            raise also(InputError, (IndexError,), f"not rows of the {self._count} atoms: {error}") from None
        if rows.ndim != 1:
            raise wrong_type(f"{key!r:.60} is not a mask, a slice or a list of indices")
        return self._rows(rows)

    def _rows(self, rows: AnyArray) -> Structure:
        whole, own = (self, rows) if self._source is None else (self._source[0], np.asarray(self._source[1])[rows])
        columns = {} if self._source is None else {
            key: values[rows] for key, values in self._columns.items() if key != header.STRUCTURE_WARNINGS}
        for values in columns.values():
            values.flags.writeable = False
        return Structure._of(self._report, len(rows), columns, source=(whole, own))

    def _moved(self, positions: AnyArray) -> Structure:
        """Returns the same atoms at other positions."""
        xyz = np.array(positions, np.float64)
        xyz.flags.writeable = False
        whole, rows = self._source or (self, np.arange(self._count))
        return Structure._of(self._report, self._count, {**self._columns, header.STRUCTURE_POSITIONS: xyz},
                             source=(whole, rows))

    def select(self, selection: str) -> Structure:
        """Returns the atoms of a selection, such as "chain A and resid 10-50", in the words of read(); "index" counts the
        atoms of this structure.

        Raises UsageError for an invalid selection, and InputError if it selects no atom. Words about helices and sheets
        are decided by the positions, not by the file.

        >>> molecule.select("chain B and name CA")
        <meniscus.Structure: 8 of 64 atoms of helix.pdb>"""
        if not isinstance(selection, str):
            raise wrong_type(f"selection is of the type {type(selection).__name__}, not a text")
        return self._rows(self._selected(selection))

    def _selected(self, selection: str) -> AnyArray:
        return np.array(column_of(self._reread(**{**WHOLE, "select": selection}), header.STRUCTURE_INDICES), np.int64)

    def _usual(self) -> tuple[AnyArray, Structure]:
        """Returns the atoms that read() uses by default, with its radii: their rows, and the part."""
        handle = self._reread()
        rows = np.array(column_of(handle, header.STRUCTURE_INDICES), np.int64)
        part = self._rows(rows)
        part._columns[header.STRUCTURE_RADII] = column_of(handle, header.STRUCTURE_RADII)
        return rows, part

    def _mask(self, part: Any) -> AnyArray:
        """Returns a part as a mask, (n,). part: a selection, a mask or indices."""
        mask = np.zeros(self._count, bool)
        mask[self._selected(part) if isinstance(part, str) else np.asarray(part)] = True
        return mask

    def __iter__(self) -> Iterator[Atom]:
        return atoms_of(self, range(self._count))

    def split(self, by: Literal["residue", "chain", "model"] = "residue") -> list[Structure]:
        """Returns the residues, chains or models as parts, in order of their first atoms.

        >>> [len(chain) for chain in molecule.split("chain")]
        [32, 32]
        >>> molecule.split("residue")[0].names.tolist()
        ['N', 'CA', 'C', 'O']"""
        return [self._rows(rows) for rows in parts_of(self, by)]

    def to_dataframe(self) -> Any:
        """Returns a pandas.DataFrame with a row for each atom.

        >>> import pandas
        >>> molecule.to_dataframe().loc[1, ["name", "chain"]].tolist()
        ['CA', 'A']"""
        return dataframe_of(self)

    def write(self, path: Path, *, format: Optional[Literal["cif", "pdb"]] = None, replace: bool = False) -> None:
        """Writes the molecule as mmCIF, with all digits of the positions, or as PDB.

        format: "cif" or "pdb"; None for that of the path's extension. replace: whether an existing file is replaced.
        Raises OutputError if the file cannot be written, or exists and is not replaced; UsageError for other formats;
        and ImportError for PDB if the package gemmi is not installed.

        >>> molecule.select("chain A").write("chain.cif")
        >>> len(meniscus.read("chain.cif"))
        32"""
        written(self._text(np.asarray(self._column(header.STRUCTURE_CLASSES))), path, format, replace)

    def colors(self, scheme: str = "auto") -> Singles:
        """Returns the colours of the atoms by one of the program's schemes: sRGB in [0, 1], (n, 3), as render() and
        save() take them.

        scheme: "chain", "bfactor" or another word of `meniscus colors` that colours atoms by data of the file, a name
        such as "red", or "#rrggbb". Raises UsageError for other schemes, and InputError if no atom has the number that
        the scheme needs.

        >>> molecule.colors("red")[0].tolist()
        [1.0, 0.0, 0.0]
        >>> meniscus.surface(molecule).mesh(0.1).save("helix.ply", colors=molecule.colors("residue"))"""
        if not isinstance(scheme, str):
            raise wrong_type(f"scheme is of the type {type(scheme).__name__}, not a text")
        if self._source is not None:  # atoms keep the colours that they have in the whole molecule
            colors: Singles = self._source[0].colors(scheme)[self._source[1]]
            return colors
        colors = np.empty((len(self), 3), np.float32)
        lib.call("structure_colors", self._library_object().pointer, scheme.encode(), colors.ctypes.data)
        return colors


def _unpacked(report: Report, count: int, columns: dict[int, AnyArray]) -> Structure:
    for column in columns.values():
        column.flags.writeable = False
    return Structure._of(report, count, columns)


def _numbers_of(elements: Any, count: int) -> AnyArray:
    """Returns the atomic numbers of `count` atoms; 0 for unknown elements."""
    values = np.asarray(elements)
    if values.shape != (count,):
        raise InputError(f"elements has the shape {values.shape}; the number of atoms is {count}")
    numbers = atomic_numbers(values)
    wrong = np.flatnonzero((numbers < 0) | (numbers >= len(SYMBOLS)))
    if len(wrong):
        raise InputError(f"the element of atom {wrong[0]} is {numbers[wrong[0]]}, not an atomic number")
    return numbers


def _checked(name: str, column: int, values: Any, count: int) -> AnyArray:
    """Returns a column of Structure() as a new array. values: None for the default."""
    if column in NUMBERS:
        dtype = np.dtype(NUMBERS[column][0])
        if values is None:
            return np.full(count, np.nan if dtype.kind == "f" else 1 if name == "models" else 0, dtype)
        array = real_array(values, name, 1 if name == "radii" else None)
        array = np.broadcast_to(array, (count,)) if array.ndim == 0 else array
        if dtype.kind != "f" and array.dtype.kind == "f":
            raise wrong_type(f"{name} has fractions; give whole numbers")
    else:
        dtype = np.dtype(np.str_)
        array = np.asarray("" if values is None else values)
        array = np.broadcast_to(array, (count,)) if array.ndim == 0 else array
        if array.dtype.kind not in "UO" or (array.dtype.kind == "O" and not all(isinstance(v, str) for v in array)):
            raise wrong_type(f"{name} has {array.dtype.type.__name__}, not texts")
    if array.shape != (count,):
        raise InputError(f"{name} has the shape {array.shape}; the number of atoms is {count}")
    return np.array(array, dtype if dtype.kind != "U" else np.str_)
