# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a surface of libmeniscus at vertices of a mesh and at atoms, as arrays of .mns files."""

import numpy as np

#: Å from the axis of a spindle torus, nearer to which curvature is that there, as in Meniscus.
CORE = 0.001


def of_surface(library, made, mesh):
    """Arrays by their names in .mns files. made, mesh: of the package `library`."""
    mean, gaussian = curvatures(made, mesh)
    arrays = {"mesh.mean_curvature": mean, "mesh.gaussian_curvature": gaussian}
    try:
        arrays["atom.area"] = made.atom_areas.astype(np.float32)
        arrays["atom.accessible_area"] = made.atom_sas_areas.astype(np.float32) if made.kind == "ses" else arrays["atom.area"]
    except library.Error:
        pass  # of surfaces whose atoms' areas do not add up: nothing shows rather than something wrong
    return arrays


def curvatures(made, mesh):
    """Mean and Gaussian curvature at vertices, 1/Å and 1/Å²: that of the patch that the vertex lies on, among those of its
    triangles."""
    corner, x = mesh.triangles.ravel(), mesh.vertices
    kind, patch = np.repeat(mesh.triangle_kinds, 3), np.repeat(mesh.triangle_patches, 3)
    along, around, off = (np.zeros(len(corner)) for _ in range(3))  # principal curvatures, and Å from the patch's own surface
    patches, balls = made.patches, made.balls
    convex, torus, concave = (np.flatnonzero(kind == which) for which in range(3))
    if len(convex):
        atom = patches.convex["atom"][patch[convex]]
        radius = balls["radius"][atom]
        along[convex] = around[convex] = 1.0 / radius
        off[convex] = np.abs(np.linalg.norm(x[corner[convex]] - balls["center"][atom], axis=1) - radius)
    if len(torus):
        rows = patches.toroidal[patch[torus]]
        offset = x[corner[torus]] - rows["center"]
        height = np.einsum("nx,nx->n", offset, rows["axis"])
        out = np.linalg.norm(offset - height[:, None] * rows["axis"], axis=1)
        along[torus] = -1.0 / made.probe
        around[torus] = (rows["radius"] - out) / made.probe / np.maximum(out, CORE)
        off[torus] = np.abs(np.hypot(rows["radius"] - out, height) - made.probe)
    if len(concave):
        along[concave] = around[concave] = -1.0 / made.probe
        off[concave] = np.abs(np.linalg.norm(x[corner[concave]] - patches.concave["center"][patch[concave]], axis=1) - made.probe)
    order = np.lexsort((-np.arange(len(corner)), -np.round(off, 6)))  # the last one counts: the nearest, of these the first
    mean, gaussian = (np.zeros(len(x), dtype=np.float32) for _ in range(2))
    mean[corner[order]] = 0.5 * (along + around)[order]
    gaussian[corner[order]] = (along * around)[order]
    return mean, gaussian
