// SPDX-License-Identifier: BSD-3-Clause
// The writers of the table, one a file. Each writes all of its file but does not commit it.
#pragma once

#include "core/base/output_file.h"
#include "exporters/mesh_files/mesh_file.h"

namespace meniscus {

/// Binary STL (3D Systems, "StereoLithography Interface Specification", 1989): triangles with their normals alone.
void write_stl(OutputFile& file, const MeshFile& mesh);
/// 3MF core specification 1.3 with the materials extension's colour groups: a zip archive.
void write_3mf(OutputFile& file, const MeshFile& mesh);
/// Wavefront OBJ: vertices with colours behind their coordinates, normals, an `o` each object.
void write_obj(OutputFile& file, const MeshFile& mesh);
/// Object File Format of Geomview, as text: positions and triangles alone.
void write_off(OutputFile& file, const MeshFile& mesh);
/// glTF 2.0 in one binary file (ISO/IEC 12113:2022, section 4.4); numbers are attributes with an underscore.
void write_glb(OutputFile& file, const MeshFile& mesh);
/// VTK's XML polygons with raw appended arrays (W. Schroeder et al., "The VTK user's guide", 2010, section 19.3).
void write_vtp(OutputFile& file, const MeshFile& mesh);
/// TetGen's facets with a marker a component, points in cavities as holes, points in solids as regions (H. Si, "TetGen
/// user's manual", 2013, section 5.2.3).
void write_smesh(OutputFile& file, const MeshFile& mesh);
/// Dots of the program dms (C. Huang, UCSF; its manual page): each atom, and behind it its vertices with kind, area and
/// normal. Coordinates are Å whatever the scale.
void write_dms(OutputFile& file, const MeshFile& mesh);
/// Binary little-endian PLY (G. Turk 1994).
void write_ply(OutputFile& file, const MeshFile& mesh);

}  // namespace meniscus
