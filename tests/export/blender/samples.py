# SPDX-License-Identifier: BSD-3-Clause
"""Small surfaces for the tests of the Blender add-on, and ways to damage their files."""

import copy
import json
import os
import re
import struct
import subprocess
import zlib

import numpy as np

#: A ring, two drops with tips, every kind of patch, and a shell of carbon around a cavity (an icosahedron).
MOLECULES = {
    "pair": [(0, 0, 0, 1.7), (4.0, 0, 0, 1.7)],
    "drops": [(0, 0, 0, 1.7), (5.8, 0, 0, 1.7)],
    "triple": [(0, 0, 0, 1.7), (3.9, 0, 0, 1.55), (1.7, 3.6, 0.4, 1.52)],
}


def icosahedron(edge):
    g = (1 + 5 ** 0.5) / 2
    points = []
    for a in (-1, 1):
        for b in (-g, g):
            points += [(0, a, b), (a, b, 0), (b, 0, a)]
    return [(x * edge / 2, y * edge / 2, z * edge / 2, 1.7) for x, y, z in points]


MOLECULES["cage"] = icosahedron(4.2)


def export(program, folder, name, *options):
    """Returns the path of a fresh .mns file of a molecule, within 0.01 Å unless options say otherwise."""
    source = os.path.join(folder, name + ".xyzr")
    with open(source, "w", encoding="ascii") as file:
        for atom in MOLECULES[name]:
            file.write("%.12f %.12f %.12f %.4f\n" % atom)
    target = os.path.join(folder, name + ".mns")
    if "--tolerance" not in options:
        options = ("--tolerance", "0.01", *options)
    subprocess.run([program, "export", "blender", source, "-o", target, "--device", "cpu", "--color", "atom", "--force", *options],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    return target


#: Ubiquitin in solution, in ten models.
UBIQUITIN = "/usr/share/freesasa/test-data/1d3z.pdb"
#: Lines of a PDB file that make two copies of chain A, 20 Å apart along x.
TWO_COPIES = "REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n" + "".join(
    "REMARK 350   BIOMT%d %3d %9.6f %9.6f %9.6f %14.5f\n" % (row + 1, copy, *(float(column == row) for column in range(3)), shift if row == 0 else 0)
    for copy, shift in ((1, 0), (2, 20)) for row in range(3))


def export_run(program, target, frames="1-5:2", *options):
    """Exports fifteen residues of ubiquitin in ten models; by default frames 1, 3 and 5 at 25 a second."""
    subprocess.run([program, "export", "blender", UBIQUITIN, "--select", "resi 1-15",
                    "--frames", frames, "--fps", "25", "-o", target, "--device", "cpu", "--color", "residue",
                    "--size", "120x90", "--tolerance", "0.05", "-q", *options], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def with_right_checksum(data):
    data = bytearray(data)
    struct.pack_into("<Q", data, 24, len(data))
    struct.pack_into("<I", data, 12, zlib.crc32(bytes(data[64:])))
    return bytes(data)


def header_of(data):
    """Returns the header and its length in bytes."""
    size = struct.unpack_from("<Q", data, 16)[0]
    return json.loads(bytes(data[64:64 + size])), size


def with_header(data, header, version=2):
    """Returns the file with another header. Offsets of arrays count from the header's end, so they stay right."""
    _, size = header_of(data)
    text = json.dumps(header).encode("ascii")
    text = text.ljust((len(text) + 64) // 64 * 64 - 1) + b"\n"
    prologue = bytearray(data[:64])
    struct.pack_into("<I", prologue, 8, version)
    struct.pack_into("<Q", prologue, 16, len(text))
    return with_right_checksum(bytes(prologue) + text + data[64 + size:])


def plain(data):
    """Returns the file in version 2, with packed arrays (FORMAT.md) unpacked."""
    def unpacked(entry, content, size):
        return zlib.decompress(content[:entry.pop("bytes")]) if "bytes" in entry else content[:size]
    return with_arrays(data, unpacked, 2)


def packed(data):
    """Returns a file of version 2 in version 4, with packed arrays."""
    def made(entry, content, size):
        stream = zlib.compress(content[:size])
        entry["bytes"] = len(stream)
        return stream
    return with_arrays(data, made, 4)


def with_arrays(data, change, version):
    """Returns the file with other bytes in its arrays, by change(header's entry, bytes from the first, size of
    values)."""
    header, size = header_of(data)
    body = b""
    for entry in header["arrays"]:
        values = entry["rows"] * entry["columns"] * np.dtype(entry["type"]).itemsize
        content = change(entry, bytes(data[64 + size + entry["offset"]:]), values)
        entry["offset"] = len(body)
        body += content.ljust((len(content) + 63) // 64 * 64, b"\0")
    return with_header(bytes(data[:64 + size]) + body, header, version)


def as_version_1(data):
    """Returns the file in the first release's version: one object, whose keys and arrays are the file's own."""
    data = plain(data)
    header, _ = header_of(data)
    first = header.pop("objects")[0]
    for key in ("name", "prefix", "copies"):
        del first[key]
    del first["mesh"]["closed"]
    for array in header["arrays"]:
        array["name"] = array["name"][2:]
    header["arrays"] = [array for array in header["arrays"] if array["name"] != "atom.index"]
    return with_header(data, {**header, **first}, 1)


def seen_through(data, opacities, film):
    """Returns the file with an opacity for each atom."""
    data = plain(data)
    header, size = header_of(data)
    values = struct.pack(f"<{len(opacities)}f", *opacities)
    header["arrays"].append({"name": "0/atom.opacity", "type": "<f4", "rows": len(opacities), "columns": 1,
                             "offset": len(data) - 64 - size})
    if film:
        header["objects"][0]["film_opacity"] = True
    return with_header(bytes(data) + values.ljust(64, b"\0"), header)


#: A quarter turn about z and a shift in Å.
QUARTER_TURN = [0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30]


def as_two_objects(data):
    """Returns a file with the molecule as "A" in two places, the second by QUARTER_TURN, and once more as "B"."""
    header, _ = header_of(data)
    first = header["objects"][0]
    identity = first["copies"][0]
    header["objects"] = [{**first, "name": "A", "copies": [identity, QUARTER_TURN]}, {**first, "name": "B"}]
    return with_header(data, header)


def bad_copies(data):
    """Returns {name: bytes} of files whose copies must not be shown."""
    result = {}
    for name, copies in (("none", []), ("short", [[1, 2, 3]]), ("mirror", [[-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]]),
                         ("scaled", [[2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0]]), ("text", [["a"] * 12])):
        header, _ = header_of(data)
        header["objects"][0]["copies"] = copies
        result[name] = with_header(data, header)
    return result


def array_place(data, name):
    header, header_size = header_of(data)
    entry = next(e for e in header["arrays"] if e["name"] in (name, "0/" + name))
    return 64 + header_size + entry["offset"], entry


def patched(data, name, kind, value, row=0):
    """Returns the file with one number changed and its checksum made right."""
    data = bytearray(plain(data))
    place, _ = array_place(data, name)
    struct.pack_into("<" + kind, data, place + row * struct.calcsize(kind), value)
    return with_right_checksum(data)


def overwritten(data, name, content):
    """Returns the file with other first bytes of a stored array, and with the right checksum."""
    place, _ = array_place(data, name)
    return with_right_checksum(data[:place] + content + data[place + len(content):])


def with_entry(data, name, key, value):
    """Returns the file with another value in the entry of an array."""
    header, _ = header_of(data)
    next(entry for entry in header["arrays"] if entry["name"] == "0/" + name)[key] = value
    return with_header(data, header, 4)


def damaged_files(data):
    """Returns {name: (bytes, a word that the error must contain)}."""
    stored, data = data, plain(data)
    newer = bytearray(data)
    struct.pack_into("<I", newer, 8, 99)
    flipped = bytearray(data)
    flipped[len(data) // 2] ^= 1
    no_json = bytearray(data)
    no_json[64:66] = b"??"
    place, _ = array_place(data, "mesh.triangle")
    first = struct.unpack_from("<3I", data, place)
    return {
        "empty": (b"", "empty"),
        "short": (data[:40], "few"),
        "truncated": (data[:-64], "incomplete"),
        "grown": (data + b"\0" * 64, "incomplete"),
        "wrong_magic": (b"PNG" + data[3:], "not a .mns"),
        "text_mode": (data.replace(b"\r\n", b"\n"), "not a .mns"),
        "newer": (bytes(newer), "newer"),
        "wrong_crc": (bytes(flipped), "checksum"),
        "no_json": (with_right_checksum(no_json), "JSON"),
        "bad_index": (patched(data, "mesh.triangle", "I", 4000000000), "index"),
        "bad_atom": (patched(data, "mesh.atom", "I", 77), "index"),
        "bad_component": (patched(data, "mesh.component", "I", 9), "index"),
        "nan_position": (patched(data, "mesh.position", "f", float("nan"), 4), "finite"),
        "infinite_normal": (patched(data, "mesh.normal", "f", float("inf"), 2), "finite"),
        "not_closed": (patched(data, "mesh.triangle", "I", first[1]), "closed"),
        "not_packed": (overwritten(stored, "mesh.position", b"\xff\xff"), "cannot be unpacked"),
        "short_packed": (with_entry(stored, "mesh.position", "bytes", 20), "does not have"),
        "much_packed": (with_entry(stored, "mesh.position", "rows", 2**62), "cannot be unpacked"),
        "negative_packed": (with_entry(stored, "mesh.position", "bytes", -1), "outside"),
        "odd_packed": (with_entry(stored, "mesh.position", "bytes", "1"), "malformed"),
        "wrong_count": (with_right_checksum(re.sub(rb'("vertices": )\d', rb"\g<1>9", data)), "disagree"),
    }

#: A camera in the form of a header.
CAMERA = {"position": [0, 0, 9], "target": [0, 0, 0], "up": [0, 1, 0], "projection": "perspective", "vertical_fov": 30, "size": [64, 48]}
LEFT_OUT = object()
#: Values that replace a header's value; "deep" is nested beyond any stack.
ODD_VALUES = [None, True, 0, -1, 1.5, 2**31, 2**32, 2**63, 10**30, 10**400, -0.0, 1e308, float("nan"), float("inf"), "",
              "nan", "\u0000", "\ud800", [], {}, [[]], [1, 2], [1e200] * 12, [0] * 3, ["a"] * 3, ["1"] * 3, ["\ud800"], [10**400] * 3, [[0] * 12],
              [[0] * 24], [[float("nan")] * 12], [{}], "<i4", "<f4", "|u1"]


def small_surface(is_cut):
    """Returns the file of a tetrahedron of one atom with every key that the add-on reads; with velocities or a cap."""
    arrays = {
        "mesh.position": np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], "<f4"),
        "mesh.normal": np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], "<f4"),
        "mesh.triangle": np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], "<u4"),
        "mesh.kind": np.array([0, 0, 0, 4 if is_cut else 0], "|u1"), "mesh.patch": np.zeros(4, "<u4"), "mesh.component": np.zeros(4, "<u4"),
        "mesh.atom": np.zeros(4, "<u4"), "mesh.sharp_corner": np.array([5], "<u4"),
        "mesh.sharp_corner_normal": np.array([[0, 0, 1]], "<f4"), "mesh.sharp_edge": np.array([[0, 1]], "<u4"),
        **({"mesh.cap_plane": np.array([2**32 - 1] * 3 + [0], "<u4")} if is_cut else {"mesh.velocity": np.zeros((4, 3), "<f4")}),
        "atom.center": np.zeros((1, 3), "<f8"), "atom.radius": np.ones(1, "<f8"), "atom.color": np.ones((1, 3), "<f4"),
        "atom.index": np.zeros(1, "<u4"), "atom.file_index": np.zeros(1, "<u4"), "atom.atomic_number": np.ones(1, "<i4"),
        "atom.opacity": np.ones(1, "<f4"), **{f"atom.{name}": np.zeros(1, "<i4") for name in ("chain_id", "name_id", "residue_name_id")},
    }
    body, entries = b"", []
    for name, array in arrays.items():
        entries.append({"name": "0/" + name, "type": array.dtype.str, "rows": len(array),
                        "columns": 1 if array.ndim == 1 else array.shape[1], "offset": len(body)})
        body += array.tobytes().ljust((array.nbytes + 63) // 64 * 64, b"\0")
    header = {"format": "meniscus surface", "generator": "test", "source": {"file": "a.pdb"}, "arrays": entries,
              "camera": {**CAMERA, "shadows": 0.5, "shadow_softness": 2.0},
              "objects": [{"name": "A", "prefix": "0/", "copies": [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]], "chain_names": ["A"],
                           "atom_names": ["CA"], "residue_names": ["ALA"], "probe_radius": 1.4, "area": 1.0, "volume": 1.0,
                           "kind_colors": [[1.0, 0.0, 0.0]] * 3, "film_opacity": True,
                           "material": {"ambient": 0.1, "roughness": 0.1, "specular": 0.1, "shininess": 40.0},
                           "components": [{"kind": "outer", "euler": 2, "area": 1.0, "volume": 1.0}],
                           "mesh": {"vertices": 4, "triangles": 4, "origin": [0.0, 0.0, 0.0], "closed": True, "tolerance": 0.05}}]}
    if is_cut:
        header["caps"] = {"planes": [[0.0, 0.0, 1.0, 2.0]], "color": [1.0, 0.0, 0.0],
                          "hatching": {"distance": 0.5, "across": [[1.0, 0.0, 0.0]], "share": 0.4, "light": 0.3}}
    prologue = b"\x89MNS\r\n\x1a\n" + struct.pack("<IIQQ", 2, 0, 0, 0)
    text = b"{}".ljust(64)
    return with_header(prologue[:16] + struct.pack("<Q", len(text)) + bytes(40) + text + body, header, 3 if is_cut else 2)


def places_in(value, place=()):
    """Returns the paths to all values of a tree of dicts and lists but its root."""
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
        yield place + (key,)
        if isinstance(inner, (dict, list)):
            yield from places_in(inner, place + (key,))


def odd_headers(data):
    """Yields words and a file in which one value of the header, but for the arrays, is left out or odd."""
    header, _ = header_of(data)
    for place in places_in({key: value for key, value in header.items() if key != "arrays"}):
        for odd in [LEFT_OUT, *ODD_VALUES]:
            changed = copy.deepcopy(header)
            holder = changed
            for key in place[:-1]:
                holder = holder[key]
            if odd is LEFT_OUT:
                del holder[place[-1]]
            else:
                holder[place[-1]] = copy.deepcopy(odd)
            yield f"{'.'.join(map(str, place))}: {str(odd)[:40]!r}", with_header(data, changed, struct.unpack_from("<I", data, 8)[0])


def signed_volume(positions, triangles):
    """Returns the volume in Å³; it is positive when the triangles face outwards."""
    p = positions.astype(np.float64)
    a, b, c = (p[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


def corner_normals(mesh):
    """Returns the normals by which Blender shades a mesh with custom normals, (corners, 3)."""
    normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
    if hasattr(mesh, "calc_normals_split"):
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", normals)
        mesh.free_normals_split()
    else:
        mesh.corner_normals.foreach_get("vector", normals)
    return normals.reshape(-1, 3)
