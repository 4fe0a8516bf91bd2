# SPDX-License-Identifier: BSD-3-Clause
"""Damaged .mns files and manifests for the readers of the Blender add-on: arguments ADDON_FOLDER [CASES [SEED]].

Bytes, numbers of arrays, and values of the header change by a seeded generator, the checksum always being right. What
is read then must be sound; what is refused must be refused with MnsError, which names the file."""

import copy
import json
import os
import random
import struct
import sys
import tempfile
import traceback

ADDON = sys.argv[1]
CASES = int(sys.argv[2]) if len(sys.argv) > 2 else 4000
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 11
sys.path[:0] = [os.path.join(ADDON, "meniscus_import"),
                os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "export", "blender")]

import numpy as np  # noqa: E402

import mns_reader  # noqa: E402
import samples  # noqa: E402
import sequence_reader  # noqa: E402

#: What takes the place of a value; "deep" is nested beyond any stack.
ODD_VALUES = [None, True, 0, -1, 1.5, 2**31, 2**32, 2**63, 10**30, 10**400, -0.0, 1e308, float("nan"), float("inf"), "",
              "nan", "\u0000", [], {}, [[]], [1, 2], [1e200] * 12, [0] * 3, ["a"] * 3, [10**400] * 3, [[0] * 12],
              [[0] * 24], [[float("nan")] * 12], [{}], "<i4", "<f4", "|u1"]


def small_surface():
    """A tetrahedron of one atom, as a whole file."""
    arrays = {
        "mesh.position": np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], "<f4"),
        "mesh.normal": np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], "<f4"),
        "mesh.triangle": np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], "<u4"),
        "mesh.kind": np.zeros(4, "|u1"), "mesh.patch": np.zeros(4, "<u4"), "mesh.component": np.zeros(4, "<u4"),
        "mesh.atom": np.zeros(4, "<u4"), "mesh.sharp_corner": np.array([5], "<u4"),
        "mesh.sharp_corner_normal": np.array([[0, 0, 1]], "<f4"), "mesh.sharp_edge": np.array([[0, 1]], "<u4"),
        "mesh.velocity": np.zeros((4, 3), "<f4"),
        "atom.center": np.zeros((1, 3), "<f8"), "atom.radius": np.ones(1, "<f8"), "atom.color": np.ones((1, 3), "<f4"),
        "atom.index": np.zeros(1, "<u4"), "atom.chain_id": np.zeros(1, "<u4"),
    }
    body, entries = b"", []
    for name, array in arrays.items():
        entries.append({"name": "0/" + name, "type": array.dtype.str, "rows": len(array),
                        "columns": 1 if array.ndim == 1 else array.shape[1], "offset": len(body)})
        body += array.tobytes().ljust((array.nbytes + 63) // 64 * 64, b"\0")
    header = {"generator": "test", "probe_radius": 1.4, "arrays": entries,
              "objects": [{"name": "A", "prefix": "0/", "copies": [mns_reader.IDENTITY], "chain_names": ["A"],
                           "components": [{"kind": "outer", "euler": 2}],
                           "mesh": {"vertices": 4, "triangles": 4, "origin": [0.0, 0.0, 0.0], "closed": True}}]}
    prologue = mns_reader.MAGIC + struct.pack("<IIQQ", 2, 0, 0, 0)
    text = b"{}".ljust(64)
    return samples.with_header(prologue[:16] + struct.pack("<Q", len(text)) + bytes(40) + text + body, header)


def small_manifest():
    camera = {"position": [0, 0, 9], "target": [0, 0, 0], "up": [0, 1, 0], "projection": "perspective",
              "vertical_fov": 30, "size": [64, 48]}
    return {"format": "meniscus surface sequence", "version": 1, "run": "r", "origin": [0, 0, 0], "scale": 0.1,
            "fps": 24, "camera": camera, "frames": [{"frame": n, "file": f"surface_{n:05}.mns"} for n in range(3)]}


def places_in(value, place=()):
    """The paths to all values of a tree of dicts and lists but its root."""
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
        yield place + (key,)
        if isinstance(inner, (dict, list)):
            yield from places_in(inner, place + (key,))


def with_odd_value(tree, rng):
    tree = copy.deepcopy(tree)
    place = rng.choice(list(places_in(tree)))
    holder = tree
    for key in place[:-1]:
        holder = holder[key]
    action = rng.randrange(8)
    if action == 0:
        del holder[place[-1]]
    elif action == 1 and isinstance(holder, list):
        holder.append(copy.deepcopy(holder[place[-1]]))
    else:
        holder[place[-1]] = copy.deepcopy(rng.choice(ODD_VALUES))
    return tree


def damaged(data, rng):
    """One of: header values, numbers in arrays, any bytes, another end, deep nesting."""
    header, size = samples.header_of(data)
    action = rng.randrange(10)
    if action < 6:
        for _ in range(rng.randint(1, 3)):
            header = with_odd_value(header, rng) if header else header
        return samples.with_header(data, header)
    result = bytearray(data)
    if action < 8:
        for _ in range(rng.randint(1, 4)):
            at = rng.randrange(64 + size, len(result) - 4)
            result[at:at + 4] = struct.pack("<I", rng.choice([0, 1, 3, 4, 0x7fc00000, 0x7f800000, 0x80000000, 0xffffffff]))
        return samples.with_right_checksum(result)
    if action == 8:
        for _ in range(rng.randint(1, 6)):
            result[rng.randrange(len(result))] = rng.randrange(256)
        return samples.with_right_checksum(result) if rng.random() < 0.8 else bytes(result)
    end = bytes(result[:rng.randrange(len(result))]) if rng.random() < 0.7 else bytes(result) + bytes(rng.randrange(99))
    return samples.with_right_checksum(end) if len(end) > 64 else end


def deeply_nested(data):
    text = (b"[" * 200_000).ljust(200_064)
    prologue = bytearray(data[:64])
    struct.pack_into("<Q", prologue, 16, len(text))
    return samples.with_right_checksum(bytes(prologue) + text)


def check_file(path):
    """What the add-on relies on in a file that was read."""
    file = mns_reader.read(path)
    for surface in file.objects:
        vertices = len(surface["mesh.position"])
        triangle = surface["mesh.triangle"]
        assert triangle.dtype.kind in "iu" and 0 <= int(triangle.min()) and int(triangle.max()) < vertices
        assert all(np.isfinite(array).all() for array in surface.arrays.values() if array.dtype.kind == "f")
        assert all(np.allclose(turn[:, :3] @ turn[:, :3].T, np.eye(3), atol=1e-5) for turn in surface.copies)
        assert all(isinstance(part["kind"], str) for part in surface.header["components"])
        assert len(surface.header["mesh"]["origin"]) == 3
        mns_reader.is_closed(triangle)
        mns_reader.signed_volume(surface["mesh.position"], triangle)


def check_manifest(path):
    sequence = sequence_reader.read(path)
    assert np.isfinite(sequence.origin).all() and sequence.scale > 0 and sequence.fps > 0
    folder = os.path.dirname(path)
    assert all(os.path.dirname(frame.path) == folder for frame in sequence.frames)
    assert sequence_reader.Timing().place(1.0, len(sequence.frames)) == 1 and isinstance(sequence.camera_moves, bool)


def holds(check, path):
    """Is the file read soundly, or refused with one sentence that names it? Prints what else happened."""
    try:
        check(path)
    except mns_reader.MnsError as error:
        if path in str(error):
            return True
        print(f"the refusal names no file: {error}")
    except Exception:  # whatever else escapes is what this test is for
        traceback.print_exc()
    else:
        return True
    return False


def main():
    rng = random.Random(SEED)
    data, manifest = small_surface(), small_manifest()
    failures = cases = refused = 0
    with tempfile.TemporaryDirectory() as folder:
        path, list_path = os.path.join(folder, "a.mns"), os.path.join(folder, "a.json")

        def try_bytes(target, content, check):
            nonlocal cases, failures
            with open(target, "wb") as file:
                file.write(content)
            cases += 1
            if not holds(check, target):
                failures += 1
                print(f"case {cases} of seed {SEED}")

        try_bytes(path, data, check_file)
        mns_reader.read(path)  # the sample itself is sound
        try_bytes(path, deeply_nested(data), check_file)
        try_bytes(list_path, json.dumps(manifest).encode(), check_manifest)
        sequence_reader.read(list_path)
        try_bytes(list_path, b"[" * 200_000, check_manifest)
        while cases < CASES and failures < 10:
            if rng.random() < 0.75:
                try_bytes(path, damaged(data, rng), check_file)
            else:
                odd = with_odd_value(with_odd_value(manifest, rng), rng)
                try_bytes(list_path, json.dumps(odd).encode(), check_manifest)
    print(f"cases {cases} failures {failures}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
