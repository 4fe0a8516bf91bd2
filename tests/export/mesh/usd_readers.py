# SPDX-License-Identifier: BSD-3-Clause
"""usd_readers.py PROGRAM: USD files in OpenUSD itself (usd-core of PyPI): its validators, which usdchecker runs, find nothing;
points, triangles, colours and boxes are those of the PLY files of the same molecule, frame by frame; each mesh, also those of
instances, has a material that takes its colours, whose looks can be chosen in the scene that refers to it. At the end "cases N
failures M"."""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from pxr import Usd, UsdGeom, UsdShade, UsdValidation

from mesh_readers_test import COPIES, read_ply, positions_of, volume_of, write_capsid

STILL = ["/usr/share/pymol/data/demo/1tii.pdb", "--tolerance", "0.2", "--device", "cpu", "-q"]
RUN = ["/usr/share/freesasa/test-data/1d3z.pdb", "--frames", "0-4", "--density", "0.5", "--device", "cpu", "-q"]
FPS = 25


def export(path, *words):
    subprocess.run([sys.argv[1], "export", "mesh", *words, "-o", str(path)], check=True, stdout=subprocess.DEVNULL)


def complaints(path):
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    return [error.GetErrorAsString() for error in context.Validate(Usd.Stage.Open(str(path)))]


def meshes_of(stage):
    """Returns all meshes of a stage, with a separate one for each instance."""
    return [UsdGeom.Mesh(prim) for prim in stage.Traverse(Usd.TraverseInstanceProxies()) if prim.IsA(UsdGeom.Mesh)]


def material_faults(mesh, **wanted):
    """Returns faults of the material that the mesh is drawn with; wanted: its numbers."""
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    if not material:
        return [f"{mesh.GetPath()}: no material"]
    shader, _, _ = material.ComputeSurfaceSource()
    faults = [f"{mesh.GetPath()}: {name} {shader.GetInput(name).Get()}" for name, value in wanted.items()
              if abs(shader.GetInput(name).Get() - value) > 1e-3]
    source, = shader.GetInput("diffuseColor").GetConnectedSources()[0]
    reader = UsdShade.Shader(source.source)
    if shader.GetIdAttr().Get() != "UsdPreviewSurface" or reader.GetInput("varname").Get() != "displayColor":
        faults.append("shaders")
    return faults


def encoded(light):
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0) ** (1 / 2.4) - 0.055)


def differences(meshes, time, vertices, triangles, scale):
    """Returns differences between all meshes together and a PLY file."""
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
    for mesh in meshes:
        faults += material_faults(mesh, roughness=(2 / 62) ** 0.25)  # roughness of the usual look's highlight
    return faults + differences(meshes, Usd.TimeCode.Default(), *read_ply(folder / "still.ply"), 0.1)


def copies_faults(folder, ending):
    """Returns faults of a file of copies, and of a shot's scene that refers to it and chooses another look."""
    places = write_capsid(folder / "capsid.pdb")
    export(folder / f"copies.{ending}", str(folder / "capsid.pdb"), *COPIES, *STILL[1:], "--opacity", "resid 1-20=0.3", "--force")
    shot = Usd.Stage.CreateNew(str(folder / f"shot_{ending}.usda"))
    UsdGeom.SetStageUpAxis(shot, "Y")
    UsdGeom.SetStageMetersPerUnit(shot, 1)
    shot.SetDefaultPrim(UsdGeom.Xform.Define(shot, "/shot").GetPrim())
    virus = UsdGeom.Xform.Define(shot, "/shot/virus").GetPrim()
    virus.GetReferences().AddReference(f"./copies.{ending}")
    virus.GetVariantSets().SetSelection("look", "metal")
    shot.Save()
    faults = []
    for name, wanted in ((f"copies.{ending}", {}), (f"shot_{ending}.usda", {"roughness": 0.35, "metallic": 1})):
        faults += complaints(folder / name)
        stage = Usd.Stage.Open(str(folder / name))
        meshes = meshes_of(stage)
        if len(stage.GetPrototypes()) != 1 or len(meshes) != len(places):
            faults.append(f"{len(meshes)} meshes of {len(stage.GetPrototypes())} prototypes")
        for mesh, place in zip(meshes, places):
            found = np.array(mesh.ComputeLocalToWorldTransform(Usd.TimeCode.Default())).T
            if not np.allclose(found, place, atol=1e-9):
                faults.append(f"{mesh.GetPath()} at {found}")
            faults += material_faults(mesh, **wanted)
            opacity = UsdGeom.Gprim(mesh).GetDisplayOpacityPrimvar()
            if opacity.GetInterpolation() != "vertex" or set(np.round(opacity.Get(), 4)) != {np.float32(0.3), np.float32(1)}:
                faults.append("opacity")
    return faults


def run_faults(folder, ending):
    """Returns faults of a run's frames, and of velocities that lead from one frame towards the next."""
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
    # OpenUSD itself applies the velocities for half a frame.
    moved = np.array(mesh.ComputePointsAtTime(1.5, 1))
    if not np.allclose(moved, np.array(mesh.GetPointsAttr().Get(1)) + 0.5 / FPS * velocities, atol=1e-4):
        faults.append("points in between")
    return faults


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as room:
        cases = [(check, ending) for check in (still_faults, copies_faults, run_faults) for ending in ("usda", "usdz")]
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
