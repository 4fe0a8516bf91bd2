# SPDX-License-Identifier: BSD-3-Clause
"""The recipe of docs/how-to/electrostatics.md, word for word: from a PDB file to a picture of its potential, and the values
that a mesh gets of it have the signs that charged side chains give them."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

for tool in ("apbs", "pdb2pqr"):
    if not shutil.which(tool):
        print(f"skipped: there is no {tool}; Debian has it")
        sys.exit(77)

PROGRAM, PAGE = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))


def run(words, folder):
    result = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=600)
    assert result.returncode == 0, (words, result.stderr[-2000:], result.stdout[-2000:])
    return result.stderr


def vertices_of(path):
    """Returns positions and map values of a binary PLY file."""
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
    first = next(n for n, line in enumerate(lines) if line.startswith("element vertex"))
    types = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4", "uint": "<u4", "ushort": "<u2", "short": "<i2"}
    fields = []
    for line in lines[first + 1 :]:
        if not line.startswith("property"):
            break
        _, kind, name = line.split()
        fields.append((name, types[kind]))
    table = numpy.frombuffer(body, numpy.dtype(fields), count)
    return numpy.stack([table[axis] for axis in "xyz"], axis=1), table["map_value"]


class Electrostatics(unittest.TestCase):
    def test_the_recipe_as_it_is_written(self):
        block = re.search(r"```\n(.*?)```", PAGE.read_text(), re.S).group(1)
        commands = [line.split("#")[0].split() for line in block.splitlines()]
        self.assertEqual([words[0] for words in commands], ["pdb2pqr", "apbs", "meniscus"])
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for words in commands:
                said = run([PROGRAM] + words[1:] if words[0] == "meniscus" else words, folder)
                if words[0] == "meniscus":
                    # The surface holds all atoms that the map was computed from, and the map covers the surface.
                    self.assertNotIn("warning", said)
            pixels = OpenImageIO.ImageInput.open(str(folder / "potential.png")).read_image("float")[..., :3]
            molecule = pixels[:, : pixels.shape[1] * 3 // 4]
            red = (molecule[..., 0] > molecule[..., 2] + 0.2).mean()
            blue = (molecule[..., 2] > molecule[..., 0] + 0.2).mean()
            self.assertGreater(red, 0.03)
            self.assertGreater(blue, 0.03)
            words = commands[2]
            words = [PROGRAM, "export", "ply"] + [w for w in words[2:] if w not in ("--legend", "--background", "white")]
            words[words.index("potential.png")] = "potential.ply"
            run(words + ["--tolerance", "0.1", "-q"], folder)
            self.check_pixels(folder, commands[2])
            self.check_that_waters_are_missed(folder, commands)
            positions, values = vertices_of(folder / "potential.ply")
            means = {}
            for line in (folder / "1ubq.pqr").read_text().splitlines():
                name, residue = line[12:16].strip(), line[17:20]
                if not line.startswith("ATOM") or (name, residue) not in (("NZ", "LYS"), ("OE1", "GLU"), ("OD1", "ASP")):
                    continue
                place = numpy.array([float(word) for word in line.split()[5:8]])
                near = numpy.linalg.norm(positions - place, axis=1) < 3.0
                if near.sum() > 50:
                    means.setdefault(residue, []).append(numpy.nanmean(values[near]))
            self.assertGreater(numpy.median(means["LYS"]), 1.0)
            self.assertLess(numpy.median(means["GLU"] + means["ASP"]), -1.0)

    def check_pixels(self, folder, recipe):
        """Checks a picture without light against colours that numpy looks up in the map at the end of each ray."""
        words = [PROGRAM, *recipe[1:], "--preset", "flat", "--silhouettes", "0", "--aovs", "--samples", "1", "--size", "160x120", "-q"]
        words = [w for w in words if w not in ("--legend", "--background", "white")]
        words[words.index("potential.png")] = "flat.exr"
        run(words, folder)
        image = OpenImageIO.ImageInput.open(str(folder / "flat.exr"))
        names = list(image.spec().channelnames)
        pixels = dict(zip(names, numpy.moveaxis(numpy.asarray(image.read_image("float")), 2, 0)))
        image.close()
        hit = numpy.isfinite(pixels["Z"]) & (pixels["A"] > 0.99)
        self.assertGreater(hit.sum(), 3000)
        points = numpy.stack([pixels[f"P.{axis}"][hit] for axis in "xyz"], axis=1).astype(float)
        low, high = (float(word) for word in next(w for w in recipe if w.startswith("--color-range=")).split("=")[1].split(":"))
        share = numpy.clip((self.looked_up(folder / "1ubq.pqr-PE0.dx", points) - low) / (high - low), 0.0, 1.0)[:, None]
        red, white, blue = (numpy.array(color) / 255.0 for color in ((0xD2, 0x32, 0x2A), (255, 255, 255), (0x2A, 0x4F, 0xD7)))
        color = numpy.where(share < 0.5, red + (white - red) * 2 * share, white + (blue - white) * (2 * share - 1))
        linear = numpy.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)
        shown = numpy.stack([pixels[channel][hit] for channel in "RGB"], axis=1)
        self.assertLess(numpy.abs(shown - linear).max(), 0.005)

    @staticmethod
    def looked_up(path, points):
        """Returns trilinear values of an OpenDX map."""
        counts = origin = None
        steps, numbers = [], []
        for line in path.read_text().splitlines():
            words = line.split()
            if "gridpositions" in line:
                counts = [int(word) for word in words[-3:]]
            elif words[:1] == ["origin"]:
                origin = numpy.array([float(word) for word in words[1:]])
            elif words[:1] == ["delta"]:
                steps.append(max(float(word) for word in words[1:]))
            elif words and re.match(r"[-+]?[0-9]", words[0]):
                numbers.extend(words)
        grid = numpy.array(numbers, float).reshape(counts)
        places = (points - origin) / steps
        base = numpy.floor(places).astype(int)
        share = places - base
        value = 0.0
        for corner in numpy.ndindex(2, 2, 2):
            weight = numpy.where(corner, share, 1.0 - share).prod(axis=1)
            value = value + weight * grid[tuple((base + corner).T)]
        return value

    def check_that_waters_are_missed(self, folder, commands):
        """Checks that an earlier recipe, whose waters have charges, is noticed."""
        words = [word for word in commands[0] if word not in ("--drop-water", "1ubq.pqr") and "--apbs" not in word]
        run(words + ["water.pqr"], folder)
        small = ["--force", "--size", "320x240"]
        said = run([PROGRAM] + ["water.pqr" if word == "1ubq.pqr" else word for word in commands[2][1:]] + small, folder)
        self.assertIn("58 atoms with charges are left out of the surface (58 water atoms)", said)


if __name__ == "__main__":
    unittest.main()
