# SPDX-License-Identifier: BSD-3-Clause
"""Molecules from files, and van der Waals radii by element."""
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

#: The dtype of the rows of each column, and its number of columns. All other columns are texts.
_NUMBERS: dict[int, Any] = {
    header.STRUCTURE_POSITIONS: (np.float64, 3), header.STRUCTURE_RADII: (np.float64,), header.STRUCTURE_ELEMENTS: (np.uint8,),
    header.STRUCTURE_INDICES: (np.uint32,), header.STRUCTURE_RESIDUE_NUMBERS: (np.int32,),
    header.STRUCTURE_RESIDUES: (np.uint32,), header.STRUCTURE_MODELS: (np.int32,), header.STRUCTURE_COPIES: (np.uint32,),
    header.STRUCTURE_CHARGES: (np.float32,), header.STRUCTURE_B_FACTORS: (np.float32,),
    header.STRUCTURE_OCCUPANCIES: (np.float32,), header.STRUCTURE_CLASSES: (np.uint8,),
    header.STRUCTURE_HYDROPATHIES: (np.float64,)}
_HYDROGENS = {"auto": header.HYDROGENS_AUTO, "keep": header.HYDROGENS_KEEP, "drop": header.HYDROGENS_DROP}
_UNKNOWN_ELEMENTS = {"halt": header.UNKNOWN_HALT, "guess": header.UNKNOWN_GUESS, "skip": header.UNKNOWN_SKIP}


class _Report(NamedTuple):
    """The fields of meniscus_read_report that Structure has."""
    file: str
    format: str
    radii_set: str
    sentence: str
    atoms: int
    models: int


class Structure:
    """The atoms of a file from which a surface is computed, which read() returns. It never changes, and all threads may
    use it at once. Arrays have one row per atom, (n,) unless their description has another shape; arrays of numbers are
    read-only views.

    >>> molecule = meniscus.read("helix.pdb")
    >>> molecule
    <meniscus.Structure: helix.pdb, PDB: 65 atoms read; 1 of water left out; 64 used>"""

    __slots__ = ("_columns", "_handle", "_report", "__weakref__")

    def __init__(self, handle: Optional[lib.Handle], report: _Report, columns: dict[int, AnyArray]) -> None:
        """columns: the columns that are known already, which are all of them if handle is None."""
        self._handle, self._report, self._columns = handle, report, columns

    def _column(self, column: int) -> AnyArray:
        if column not in self._columns:
            assert self._handle is not None
            row = _NUMBERS.get(column)
            self._columns[column] = (view(self._handle, "structure_table", column, *row) if row else
                                     texts(self._handle, "structure_table", column))
        return self._columns[column]

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles have all columns. Unpickling does not read the file again."""
        columns = range(header.STRUCTURE_POSITIONS, header.STRUCTURE_HYDROPATHIES + 1)
        return _unpacked, (self._report, {column: self._column(column) for column in columns})

    def __copy__(self) -> Structure:
        """Returns this object, because it never changes."""
        return self

    def __deepcopy__(self, memo: Any) -> Structure:
        return self

    # ---- the file

    @property
    def file(self) -> str:
        """The path that was passed to read().

        >>> molecule.file
        'helix.pdb'"""
        return self._report.file

    @property
    def format(self) -> str:
        """The format of the file, such as "PDB" or "mmCIF".

        >>> molecule.format
        'PDB'"""
        return self._report.format

    @property
    def radii_set(self) -> str:
        """The set of radii: "bondi", "united", "protor" or "file", with files and overrides.

        >>> molecule.radii_set
        'bondi'"""
        return self._report.radii_set

    @property
    def report(self) -> str:
        """A sentence about the atoms that were read, left out and used.

        >>> molecule.report
        '65 atoms read; 1 of water left out; 64 used'"""
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
        return self._report.atoms

    def __repr__(self) -> str:
        return f"<meniscus.Structure: {self.file}, {self.format}: {self.report}>"

    # ---- atoms

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
    def elements(self) -> Bytes:
        """The atomic numbers; 0 for unknown elements.

        >>> molecule.elements[:4].tolist()
        [7, 6, 6, 8]"""
        return self._column(header.STRUCTURE_ELEMENTS)

    @property
    def indices(self) -> Indices:
        """The indices of the atoms among all atoms of the file, from 0, as in tables and meshes of the program.

        >>> molecule.indices[-3:].tolist()
        [61, 62, 63]"""
        return self._column(header.STRUCTURE_INDICES)

    @property
    def names(self) -> Texts:
        """The names of the atoms, such as "CA".

        >>> molecule.names[:4].tolist()
        ['N', 'CA', 'C', 'O']"""
        return self._column(header.STRUCTURE_NAMES)

    @property
    def residue_names(self) -> Texts:
        """The names of the residues, such as "ALA".

        >>> molecule.residue_names[::8].tolist()[:2]
        ['ALA', 'ALA']"""
        return self._column(header.STRUCTURE_RESIDUE_NAMES)

    @property
    def chains(self) -> Texts:
        """The chains, such as "A"; "A-2" in the second copy of an assembly.

        >>> molecule.chains[[0, -1]].tolist()
        ['A', 'B']"""
        return self._column(header.STRUCTURE_CHAINS)

    @property
    def segments(self) -> Texts:
        """The segment identifiers of molecular dynamics programs.

        >>> set(molecule.segments.tolist())
        {''}"""
        return self._column(header.STRUCTURE_SEGMENTS)

    @property
    def residue_numbers(self) -> Numbers:
        """The residue numbers of the file.

        >>> molecule.residue_numbers[::8].tolist()
        [1, 3, 5, 7, 9, 11, 13, 15]"""
        return self._column(header.STRUCTURE_RESIDUE_NUMBERS)

    @property
    def insertion_codes(self) -> Texts:
        """The letters after residue numbers; "" where there is none.

        >>> set(molecule.insertion_codes.tolist())
        {''}"""
        return np.char.strip(self._column(header.STRUCTURE_INSERTION_CODES))

    @property
    def altlocs(self) -> Texts:
        """The letters of alternate locations; "" where there is none.

        >>> set(molecule.altlocs.tolist())
        {''}"""
        return np.char.strip(self._column(header.STRUCTURE_ALTLOCS))

    @property
    def residues(self) -> Indices:
        """The indices of the residues in the file, from 0.

        >>> molecule.residues[::8].tolist()
        [0, 2, 4, 6, 8, 10, 12, 14]"""
        return self._column(header.STRUCTURE_RESIDUES)

    @property
    def models(self) -> Numbers:
        """The numbers of the models, from 1.

        >>> set(molecule.models.tolist())
        {1}"""
        return self._column(header.STRUCTURE_MODELS)

    @property
    def copies(self) -> Indices:
        """The indices of the copies in an assembly, from 0.

        >>> set(molecule.copies.tolist())
        {0}"""
        return self._column(header.STRUCTURE_COPIES)

    @property
    def charges(self) -> Singles:
        """The partial charges in e; NaN where the file has none.

        >>> bool(np.isnan(molecule.charges).all())
        True"""
        return self._column(header.STRUCTURE_CHARGES)

    @property
    def b_factors(self) -> Singles:
        """The B-factors in Å²; NaN where the file has none.

        >>> molecule.b_factors[:3].tolist()
        [0.0, 1.0, 2.0]"""
        return self._column(header.STRUCTURE_B_FACTORS)

    @property
    def occupancies(self) -> Singles:
        """The occupancies, 0 to 1; NaN where the file has none.

        >>> molecule.occupancies[:3].tolist()
        [1.0, 1.0, 1.0]"""
        return self._column(header.STRUCTURE_OCCUPANCIES)

    @property
    def classes(self) -> Texts:
        """The classes of the atoms: "polymer", "ligand", "water" or "ion"; "unclassified" if the format has none.

        >>> set(molecule.classes.tolist())
        {'polymer'}"""
        words = np.array(["polymer", "ligand", "water", "ion", "unclassified"])
        return words[self._column(header.STRUCTURE_CLASSES)]

    @property
    def hydropathies(self) -> Floats:
        """The hydropathies of the residues (Kyte & Doolittle 1982); NaN for residues that are not amino acids.

        >>> molecule.hydropathies[:3].tolist()
        [1.8, 1.8, 1.8]"""
        return self._column(header.STRUCTURE_HYDROPATHIES)

    def colors(self, scheme: str = "auto") -> Singles:
        """Returns the colours of the atoms by one of the program's schemes: sRGB in [0, 1], (n, 3), as render() and
        save() take them.

        scheme: "chain", "bfactor" or another word of `meniscus colors` that colours atoms by data of the file, a name
        such as "red", or "#rrggbb". Raises UsageError for other schemes, and InputError if no atom has the number that
        the scheme needs, or if the structure was unpickled.

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
    """Returns the overrides of radii as texts "EXPR=R"."""
    if radius is None:
        return []
    if isinstance(radius, str):
        return [radius]
    if isinstance(radius, Mapping):
        return [f"{selection}={number('radius', value)!r}" for selection, value in radius.items()]
    return listed("radius", radius, "texts such as 'element Zn=1.1'")


def _c_array(texts: Sequence[bytes]) -> Any:
    return (ctypes.c_char_p * len(texts))(*texts)


def read(path: Path, *, select: Optional[str] = None, assembly: Union[str, int, None] = None,
         model: Union[int, Literal["all"]] = 1, altloc: str = "best", hydrogens: Hydrogens = "auto",
         radii: Optional[RadiiSet] = None, radii_files: Union[Path, Sequence[Path]] = (),
         radius: Union[Mapping[str, float], Iterable[str], None] = None, keep_water: bool = False,
         keep_ions: bool = False, unknown_element: UnknownElement = "halt") -> Structure:
    """Reads a molecule from a PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ or XYZR file, which may be
    compressed with gzip. By default it uses the polymers of the first model with the sugars that are bound to them, or
    all of a file without a polymer, with the most occupied conformer of each residue, but neither water nor free ions.
    Unusual things in the file are UserWarnings.

    select: a selection such as "chain A and resid 10-50", or "all" to use ligands, too. assembly: the biological assembly to build. model: the number
    of the model, from 1, or "all" for all models as one molecule. altloc: the alternate location of each residue:
    "best", "first", "all" or a letter. hydrogens: "keep", "drop", or "auto", which keeps them unless the radii of heavy
    atoms include them. radii: the set of radii, "bondi", "united", "protor" or "file"; None for those of the file if it
    has any, else "bondi". radii_files: paths of tables by residue and atom, which override the set. radius: radii in Å
    by selection, such as {"element Zn": 1.1}. keep_water, keep_ions: whether water and free ions are used, too.
    unknown_element: what happens to atoms of unknown element: "halt" raises InputError, "guess" gives them a radius of
    2.0 Å, "skip" ignores them.

    Raises InputError if the file cannot be read, and UsageError for an invalid option or selection.

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
    tables = _c_array([file_name("radii_files", file) for file in files])
    overrides = _c_array([text("radius", override) or b"" for override in _overrides(radius)])
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
