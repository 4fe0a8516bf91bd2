# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the data of a Blender mesh from a surface. Uses numpy only, so that any process can do it."""

import dataclasses

import numpy as np

from . import mns_reader

#: The roles of a mesh's materials in order. A mesh without caps lacks the third.
SLOTS = ("outer", "cavity", "cap")
#: Attributes of faces, which are not interpolated there, and their arrays. Only joined objects have ses_object.
FACE_INTEGERS = {
    "ses_kind": "mesh.kind", "ses_patch": "mesh.patch", "ses_component": "mesh.component", "ses_object": "mesh.object"}
#: Attributes of points with numbers of atoms, as in Molecular Nodes and with its names if it has them: the array of the
#: atoms, and the type. vdw_radii is in Blender units. Attributes in NAMES are indices into the sorted names.
POINT_NUMBERS = {
    "atomic_number": ("atom.atomic_number", "INT"), "res_id": ("atom.res_id", "INT"),
    "chain_id": ("atom.chain_id", "INT"), "atom_name_id": ("atom.name_id", "INT"),
    "res_name_id": ("atom.residue_name_id", "INT"), "entity": ("atom.entity", "INT"),
    "charge": ("atom.charge", "FLOAT"), "hydrophobicity": ("atom.hydrophobicity", "FLOAT"),
    "b_factor": ("atom.b_factor", "FLOAT"), "vdw_radii": ("atom.radius", "FLOAT"), "atom_area": ("atom.area", "FLOAT"),
    "accessible_area": ("atom.accessible_area", "FLOAT"), "buried_area": ("atom.buried_area", "FLOAT")}
#: Attributes of points with numbers of the surface, and their arrays. Curvatures are in 1/Å and 1/Å² for any scale.
VERTEX_NUMBERS = {
    name: f"mesh.{name}" for name in ("mean_curvature", "gaussian_curvature", "smooth_mean_curvature",
                                      "smooth_gaussian_curvature", "open_sky")}
#: Attributes that are indices into a list of names: the key of the list in headers, and the custom property with the
#: sorted list.
NAMES = {
    "chain_id": ("chain_names", "chain_ids"), "atom_name_id": ("atom_names", "atom_names"),
    "res_name_id": ("residue_names", "res_names")}
#: All attributes that an import makes.
OURS = {
    "atom_index", "ses_atom", "opacity", "velocity", "Color", "ses_cap", "cap_stripe", "map_value", "map_known",
    "patch_area", *FACE_INTEGERS, *POINT_NUMBERS, *VERTEX_NUMBERS}


@dataclasses.dataclass
class MeshArrays:
    """The data of a mesh.

    positions: (n, 3) float32, Blender units.
    triangles: (m, 3) int32.
    normals: float32, (n, 3) of vertices, or (3 m, 3) of corners if some are sharp.
    sharp_edges: sorted keys a << 32 | b of vertex pairs a < b.
    slots: (m,) int32, indices into SLOTS.
    ses_atom: (m,) int32, the number of each triangle's atom.
    velocity: (n, 3) float32, Blender units per frame of the run, or None.
    attributes: tuples of name, type and domain in Blender's terms, and values with one row per element in the type that
    Blender stores."""

    positions: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    sharp_edges: np.ndarray
    slots: np.ndarray
    ses_atom: np.ndarray
    velocity: np.ndarray
    attributes: list

    @property
    def nbytes(self):
        return sum(each.nbytes
                   for each in (self.positions, self.triangles, self.normals, *(values
                                                                                for *_, values in self.attributes)))


def of_surface(surface, scale, crisp_colors, names, base=0.0):
    """Returns the MeshArrays of a mns_reader.Surface. Raises mns_reader.MnsError, also if it must be closed and is not.

    scale: Blender units per Å. crisp_colors: True if colours change at edges, False if they blend between vertices.
    names: the result of names_of() for all surfaces that are imported together. base: subtracted from all positions, Å.
    """
    surface.check_closed()
    positions = positions_of(surface, scale, base)
    triangles = np.ascontiguousarray(surface["mesh.triangle"], dtype=np.int32)
    pairs = np.sort(surface["mesh.sharp_edge"].reshape(-1, 2), axis=1).astype(np.uint64)
    cavity = np.array([part["kind"] == "cavity" for part in surface.header["components"]], dtype=np.int32)
    slots = np.where(caps_of(surface), SLOTS.index("cap"), cavity[surface["mesh.component"]]).astype(np.int32)
    velocity = surface.get("mesh.velocity")
    index = surface.get("atom.index")  # version 1 has none: one object has the atoms of the molecule in order
    ses_atom = (surface["mesh.atom"] if index is None else index[surface["mesh.atom"]]).astype(np.int32)
    return MeshArrays(positions, triangles, normals_of(surface), pairs[:, 0] << np.uint64(32) | pairs[:, 1], slots,
                      ses_atom, None if velocity is None else (velocity * scale).astype(np.float32),
                      [*_of_faces(surface, ses_atom), *_of_points(surface, scale, names),
                       _colors(surface, triangles, len(positions), crisp_colors)])


def names_of(*surfaces):
    """Returns the sorted names of chains, atoms and residues of surfaces, by the attribute of NAMES."""
    return {attribute: sorted({str(name) for surface in surfaces for name in surface.header.get(key, [])})
            for attribute, (key, _) in NAMES.items()}


def renumber(arrays, names, tables):
    """Converts attributes of NAMES in a MeshArrays from indices into `names` to indices into `tables` (attribute ->
    list of names). New names are appended to the tables. Meshes that follow one another get the same indices in this
    way."""
    for number, (attribute, kind, domain, values) in enumerate(arrays.attributes):
        if attribute not in NAMES:
            continue
        own, table = names[attribute], tables.setdefault(attribute, list(names[attribute]))
        if own == table[:len(own)]:
            continue
        table += [name for name in own if name not in table]
        places = np.array([table.index(name) for name in own], dtype=values.dtype)
        arrays.attributes[number] = (attribute, kind, domain, places[values])


def _of_faces(surface, ses_atom):
    for name, array in FACE_INTEGERS.items():  # the type is INT, because Cycles 3.4 reads INT8 as 0
        if surface.get(array) is not None:
            yield (name, "INT", "FACE", surface[array].astype(np.int32))
    in_file = surface.get("atom.file_index")  # files of 0.1.0 and atoms of Blender have a single numbering
    yield ("atom_index", "INT", "FACE", ses_atom if in_file is None else in_file[surface["mesh.atom"]].astype(np.int32))
    yield ("ses_atom", "INT", "FACE", ses_atom)
    if surface.get("mesh.patch_area") is not None:
        yield ("patch_area", "FLOAT", "FACE", surface["mesh.patch_area"].astype(np.float32))
    if surface.get("atom.opacity") is not None:  # an attribute of faces, so that it changes at edges like colours
        yield ("opacity", "FLOAT", "FACE", surface["atom.opacity"][surface["mesh.atom"]].astype(np.float32))
    if surface.get("mesh.cap_plane") is not None:
        yield ("ses_cap", "INT", "FACE", np.where(caps_of(surface), surface["mesh.cap_plane"].astype(np.int32), -1))
        if "hatching" in surface.header["caps"]:
            yield ("cap_stripe", "FLOAT", "CORNER", stripes(surface))


def _of_points(surface, scale, names):
    of_vertex = vertex_atoms(surface["mesh.triangle"], surface["mesh.atom"], len(surface["mesh.position"]))
    for name, (array, kind) in POINT_NUMBERS.items():
        if surface.get(array) is None:
            continue
        values = surface[array]
        if name == "vdw_radii":
            values = values * scale
        elif name in NAMES:
            values = places_of(surface, name, names[name])[values]
        yield (name, kind, "POINT", values[of_vertex].astype(np.int32 if kind == "INT" else np.float32))
    for name, array in VERTEX_NUMBERS.items():
        if surface.get(array) is not None:
            yield (name, "FLOAT", "POINT", surface[array].astype(np.float32))
    if surface.get("mesh.map_value") is not None:
        yield ("map_value", "FLOAT", "POINT", surface["mesh.map_value"])
        if surface.get("mesh.map_known") is not None:
            yield ("map_known", "BOOLEAN", "POINT", surface["mesh.map_known"].astype(bool))


def _colors(surface, triangles, count, crisp):
    colors = corner_colors(surface)
    if crisp:
        rgba = np.ones((len(triangles), 3, 4), dtype=np.float32)
        rgba[:, :, :3] = colors
        return ("Color", "BYTE_COLOR", "CORNER", rgba.reshape(-1, 4))
    corners = triangles.ravel()
    around = np.maximum(np.bincount(corners, minlength=count), 1)
    rgba = np.ones((count, 4), dtype=np.float32)
    for channel in range(3):
        rgba[:, channel] = np.bincount(corners, colors[:, :, channel].ravel(), count) / around
    return ("Color", "FLOAT_COLOR", "POINT", rgba)


def positions_of(surface, scale, base=0.0):
    """Returns vertex positions in Blender units as float32: coordinates of the input file minus `base`, in Å, times
    `scale`."""
    origin = np.array(surface.header["mesh"]["origin"], dtype=np.float64) - base
    return ((surface["mesh.position"].astype(np.float64) + origin) * scale).astype(np.float32)


def normals_of(surface):
    """Returns the normals of vertices, (n, 3), or of corners, (3 m, 3), if there are sharp corners."""
    normals, sharp = surface["mesh.normal"], surface["mesh.sharp_corner"]
    if len(sharp):
        normals = normals[surface["mesh.triangle"].ravel()]
        normals[sharp] = surface["mesh.sharp_corner_normal"]
    return np.ascontiguousarray(normals, dtype=np.float32)


def caps_of(surface):
    """Returns True for each triangle of a cap."""
    return surface["mesh.kind"] == mns_reader.CAP


def stripes(surface):
    """Returns the number of hatching lines before each corner of a cap. Other corners get a value between two lines."""
    hatching, cap = surface.header["caps"]["hatching"], caps_of(surface)
    origin = np.array(surface.header["mesh"]["origin"], dtype=np.float64)
    across = np.array(hatching["across"], dtype=np.float64)[surface["mesh.cap_plane"][cap]]
    points = (surface["mesh.position"][surface["mesh.triangle"][cap]].astype(np.float64) + origin +
              surface.header.get("moved_by", 0.0))
    values = np.full((len(cap), 3), 0.5 + 0.5 * hatching["share"], dtype=np.float32)
    values[cap] = np.einsum("tkx,tx->tk", points, across) / hatching["distance"]
    return values.ravel()


def corner_colors(surface):
    """Returns the scene-linear colour of each corner of each triangle, (triangles, 3, 3) float32."""
    colors = np.repeat(linear(face_colors(surface))[:, None, :], 3, axis=1)
    of_map = surface.get("mesh.map_color")
    if of_map is not None:
        own = surface.get("atom.own_color")
        by_map = ~caps_of(surface) if own is None else ~caps_of(surface) & (own[surface["mesh.atom"]] == 0)
        colors[by_map] = linear(of_map)[surface["mesh.triangle"][by_map]]
    return colors


def vertex_atoms(triangles, atom, count):
    """Returns the atom of each vertex, which is the first of the atoms of its triangles, as in mesh files of
    Meniscus."""
    found = np.zeros(count, dtype=np.int64)
    order = np.argsort(-atom.astype(np.int64), kind="stable")
    found[triangles[order].ravel()] = np.repeat(atom[order], 3)  # the last assignment counts
    return found


def places_of(surface, attribute, names):
    """Returns the index into the sorted `names` for each number of the file."""
    own = surface.header.get(NAMES[attribute][0], [])
    mns_reader.check_names(surface.path, POINT_NUMBERS[attribute][0], surface[POINT_NUMBERS[attribute][0]], own)
    place = {name: number for number, name in enumerate(names)}
    return np.array([place[str(name)] for name in own] or [0], dtype=np.int32)


def face_colors(surface):
    """Returns the colour of each triangle as sRGB, without colours of volume maps."""
    kinds, cap = surface.header.get("kind_colors"), caps_of(surface)
    colors = surface["atom.color"][surface["mesh.atom"]]
    if kinds is not None:
        colors = np.where(cap[:, None], colors,
                          np.array(kinds, dtype=np.float32)[np.where(cap, 0, surface["mesh.kind"])])
    if "color" in surface.header.get("caps", {}):
        colors = np.where(cap[:, None], np.array(surface.header["caps"]["color"], dtype=np.float32), colors)
    return colors


def linear(srgb):
    """Converts sRGB to scene-linear Rec. 709, which Blender's colour attributes contain."""
    srgb = np.asarray(srgb, dtype=np.float64)
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(np.float32)
