#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares two tables of result_table.cpp: decisions and triangles have to be equal, numbers almost.

compare_tables.py A B [--within RELATIVE]"""

import argparse
import struct
import sys

HEADINGS = ("decisions", "triangles", "area", "volume", "numbers", "points", "refused")


def rows(path):
    """Returns {name: {heading: words}} of a table."""
    table = {}
    with open(path, encoding="ascii") as file:
        for line in file:
            name, *words = line.split()
            row = {}
            for word in words:
                if word in HEADINGS:
                    row[word] = []
                    last = row[word]
                else:
                    last.append(word)
            table[name] = row
    return table


def number(words):
    return struct.unpack(">d", bytes.fromhex(words[0]))[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tables", nargs=2)
    parser.add_argument("--within", type=float, default=1e-12, help="relative difference that areas may have [1e-12]")
    arguments = parser.parse_args()
    a, b = (rows(path) for path in arguments.tables)
    if not a or a.keys() != b.keys():
        sys.exit("the tables are not of the same molecules")
    unequal = {heading: [name for name in a if a[name][heading] != b[name][heading]] for heading in HEADINGS}
    apart = max(abs(number(a[name][heading]) - number(b[name][heading])) / max(abs(number(a[name][heading])), 1.0)
                for name in a for heading in ("area", "volume"))
    print(f"{len(a)} rows; rows that differ: " + ", ".join(f"{h} {len(unequal[h])}" for h in HEADINGS) +
          f"; areas and volumes by {apart:.1e} at most")
    for heading in ("decisions", "triangles", "refused"):
        for name in unequal[heading][:5]:
            print(f"{heading} of {name} differ", file=sys.stderr)
    decided = unequal["decisions"] or unequal["triangles"] or unequal["refused"]
    sys.exit(1 if decided or not apart <= arguments.within else 0)


if __name__ == "__main__":
    main()
