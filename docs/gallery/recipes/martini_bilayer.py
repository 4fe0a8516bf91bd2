#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds a patch of a bilayer of DPPC in beads of Martini, for pictures: it is not equilibrated.

  martini_bilayer.py LIPIDS FILE.gro

LIPIDS stand along each side of a square, in both leaflets, 8 A apart (an area of 64 A^2 a lipid). Each is turned about its axis and
tilted at random, always the same way for the same number, and rises and sinks with a wave. 12 beads a lipid, 4.7 A apart; the box is
the square."""

import math
import random
import sys

APART, BOND = 8.0, 4.7  # A
WAVE = 4.0              # A, up and down
TILT = 12.0             # degrees, at most
#: Bead, place across (A), place along the lipid (bonds above the last beads of the tails).
BEADS = [("NC3", 0.0, 6), ("PO4", 0.0, 5), ("GL1", -1.5, 4), ("GL2", 2.3, 4),
         *((f"C{n}A", -2.3, 4 - n) for n in range(1, 5)), *((f"C{n}B", 2.3, 4 - n - 0.4) for n in range(1, 5))]


def lipid(draw, x, y, side, up):
    """Places of its beads, A; side: 1 for the upper leaflet, -1 for the lower."""
    turn, lean, towards = draw.uniform(0, math.tau), math.radians(draw.uniform(0, TILT)), draw.uniform(0, math.tau)
    for name, across, along in BEADS:
        height = 2.5 + 0.8 * BOND * along
        shift = height * math.tan(lean) + draw.uniform(-0.5, 0.5)
        yield (name, x + across * math.cos(turn) + shift * math.cos(towards), y + across * math.sin(turn) + shift * math.sin(towards),
               side * height + up)


def main():
    count, path = int(sys.argv[1]), sys.argv[2]
    draw, width = random.Random(count), count * APART
    atoms, number = [], 0
    for side in 1, -1:
        for row in range(count):
            for column in range(count):
                x, y = (APART * (n + 0.5) + draw.uniform(-0.8, 0.8) for n in (column, row))
                number += 1
                atoms += [(number, *bead) for bead in lipid(draw, x, y, side, WAVE * math.sin(math.tau * (x + 0.4 * y) / width))]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"a bilayer of DPPC in Martini beads, not equilibrated\n{len(atoms)}\n")
        for n, (residue, name, x, y, z) in enumerate(atoms, 1):
            file.write(f"{residue % 100000:5}{'DPPC':5}{name:>5}{n % 100000:5}{x / 10:8.3f}{y / 10:8.3f}{z / 10 + 5:8.3f}\n")
        file.write(f"{width / 10:10.5f}{width / 10:10.5f}{10:10.5f}\n")


if __name__ == "__main__":
    main()
