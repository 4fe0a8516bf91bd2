# SPDX-License-Identifier: BSD-3-Clause
"""Damaged .mns files and manifests for the readers of the Blender add-on: arguments ADDON_FOLDER [CASES [SEED]].

Each value of a header is replaced by each odd value. Bytes, numbers of arrays, and values of headers also change by a seeded
generator. The checksum is always right. What is read then must be sound; what is refused must be refused with MnsError, which
names the file."""

import copy
import json
import os
import random
import struct
import sys
import tempfile
import traceback
import types
import warnings

ADDON = sys.argv[1]
CASES = int(sys.argv[2]) if len(sys.argv) > 2 else 4000
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 11
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "export", "blender"))
package = sys.modules["meniscus_import"] = types.ModuleType("meniscus_import")  # without the add-on itself, which needs Blender
package.__path__ = [os.path.join(ADDON, "meniscus_import")]

import numpy as np  # noqa: E402

import samples  # noqa: E402
from meniscus_import import joined, mesh_arrays, mns_reader, sequence_reader  # noqa: E402

warnings.simplefilter("error")  # A number that overflows would become another one.

def small_manifest():
    return {"format": "meniscus surface sequence", "version": 1, "run": "r", "origin": [0, 0, 0], "scale": 0.1,
            "fps": 24, "camera": samples.CAMERA, "atoms": 1, "source": {"file": "a.pdb"}, "frames": [{"frame": n, "file": f"surface_{n:05}.mns"} for n in range(3)]}


def with_odd_value(tree, rng):
    tree = copy.deepcopy(tree)
    place = rng.choice(list(samples.places_in(tree)))
    holder = tree
    for key in place[:-1]:
        holder = holder[key]
    action = rng.randrange(8)
    if action == 0:
        del holder[place[-1]]
    elif action == 1 and isinstance(holder, list):
        holder.append(copy.deepcopy(holder[place[-1]]))
    else:
        holder[place[-1]] = copy.deepcopy(rng.choice(samples.ODD_VALUES))
    return tree


def damaged(data, rng):
    """Changes header values, numbers in arrays, or any bytes, or sets another end or deep nesting."""
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
    """Checks the properties of a file that the add-on relies on."""
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
        samples.signed_volume(surface["mesh.position"], triangle)
        check_arrays(file, surface)


def check_arrays(file, surface):
    """Checks that the numbers for Blender are finite, for the object alone and joined."""
    try:
        parts = [surface, joined.joined(file, np.zeros(3)), *(part for _, part in joined.by_role(surface))]
        for part in parts:
            arrays = mesh_arrays.of_surface(part, 0.1, True, mesh_arrays.names_of(part))
            assert all(np.isfinite(values).all() for values in (arrays.positions, *(each[3] for each in arrays.attributes)))
            assert all(abs(float(part.header.get(key, 0.0))) < 1e38 for key in ("probe_radius", "area", "volume"))
            part.header.get("source", {}).get("file", "")
    except mns_reader.MnsError as error:
        assert file.objects[0].path in str(error), error


def check_manifest(path):
    sequence = sequence_reader.read(path)
    assert np.isfinite(sequence.origin).all() and sequence.scale > 0 and sequence.fps > 0
    folder = os.path.dirname(path)
    assert all(os.path.dirname(frame.path) == folder for frame in sequence.frames)
    int(sequence.header.get("atoms", 0)), sequence.header.get("source", {}).get("file", ""), sequence.run.encode(), round(sequence.fps)
    assert all(type(value) is int for frame in sequence.frames for value in (frame.camera or {}).get("size", ()))
    assert sequence_reader.Timing().place(1.0, len(sequence.frames)) == 1 and isinstance(sequence.camera_moves, bool)


def small_storyboard():
    scenes = [{"name": f"scene {n}", "title": "A", "file": f"{n}.mns", "first": 10 * n + 1, "last": 10 * n + 5, "camera": samples.CAMERA,
               "background": [1.0, 1.0, 1.0]} for n in range(2)]
    return {"format": "meniscus storyboard", "version": 1, "origin": [0, 0, 0], "scale": 0.1, "fps": 24, "ease": "smooth", "scenes": scenes}


def check_storyboard(path):
    board = sequence_reader.read_storyboard(path)
    assert np.isfinite(board.origin).all() and 0 < board.scale < 1e10 and 0 < board.fps < 1e10
    for scene in board.scenes:
        (scene.name + scene.title).encode()
        assert all(type(value) is int for value in scene.camera.get("size", ()))


def holds(check, path):
    """Returns whether the file is read soundly or refused with one sentence that names it; prints anything else."""
    try:
        check(path)
    except mns_reader.MnsError as error:
        if path in str(error):
            return True
        print(f"the refusal names no file: {error}")
    except Exception:  # This test looks for any other exception.
        traceback.print_exc()
    else:
        return True
    return False


def main():
    rng = random.Random(SEED)
    data, cut, manifest, story = samples.small_surface(False), samples.small_surface(True), small_manifest(), small_storyboard()
    packed = samples.packed(cut)
    failures = cases = 0
    with tempfile.TemporaryDirectory() as folder:
        path, list_path, story_path = (os.path.join(folder, name) for name in ("a.mns", "a.json", "story.json"))

        def try_bytes(target, content, check, words=""):
            nonlocal cases, failures
            with open(target, "wb") as file:
                file.write(content)
            cases += 1
            if not holds(check, target):
                failures += 1
                print(f"case {cases} of seed {SEED} {words}")

        for sound in (data, cut, packed):
            try_bytes(path, sound, check_file)
            mns_reader.read(path)  # the sample itself is sound
        try_bytes(path, deeply_nested(data), check_file)
        try_bytes(list_path, json.dumps(manifest).encode(), check_manifest)
        sequence_reader.read(list_path)
        try_bytes(list_path, b"[" * 200_000, check_manifest)
        try_bytes(story_path, json.dumps(story).encode(), check_storyboard)
        sequence_reader.read_storyboard(story_path)
        for sound in (data, cut):
            for words, odd in samples.odd_headers(sound):
                try_bytes(path, odd, check_file, words)
        for _ in range(CASES if failures < 10 else 0):
            what = rng.random()
            if what < 0.7:
                try_bytes(path, damaged(rng.choice((data, cut, packed)), rng), check_file)
            elif what < 0.85:
                odd = with_odd_value(with_odd_value(manifest, rng), rng)
                try_bytes(list_path, json.dumps(odd).encode(), check_manifest)
            else:
                try_bytes(story_path, json.dumps(with_odd_value(story, rng)).encode(), check_storyboard)
    print(f"cases {cases} failures {failures}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
