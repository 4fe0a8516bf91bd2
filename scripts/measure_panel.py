# SPDX-License-Identifier: BSD-3-Clause
"""Measures how long a change in the panel of the Blender add-on takes, stage by stage: the probe moves, and the mesh
follows.

    MENISCUS_LIBRARY=build/release/exporters/bindings/c/libmeniscus.so blender [-b] --factory-startup --python-exit-code 3 \
        --python scripts/measure_panel.py -- FILE [--density D | --tolerance T] [--changes N] [--trajectory T] [--program P]
    blender [-b] ... --python scripts/measure_panel.py -- surface_sequence.json

The table has the smallest, the median and the largest time in ms. With a trajectory the timeline is played instead, for ten
seconds from its first frame, and what comes is frames a second: without -b of the window, drawn in full each time. So it is with a
sequence of .mns files, which is streamed."""

import argparse
import os
import statistics
import sys
import time

import bpy

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "exporters", "blender", "addon"))
import meniscus_import  # noqa: E402
from meniscus_import import build, computed, sequence  # noqa: E402
from meniscus_import.computing import process  # noqa: E402

TOLD = {"look": "request read and sent (window's thread)", "Atoms": "atoms read", "Surface": "surface", "Mesh": "mesh",
        "Arrays": "arrays made and handed over", "show": "shown (window's thread)", "fill": "of it Blender's mesh filled",
        "change": "from the slider to the mesh"}
SECONDS = 10.0
times = {}


def note(stage, began):
    times.setdefault(stage, []).append(1e3 * (time.perf_counter() - began))


def timed(stage, work):
    def run(*arguments, **options):
        began = time.perf_counter()
        try:
            return work(*arguments, **options)
        finally:
            note(stage, began)

    return run


def heard(hear):
    """Stages of the other process as they are told."""
    now = ["", 0.0]

    def run(self, word, number, what):
        if now[0]:
            note(now[0], now[1])
        now[:] = (what if word == "stage" else ""), time.perf_counter()
        return hear(self, word, number, what)

    return run


def surface(options):
    """The object that is measured, computed once."""
    meniscus_import.register()
    computed._process = process.Process(os.path.join(ROOT, "exporters", "bindings", "python", "meniscus"), options.program)
    computed.working = lambda: computed._process
    for other in list(bpy.data.objects):
        bpy.data.objects.remove(other)
    bpy.ops.object.meniscus_from_file("EXEC_DEFAULT", filepath=options.file, selection=options.selection, trajectory=options.trajectory,
                                      wait=True, detail="FINE")
    item = bpy.context.view_layer.objects.active
    item.meniscus.live = False
    item.meniscus.detail = "FINE" if options.tolerance else "PROXY"
    item.meniscus.density, item.meniscus.tolerance = options.density, options.tolerance or 0.05
    bpy.ops.object.meniscus_update("EXEC_DEFAULT", wait=True)
    return item


def change(item, probe):
    """One change, as the slider makes it; ends when the mesh shows it."""
    item.meniscus.probe = probe
    began = time.perf_counter()
    computed.ask(item)
    note("look", began)
    while computed._process.is_busy():
        computed._deliver(computed._process.take(1.0))
    note("change", began)
    if item.get("meniscus_error"):
        sys.exit(f"probe {probe:.2f}: {item["meniscus_error"]}")


def measure(item, changes):
    process.Process._hear = heard(process.Process._hear)
    build.fill_mesh, computed.show = timed("fill", build.fill_mesh), timed("show", computed.show)
    for step in range(changes):
        change(item, 1.2 + 0.02 * step)
    print(f"{len(item.data.vertices):,} vertices, {len(item.data.polygons):,} triangles, {changes} changes of the probe; ms")
    for stage, label in TOLD.items():
        if stage in times:
            print(f"{label:45}{min(times[stage]):9.1f}{statistics.median(times[stage]):9.1f}{max(times[stage]):9.1f}")


def next_frame(count, error_of):
    scene = bpy.context.scene
    scene.frame_set(scene.frame_current % count + 1)
    if error_of():
        sys.exit(f"frame {scene.frame_current}: {error_of()}")


def cpu_of(child):
    """s, of a process and of those of its children that have ended."""
    with open(f"/proc/{child.pid}/stat", encoding="ascii", errors="replace") as file:
        return sum(int(word) for word in file.read().rsplit(")", 1)[1].split()[11:15]) / os.sysconf("SC_CLK_TCK")


def play(item, count, error_of, other):
    """Frames a second; in a window each is drawn before the next is asked for. other: gives the process that computes or reads."""
    next_frame(count, error_of)
    cpu_here, cpu_there = time.process_time(), cpu_of(other())
    frames, began = 0, time.perf_counter()
    while time.perf_counter() - began < SECONDS:
        next_frame(count, error_of)
        if not bpy.app.background:
            bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
        frames += 1
    spent = time.perf_counter() - began
    print(f"{count} frames of {len(item.data.polygons):,} triangles; {frames / spent:.1f} a second")
    for who, cpu in (("Blender", time.process_time() - cpu_here), ("the other process", cpu_of(other()) - cpu_there)):
        print(f"CPU of {who}: {1e3 * cpu / frames:.1f} ms a frame")


def main(words):
    parser = argparse.ArgumentParser(prog="measure_panel.py")
    parser.add_argument("file")
    parser.add_argument("--selection", default="")
    parser.add_argument("--density", type=float, default=0.2)
    parser.add_argument("--tolerance", type=float)
    parser.add_argument("--changes", type=int, default=11)
    parser.add_argument("--trajectory", default="")
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "meniscus"))
    options = parser.parse_args(words)
    if options.file.endswith(".json"):
        meniscus_import.register()
        item = sequence.stream(options.file)
        play(item, bpy.context.scene.frame_end, lambda: item["meniscus_error"], lambda: sequence._ahead.process._child)
        sequence.unregister()
        return
    item = surface(options)
    if options.trajectory:
        item.meniscus.outside = "LOOP"
        play(item, computed.frame_count(item), lambda: item["meniscus_error"], lambda: computed._process._child)
    else:
        measure(item, options.changes)
    computed.end()


main(sys.argv[sys.argv.index("--") + 1:])
