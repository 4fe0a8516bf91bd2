# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures a surface of libmeniscus at vertices of a mesh and at atoms, and returns arrays of .mns files."""

import numpy as np

#: Points nearer than this (Å) to the axis of a spindle torus get the curvature at this distance, as in Meniscus.
CORE = 0.001


def of_surface(library, made, mesh):
    """Returns arrays by their names in .mns files. made, mesh: a surface and a mesh of the package `library`."""
    mean, gaussian = curvatures(made, mesh)
    arrays = {"mesh.mean_curvature": mean, "mesh.gaussian_curvature": gaussian}
    try:
        arrays["atom.area"] = made.atom_areas.astype(np.float32)
        arrays["atom.accessible_area"] = (made.atom_sas_areas.astype(np.float32) if made.kind == "ses" else
                                          arrays["atom.area"])
    except library.Error:
        pass  # the areas of the atoms do not add up, so they are left out rather than wrong
    return arrays


def curvatures(made, mesh):
    """Returns the mean and the Gaussian curvature at vertices, in 1/Å and 1/Å². Among the patches of a vertex's
    triangles, the one that it lies on counts."""
    corner, x = mesh.triangles.ravel(), mesh.vertices
    kind, patch = np.repeat(mesh.triangle_kinds, 3), np.repeat(mesh.triangle_patches, 3)
    # The principal curvatures, and the distance from the surface of the patch in Å.
    along, around, off = (np.zeros(len(corner)) for _ in range(3))
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
        off[concave] = np.abs(
            np.linalg.norm(x[corner[concave]] - patches.concave["center"][patch[concave]], axis=1) - made.probe)
    # The last assignment to a vertex counts: that of the nearest patch, and of equally near ones the first.
    order = np.lexsort((-np.arange(len(corner)), -np.round(off, 6)))
    mean, gaussian = (np.zeros(len(x), dtype=np.float32) for _ in range(2))
    mean[corner[order]] = 0.5 * (along + around)[order]
    gaussian[corner[order]] = (along * around)[order]
    return mean, gaussian
