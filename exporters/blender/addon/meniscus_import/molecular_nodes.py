# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads atoms of an object in the form of Molecular Nodes: a vertex per atom, named attributes, radii in Blender
units."""

import numpy as np

from . import attributes, mns_reader
from .computing.atoms import Atoms

#: The attribute with the radii, which must exist.
RADII = "vdw_radii"
#: Optional attributes, and their arrays and types in .mns files.
ARRAYS = {"b_factor": ("atom.b_factor", np.float32), "atomic_number": ("atom.atomic_number", np.int32),
          "res_id": ("atom.res_id", np.int32), "chain_id": ("atom.chain_id", np.int32)}
#: Possible scales in Blender units per Å. Molecular Nodes has used 0.01 and 0.1.
SCALES = 10.0 ** np.arange(-4, 3)
#: A typical radius of atoms in all published tables, Å.
USUAL_RADIUS = 1.6
#: sRGB of atoms without an attribute Color.
PLAIN = (0.78, 0.80, 0.83)


def is_molecule(item):
    return item is not None and item.type == "MESH" and RADII in item.data.attributes


def scale_of(item):
    """Returns the scale in Blender units per Å: the power of ten for which the radii are those of atoms. Raises
    MnsError if no atom has a radius."""
    radii = _values(item.data, RADII)
    radii = radii[np.isfinite(radii) & (radii > 0)]
    if not len(radii):
        raise mns_reader.MnsError(f"{item.name}: no atom has a radius")
    return float(SCALES[np.argmin(np.abs(np.log10(np.median(radii) / USUAL_RADIUS / SCALES)))])


def frames_of(item):
    """Returns the objects with the frames of a molecule in order. Molecular Nodes keeps them in a collection with a
    special name."""
    import bpy

    collection = bpy.data.collections.get(f".data_{item.name}_frames")
    count = len(item.data.vertices)
    frames = [] if collection is None else [
        other for other in collection.objects if other.type == "MESH" and len(other.data.vertices) == count]
    return sorted(
        frames,
        key=lambda other: int("0" + "".join(c for c in other.name.rpartition("_")[2].split(".")[0] if c.isdigit())))


def read(item, scale, selection="", place=0):
    """Returns the selected atoms.Atoms, and their other attributes by atom as attributes.Kept. selection: the name of a
    boolean attribute, or "". place: the place of the frame, from 1; 0 for the object itself. Raises MnsError."""
    mesh = item.data
    count = len(mesh.vertices)
    if not is_molecule(item) or not count:
        raise mns_reader.MnsError(f"{item.name}: its vertices are not atoms: they have no attribute {RADII}")
    chosen = _chosen(item, selection)
    if not chosen.any():
        raise mns_reader.MnsError(f"{item.name}: the selection {selection} has no atom")
    index = np.flatnonzero(chosen).astype(np.uint32)
    numbers = {
        array: _values(mesh, name)[chosen].astype(kind) for name, (array, kind) in ARRAYS.items()
        if _is_number(mesh, name)}
    names = [str(name) for name in item.get("chain_ids", [])]
    chains = numbers.get("atom.chain_id")
    if chains is not None and not 0 <= chains.min() <= chains.max() < len(names):
        names = [f"{number:06d}" for number in range(max(int(chains.max()), 0) + 1)]  # sorted texts keep their order
        numbers["atom.chain_id"] = np.maximum(chains, 0)
    atoms = Atoms(_positions(frames_of(item)[place - 1].data if place else mesh)[chosen] / scale,
                  _values(mesh, RADII)[chosen].astype(np.float64) / scale, _colors(mesh)[chosen], index, numbers, names,
                  source=item.name)
    return atoms, _others(mesh, chosen)


def selections(item):
    """Returns the names of the attributes that can select atoms."""
    return [attribute.name for attribute in item.data.attributes
            if attribute.data_type == "BOOLEAN" and attribute.domain == "POINT" and not attribute.name.startswith(".")]


def _chosen(item, selection):
    if not selection:
        return np.ones(len(item.data.vertices), dtype=bool)
    if selection not in selections(item):
        raise mns_reader.MnsError(f"{item.name}: no boolean attribute {selection}")
    return _values(item.data, selection).astype(bool)


def _is_number(mesh, name):
    return (name in mesh.attributes and mesh.attributes[name].domain == "POINT" and
            mesh.attributes[name].data_type in ("FLOAT", "INT"))


def _positions(mesh):
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64)


def _values(mesh, name):
    return attributes.read(mesh, name, mesh.attributes[name].data_type)[:, 0]


def _colors(mesh):
    """Returns the colours of atoms as sRGB. The attribute is linear."""
    color = mesh.attributes.get("Color")
    if color is None or color.domain != "POINT" or color.data_type not in ("FLOAT_COLOR", "BYTE_COLOR"):
        return np.tile(np.float32(PLAIN), (len(mesh.vertices), 1))
    linear = np.clip(attributes.read(mesh, "Color", color.data_type)[:, :3], 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055).astype(np.float32)


def _others(mesh, chosen):
    """Returns all other attributes of the atoms, which vertices of the surface get under the same names."""
    ours = {RADII, "Color", "position", *ARRAYS}
    names = [attribute.name for attribute in mesh.attributes
             if attribute.domain == "POINT" and attribute.data_type in attributes.TYPES and attribute.name not in ours
             and not attribute.name.startswith(".")]
    return [
        attributes.Kept(name, mesh.attributes[name].data_type, "POINT",
                        attributes.read(mesh, name, mesh.attributes[name].data_type), chosen.copy()) for name in names]
