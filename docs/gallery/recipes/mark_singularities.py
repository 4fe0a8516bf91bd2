#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""mark_singularities.py SCENE [--uncut]: colours the singular patches of a scene of `meniscus export povray` green.

A patch is singular where a torus crosses its own axis, or where the sphere of another fixed probe cuts the concave patch.
--uncut takes those cuts away, which shows what the surface would be without them (figure 3 of Krone, Dachsbacher and
Ertl 2010). The scene has to be one of a surface alone, without --clip. Changes surface_geometry.inc in place."""

import pathlib
import re
import sys

import numpy as np

GREEN = "texture{Meniscus_Solvent_Side[0][0] pigment{color srgb <0.13,0.62,0.27>}}"
GREEN += "interior_texture{Meniscus_Solvent_Side[0][0] pigment{color srgb <0.13,0.62,0.27>}}"
NUMBER = r"(-?[\d.]+(?:e-?\d+)?)"
PLANE = re.compile(rf"plane{{<{NUMBER},{NUMBER},{NUMBER}>,{NUMBER}}}")
BOX = re.compile(r"box{[^{}]*}")
LEMON = re.compile(r"(sphere{[^{}]*?) inverse}")


def directions(count=20000):
    """Points of the unit sphere, evenly: a Fibonacci lattice."""
    height = 1 - (2 * np.arange(count) + 1) / count
    angle = np.pi * (3 - 5**0.5) * np.arange(count)
    across = np.sqrt(1 - height**2)
    return np.stack([across * np.cos(angle), across * np.sin(angle), height], axis=1)


def concave(line, radius, places, uncut):
    """The line of a concave patch; green if a bisector cuts it. Side planes go through the probe, bisectors do not."""
    center = np.array([float(word) for word in re.match(r"sphere{<([^>]*)>", line).group(1).split(",")])
    planes = PLANE.findall(line)
    normals = np.array([[float(word) for word in plane[:3]] for plane in planes])
    gaps = np.array([float(plane[3]) for plane in planes]) - normals @ center
    sides = np.abs(gaps) < 1e-3
    within = np.all(places @ normals[sides].T < 0, axis=1)
    beyond = np.any(radius * places[within] @ normals[~sides].T > gaps[~sides], axis=1)
    if not beyond.any():
        return line
    if uncut:
        kept = "".join(match.group(0) for match, side in zip(PLANE.finditer(line), sides) if side)
        line = re.sub(r"clipped_by{.*}}$", f"clipped_by{{{kept}}}}}", line)
    return f"{line[:-1]}{GREEN}}}"


def toroidal(line, uncut):
    """The line of a toroidal patch that crosses its axis, green; uncut with the part past the axis, which lies in the
    opposite wedge within the sphere through both cusps."""
    green = f"{line[:-1]}{GREEN}}}"
    if not uncut:
        return green
    normals = [np.array([float(word) for word in plane[:3]]) for plane in PLANE.findall(line)]
    axis = np.array([float(word) for word in re.search(r"matrix<([^>]*)>", line).group(1).split(",")])[3:6]
    past = BOX.sub("", LEMON.sub(r"\1}", green))
    for match, normal in zip(list(PLANE.finditer(past)), normals):
        if abs(normal @ axis) < 0.5:
            past = past.replace(match.group(0), match.group(0)[:-1] + " inverse}")
    return f"{green}\n{past}"


def main():
    path = pathlib.Path(sys.argv[1]) / "surface_geometry.inc"
    uncut = "--uncut" in sys.argv[2:]
    text = path.read_text()
    probe = re.search(r"^// Probe radius ([\d.]+) Å", text, re.M).group(1)
    places, lines = directions(), []
    for line in text.splitlines():
        if line.startswith("sphere{") and re.match(rf"sphere{{<[^>]*>,{re.escape(probe)} ", line):
            line = concave(line, float(probe), places, uncut)
        elif line.startswith("torus{") and LEMON.search(line):
            line = toroidal(line, uncut)
        lines.append(line)
    path.write_text("\n".join(lines) + "\n")
    print(f"{sum(GREEN in line for line in lines)} singular patches of {sum(line.endswith('}}') for line in lines)}")


if __name__ == "__main__":
    main()
