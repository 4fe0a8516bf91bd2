# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies attributes that a user added to a mesh to other triangles of the same atoms."""

import numpy as np

from . import compat

#: Types of attributes that can be copied: the field of a value, its columns, its numpy type.
TYPES = {
    "FLOAT": ("value", 1, np.float32), "INT": ("value", 1, np.int32), "BOOLEAN": ("value", 1, bool),
    "FLOAT_VECTOR": ("vector", 3, np.float32), "FLOAT2": ("vector", 2, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32), "BYTE_COLOR": ("color", 4, np.float32)}
DOMAINS = ("POINT", "FACE", "CORNER")
#: Attributes that identify atoms, also among copies of one; scenes of 0.1.0 have the second only.
KEYS = ("ses_atom", "atom_index")
#: Attributes in which Blender itself or the import stores its data.
BLENDERS = {"position", "material_index", "sharp_edge", "sharp_face", "custom_normal", "crease_edge", "crease_vert"}

_of_user = {}  # identity of a mesh -> (source of its atoms, the user's attributes by atom)


class Kept:
    """An attribute by atom. values: (atoms, columns). known: (atoms,), True if the atom has a value."""

    def __init__(self, name, kind, domain, values, known):
        self.name, self.kind, self.domain, self.values, self.known = name, kind, domain, values, known

    def with_older(self, older):
        """Returns this attribute with the values of an earlier one for atoms that the surface did not show."""
        if older is None or (older.kind, older.domain) != (self.kind, self.domain):
            return self
        count = max(len(self.known), len(older.known))
        for kept in (self, older):
            kept.values = np.concatenate(
                [kept.values, np.zeros((count - len(kept.values), kept.values.shape[1]), kept.values.dtype)])
            kept.known = np.concatenate([kept.known, np.zeros(count - len(kept.known), dtype=bool)])
        self.values[~self.known] = older.values[~self.known]
        self.known |= older.known
        return self


def keep(mesh, ours, older=()):
    """Returns the attributes of a mesh as a list of Kept, except those of Blender and those named in `ours`. older: the
    result of an earlier call."""
    before = {kept.name: kept for kept in older}
    key = next((name for name in KEYS if name in mesh.attributes), None)
    if key is None or not len(mesh.polygons):
        return list(older)
    names = [attribute.name for attribute in mesh.attributes
             if attribute.name not in ours and attribute.name not in BLENDERS and not attribute.name.startswith(".")
             and attribute.data_type in TYPES and attribute.domain in DOMAINS]
    if not names:
        return []
    atom = read(mesh, key, "INT")[:, 0]
    vertices = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    result = []
    for name in names:
        kind, domain = mesh.attributes[name].data_type, mesh.attributes[name].domain
        values = read(mesh, name, kind)
        of_faces = {"FACE": slice(None), "POINT": vertices[::3], "CORNER": slice(0, None, 3)}[domain]
        by_atom = np.zeros((atom.max() + 1, values.shape[1]), dtype=values.dtype)
        by_atom[atom] = values[of_faces]
        known = np.zeros(len(by_atom), dtype=bool)
        known[atom] = True
        result.append(Kept(name, kind, domain, by_atom, known).with_older(before.get(name)))
    return result


def keep_through(mesh, ours, source):
    """Returns the attributes of a mesh that shows the frames of `source` in turn, like keep(). Atoms that are hidden in
    this frame keep their values."""
    of, older = _of_user.get(compat.identity(mesh), (None, ()))
    kept = keep(mesh, ours, older if of == source else ())
    _of_user[compat.identity(mesh)] = source, kept
    return kept


def copy_kept(mesh, other):
    """Copies the attributes that were kept for a mesh to another mesh."""
    if compat.identity(mesh) in _of_user:
        _of_user[compat.identity(other)] = _of_user[compat.identity(mesh)]


def forget():
    _of_user.clear()


def restore(mesh, kept, arrays):
    """Adds the Kept attributes to a mesh that has been filled with mesh_arrays.MeshArrays."""
    for each in kept:
        add(mesh, each.name, each.kind, each.domain, spread(each, arrays))


def spread(kept, arrays):
    """Returns the values of a Kept for the elements of mesh_arrays.MeshArrays, one row per element. Atoms without a
    value get zero."""
    atom = arrays.ses_atom
    table = np.zeros((max(len(kept.values), atom.max(initial=0) + 1), kept.values.shape[1]), dtype=kept.values.dtype)
    table[:len(kept.values)] = kept.values
    of_faces = table[atom]
    if kept.domain == "FACE":
        return of_faces
    of_corners = np.repeat(of_faces, 3, axis=0)
    if kept.domain == "CORNER":
        return of_corners
    values = np.zeros((len(arrays.positions), of_faces.shape[1]), dtype=of_faces.dtype)
    values[arrays.triangles.ravel()] = of_corners
    return values


def add(mesh, name, kind, domain, values):
    """Adds an attribute to a mesh. values: one row per element, in the type that Blender stores."""
    attribute = mesh.attributes.new(name, kind, domain)
    attribute.data.foreach_set(TYPES[kind][0], np.ascontiguousarray(values).ravel())


def read(mesh, name, kind):
    """Returns the values of an attribute, (elements, columns)."""
    field, columns, dtype = TYPES[kind]
    data = mesh.attributes[name].data
    values = np.empty(len(data) * columns, dtype=dtype)
    data.foreach_get(field, values)
    return values.reshape(-1, columns)
