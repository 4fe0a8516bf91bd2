# SPDX-License-Identifier: BSD-3-Clause
"""Reads the test data of other programs, and compares every atom with the program that the format belongs to.

    compare_suites.py BUILD FOLDER...

BUILD is the folder of a build with tests; a FOLDER holds unpacked test suites, such as MDAnalysisTests, the source package of Biopython,
or chemfiles' tests-data. PDB and mmCIF are compared with gemmi, SDF with RDKit, MOL2 with Open Babel and MDAnalysis, PQR with the rules of
APBS, PSF and prmtop with ParmEd, trajectories with MDAnalysis and chemfiles, and radii with FreeSASA's table ProtOr. What differs is
printed, file by file; the table at the end counts. Needs gemmi and chemfiles of PyPI beside Debian's packages; their rows are left out, and
named, where they are missing."""

import collections
import csv
import gzip
import pathlib
import re
import subprocess
import sys
import tempfile
import warnings

import numpy as np

import compare_readers as molecules

warnings.filterwarnings("ignore")
try:
    import gemmi
except ImportError:
    gemmi = None
try:
    import chemfiles
    chemfiles.set_warnings_callback(lambda message: None)
except ImportError:
    chemfiles = None
import MDAnalysis
import parmed

FAULTS = (Exception,) + ((chemfiles.ChemfilesError,) if chemfiles else ())  # chemfiles' own errors are not exceptions to Python
SECONDS = 120  # the longest time for one file
STRUCTURES = (".pdb", ".ent", ".cif", ".mmcif")
TRAJECTORIES = (".xtc", ".trr", ".dcd", ".nc", ".ncdf", ".ncrst", ".lammpstrj", ".rst7", ".inpcrd", ".restrt", ".crd", ".coor", ".mdcrd", ".trj")
TOPOLOGIES = (".psf", ".prmtop", ".parm7", ".top")
# Names of formats in chemfiles, for endings that it does not know.
OF_CHEMFILES = {".xtc": "XTC", ".trr": "TRR", ".dcd": "DCD", ".nc": "Amber NetCDF", ".ncdf": "Amber NetCDF", ".ncrst": "Amber Restart",
                ".lammpstrj": "LAMMPS"}
# Names of formats in MDAnalysis whose ending is used by several.
OF_MDANALYSIS = {".crd": ("CRD", "INPCRD", "TRJ"), ".rst7": ("RESTRT",), ".restrt": ("RESTRT",), ".inpcrd": ("INPCRD",), ".coor": ("COOR",),
                 ".mdcrd": ("MDCRD",), ".trj": ("TRJ", "TRR"), ".lammpstrj": ("LAMMPSDUMP",)}


class Refused(Exception):
    """A reader refuses the file."""


def run(*command):
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, errors="replace", timeout=SECONDS)
    except subprocess.TimeoutExpired:
        raise Refused(f"not read in {SECONDS} s")
    if done.returncode < 0:
        raise SystemExit(f"{' '.join(map(str, command))}: ended by signal {-done.returncode}")
    if done.returncode:
        raise Refused(done.stderr.strip())
    return done.stdout


def ending_of(path):
    return path.with_suffix("").suffix.lower() if path.suffix == ".gz" else path.suffix.lower()


# --- PDB and mmCIF: every atom of every model, with gemmi ---------------------------------------------------------------------------------

def our_atoms(path):
    """Returns {(model, chain, residue number, insertion code, residue, atom, position): element} of all atoms."""
    rows = [line.split("\t") for line in run(BUILD / "tests/trajectory/atom_dump", path, 0).splitlines()]
    atoms, places = [row for row in rows if row[0] == "atom"], [row for row in rows if row[0] == "place"]
    return [((int(place[4]), atom[5], int(atom[3]), atom[6].strip("\0 ?."), atom[2], atom[1], *(round(float(x), 3) for x in place[1:4])), int(atom[7]))
            for atom, place in zip(atoms, places)]


def gemmi_atoms(path):
    structure = gemmi.read_structure(str(path), merge_chain_parts=False)
    return [((number, chain.name, residue.seqid.num, residue.seqid.icode.strip(), residue.name, atom.name, *(round(x, 3) for x in atom.pos.tolist())),
             atom.element.atomic_number)
            for number, model in enumerate(structure, 1) for chain in model for residue in chain for atom in residue]


def compare_structure(path):
    mine = our_atoms(path)
    try:
        theirs = gemmi_atoms(path)
    except Exception as error:
        raise Refused(f"gemmi: {str(error)[:80]}")
    if not theirs:
        raise Refused("gemmi: no atoms")
    said = []
    only = [collections.Counter(key for key, _ in mine), collections.Counter(key for key, _ in theirs)]
    for name, rest in (("Meniscus", only[0] - only[1]), ("gemmi", only[1] - only[0])):
        if rest:
            said.append(f"{sum(rest.values())} of {len(mine)} atoms only by {name}, such as {next(iter(rest))}")
    elements = collections.defaultdict(collections.Counter)
    for key, element in theirs:
        elements[key][element] += 1
    others = [(key, element) for key, element in mine if key in elements and element not in elements[key]]
    if others:
        said.append(f"{len(others)} elements, such as {others[0][1]} for gemmi's {list(elements[others[0][0]])} of {others[0][0][4:6]}")
    return len(mine), said


# --- PQR: the last five numbers of a row, as APBS reads them ---------------------------------------------------------------------------------

def compare_pqr(path):
    rows = [line.split("\t") for line in run(BUILD / "tests/trajectory/atom_dump", path, 0).splitlines()]
    mine = np.array([[*map(float, place[1:4]), float(atom[8]), float(atom[9])] for atom, place in
                     zip([row for row in rows if row[0] == "atom"], [row for row in rows if row[0] == "place"])])
    text = path.read_text(errors="replace")
    theirs = np.array([[float(word) for word in line.split()[-5:]] for line in text.splitlines() if re.match("(ATOM|HETATM)", line)])
    if mine.shape != theirs.shape:
        return len(mine), [f"{len(mine)} atoms, not {len(theirs)}"]
    away = np.abs(mine - theirs).max(initial=0)
    return len(mine), [f"numbers differ by {away:.6f}"] if away > 1e-6 else []


# --- topologies: elements by mass, and bonds, with ParmEd --------------------------------------------------------------------------------------

def compare_topology(path):
    rows = [line.split("\t") for line in run(BUILD / "tests/trajectory/atom_dump", path, 0).splitlines()]
    elements = np.array([int(row[7]) for row in rows if row[0] == "atom"])
    bonds = {tuple(sorted(map(int, row[1:]))) for row in rows if row[0] == "bond"}
    try:
        read = parmed.charmm.CharmmPsfFile if path.suffix == ".psf" else parmed.amber.LoadParm
        with molecules.silence():
            topology = read(str(path))
    except Exception as error:
        raise Refused(f"ParmEd: {str(error)[:80]}")
    if len(topology.atoms) != len(elements):
        return len(elements), [f"{len(elements)} atoms, not {len(topology.atoms)}"]
    said = []
    # ParmEd takes the nearest element for any mass; what has hardly a mass is no atom
    theirs = np.array([atom.atomic_number if atom.mass >= 0.9 else 0 for atom in topology.atoms])
    at = np.flatnonzero((elements != theirs) & (elements > 0) & (theirs > 0))
    if len(at):
        atom = topology.atoms[at[0]]
        said.append(f"{len(at)} elements, such as {elements[at[0]]}, not {theirs[at[0]]}, of {atom.name} of type {atom.type}, mass {atom.mass}")
    others = {tuple(sorted((bond.atom1.idx, bond.atom2.idx))) for bond in topology.bonds}
    if bonds and bonds != others:
        said.append(f"bonds {sorted(bonds ^ others)[:3]} are in one only")
    return len(elements), said


# --- trajectories: the first, the middle and the last frame ------------------------------------------------------------------------------------

def our_frames(path, atoms):
    dump = BUILD / "tests/trajectory/frame_dump"
    count = ["--atoms", atoms] if atoms else []
    head = run(dump, path, *count, 0).splitlines()[0].split()
    frames = int(head[head.index("frames") + 1])
    chosen = sorted({0, frames // 2, frames - 1})
    found, positions = [], None
    for line in run(dump, path, *count, *chosen).splitlines():
        if line.startswith("frame "):
            positions = []
            found.append(positions)
        elif positions is not None and re.match(r"-?[0-9]", line):
            positions.append([float(word) for word in line.split()])
    return frames, chosen, [np.array(frame) for frame in found]


def frames_of_mdanalysis(path, ending, atoms):
    for name in OF_MDANALYSIS.get(ending, (None,)):
        try:
            with molecules.silence():
                universe = MDAnalysis.Universe.empty(atoms, trajectory=False)
                universe.load_new(str(path), format=name)
                if len(universe.trajectory.ts.positions) == atoms:
                    return len(universe.trajectory), lambda number: universe.trajectory[number].positions.astype(float)
        except (SystemExit, KeyboardInterrupt):
            raise
        except BaseException:
            continue
    return None


def frames_of_chemfiles(path, ending):
    if not chemfiles or ending not in OF_CHEMFILES:
        return None
    try:
        trajectory = chemfiles.Trajectory(str(path), "r", OF_CHEMFILES[ending])

        def positions(number):
            frame = trajectory.read_step(number)  # Its positions vanish with it.
            return np.array(frame.positions)

        return trajectory.nsteps, positions
    except FAULTS:
        return None


def compare_trajectory(path):
    ending = ending_of(path)
    atoms = None
    if ending in (".mdcrd", ".trj", ".crd"):
        # Amber's old format has no number of atoms, so a topology in its folder gives it.
        for topology in sorted(path.parent.glob("*")):
            if ending_of(topology) in (".prmtop", ".parm7", ".top"):
                try:
                    atoms = str(len(parmed.amber.AmberParm(str(topology)).atoms))
                    break
                except Exception:
                    continue
    frames, chosen, mine = our_frames(path, atoms)
    if not mine:
        raise Refused("no frames")
    other, name = frames_of_chemfiles(path, ending), "chemfiles"
    if not other:
        other, name = frames_of_mdanalysis(path, ending, len(mine[0])), "MDAnalysis"
    if not other:
        raise Refused("neither chemfiles nor MDAnalysis reads it")
    count, frame = other
    said = []
    if count != frames:
        said.append(f"{frames} frames, not {count} as {name}")
    for number, positions in zip(chosen, mine):
        if number >= count:
            continue
        try:
            theirs = frame(number)
        except FAULTS as error:
            raise Refused(f"{name}: {str(error)[:80]}")
        if theirs.shape != positions.shape:
            said.append(f"frame {number}: {len(positions)} atoms, not {len(theirs)} as {name}")
        else:
            away = np.abs(positions - theirs)
            if (away > 1e-3 + 1e-6 * np.abs(theirs)).any():
                said.append(f"frame {number}: positions differ by {away.max():.4f} from {name}'s")
    return frames, said


# --- radii: ProtOr, with FreeSASA ----------------------------------------------------------------------------------------------------------------

def compare_radii(path):
    """Compares radii with a PDB file of FreeSASA, whose occupancies are the radii that it used."""
    theirs = {}
    for line in run("freesasa", "--radii=protor", "-S", "-n", 10, "--format=pdb", path).splitlines():
        if line.startswith("ATOM"):
            theirs[line[21].strip(), line[22:27].strip(), line[12:16].strip()] = float(line[54:60])
    table = run(BUILD / "meniscus", "surface", path, "--radii", "protor", "--surface", "sas", "--csv", "-", "--device", "cpu")
    count, others = 0, []
    for row in csv.DictReader(table.splitlines()):
        key = row["chain"], row["number"] + row["icode"], row["name"]
        if row["class"] == "polymer" and theirs.get(key):  # FreeSASA gives 0 to unknown atoms.
            count += 1
            if abs(float(row["radius"]) - theirs[key]) > 0.005:
                others.append((row["residue"], row["name"], float(row["radius"]), theirs[key]))
    return count, [f"{len(others)} radii, such as {others[0]}"] if others else []


def compare_molecules(path):
    """Makes the rows of compare_readers.py, reader by reader; molecules that one of them accepts must agree."""
    rows, remarks = collections.defaultdict(collections.Counter), []
    with tempfile.TemporaryDirectory() as folder:
        molecules.FOLDER = folder
        molecules.compare(path, ending_of(path), rows, remarks)
    atoms = max((row["atoms"] for row in rows.values()), default=0)
    if any(row["both"] for row in rows.values()) or all(row["theirs"] for row in rows.values()):
        raise Refused("; ".join(remarks))
    # A reader that agrees is enough: the other one may not know the types of a force field.
    agrees = any(row["files"] and not (row["differ"] or row["mine"] or row["theirs"]) for row in rows.values())
    return atoms, [] if agrees else remarks


# --- the table -------------------------------------------------------------------------------------------------------------------------------------

def kinds_of(path):
    """Returns the comparisons that a file takes part in."""
    ending = ending_of(path)
    if ending in STRUCTURES and gemmi:
        yield "PDB, mmCIF / gemmi", compare_structure
        if path.suffix in (".pdb", ".ent") and RADII:
            yield "ProtOr radii / FreeSASA", compare_radii
    if ending in (".sdf", ".mol"):
        yield "SDF / RDKit", compare_molecules
    if ending == ".mol2":
        yield "MOL2 / Open Babel, MDAnalysis", compare_molecules
    if ending == ".pqr":
        yield "PQR / own rule", compare_pqr
    if ending in TOPOLOGIES:
        yield "topologies / ParmEd", compare_topology
    if ending in TRAJECTORIES:
        yield "trajectories / chemfiles, MDAnalysis", compare_trajectory


def unpacked(path, folder):
    """Returns the file itself, or its unpacked content: gemmi and Meniscus read both, others do not read gzip."""
    if path.suffix != ".gz":
        return path
    target = pathlib.Path(folder) / path.name[:-3]
    with gzip.open(path) as packed:
        target.write_bytes(packed.read())
    return target


def main():
    rows, remarks = collections.defaultdict(collections.Counter), []
    for place in map(pathlib.Path, sys.argv[2:]):
        for path in sorted(path for path in place.rglob("*") if path.is_file()) if place.is_dir() else [place]:
            for kind, compare in kinds_of(path):
                row = rows[kind]
                row["files"] += 1
                with tempfile.TemporaryDirectory() as folder:
                    try:
                        count, said = compare(unpacked(path, folder))
                        row["count"] += count
                        row["differ" if said else "same"] += 1
                        remarks += [f"differs  {kind}: {path}: {what}" for what in said[:3]]
                    except Refused as refusal:
                        row["refused"] += 1
                        remarks.append(f"refused  {kind}: {path}: {str(refusal)[:300]}")
                    except (OSError, EOFError) as error:
                        row["refused"] += 1
                        remarks.append(f"refused  {kind}: {path}: {error}")
    print("\n".join(remarks))
    print("\n| what / with | files | atoms, frames or radii | same | differ | refused by one or both |\n|---|---|---|---|---|---|")
    for kind, row in sorted(rows.items()):
        print(f"| {kind} | {row['files']} | {row['count']:,} | {row['same']} | {row['differ']} | {row['refused']} |")
    print(f"\ncases {sum(row['files'] for row in rows.values())} differences {sum(row['differ'] for row in rows.values())}")


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv[1]).resolve()
    RADII = (BUILD / "meniscus").exists()
    molecules.DUMP = str(BUILD / "tests/trajectory/atom_dump")
    main()
