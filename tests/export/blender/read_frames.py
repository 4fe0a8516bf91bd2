# SPDX-License-Identifier: BSD-3-Clause
"""read_frames.py FILE FPS FRAME...: prints the triangles and the area of the one mesh of a USD or Alembic file at frames, as the
libraries of these formats read them (usd-core and alembic3d of PyPI): JSON, a pair for each."""

import json
import sys

import numpy as np


def usd_mesh(path, _fps):
    """Returns {frame: (corners per face, corners, positions)}."""
    from pxr import Usd, UsdGeom

    stage = Usd.Stage.Open(path)
    (mesh,) = (UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh))

    def at(frame):
        return [found.Get(frame) for found in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr(), mesh.GetPointsAttr())]

    at.file = stage  # The stage closes when nothing holds it.
    return at


def alembic_mesh(path, fps):
    from alembic3d import Abc, AbcGeom

    def meshes(parent):
        for number in range(parent.getNumChildren()):
            child = parent.getChild(number)
            if AbcGeom.IPolyMesh.matches(child.getHeader()):
                yield AbcGeom.IPolyMesh(parent, child.getName())
            yield from meshes(child)

    archive = Abc.IArchive(path)
    (mesh,) = meshes(archive.getTop())

    def at(frame):
        found = mesh.getSchema().getValue(Abc.ISampleSelector(frame / fps))
        return list(found.getFaceCounts()), list(found.getFaceIndices()), [(p.x, p.y, p.z) for p in found.getPositions()]

    at.file = archive
    return at


def area_and_count(counts, corners, positions):
    assert set(counts) == {3}
    corners, positions = np.array(corners).reshape(-1, 3), np.array(positions, dtype=float)
    a, b, c = (positions[corners[:, k]] for k in range(3))
    return len(corners), float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


path, fps, *frames = sys.argv[1:]
mesh = (alembic_mesh if path.endswith(".abc") else usd_mesh)(path, float(fps))
print(json.dumps([area_and_count(*mesh(float(frame))) for frame in frames]))
