#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""measure_mesh.py FILE.xyzr [--probe R] [--density D | --tolerance T [--patches]]: one mesh of the exact surface of these
balls (x y z r) by the Python package, and how good it is, on one line each: triangles, seconds and CPU seconds, errors of
area and volume, distances in Å both ways, smallest angles, aspect, edges that are not shared by two triangles, zero areas
in single precision and after rounding to 0.001 Å. With --off PATH the mesh is written, for `tetgen -d`."""

import argparse
import resource
import time

import meniscus
import numpy as np
from scipy.spatial import cKDTree

PLACES = np.array([(1, 1, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4), (1, 1, 0), (0, 1, 1), (1, 0, 1)], dtype=float)
PLACES /= PLACES.sum(axis=1, keepdims=True)


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def edges_of(corners):
    return np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)


def areas_of(corners):
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2


def smallest_angles(corners):
    smallest = np.full(len(corners), 180.0)
    for k in range(3):
        u, v = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        sine, cosine = np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v)
        smallest = np.minimum(smallest, np.degrees(np.arctan2(sine, cosine)))
    return smallest


def distance_to_triangles(points, corners):
    """Of each point to the triangle of the same row (Ericson, Real-Time Collision Detection, 2005, section 5.1.5)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    size = np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    above = np.einsum("ij,ij->i", points - a, normal / size)
    inside = np.ones(len(points), dtype=bool)
    nearest = np.full(len(points), np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        edge = q - p
        inside &= np.einsum("ij,ij->i", np.cross(edge, points - p), normal) >= 0
        share = np.clip(np.einsum("ij,ij->i", points - p, edge) / np.maximum((edge ** 2).sum(axis=1), 1e-300), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(points - p - share[:, None] * edge, axis=1))
    return np.where(inside, np.abs(above), nearest)


def bounds_from_mesh(points, vertices, triangles, near=12):
    """The distance of each point to the triangles at its nearest vertices: no less than that to the mesh."""
    order = np.argsort(triangles.ravel(), kind="stable")
    starts = np.searchsorted(triangles.ravel()[order], np.arange(len(vertices) + 1))
    best = np.full(len(points), np.inf)
    _, vertex = cKDTree(vertices).query(points, k=near)
    for column in vertex.T:
        for turn in range(int((starts[column + 1] - starts[column]).max())):
            has = starts[column] + turn < starts[column + 1]
            triangle = order[starts[column[has]] + turn] // 3
            best[has] = np.minimum(best[has], distance_to_triangles(points[has], vertices[triangles[triangle]]))
    return best


def farthest_from_mesh(points, vertices, triangles, together=100):
    """The largest distance of the points from the mesh. Small triangles may crowd around a point whose nearest triangle
    has no vertex nearby, so the largest bounds are replaced by distances until one is no less than all bounds left."""
    bounds = bounds_from_mesh(points, vertices, triangles)
    corners = vertices[triangles]
    middles = corners.mean(axis=1)
    reach = np.linalg.norm(corners - middles[:, None], axis=2).max()
    tree = cKDTree(middles)
    largest = 0.0
    order = np.argsort(-bounds)
    for first in range(0, len(order), together):
        if largest >= bounds[order[first]]:
            break
        for i in order[first:first + together]:
            candidates = tree.query_ball_point(points[i], bounds[i] + reach + 1e-9)
            distance = distance_to_triangles(np.broadcast_to(points[i], (len(candidates), 3)), corners[candidates]).min()
            largest = max(largest, min(distance, bounds[i]))
    return largest


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument("--probe", type=float, default=1.4)
    parser.add_argument("--density", type=float, default=0.0)
    parser.add_argument("--tolerance", type=float, default=0.05)
    parser.add_argument("--patches", action="store_true")
    parser.add_argument("--off")
    parser.add_argument("--quick", action="store_true", help="no distances")
    options = parser.parse_args()
    balls = np.loadtxt(options.file)
    surface = meniscus.surface(balls[:, :3], balls[:, 3], probe=options.probe)
    began, cpu = time.perf_counter(), cpu_seconds()
    fineness = {"density": options.density} if options.density else {"tolerance": options.tolerance,
                                                                     "even": not options.patches}
    mesh = surface.mesh(split_colors=False, **fineness)
    took, cpu = time.perf_counter() - began, cpu_seconds() - cpu
    vertices, triangles = np.array(mesh.vertices), np.array(mesh.triangles, dtype=np.int64)
    corners = vertices[triangles]
    area = areas_of(corners)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    print(f"triangles {len(triangles):,}  vertices per Å² {len(vertices) / surface.area:.3f}  s {took:.2f}  CPU s {cpu:.2f}")
    print(f"area error {100 * (area.sum() / surface.area - 1):+.3f} %  volume error "
          f"{100 * (volume / surface.volume - 1):+.4f} %")
    angles, edges = smallest_angles(corners), edges_of(corners)
    with np.errstate(divide="ignore"):
        aspect = edges.max(axis=1) ** 2 / (2 * area)  # longest edge over the height on it
    p = np.percentile(angles, [0, 1, 5, 50])
    print(f"angles min {p[0]:.2f} p1 {p[1]:.1f} p5 {p[2]:.1f} median {p[3]:.1f}  below 5° {100 * (angles < 5).mean():.4f} %"
          f"  below 1° {(angles < 1).sum()}  aspect {aspect.max():.3g}")
    edge, count = np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]),
                                    axis=1), axis=0, return_counts=True)
    single = areas_of(corners.astype(np.float32).astype(float))
    rounded = areas_of(np.round(corners, 3))
    print(f"edges without two triangles {(count != 2).sum()}  Euler {len(vertices) - len(edge) + len(triangles)} of "
          f"{int(surface.components['euler'].sum())}  zero areas: single precision {(single == 0).sum()}, at 0.001 Å "
          f"{(rounded < 1e-9).sum()}  edges {edges.min():.4f} to {edges.max():.3f} Å")
    if not options.quick:
        middle, _ = corners.mean(axis=1), None
        at_middle = np.abs(surface.distance(middle))
        forward = np.abs(surface.distance(np.einsum("pk,tkc->tpc", PLACES, corners).reshape(-1, 3)))
        samples = np.array(surface.mesh(0.01, split_colors=False).vertices)
        back = farthest_from_mesh(samples, vertices, triangles)
        print(f"Å: vertices {np.abs(surface.distance(vertices)).max():.1e}  middles max {at_middle.max():.4f} mean "
              f"{at_middle.mean():.4f}  mesh to surface {forward.max():.4f}  surface to mesh {back:.4f}")
    if options.off:
        with open(options.off, "w", encoding="ascii") as file:
            file.write(f"OFF\n{len(vertices)} {len(triangles)} 0\n")
            np.savetxt(file, vertices, "%.17g")
            np.savetxt(file, np.column_stack([np.full(len(triangles), 3), triangles]), "%d")


if __name__ == "__main__":
    main()
