# SPDX-License-Identifier: BSD-3-Clause
"""Compares the cost and the error of solvent-accessible areas by several Python libraries, as a table and a plot; compare_areas.sh
runs it.

  compare_areas.py PLOT.svg FILE...    molecules that Meniscus reads, from the smallest to the largest

Every library gets the same positions and Bondi radii, as arrays, and one thread. What is measured is the call alone: CPU seconds,
medians of RUNS calls, those of all libraries in turn. The exact area of each atom is that of Meniscus in closed form; an error is the
mean over atoms of the difference beside it, over the mean area of an atom, for errors of opposite sign cancel in the whole.
Reading radii of another table moves areas as well: the last table says by how much.
"""

import math
import statistics
import sys
import time

import freesasa
import meniscus
import numpy
import rust_sasa_python
import zsasa

PROBE = 1.4  # Å
RUNS = 5
LIMIT = 0.03  # a whole area further off is not of the same atoms and radii
SETS = ("bondi", "united", "protor")
COLORS = {"Meniscus": "#000000", "RustSASA": "#b7410e", "zsasa": "#1f77b4", "FreeSASA": "#2ca02c"}


class Atoms:
    """The same positions (n, 3) and radii (n,), Å, in the forms that the libraries take."""

    def __init__(self, path):
        self.structure = meniscus.read(path)
        self.xyz = numpy.ascontiguousarray(self.structure.positions)
        self.radii = numpy.ascontiguousarray(self.structure.radii)
        self.flat, self.list = self.xyz.ravel().tolist(), self.radii.tolist()
        self.rust = [((x, y, z), radius, n) for n, ((x, y, z), radius) in enumerate(zip(self.xyz.tolist(), self.list))]


def by_freesasa(algorithm, key, count):
    parameters = freesasa.Parameters({"algorithm": algorithm, key: count, "n-threads": 1, "probe-radius": PROBE})

    def areas(atoms):
        result = freesasa.calcCoord(atoms.flat, atoms.list, parameters)
        return lambda: [result.atomArea(n) for n in range(result.nAtoms())]

    return areas


def by_zsasa(**options):
    def areas(atoms):
        result = zsasa.calculate_sasa(atoms.xyz, atoms.radii, probe_radius=PROBE, n_threads=1, **options)
        return lambda: result.atom_areas

    return areas


def by_rust(points):
    def areas(atoms):
        result = rust_sasa_python.calculate_sasa_internal(atoms.rust, PROBE, points, 1)
        return lambda: result

    return areas


def by_meniscus(atoms):
    areas = meniscus.surface(atoms.xyz, atoms.radii, PROBE, kind="sas", threads=1).atom_areas
    return lambda: areas


# Library, setting, and what answers the areas of all atoms; taking them out of its answer is not timed.
METHODS = [("Meniscus", "closed form", by_meniscus)]
METHODS += [("RustSASA", f"{count} points", by_rust(count)) for count in (100, 300, 960, 3000)]
METHODS += [("zsasa", f"{count} points", by_zsasa(n_points=count)) for count in (100, 300, 960, 3000)]
METHODS += [("zsasa", f"{count} points by bits", by_zsasa(n_points=count, use_bitmask=True)) for count in (100, 960)]
METHODS += [("zsasa", "20 slices", by_zsasa(algorithm="lr", n_slices=20))]
METHODS += [("FreeSASA", f"{count} points", by_freesasa(freesasa.ShrakeRupley, "n-points", count)) for count in (100, 960)]
METHODS += [("FreeSASA", f"{count} slices", by_freesasa(freesasa.LeeRichards, "n-slices", count)) for count in (20, 100)]


def timed(atoms):
    """Per method CPU seconds (median) and areas of atoms."""
    seconds, found = [[] for _ in METHODS], [None] * len(METHODS)
    for _ in range(RUNS if len(atoms.list) < 100000 else 3):
        for n, (_, _, areas) in enumerate(METHODS):
            begin = time.process_time()
            answer = areas(atoms)
            seconds[n].append(time.process_time() - begin)
            found[n] = numpy.asarray(answer())
    return [statistics.median(some) for some in seconds], found


def plotted(points, path):
    """Draws error over cost, of (library, setting, microseconds an atom, error). The exact one is a line: it has no error."""
    left, top, width, height = 70, 20, 640, 360
    costs = [math.log10(cost) for _, _, cost, _ in points]
    errors = [math.log10(error) for _, _, _, error in points if error > 0]
    low, high = min(costs) - 0.1, max(costs) + 0.1
    floor, ceiling = math.floor(min(errors)), max(errors) + 0.15
    x = lambda cost: left + width * (math.log10(cost) - low) / (high - low)
    y = lambda error: top + height * (ceiling - math.log10(error)) / (ceiling - floor)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + width + 110} {top + height + 50}" '
           'font-family="sans-serif" font-size="12">', '<rect width="100%" height="100%" fill="#ffffff"/>']
    for decade in range(floor, math.floor(ceiling) + 1):
        out.append(f'<path d="M{left} {y(10.0 ** decade):.1f}h{width}" stroke="#dddddd"/>'
                   f'<text x="{left - 6}" y="{y(10.0 ** decade) + 4:.1f}" text-anchor="end">{100 * 10.0 ** decade:g} %</text>')
    for cost in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000):
        if low <= math.log10(cost) <= high:
            out.append(f'<path d="M{x(cost):.1f} {top}v{height}" stroke="#eeeeee"/>'
                       f'<text x="{x(cost):.1f}" y="{top + height + 16}" text-anchor="middle">{cost}</text>')
    out.append(f'<text x="{left + width / 2}" y="{top + height + 36}" text-anchor="middle">CPU microseconds an atom, one thread</text>')
    out.append(f'<text transform="translate(14 {top + height / 2}) rotate(-90)" text-anchor="middle">mean error of an atom\'s area; numbers are points</text>')
    for n, (library, color) in enumerate(COLORS.items()):
        at = top + 14 + 18 * n
        out.append(f'<path d="M{left + width + 14} {at - 4}h10" stroke="{color}" stroke-width="8"/>'
                   f'<text x="{left + width + 30}" y="{at}">{library}</text>')
    for library, setting, cost, error in points:
        if error == 0:
            out.append(f'<path d="M{x(cost):.1f} {top}v{height}" stroke="{COLORS[library]}" stroke-width="2"/>'
                       f'<text x="{x(cost) + 5:.1f}" y="{top + height - 6}">exact</text>')
            continue
        below, anchor = "slices" in setting, "end" if library == "RustSASA" else "start"
        if below and library == "zsasa":
            anchor = "end"
        out.append(f'<circle cx="{x(cost):.1f}" cy="{y(error):.1f}" r="4" fill="{COLORS[library]}"/>'
                   f'<text x="{x(cost):.1f}" y="{y(error) + (17 if below else -9):.1f}" font-size="11" text-anchor="{anchor}">'
                   f'{setting.replace(" points", "").replace("by ", "")}</text>')
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([*out, "</svg>", ""]))


def main(plot, *paths):
    failures, columns, shown = 0, [], []
    for path in paths:
        atoms = Atoms(path)
        seconds, found = timed(atoms)
        exact = found[0]
        errors = [float(numpy.abs(areas - exact).mean() / exact.mean()) for areas in found]
        wholes = [float(areas.sum() / exact.sum() - 1) for areas in found]
        failures += sum(not abs(error) < LIMIT for error in wholes)
        columns.append((path.rsplit("/", 1)[-1], len(exact), [1e6 * some / len(exact) for some in seconds], errors, wholes))
        print(f"{path}: {len(exact):,} atoms", file=sys.stderr)
        if not shown or len(exact) < 100000:
            shown = [(library, setting, cost, error) for (library, setting, _), cost, error in zip(METHODS, *columns[-1][2:4])]
    print("| library | setting | " + " | ".join(f"{name}, {count:,} atoms" for name, count, *_ in columns)
          + " | error of an atom | of the whole |")
    print("|---|---|" + "---|" * (len(columns) + 2))
    for n, (library, setting, _) in enumerate(METHODS):
        costs = " | ".join(f"{costs[n]:.1f}" for _, _, costs, _, _ in columns)
        worst = max(errors[n] for *_, errors, _ in columns)
        whole = max((wholes[n] for *_, wholes in columns), key=abs)
        errors = f"{100 * worst:.2g} % | {100 * whole:+.3f} %" if n else "exact | exact"
        print(f"| {library} | {setting} | {costs} | {errors} |")
    print("\n| file | " + " | ".join(SETS) + " |\n|---|" + "---|" * len(SETS))
    for path in paths:
        areas = [meniscus.surface(meniscus.read(path, radii=radii), kind="sas").area for radii in SETS]
        told = [f"{areas[0]:,.1f} Å²"] + [f"{100 * (area / areas[0] - 1):+.2f} %" for area in areas[1:]]
        print(f"| {path.rsplit('/', 1)[-1]} | " + " | ".join(told) + " |")
    plotted(shown, plot)
    print(f"\ncases {len(METHODS) * len(columns)} failures {failures}")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
