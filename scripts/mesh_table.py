#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""mesh_table.py --inputs '1tii.pdb' 'adk.psf --trajectory adk.dcd --frames 0,40' --settings '--tolerance 0.1' '--density 2'

One row for each mesh of each input, in Markdown: what `meniscus export mesh` makes and what that costs, and how good the file
is. An input is what `meniscus export atoms` takes, every frame of it a molecule; a setting is what `export mesh` takes. The
probe is 1.4 Å. Bytes are those of a binary PLY without attributes, seconds and memory those of the whole program, which reads
the atoms and computes the surface, too. Distances in Å are measured by the library: from 7 places of triangles to the exact
surface, and from vertices of a mesh within --reference Å of it back to the triangles; of at most --points each, drawn evenly.
`tetgen -d` looks for triangles that cross."""

import argparse
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "exporters/bindings/python"), str(ROOT / "exporters/blender/addon/meniscus_import")]

import mns_reader
import numpy as np

COLUMNS = ("molecule", "atoms", "mesh", "triangles", "MB", "CPU s", "s", "peak MB", "angle min", "p1", "p5", "median",
           "< 5° %", "aspect", "area error %", "mesh to surface", "surface to mesh", "zero areas", "tetgen -d")


def molecules(program, words, folder):
    """Name, XYZR file and its rows of every frame of an input."""
    path = folder / "input.atoms"
    subprocess.run([program, "export", "atoms", "-q", "--force", *shlex.split(words), "-o", path], check=True,
                   stdout=subprocess.DEVNULL)
    header, arrays = mns_reader.read_arrays(path)
    radii, frames = np.asarray(arrays["atom.radius"]), header.get("frames") or []
    centers = arrays["frame.position"].reshape(len(frames), -1, 3) if frames else [arrays["atom.center"]]
    for place, positions in enumerate(centers):
        name = pathlib.Path(shlex.split(words)[0]).name + (f" frame {frames[place]}" if frames else "")
        rows = np.column_stack([np.asarray(positions, dtype=float), radii])
        table = folder / "molecule.xyzr"
        table.write_text("".join(f"{x!r} {y!r} {z!r} {r!r}\n" for x, y, z, r in rows.tolist()))
        yield name, table, rows


def read_ply(path):
    """Vertices and triangles of a binary PLY as Meniscus writes it."""
    types = {"float": "<f4", "uchar": "u1", "int": "<i4", "uint": "<u4"}
    head, body = path.read_bytes().split(b"end_header\n", 1)
    vertex, face = head.decode().split("element face ")
    count = int(vertex.split("element vertex ")[1].split()[0])
    properties = [line.split()[1:] for line in vertex.splitlines() if line.startswith("property")]
    row = np.dtype([(name, types[kind]) for kind, name in properties])
    vertices = np.frombuffer(body, row, count)
    triangles = np.frombuffer(body, np.dtype([("corners", "u1"), ("at", "<u4", 3)]), int(face.split()[0]),
                              count * row.itemsize)
    return np.stack([vertices[axis] for axis in "xyz"], axis=1), triangles["at"].astype(np.int64)


# A process begins with the memory of the one that starts it, so a small one does, and tells what its child used.
RUNNER = """import resource, subprocess, sys, time
began = time.perf_counter()
code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(time.perf_counter() - began, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, code)"""


def exported(program, table, setting, path):
    """Seconds, CPU seconds, peak MB and exit code of `export mesh`, and its last words."""
    words = [program, "export", "mesh", "--device", "cpu", "--force", "--attributes", "none", table, "-o", path]
    done = subprocess.run([sys.executable, "-S", "-c", RUNNER, *words, *shlex.split(setting)], capture_output=True, text=True,
                          check=True)
    seconds, cpu, peak, code = done.stdout.split()
    return float(seconds), float(cpu), float(peak), int(code), done.stderr.strip().splitlines()[-1:]


def drawn(rows, most):
    return rows if len(rows) <= most else rows[np.random.default_rng(1).choice(len(rows), most, replace=False)]


def quality(vertices, triangles, surface, options):
    """The columns from the angles to the areas that are zero."""
    import measure_mesh as measure
    corners = vertices.astype(float)[triangles]
    areas, angles = measure.areas_of(corners), measure.smallest_angles(corners)
    with np.errstate(divide="ignore"):
        aspect = measure.edges_of(corners).max(axis=1) ** 2 / (2 * areas)
    zero = (measure.areas_of(np.round(corners, 3)) < 1e-9).sum()
    few = drawn(corners, options.points // len(measure.PLACES))
    places = np.einsum("pk,tkc->tpc", measure.PLACES, few).reshape(-1, 3)
    forward = np.abs(surface.distance(places)).max()
    samples = drawn(np.array(surface.mesh(options.reference, split_colors=False).vertices), options.points)
    back = measure.farthest_from_mesh(samples, vertices.astype(float), triangles)
    p = np.percentile(angles, [0, 1, 5, 50])
    return [f"{p[0]:.2f}", f"{p[1]:.1f}", f"{p[2]:.1f}", f"{p[3]:.1f}", f"{100 * (angles < 5).mean():.4f}",
            f"{aspect.max():.3g}", f"{100 * (areas.sum() / surface.area - 1):+.2f}", f"{forward:.4f}", f"{back:.4f}",
            str(zero)]


def crossings(program, table, setting, folder, options, count):
    """What `tetgen -d` says of the mesh."""
    if count > options.tetgen_most:
        return "not asked"
    path = folder / "mesh.smesh"
    subprocess.run([program, "export", "mesh", "--device", "cpu", "-q", "--force", table, "-o", path, *shlex.split(setting)],
                   check=True, stdout=subprocess.DEVNULL)
    try:
        said = subprocess.run(["tetgen", "-d", path], capture_output=True, text=True, timeout=options.tetgen_seconds).stdout
    except subprocess.TimeoutExpired:
        return f"no answer in {options.tetgen_seconds:g} s"
    if "No faces are intersecting" in said:
        return "none"
    return next((line.strip() for line in said.splitlines() if "intersect" in line.lower()), "failed")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", nargs="+", required=True, metavar="WORDS")
    parser.add_argument("--settings", nargs="+", required=True, metavar="WORDS")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", metavar="FOLDER")
    parser.add_argument("--program", type=pathlib.Path, help="another meniscus that makes the meshes, of an older version, say")
    parser.add_argument("--points", type=int, default=1_000_000, metavar="N")
    parser.add_argument("--reference", type=float, default=0.02, metavar="Å")
    parser.add_argument("--tetgen-most", type=int, default=1_000_000, metavar="TRIANGLES")
    parser.add_argument("--tetgen-seconds", type=float, default=900, metavar="S")
    options = parser.parse_args()
    os.environ.setdefault("MENISCUS_LIBRARY", str(options.build / "exporters/bindings/c/libmeniscus.so"))
    import meniscus
    program = options.program or options.build / "meniscus"
    print("| " + " | ".join(COLUMNS) + " |\n|" + "-|" * len(COLUMNS), flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for words in options.inputs:
            for molecule, table, balls in molecules(options.build / "meniscus", words, folder):
                surface = meniscus.surface(balls[:, :3], balls[:, 3])
                for setting in options.settings:
                    print(f"{molecule}: {setting}", file=sys.stderr, flush=True)
                    path = folder / "mesh.ply"
                    seconds, cpu, peak, code, last = exported(program, table, setting, path)
                    row = [molecule, f"{len(balls):,}", setting]
                    if code == 0:
                        vertices, triangles = read_ply(path)
                        row += [f"{len(triangles):,}", f"{path.stat().st_size / 1e6:.1f}", f"{cpu:.2f}", f"{seconds:.2f}",
                                f"{peak:.0f}", *quality(vertices, triangles, surface, options),
                                crossings(program, table, setting, folder, options, len(triangles))]
                    else:
                        row += [f"exit code {code}: " + " ".join(last)]
                    print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
