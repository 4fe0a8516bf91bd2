#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the normals of one view between the ray caster, POV-Ray and Blender.

  compare_pictures.py RAY_CAST.exr POVRAY_NORMAL.png BLENDER_PASSES.exr [--json]

Every picture has one normal a pixel, taken at the pixel's centre: the EXR of `meniscus render --aovs`, the buffer
`povray surface.ini[normal]`, and the passes of render_mns.py. A pixel differs if only one picture shows the surface
there, or if the normals are more than 2 degrees apart. Prints one line. Needs numpy and OpenImageIO's Python module.
"""

import argparse
import json
import sys

import numpy
import OpenImageIO as oiio

LIMIT_DEGREES = 2.0


def read(path):
    """Returns all channels of a picture as float, and their names."""
    picture = oiio.ImageInput.open(path)
    if picture is None:
        sys.exit(f"compare_pictures: error: {path}: {oiio.geterror()}")
    pixels = picture.read_image("float")
    names = list(picture.spec().channelnames)
    picture.close()
    return pixels, names


def channels(pixels, names, *wanted):
    """Returns the named channels, whatever layer the writer put before their names."""
    found = []
    for name in wanted:
        matches = [n for n, full in enumerate(names) if full == name or full.endswith("." + name)]
        if not matches:
            sys.exit(f"compare_pictures: error: no channel {name} among {', '.join(names)}")
        found.append(pixels[..., matches[0]])
    return numpy.stack(found, axis=-1)


def ray_cast_normals(path):
    pixels, names = read(path)
    normals = channels(pixels, names, "N.x", "N.y", "N.z")
    return normals, numpy.isfinite(channels(pixels, names, "Z")[..., 0])


def povray_normals(path):
    pixels, _ = read(path)
    # The export's _aov.inc has rgb = asin(normal) / pi + 1/2.
    return numpy.sin((pixels[..., :3] - 0.5) * numpy.pi), pixels[..., 3] > 0.5


def blender_normals(path):
    pixels, names = read(path)
    normals = channels(pixels, names, "Normal.X", "Normal.Y", "Normal.Z")
    return normals, numpy.linalg.norm(normals, axis=-1) > 0.5


def differing_share(a, b):
    """Returns the share of the pixels of either picture that differ, and the number that differ in coverage only."""
    (normal_a, hit_a), (normal_b, hit_b) = a, b
    if normal_a.shape != normal_b.shape:
        sys.exit(f"compare_pictures: error: pictures of {normal_a.shape[:2]} and {normal_b.shape[:2]} pixels")
    both = hit_a & hit_b
    cosine = numpy.sum(normal_a * normal_b, axis=-1)
    cosine /= numpy.maximum(numpy.linalg.norm(normal_a, axis=-1) * numpy.linalg.norm(normal_b, axis=-1), 1e-9)
    apart = both & (cosine < numpy.cos(numpy.radians(LIMIT_DEGREES)))
    shown = numpy.count_nonzero(hit_a | hit_b)
    coverage = numpy.count_nonzero(hit_a ^ hit_b)
    return {"pixels": int(shown), "coverage": int(coverage), "normal": int(numpy.count_nonzero(apart)),
            "share": (coverage + numpy.count_nonzero(apart)) / max(1, shown)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ray_cast")
    parser.add_argument("povray")
    parser.add_argument("blender")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    ours = ray_cast_normals(arguments.ray_cast)
    result = {"povray": differing_share(ours, povray_normals(arguments.povray)),
              "blender": differing_share(ours, blender_normals(arguments.blender))}
    if arguments.json:
        print(json.dumps(result))
        return
    print("of the {:,} pixels that show the surface, {:.3f} % differ in POV-Ray and {:.3f} % in Blender "
          "(normal by more than {:g} degrees, or outline)".format(
              result["povray"]["pixels"], 100 * result["povray"]["share"], 100 * result["blender"]["share"],
              LIMIT_DEGREES))


if __name__ == "__main__":
    main()
