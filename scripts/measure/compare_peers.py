# SPDX-License-Identifier: BSD-3-Clause
"""Compares areas, areas of a trajectory and pictures of one molecule by several programs, as tables; compare_peers.sh
runs it.

Every program gets the same heavy atoms with the same radii (Bondi 1964, by element), so that areas differ by method alone. The
exact solvent-accessible area is that of Meniscus in closed form; an error is a program's whole area beside it. Times are
medians of whole processes, reading the file included; those of Python libraries are of the call alone, which favours them.
"""

import json
import os
import re
import statistics
import sys
import tempfile
import time

import mdtraj
import numpy
from mdtraj.geometry import sasa

from measured import measured

RADII = {"C": 1.70, "N": 1.55, "O": 1.52, "S": 1.80, "P": 1.80}  # Å
PROBE = 1.4
LIMIT = 0.03  # an area further off is not of the same atoms and radii
RUNS = 5
FRAMES = 50  # of the trajectory


class Molecule:
    """The heavy atoms of a PDB file's first model, in the forms that the programs read."""

    def __init__(self, path, folder):
        self.name = os.path.basename(path)
        self.pdb, self.xyzr = os.path.join(folder, "atoms.pdb"), os.path.join(folder, "atoms.xyzr")
        lines = []
        with open(path, encoding="ascii", errors="replace") as file:
            for line in file:
                if line.startswith("ENDMDL"):
                    break
                if line.startswith(("ATOM", "HETATM")) and line[76:78].strip() in RADII and line[16] in " A" and line[17:20] != "HOH":
                    lines.append(line.rstrip("\n").ljust(80))
        if not lines:
            sys.exit(f"compare_peers: error: {path}: no heavy atoms of the elements {', '.join(RADII)}")
        self.count = len(lines)
        with open(self.pdb, "w", encoding="ascii") as pdb, open(self.xyzr, "w", encoding="ascii") as xyzr:
            for line in lines:
                radius = RADII[line[76:78].strip()]
                pdb.write(f"ATOM  {line[6:16]} {line[17:54]}{radius:6.2f}{line[60:]}\n")  # the radius as occupancy
                xyzr.write(f"{line[30:38]} {line[38:46]} {line[46:54]} {radius}\n")
            pdb.write("END\n")
        # Names of atoms begin with their element; GROMACS reads this table from the folder it works in, in nm.
        with open(os.path.join(folder, "vdwradii.dat"), "w", encoding="ascii") as table:
            table.writelines(f"???  {element}  {radius / 10}\n" for element, radius in RADII.items())


def medians(command, folder, **environment):
    """Median of the wall clock and of CPU seconds, largest memory (MB), and the last output of a process."""
    costs = [measured(command, cwd=folder, env={**os.environ, **environment}) for _ in range(RUNS)]
    return (statistics.median(cost.wall for cost in costs), statistics.median(cost.busy for cost in costs),
            max(cost.peak for cost in costs), costs[-1].output)


def called(work):
    """Medians of the wall clock and of CPU seconds of a call, and its last result."""
    walls, busy = [], []
    for _ in range(RUNS):
        begin, begin_busy = time.perf_counter(), time.process_time()
        result = work()
        walls.append(time.perf_counter() - begin)
        busy.append(time.process_time() - begin_busy)
    return statistics.median(walls), statistics.median(busy), result


def areas(program, molecule, folder):
    """Rows: program, setting, area (Å²), seconds."""
    surface = [program, "surface", molecule.xyzr, "--surface", "sas", "--json"]
    wall, _, _, output = medians(surface, folder)
    yield "Meniscus", "closed form", json.loads(output)["area"], wall
    for method, points in (("lee-richards", 20), ("lee-richards", 200), ("shrake-rupley", 100), ("shrake-rupley", 2000)):
        wall, _, _, output = medians(["freesasa", f"--{method}", f"--resolution={points}", "--n-threads=2", "--hetatm",
                                       "--radius-from-occupancy", f"--probe-radius={PROBE}", molecule.pdb], folder)
        kind = "slices" if method == "lee-richards" else "points"
        yield "FreeSASA", f"{method}, {points} {kind}", float(re.search(r"Total\s*:\s*([\d.]+)", output)[1]), wall
    for points in (24, 960):
        wall, _, _, _ = medians(["gmx", "sasa", "-quiet", "-s", molecule.pdb, "-f", molecule.pdb, "-surface", "all",
                                  "-probe", str(PROBE / 10), "-ndots", str(points), "-xvg", "none", "-o", "area.xvg"],
                                 folder, OMP_NUM_THREADS="2", GMX_MAXBACKUP="-1")
        with open(os.path.join(folder, "area.xvg"), encoding="ascii") as file:
            yield "gmx sasa", f"{points} points", 100 * float(file.read().split()[1]), wall
    sasa._ATOMIC_RADII.update({element: radius / 10 for element, radius in RADII.items()})  # it takes no list of radii
    trajectory = mdtraj.load_pdb(molecule.pdb, standard_names=False)
    for points in (100, 960):
        wall, _, result = called(lambda: mdtraj.shrake_rupley(trajectory, PROBE / 10, n_sphere_points=points))
        yield "MDTraj", f"{points} points, the call alone", 100 * float(result.sum()), wall
    for density in (2, 4):
        wall, area = pymol_area(molecule, folder, density)
        yield "PyMOL", f"get_area, dot_density {density}, the call alone", area, wall


def make_trajectory(molecule, folder):
    """FRAMES frames in which the molecule breathes and shakes, as XTC, and what XTC keeps of them (0.01 Å) as models."""
    trajectory = mdtraj.load_pdb(molecule.pdb, standard_names=False)
    random = numpy.random.default_rng(1)
    start, middle = trajectory.xyz[0], trajectory.xyz[0].mean(axis=0)
    frames = [middle + (start - middle) * (1 + 0.02 * numpy.sin(n / 8)) + 0.02 * random.normal(size=start.shape)
              for n in range(FRAMES)]
    xtc = os.path.join(folder, "run.xtc")
    mdtraj.Trajectory(numpy.array(frames), trajectory.topology).save_xtc(xtc)
    trajectory = mdtraj.load_xtc(xtc, top=trajectory.topology)
    with open(molecule.pdb, encoding="ascii") as file:
        lines = [line for line in file if line.startswith("ATOM")]
    models = os.path.join(folder, "models.pdb")
    with open(models, "w", encoding="ascii") as file:
        for n, xyz in enumerate(10 * trajectory.xyz.astype(float)):
            file.write(f"MODEL     {n + 1:4d}\n")
            file.writelines(f"{line[:30]}{x:8.3f}{y:8.3f}{z:8.3f}{line[54:]}" for line, (x, y, z) in zip(lines, xyz))
            file.write("ENDMDL\n")
    return trajectory, xtc, models


def series(program, molecule, folder):
    """Rows: program, setting, areas of all frames (Å²), wall and CPU seconds of all of them."""
    trajectory, xtc, models = make_trajectory(molecule, folder)
    wall, busy, _, output = medians([program, "surface", molecule.xyzr, xtc, "--surface", "sas", "--csv-series", "-", "-q"], folder)
    header, *rows = [line.split(",") for line in output.splitlines()]
    yield "Meniscus", "closed form", [float(row[header.index("sas_area")]) for row in rows], wall, busy
    for method, points in (("lee-richards", 20), ("shrake-rupley", 100)):
        wall, busy, _, output = medians(["freesasa", f"--{method}", f"--resolution={points}", "--n-threads=2", "--hetatm",
                                       "--radius-from-occupancy", f"--probe-radius={PROBE}", "--separate-models", models], folder)
        kind = "slices" if method == "lee-richards" else "points"
        yield "FreeSASA", f"{method}, {points} {kind}", [float(area) for area in re.findall(r"Total\s*:\s*([\d.]+)", output)], wall, busy
    for points in (24, 960):
        wall, busy, _, _ = medians(["gmx", "sasa", "-quiet", "-s", molecule.pdb, "-f", xtc, "-surface", "all", "-nopbc",
                                  "-probe", str(PROBE / 10), "-ndots", str(points), "-xvg", "none", "-o", "series.xvg"],
                                 folder, OMP_NUM_THREADS="2", GMX_MAXBACKUP="-1")
        with open(os.path.join(folder, "series.xvg"), encoding="ascii") as file:
            yield "gmx sasa", f"{points} points", [100 * float(line.split()[1]) for line in file], wall, busy
    for points in (100, 960):
        wall, busy, result = called(lambda: mdtraj.shrake_rupley(trajectory, PROBE / 10, n_sphere_points=points))
        yield "MDTraj", f"{points} points, the call alone", [100 * float(area) for area in result.sum(axis=1)], wall, busy


def print_series(program, molecule, folder):
    """Prints the table; how many rows it has, and how many of them are off."""
    print(f"\n{molecule.name}, {FRAMES} frames: solvent-accessible area of each\n")
    print("| program | method | mean error | largest | ms a frame | CPU ms |\n|---|---|---|---|---|---|")
    exact, count, failures = None, 0, 0
    for name, setting, found, wall, busy in series(program, molecule, folder):
        areas_found = numpy.array(found)
        exact = areas_found if exact is None else exact
        count += 1
        if areas_found.shape != exact.shape or len(exact) != FRAMES:
            failures += 1
            print(f"| {name} | {setting} | {len(found)} frames of {FRAMES} | | | |", flush=True)
            continue
        errors = areas_found / exact - 1
        failures += abs(errors).max() > LIMIT
        told = "exact | exact" if areas_found is exact else f"{100 * errors.mean():+.3f} % | {100 * abs(errors).max():.3f} %"
        print(f"| {name} | {setting} | {told} | {1000 * wall / FRAMES:,.1f} | {1000 * busy / FRAMES:,.1f} |", flush=True)
    return count, failures


def pymol_area(molecule, folder, density):
    """Seconds of get_area, and its answer."""
    script = os.path.join(folder, "area.py")
    with open(script, "w", encoding="ascii") as file:
        file.write(f"""
import time
from pymol import cmd
cmd.load({molecule.pdb!r})
cmd.alter("all", "vdw=q")
cmd.rebuild()
cmd.set("dot_solvent", 1)
cmd.set("solvent_radius", {PROBE})
cmd.set("dot_density", {density})
times = []
for run in range({RUNS}):
    begin = time.perf_counter()
    area = cmd.get_area("all")
    times.append(time.perf_counter() - begin)
print("AREA", area, sorted(times)[{RUNS // 2}])
""")
    output = medians(["pymol", "-cqr", script], folder)[3]
    _, area, seconds = re.search(r"AREA .*", output)[0].split()
    return float(seconds), float(area)


def pictures(program, molecule, folder):
    """Rows: program, what of, wall, CPU seconds, MB; each with shade or shadows and smooth edges, 1280×960."""
    render = [program, "render", molecule.pdb, "-o", "meniscus.png", "--size", "1280x960", "--force", "--color", "chain",
              "--preset", "classic"]
    yield "Meniscus", "4 samples", *medians([*render, "--samples", "4"], folder)[:3]
    effects = ["--ambient-occlusion", "0.8", "--silhouettes", "1"]
    yield "Meniscus", "4 samples, shade and lines", *medians([*render, "--samples", "4", *effects], folder)[:3]
    for quality in (0, 1):
        script = os.path.join(folder, "picture.py")
        with open(script, "w", encoding="ascii") as file:
            file.write(f"""
from pymol import cmd, util
cmd.load({molecule.pdb!r})
cmd.alter("all", "vdw=q")
cmd.set("max_threads", 2)
cmd.set("surface_quality", {quality})
cmd.set("antialias", 1)
cmd.hide()
cmd.show("surface")
util.cbc()
cmd.ray(1280, 960)
cmd.png("pymol.png")
""")
        figures = medians(["pymol", "-cqr", script], folder)[:3]
        if not os.path.exists(os.path.join(folder, "pymol.png")):
            sys.exit("compare_peers: error: PyMOL made no picture")
        os.remove(os.path.join(folder, "pymol.png"))
        yield "PyMOL", f"ray, surface_quality {quality}", *figures


def main(program, files):
    program = os.path.abspath(program)
    cases = failures = 0
    for path in files:
        with tempfile.TemporaryDirectory() as folder:
            molecule = Molecule(path, folder)
            print(f"\n{molecule.name}, {molecule.count} heavy atoms: solvent-accessible area\n")
            print("| program | method | area Å² | error | ms |\n|---|---|---|---|---|")
            exact = None
            for name, setting, area, wall in areas(program, molecule, folder):
                exact = exact or area
                cases += 1
                failures += abs(area / exact - 1) > LIMIT
                error = "exact" if area == exact else f"{100 * (area / exact - 1):+.3f} %"
                print(f"| {name} | {setting} | {area:,.2f} | {error} | {1000 * wall:,.0f} |", flush=True)
            counted, wrong = print_series(program, molecule, folder)
            cases += counted
            failures += wrong
            print(f"\n{molecule.name}: picture of the solvent-excluded surface\n")
            print("| program | picture | s | CPU s | MB |\n|---|---|---|---|---|")
            for name, what, wall, busy, peak in pictures(program, molecule, folder):
                print(f"| {name} | {what} | {wall:.2f} | {busy:.2f} | {peak:,.0f} |", flush=True)
    print(f"\ncases {cases} failures {failures}")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
