# SPDX-License-Identifier: BSD-3-Clause
"""usd_readers.py PROGRAM: USD files in OpenUSD itself (usd-core of PyPI): its validators, which usdchecker runs, find nothing;
points, triangles, colours and boxes are those of the PLY files of the same molecule, frame by frame. At the end "cases N
failures M"."""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from pxr import Usd, UsdGeom, UsdValidation

from mesh_readers_test import read_ply, positions_of, volume_of

STILL = ["/usr/share/pymol/data/demo/1tii.pdb", "--tolerance", "0.2", "--device", "cpu", "-q"]
RUN = ["/usr/share/freesasa/test-data/1d3z.pdb", "--frames", "0-4", "--density", "0.5", "--device", "cpu", "-q"]
FPS = 25


def export(path, *words):
    subprocess.run([sys.argv[1], "export", "mesh", *words, "-o", str(path)], check=True, stdout=subprocess.DEVNULL)


def complaints(path):
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    return [error.GetErrorAsString() for error in context.Validate(Usd.Stage.Open(str(path)))]


def meshes_of(stage):
    return [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]


def encoded(light):
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0) ** (1 / 2.4) - 0.055)


def differences(meshes, time, vertices, triangles, scale):
    """Of all meshes together and a PLY file."""
    points, faces, colors, normals, faults = [], [], [], [], []
    for mesh in meshes:
        own = np.array(mesh.GetPointsAttr().Get(time))
        counts, indices = mesh.GetFaceVertexCountsAttr().Get(time), mesh.GetFaceVertexIndicesAttr().Get(time)
        fine, reason = UsdGeom.Mesh.ValidateTopology(indices, counts, len(own))
        if not fine:
            faults.append(reason)
        low, high = np.array(mesh.GetExtentAttr().Get(time))
        if not (np.array_equal(low, own.min(axis=0)) and np.array_equal(high, own.max(axis=0))):
            faults.append("extent")
        faces.append(np.array(indices).reshape(-1, 3) + sum(map(len, points)))
        points.append(own)
        color = mesh.GetDisplayColorPrimvar()
        colors.append(np.array(color.Get(time)))
        normals.append(np.array(mesh.GetNormalsAttr().Get(time)))
        if color.GetInterpolation() != "vertex" or mesh.GetNormalsInterpolation() != "vertex":
            faults.append("interpolation")
    points, faces = np.concatenate(points), np.concatenate(faces)
    wanted = positions_of(vertices).astype(float) * scale
    if points.shape != wanted.shape or not np.allclose(points, wanted, rtol=1e-6, atol=1e-6):
        return [*faults, f"points {points.shape}, not {wanted.shape}"]
    if not np.array_equal(faces, triangles):
        faults.append("triangles")
    srgb = np.stack([vertices[c] for c in ("red", "green", "blue")], axis=1)
    if not np.allclose(255 * encoded(np.concatenate(colors)), srgb, atol=0.01):
        faults.append("colours")
    if not np.allclose(np.concatenate(normals), np.stack([vertices[c] for c in ("nx", "ny", "nz")], axis=1), atol=1e-5):
        faults.append("normals")
    print(f"    {len(points)} points, {len(faces)} triangles, volume {volume_of(points, faces) / scale**3:.2f} Å³")
    return faults


def still_faults(folder, ending):
    export(folder / "still.ply", *STILL, "--by", "chain", "--color", "chain")
    export(folder / f"still.{ending}", *STILL, "--by", "chain", "--color", "chain", "--scale", "0.1")
    stage = Usd.Stage.Open(str(folder / f"still.{ending}"))
    meshes = meshes_of(stage)
    faults = complaints(folder / f"still.{ending}")
    if UsdGeom.GetStageMetersPerUnit(stage) != 1 or UsdGeom.GetStageUpAxis(stage) != "Y":
        faults.append("units")
    if [mesh.GetPrim().GetName() for mesh in meshes] != [f"chain_{c}" for c in "DEFGHAC"]:
        faults.append(f"names {[mesh.GetPrim().GetName() for mesh in meshes]}")
    return faults + differences(meshes, Usd.TimeCode.Default(), *read_ply(folder / "still.ply"), 0.1)


def run_faults(folder, ending):
    """All frames; between them the velocities lead from one towards the next."""
    export(folder / "run_#.ply", *RUN, "--force")
    export(folder / f"run.{ending}", *RUN)
    stage = Usd.Stage.Open(str(folder / f"run.{ending}"))
    mesh, = meshes_of(stage)
    faults = complaints(folder / f"run.{ending}")
    if (stage.GetStartTimeCode(), stage.GetEndTimeCode(), stage.GetTimeCodesPerSecond()) != (1, 5, FPS):
        faults.append("times")
    if mesh.GetPointsAttr().GetTimeSamples() != [1, 2, 3, 4, 5]:
        faults.append("samples")
    for frame in range(5):
        faults += differences([mesh], frame + 1, *read_ply(folder / f"run_{frame}.ply"), 1)
    velocities = np.array(mesh.GetVelocitiesAttr().Get(1))
    if len(velocities) != len(mesh.GetPointsAttr().Get(1)) or not 0 < np.linalg.norm(velocities, axis=1).mean() < 10 * FPS:
        faults.append("velocities")
    # OpenUSD's own use of them, half a frame on.
    moved = np.array(mesh.ComputePointsAtTime(1.5, 1))
    if not np.allclose(moved, np.array(mesh.GetPointsAttr().Get(1)) + 0.5 / FPS * velocities, atol=1e-4):
        faults.append("points in between")
    return faults


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as room:
        cases = [(check, ending) for check in (still_faults, run_faults) for ending in ("usda", "usdz")]
        for check, ending in cases:
            faults = check(pathlib.Path(room), ending)
            failures += bool(faults)
            print(check.__name__, ending, *(faults or ["sound"]), flush=True)
            for old in pathlib.Path(room).glob("still.ply"):
                old.unlink()
    print(f"cases {len(cases)} failures {failures}")
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
