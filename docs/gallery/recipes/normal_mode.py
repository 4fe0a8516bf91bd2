#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""normal_mode.py FILE.pdb SELECTION MODE OUT.pdb: half a swing along a normal mode, as six models of a PDB file.

MODE counts from 1, the slowest. An anisotropic network of CA atoms (15 Å), by ProDy (Debian's python3-prody); every residue moves
as its CA does. The extremes lie 4 Å RMSD from the structure, which is none of the models: they go from one side to the other."""

import sys

import numpy as np
import prody

REACH = 4.0
MODELS = 6


def main():
    source, selection, number, target = sys.argv[1:]
    prody.confProDy(verbosity="none")
    atoms = prody.parsePDB(source).select(selection).copy()
    network = prody.ANM()
    network.buildHessian(atoms.ca, cutoff=15)
    network.calcModes(int(number))
    mode, _ = prody.extendModel(network, atoms.ca, atoms)
    motion = mode[int(number) - 1].getArray().reshape(-1, 3)
    motion *= REACH / np.sqrt((motion**2).sum(axis=1).mean())
    rest = atoms.getCoords()
    atoms.setCoords(np.array([rest + motion * np.cos(np.pi * k / (MODELS - 1)) for k in range(MODELS)]))
    prody.writePDB(target, atoms)


if __name__ == "__main__":
    main()
