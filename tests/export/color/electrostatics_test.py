# SPDX-License-Identifier: BSD-3-Clause
"""The recipe of docs/electrostatics.md, word for word: from a PDB file to a picture of its potential, and the values
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


def vertices_of(path):
    """Positions and map values of a binary PLY file."""
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
                words = [PROGRAM] + words[1:] + ["-q"] if words[0] == "meniscus" else words
                run(words, folder)
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


if __name__ == "__main__":
    unittest.main()
