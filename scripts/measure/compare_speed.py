# SPDX-License-Identifier: BSD-3-Clause
"""Compares what two builds of the program cost, as a table.

  compare_speed.py BEFORE NOW FOLDER [CASE...]    FOLDER: with the structures that Debian does not ship, as the PDB has
                                                  them, packed or not; CASE: words of the cases that are run

Each case is a whole process, run RUNS times by either program in turn. CPU seconds are medians, memory is the largest. What
takes longer than PATIENCE seconds is given up. Both have to write the same to standard output, but for times.
"""

import os
import re
import statistics
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass

RUNS = int(os.environ.get("MENISCUS_RUNS", "3"))
PATIENCE = float(os.environ.get("MENISCUS_PATIENCE", "120"))
TOXIN = "/usr/share/pymol/data/demo/1tii.pdb"
SERIES = ["surface", "adk.psf", "--trajectory", "adk_dims.dcd", "--frames", "all", "--csv-series", "-"]
#: Title, arguments, and the number of frames of one run.
CASES = [
    ("areas, SAS: 1TII", ["surface", TOXIN, "--surface", "sas", "--json"], 1),
    ("areas, SAS: 1AON", ["surface", "1aon.cif", "--surface", "sas", "--json"], 1),
    ("areas, SAS: 7CGO", ["surface", "7cgo.cif", "--surface", "sas", "--json"], 1),
    ("areas and volumes, SES: 1TII", ["surface", TOXIN, "--json"], 1),
    ("areas and volumes, SES: 1AON", ["surface", "1aon.cif", "--json"], 1),
    ("areas and volumes, SES: 7CGO", ["surface", "7cgo.cif", "--json"], 1),
    ("areas and volumes, SES: 1IHM, 677,040 atoms", ["surface", "1ihm.pdb", "--assembly", "1", "--json"], 1),
    ("a frame of 3,341 atoms, SAS", [*SERIES, "--surface", "sas"], 98),
    ("a frame of 3,341 atoms, SES", SERIES, 98),
    ("even mesh: 1TII at 3 per Å²", ["export", "mesh", TOXIN, "--density", "3", "-o", "made.ply"], 1),
    ("even mesh: 1AON at 1 per Å²", ["export", "mesh", "1aon.cif", "--density", "1", "-o", "made.ply"], 1),
    ("even mesh: 1TII within 0.1 Å", ["export", "mesh", TOXIN, "--even", "--tolerance", "0.1", "-o", "made.ply"], 1),
    ("even mesh: 1TII at 0.1 per Å²", ["export", "mesh", TOXIN, "--density", "0.1", "-o", "made.ply"], 1),
    ("even mesh: 1IHM at 0.1 per Å²", ["export", "mesh", "1ihm.pdb", "--assembly", "1", "--density", "0.1", "-o", "made.ply"], 1),
    ("picture: 1TII, 1280×960", ["render", TOXIN, "-o", "made.png"], 1),
    ("picture: a pocket of 1AKE with caps",
     ["render", "1ake.cif", "--select", "polymer and chain A", "--sticks", "ligand and chain A", "--color", "lightgrey", "--color",
      "ligand=element", "--zoom-to", "within 5 of (ligand and chain A)", "--clip", "depth>0.55", "--background", "white", "-o",
      "made.png"], 1),
    ("picture: 1IHM, 677,040 atoms", ["render", "1ihm.pdb", "--assembly", "1", "-o", "made.png"], 1),
    ("picture: 1TII, 10,000 × 7,500 pixels", ["render", TOXIN, "--size", "10000x7500", "-o", "made.png"], 1)]


@dataclass
class Cost:
    """The cost of one process: CPU seconds, its largest memory in MB, and its output."""
    busy: float
    peak: float
    output: str


def measured(command, cwd):
    """Returns the cost of a command; None after PATIENCE seconds. Ends this program if the command fails."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=cwd)
    late = threading.Event()
    timer = threading.Timer(PATIENCE, lambda: (late.set(), process.kill()))
    timer.start()
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    if late.is_set():
        return None
    if status:
        sys.exit(f"compare_speed.py: error: {' '.join(map(str, command))} ended with {process.returncode}")
    return Cost(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, output)


def path_of(word, folder):
    """Returns a structure's path in the folder, packed or not; returns other words unchanged."""
    for name in (word, word + ".gz"):
        if os.path.exists(os.path.join(folder, name)):
            return os.path.join(folder, name)
    return word


def without_times(output):
    return re.sub(r'"ms": .*', "", output)


def run(programs, words, place):
    """Runs both programs in turn. Returns the costs of each, or None if it was given up."""
    costs = {program: [] for program in programs}
    for _ in range(RUNS):
        for program in programs:
            if None in costs[program]:
                continue
            cost = measured([program, *words, "--device", "cpu", "--force", "-q"], place)
            costs[program].append(cost)
    return [None if None in costs[program] else costs[program] for program in programs]


def told(costs, unit):
    if costs is None:
        return f"not in {PATIENCE:.0f} s", ""
    busy = statistics.median(cost.busy for cost in costs) / unit
    return f"{busy:.2f}" if unit == 1 else f"{1000 * busy:.1f} ms", f"{max(cost.peak for cost in costs):,.0f}"


def main(before, now, folder, *chosen):
    programs = [os.path.abspath(program) for program in (before, now)]
    differing = 0
    print("| what | CPU s before | now | MB before | now |\n|---|---|---|---|---|")
    for title, words, frames in CASES:
        if chosen and not any(word in title for word in chosen):
            continue
        words = [path_of(word, os.path.abspath(folder)) for word in words]
        with tempfile.TemporaryDirectory() as place:
            old, new = run(programs, words, place)
        if old and new and without_times(old[-1].output) != without_times(new[-1].output):
            differing += 1
            title += " (other numbers)"
        (old_busy, old_peak), (new_busy, new_peak) = told(old, frames), told(new, frames)
        print(f"| {title} | {old_busy} | {new_busy} | {old_peak} | {new_peak} |", flush=True)
    print(f"\ndiffering outputs: {differing}")
    return differing > 0


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
