# SPDX-License-Identifier: BSD-3-Clause
"""The constants, structs and functions of meniscus.h without "meniscus_", written by scripts/check/python_header.py."""
from __future__ import annotations

from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from typing import Any

from ._arguments import Struct

(OK, INTERNAL, USAGE, INPUT, NO_GPU, CAPACITY, OUTPUT, NOT_CLOSED) = range(8)
(SES, SAS, VDW) = range(3)
(CPU, AUTO, GPU, SOFTWARE) = range(4)

class Options(Struct):
    _fields_ = [("size", c_size_t), ("probe_radius", c_double), ("kind", c_int32), ("device", c_int32),
                ("threads", c_int32), ("verify", c_int32)]

(DOUBLE, FLOAT) = range(2)

class Atoms(Struct):
    _fields_ = [("size", c_size_t), ("count", c_size_t), ("positions", c_void_p), ("radii", c_void_p),
                ("positions_stride", c_size_t), ("radii_stride", c_size_t), ("positions_type", c_int32),
                ("radii_type", c_int32), ("equal_radii", c_int32), ("reserved", c_int32)]

class Summary(Struct):
    _fields_ = [("size", c_size_t), ("area", c_double), ("volume", c_double), ("probe_radius", c_double),
                ("grown_by", c_double), ("atoms", c_uint64), ("convex", c_uint64), ("toroidal", c_uint64),
                ("concave", c_uint64), ("free_edges", c_uint64), ("spindle", c_uint64), ("fixed_probes", c_uint64),
                ("arcs", c_uint64), ("faces", c_uint64), ("borders", c_uint64), ("vertices", c_uint64),
                ("components", c_uint64), ("cavities", c_uint64), ("device", c_char_p), ("exact_within", c_double)]

class Array(Struct):
    _fields_ = [("data", c_void_p), ("count", c_size_t), ("stride", c_size_t)]

(COMPONENTS, ATOM_AREAS, ATOM_SAS_AREAS, ATOMS, CONVEX, TOROIDAL, CONCAVE, PLANES, CONTACTS, CUTS, VERTICES, BORDERS,
 HALF_BORDERS, LOOPS, FACES) = range(15)
(KIND_CONVEX, KIND_TOROIDAL, KIND_CONCAVE) = range(3)
(BORDER_CONTACT, BORDER_EDGE, BORDER_CUSP) = range(3)
(OUTER, CAVITY) = range(2)

class Component(Struct):
    _fields_ = [("kind", c_uint8), ("area", c_double), ("volume", c_double), ("euler", c_int32)]

class Ball(Struct):
    _fields_ = [("center", c_double * 3), ("radius", c_double)]

class Plane(Struct):
    _fields_ = [("normal", c_double * 3), ("offset", c_double)]

class Convex(Struct):
    _fields_ = [("atom", c_uint32), ("first_plane", c_uint32), ("plane_count", c_uint32), ("first_face", c_uint32),
                ("face_count", c_uint32)]

class Toroidal(Struct):
    _fields_ = [("atom", c_uint32 * 2), ("probe", c_uint32 * 2), ("center", c_double * 3), ("axis", c_double * 3),
                ("radius", c_double), ("start", c_double * 3), ("sweep", c_double), ("first_face", c_uint32),
                ("face_count", c_uint32), ("has_piece", c_uint8 * 2)]

class Concave(Struct):
    _fields_ = [("center", c_double * 3), ("first_contact", c_uint32), ("contact_count", c_uint32),
                ("first_plane", c_uint32), ("side_count", c_uint32), ("cut_count", c_uint32), ("other_count", c_uint32),
                ("first_cut", c_uint32), ("first_face", c_uint32), ("face_count", c_uint32)]

class Border(Struct):
    _fields_ = [("kind", c_uint8), ("center", c_double * 3), ("axis", c_double * 3), ("radius", c_double),
                ("start", c_double * 3), ("sweep", c_double), ("vertex", c_uint32 * 2), ("face", c_uint32 * 2)]

class Loop(Struct):
    _fields_ = [("first_half_border", c_uint32), ("half_border_count", c_uint32)]

class Face(Struct):
    _fields_ = [("kind", c_uint8), ("patch", c_uint32), ("first_loop", c_uint32), ("loop_count", c_uint32),
                ("component", c_uint32), ("tip", c_uint32), ("area", c_double)]

(GRADIENT_AREA, GRADIENT_VOLUME, GRADIENT_SAS_AREA, GRADIENT_SAS_VOLUME) = range(4)
(HYDROGENS_AUTO, HYDROGENS_KEEP, HYDROGENS_DROP) = range(3)
(UNKNOWN_HALT, UNKNOWN_GUESS, UNKNOWN_SKIP) = range(3)

class ReadOptions(Struct):
    _fields_ = [("size", c_size_t), ("select", c_char_p), ("assembly", c_char_p), ("altloc", c_char_p),
                ("radii", c_char_p), ("radii_files", POINTER(c_char_p)), ("radius", POINTER(c_char_p)),
                ("radii_file_count", c_size_t), ("radius_count", c_size_t), ("model", c_int32), ("hydrogens", c_int32),
                ("unknown_element", c_int32), ("keep_water", c_int32), ("keep_ions", c_int32), ("reserved", c_int32)]

class ReadReport(Struct):
    _fields_ = [("size", c_size_t), ("file", c_char_p), ("format", c_char_p), ("radii_set", c_char_p),
                ("sentence", c_char_p), ("read", c_uint64), ("atoms", c_uint64), ("models", c_uint64)]

(STRUCTURE_POSITIONS, STRUCTURE_RADII, STRUCTURE_ELEMENTS, STRUCTURE_INDICES, STRUCTURE_NAMES, STRUCTURE_RESIDUE_NAMES,
 STRUCTURE_CHAINS, STRUCTURE_SEGMENTS, STRUCTURE_RESIDUE_NUMBERS, STRUCTURE_INSERTION_CODES, STRUCTURE_ALTLOCS,
 STRUCTURE_RESIDUES, STRUCTURE_MODELS, STRUCTURE_COPIES, STRUCTURE_CHARGES, STRUCTURE_B_FACTORS, STRUCTURE_OCCUPANCIES,
 STRUCTURE_CLASSES, STRUCTURE_WARNINGS, STRUCTURE_HYDROPATHIES) = range(20)

class PocketOptions(Struct):
    _fields_ = [("size", c_size_t), ("large_probe_radius", c_double), ("trim", c_double), ("min_volume", c_double),
                ("mouth_tolerance", c_double)]

(POCKETS, POCKET_MOUTHS, POCKET_ATOMS, POCKET_PROBES) = range(4)

class Pocket(Struct):
    _fields_ = [("volume", c_double), ("volume_excess", c_double), ("area", c_double), ("mouth_area", c_double),
                ("depth", c_double), ("middle", c_double * 3), ("first_mouth", c_uint32), ("mouth_count", c_uint32),
                ("first_atom", c_uint32), ("atom_count", c_uint32), ("first_probe", c_uint32),
                ("probe_count", c_uint32)]

(MESH_BY_PATCH, MESH_EVEN, MESH_BY_DENSITY) = range(3)

class MeshOptions(Struct):
    _fields_ = [("size", c_size_t), ("method", c_int32), ("split_colors", c_int32), ("tolerance", c_double),
                ("density", c_double)]

(MESH_POSITIONS, MESH_NORMALS, MESH_TRIANGLES, MESH_TRIANGLE_ATOMS, MESH_TRIANGLE_KINDS, MESH_TRIANGLE_FACES,
 MESH_TRIANGLE_PATCHES, MESH_TRIANGLE_COMPONENTS, MESH_SHARP_CORNERS, MESH_SHARP_NORMALS, MESH_VERTEX_ATOMS) = range(11)

class MeshFile(Struct):
    _fields_ = [("size", c_size_t), ("format", c_char_p), ("attributes", c_char_p), ("atom_colors", c_void_p),
                ("scale", c_double), ("color", c_float * 3), ("replace", c_int32)]

(PERSPECTIVE, ORTHOGRAPHIC) = range(2)

class Camera(Struct):
    _fields_ = [("size", c_size_t), ("position", c_double * 3), ("target", c_double * 3), ("up", c_double * 3),
                ("vertical_fov", c_double), ("height", c_double), ("projection", c_int32), ("reserved", c_int32)]

(VALUE_FLAG, VALUE_NUMBER, VALUE_COUNT, VALUE_WORD, VALUE_TEXT, VALUE_FILE, VALUE_NEW_FILE, VALUE_CAMERA) = range(8)

class Property(Struct):
    _fields_ = [("name", c_char_p), ("key", c_char_p), ("value", c_char_p), ("help", c_char_p), ("words", c_char_p),
                ("initial", c_char_p), ("lowest", c_double), ("highest", c_double), ("type", c_int32),
                ("repeatable", c_int32), ("of_surface", c_int32), ("reserved", c_int32)]

#: The types of the result and of the arguments of each function.
FUNCTIONS: dict[str, tuple[Any, list[Any]]] = {
    "last_error": (c_char_p, []), "version": (c_char_p, []), "element_of_symbol": (c_int32, [c_char_p, c_void_p]),
    "element_radius": (c_int32, [c_int32, c_void_p, POINTER(c_char_p)]),
    "default_options": (c_int32, [POINTER(Options)]), "computer_new": (c_int32, [POINTER(Options), POINTER(c_void_p)]),
    "computer_retain": (c_void_p, [c_void_p]), "computer_release": (None, [c_void_p]),
    "compute": (c_int32, [c_void_p, POINTER(Atoms), POINTER(c_void_p)]),
    "recompute": (c_int32, [c_void_p, POINTER(Atoms), POINTER(c_void_p)]), "surface_retain": (c_void_p, [c_void_p]),
    "surface_release": (None, [c_void_p]), "surface_summary": (c_int32, [c_void_p, POINTER(Summary)]),
    "surface_table": (c_int32, [c_void_p, c_int32, POINTER(Array)]),
    "surface_distance": (c_int32, [c_void_p, c_size_t, c_void_p, c_void_p, c_void_p]),
    "surface_gradient": (c_int32, [c_void_p, c_int32, c_void_p, c_void_p]),
    "default_read_options": (c_int32, [POINTER(ReadOptions)]),
    "read": (c_int32, [c_char_p, POINTER(ReadOptions), POINTER(c_void_p)]), "structure_retain": (c_void_p, [c_void_p]),
    "structure_release": (None, [c_void_p]), "structure_atoms": (c_int32, [c_void_p, POINTER(Atoms)]),
    "structure_report": (c_int32, [c_void_p, POINTER(ReadReport)]),
    "structure_table": (c_int32, [c_void_p, c_int32, POINTER(Array)]),
    "structure_colors": (c_int32, [c_void_p, c_char_p, c_void_p]),
    "default_pocket_options": (c_int32, [POINTER(PocketOptions)]),
    "surface_pockets": (c_int32, [c_void_p, POINTER(PocketOptions), POINTER(c_void_p)]),
    "pockets_retain": (c_void_p, [c_void_p]), "pockets_release": (None, [c_void_p]),
    "pockets_table": (c_int32, [c_void_p, c_int32, POINTER(Array)]),
    "default_mesh_options": (c_int32, [POINTER(MeshOptions)]),
    "surface_mesh": (c_int32, [c_void_p, POINTER(MeshOptions), POINTER(c_void_p)]),
    "mesh_retain": (c_void_p, [c_void_p]), "mesh_release": (None, [c_void_p]),
    "mesh_table": (c_int32, [c_void_p, c_int32, POINTER(Array)]), "default_mesh_file": (c_int32, [POINTER(MeshFile)]),
    "mesh_save": (c_int32, [c_void_p, c_char_p, POINTER(MeshFile)]),
    "surface_camera": (c_int32, [c_void_p, c_double, c_int32, POINTER(Camera)]),
    "scene_new": (c_int32, [POINTER(c_void_p)]), "scene_read": (c_int32, [c_char_p, POINTER(c_void_p)]),
    "scene_parse": (c_int32, [c_char_p, POINTER(c_void_p)]), "scene_retain": (c_void_p, [c_void_p]),
    "scene_release": (None, [c_void_p]), "scene_set": (c_int32, [c_void_p, c_char_p, c_char_p]),
    "scene_get": (c_int32, [c_void_p, c_char_p, c_size_t, POINTER(c_char_p)]),
    "scene_json": (c_int32, [c_void_p, c_char_p, POINTER(c_char_p)]),
    "scene_size": (c_int32, [c_void_p, c_void_p, c_void_p]), "scene_properties": (c_int32, [POINTER(Array)]),
    "renderer_new": (c_int32, [c_int32, POINTER(c_void_p)]), "renderer_retain": (c_void_p, [c_void_p]),
    "renderer_release": (None, [c_void_p]), "render_scene": (c_int32, [c_void_p, c_void_p, c_void_p, c_size_t]),
    "render": (c_int32, [c_void_p, c_void_p, c_void_p, POINTER(Camera), c_void_p, c_void_p, c_size_t]),
    "scene_page": (c_int32, [c_void_p, POINTER(c_void_p)]),
    "surface_page": (c_int32, [c_void_p, c_void_p, c_void_p, POINTER(Camera), c_void_p, POINTER(c_void_p)]),
    "page_retain": (c_void_p, [c_void_p]), "page_release": (None, [c_void_p]),
    "page_html": (c_int32, [c_void_p, POINTER(c_char_p), c_void_p])}
