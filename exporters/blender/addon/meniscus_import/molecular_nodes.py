# SPDX-License-Identifier: GPL-3.0-or-later
"""Atoms of an object as Molecular Nodes has them: a vertex an atom, named attributes, radii in Blender units."""

import numpy as np

from . import attributes, mns_reader
from .computing.atoms import Atoms

#: What a surface needs; and where our arrays come from, if the object has them.
RADII = "vdw_radii"
ARRAYS = {"b_factor": ("atom.b_factor", np.float32), "atomic_number": ("atom.atomic_number", np.int32),
          "res_id": ("atom.res_id", np.int32), "chain_id": ("atom.chain_id", np.int32)}
#: Units of length that scales of Blender units per Å are looked for in: Molecular Nodes has had 0.01 and 0.1.
SCALES = 10.0 ** np.arange(-4, 3)
#: Å: radii of atoms lie about it in every published table.
USUAL_RADIUS = 1.6
#: sRGB of atoms without an attribute Color.
PLAIN = (0.78, 0.80, 0.83)


def is_molecule(item):
    return item is not None and item.type == "MESH" and RADII in item.data.attributes


def scale_of(item):
    """Blender units per Å: the power of ten that makes the radii those of atoms."""
    radii = _values(item.data, RADII)
    radii = radii[np.isfinite(radii) & (radii > 0)]
    if not len(radii):
        raise mns_reader.MnsError(f"{item.name}: no atom has a radius")
    return float(SCALES[np.argmin(np.abs(np.log10(np.median(radii) / USUAL_RADIUS / SCALES)))])


def frames_of(item):
    """Objects that hold the other models of a molecule, in order; Molecular Nodes keeps them in a collection of this name."""
    import bpy

    collection = bpy.data.collections.get(f".data_{item.name}_frames")
    count = len(item.data.vertices)
    frames = [] if collection is None else [other for other in collection.objects if other.type == "MESH" and len(other.data.vertices) == count]
    return sorted(frames, key=lambda other: int("0" + "".join(c for c in other.name.rpartition("_")[2].split(".")[0] if c.isdigit())))


def read(item, scale, selection="", place=0):
    """The atoms.Atoms that are selected, and their other attributes by atom as attributes.Kept. selection: the name of a boolean
    attribute. place: of the frames, from 1; 0: as the object itself is."""
    mesh = item.data
    count = len(mesh.vertices)
    if not is_molecule(item) or not count:
        raise mns_reader.MnsError(f"{item.name}: its vertices are not atoms: they have no attribute {RADII}")
    chosen = _chosen(item, selection)
    if not chosen.any():
        raise mns_reader.MnsError(f"{item.name}: the selection {selection} has no atom")
    index = np.flatnonzero(chosen).astype(np.uint32)
    numbers = {array: _values(mesh, name)[chosen].astype(kind) for name, (array, kind) in ARRAYS.items() if _is_number(mesh, name)}
    names = [str(name) for name in item.get("chain_ids", [])]
    chains = numbers.get("atom.chain_id")
    if chains is not None and not 0 <= chains.min() <= chains.max() < len(names):
        names = [f"{number:06d}" for number in range(max(int(chains.max()), 0) + 1)]  # sorted as they count
        numbers["atom.chain_id"] = np.maximum(chains, 0)
    atoms = Atoms(_positions(frames_of(item)[place - 1].data if place else mesh)[chosen] / scale,
                  _values(mesh, RADII)[chosen].astype(np.float64) / scale, _colors(mesh)[chosen], index, numbers, names,
                  source=item.name)
    return atoms, _others(mesh, chosen)


def selections(item):
    """Names of the attributes that select atoms."""
    return [attribute.name for attribute in item.data.attributes
            if attribute.data_type == "BOOLEAN" and attribute.domain == "POINT" and not attribute.name.startswith(".")]


def _chosen(item, selection):
    if not selection:
        return np.ones(len(item.data.vertices), dtype=bool)
    if selection not in selections(item):
        raise mns_reader.MnsError(f"{item.name}: no boolean attribute {selection}")
    return _values(item.data, selection).astype(bool)


def _is_number(mesh, name):
    return name in mesh.attributes and mesh.attributes[name].domain == "POINT" and mesh.attributes[name].data_type in ("FLOAT", "INT")


def _positions(mesh):
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64)


def _values(mesh, name):
    return attributes.read(mesh, name, mesh.attributes[name].data_type)[:, 0]


def _colors(mesh):
    """sRGB; the attribute is linear."""
    color = mesh.attributes.get("Color")
    if color is None or color.domain != "POINT" or color.data_type not in ("FLOAT_COLOR", "BYTE_COLOR"):
        return np.tile(np.float32(PLAIN), (len(mesh.vertices), 1))
    linear = np.clip(attributes.read(mesh, "Color", color.data_type)[:, :3], 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055).astype(np.float32)


def _others(mesh, chosen):
    """All other attributes of the atoms, which go with them to the vertices of the surface under their own names."""
    ours = {RADII, "Color", "position", *ARRAYS}
    names = [attribute.name for attribute in mesh.attributes
             if attribute.domain == "POINT" and attribute.data_type in attributes.TYPES and attribute.name not in ours
             and not attribute.name.startswith(".")]
    return [attributes.Kept(name, mesh.attributes[name].data_type, "POINT", attributes.read(mesh, name, mesh.attributes[name].data_type),
                            chosen.copy()) for name in names]
