# SPDX-License-Identifier: GPL-3.0-or-later
"""Joins the objects of a .mns file and their copies into one surface, or separates outer surfaces from cavities."""

import numpy as np

from . import mns_reader

#: Arrays with indices, and the array that they refer to. Indices increase by the number of its rows in earlier objects.
INDICES = {"mesh.triangle": "mesh.position", "mesh.sharp_edge": "mesh.position", "mesh.atom": "atom.center"}
TURNED = ("mesh.normal", "mesh.sharp_corner_normal", "mesh.velocity")
PLAIN = ("mesh.kind", "mesh.patch", "atom.radius", "atom.color", "atom.index", "atom.file_index", "atom.b_factor",
         "atom.atomic_number", "atom.res_id")
#: Arrays with indices into lists of names of their object, and the key of the list in its header.
NAMED = {"atom.chain_id": "chain_names", "atom.name_id": "atom_names", "atom.residue_name_id": "residue_names"}
#: Arrays that some objects may lack, and their default: value, number of columns, type.
STAND_INS = {
    "atom.opacity": (1.0, 1, np.float32),
    "mesh.cap_plane": (0xffffffff, 1, np.uint32),
    "mesh.map_value": (0.0, 1, np.float32),
    "mesh.map_color": (0.0, 3, np.float32),
    "mesh.map_known": (1, 1, np.uint8),
    "atom.own_color": (0, 1, np.uint8),
    "mesh.patch_area": (0.0, 1, np.float32),
    "atom.entity": (4, 1, np.int32),
    **{
        f"atom.{name}": (0.0, 1, np.float32)
        for name in ("charge", "hydrophobicity", "area", "accessible_area", "buried_area")},
    **{f"mesh.{name}": (0.0, 1, np.float32) for name in mns_reader.OF_VERTICES if name.endswith("curvature")}}
OF_TRIANGLES = ("mesh.kind", "mesh.patch", "mesh.component", "mesh.atom", "mesh.cap_plane", "mesh.patch_area")
OF_VERTICES = ("mesh.position", "mesh.normal", "mesh.velocity", "mesh.map_color", *(f"mesh.{name}"
                                                                                    for name in mns_reader.OF_VERTICES))


def joined(file, origin):
    """Returns one mns_reader.Surface of all objects and copies. mesh.position is in Å relative to `origin` as float64,
    and mesh.object is the number of the object of each triangle."""
    columns = {}
    optional = [name for name in STAND_INS if any(surface.get(name) is not None for surface in file.objects)]
    if "mesh.map_color" in optional and not all(surface.get("mesh.map_color") is not None for surface in file.objects):
        optional.append("atom.own_color")
    rows = {"mesh.position": 0, "mesh.triangle": 0, "atom.center": 0, "components": 0}
    names = {key: {} for key in NAMED.values()}
    for number, surface in enumerate(file.objects):
        for copy in surface.copies:
            part = _placed(surface, copy, origin, rows, names)
            part["mesh.object"] = np.full(surface.triangle_count, number, dtype=np.int32)
            for name in optional:
                part[name] = _or_stand_in(surface, name)
            for name, values in part.items():
                columns.setdefault(name, []).append(values)
            for name in ("mesh.position", "mesh.triangle", "atom.center"):
                rows[name] += len(surface[name])
            rows["components"] += len(surface.header["components"])
    total = sum(len(surface.copies) for surface in file.objects)
    arrays = {name: np.concatenate(parts) for name, parts in columns.items() if len(parts) == total}
    return mns_reader.Surface(file.objects[0].path,
                              _header(file, arrays, {key: list(table) for key, table in names.items()}, origin), arrays)


def _or_stand_in(surface, name):
    found = surface.get(name)
    if found is not None:
        return found
    value, columns, kind = STAND_INS[name]
    if name == "atom.own_color" and surface.get("mesh.map_color") is None:  # objects without a map keep their colours
        value = 1
    of = "atom.center" if name.startswith("atom.") else "mesh.triangle" if name in OF_TRIANGLES else "mesh.position"
    rows = len(surface[of])
    return np.full(rows if columns == 1 else (rows, columns), value, dtype=kind)


def _placed(surface, copy, origin, rows, names):
    turn, shift = copy[:, :3], copy[:, 3]
    base = np.array(surface.header["mesh"]["origin"], dtype=np.float64)
    part = {"mesh.position": (surface["mesh.position"].astype(np.float64) + base) @ turn.T + shift - origin,
            "atom.center": surface["atom.center"] @ turn.T + shift - origin,
            "mesh.component": surface["mesh.component"] + np.uint32(rows["components"]),
            "mesh.sharp_corner": surface["mesh.sharp_corner"] + np.uint32(3 * rows["mesh.triangle"])}
    for name, of in INDICES.items():
        part[name] = surface[name] + np.uint32(rows[of])
    for name in TURNED:
        if surface.get(name) is not None:
            part[name] = surface[name].astype(np.float64) @ turn.T
    for name in PLAIN:
        if surface.get(name) is not None:
            part[name] = surface[name]
    for array, key in NAMED.items():
        if surface.get(array) is None:
            continue
        own, ids = surface.header.get(key, []), surface[array]
        number = np.array([names[key].setdefault(name, len(names[key])) for name in own], dtype=np.int32)
        mns_reader.check_names(surface.path, array, ids, own)
        part[array] = number[ids]
    return part


def _header(file, arrays, names, origin):
    first = file.objects[0].header
    meshes = [(surface.header["mesh"], len(surface.copies)) for surface in file.objects]
    header = {key: value for key, value in first.items() if key not in ("name", "prefix", "copies", "objects")}
    header["moved_by"] = [float(value) for value in origin]  # was subtracted from all positions
    header["mesh"] = {"origin": [0.0, 0.0, 0.0], "tolerance": max(mesh.get("tolerance", 0.0) for mesh, _ in meshes),
                      "vertices": len(arrays["mesh.position"]), "triangles": len(arrays["mesh.triangle"]),
                      "closed": all(mesh.get("closed", True) for mesh, _ in meshes)}
    header["components"] = [part for surface in file.objects for _ in surface.copies
                            for part in surface.header["components"]]
    if any(surface.header.get("film_opacity") is True for surface in file.objects):
        header["film_opacity"] = True
    for key in ("area", "volume"):
        header[key] = sum(surface.header.get(key, 0.0) * len(surface.copies) for surface in file.objects)
    header.update(names)
    return header


def by_role(surface):
    """Yields pairs of "outer" or "cavities" and the part of a surface with this role. Empty parts are left out."""
    cavity = np.array([part["kind"] == "cavity" for part in surface.header["components"]], dtype=bool)
    for role, wanted in (("outer", ~cavity), ("cavities", cavity)):
        shown = wanted[surface["mesh.component"]]
        if shown.any():
            yield role, _part(surface, shown, wanted)


def _part(surface, shown, wanted):
    """Returns the part of a surface that consists of whole components, with their triangles and vertices. shown: True
    for each of its triangles. wanted: True for each of its components."""
    triangles = surface["mesh.triangle"][shown]
    used = np.zeros(len(surface["mesh.position"]), dtype=bool)
    used[triangles] = True
    vertex = np.cumsum(used) - 1
    arrays = dict(surface.arrays)
    for name in OF_VERTICES:
        if name in arrays:
            arrays[name] = arrays[name][used]
    for name in OF_TRIANGLES:
        if name in arrays:
            arrays[name] = arrays[name][shown]
    arrays["mesh.triangle"] = vertex[triangles].astype(np.uint32)
    corner = (np.cumsum(np.repeat(shown, 3)) - 1).astype(np.uint32)
    sharp = surface["mesh.sharp_corner"]
    stays = np.repeat(shown, 3)[sharp]
    arrays["mesh.sharp_corner"] = corner[sharp[stays]]
    arrays["mesh.sharp_corner_normal"] = surface["mesh.sharp_corner_normal"][stays]
    edges = surface["mesh.sharp_edge"].reshape(-1, 2)
    arrays["mesh.sharp_edge"] = vertex[edges[used[edges].all(axis=1)]].astype(np.uint32)
    mesh = {**surface.header["mesh"], "vertices": int(used.sum()), "triangles": int(shown.sum())}
    kept = [part for part, is_kept in zip(surface.header["components"], wanted) if is_kept]
    measures = {key: sum(part.get(key, 0.0) for part in kept) for key in ("area", "volume")}
    part = mns_reader.Surface(surface.path, {**surface.header, **measures, "mesh": mesh}, arrays)
    part.known_closed = surface.known_closed
    return part
