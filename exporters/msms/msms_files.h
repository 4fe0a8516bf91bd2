// SPDX-License-Identifier: BSD-3-Clause
// Meshes of components as MSMS numbers them, and the text of its .vert, .face and .area files.
#pragma once

#include <string>

#include "core/surface/measure.h"
#include "core/surface/reduced_components.h"

namespace meniscus {

struct TriangleMesh;

/// Kinds of faces in files of MSMS 2.6. Its manual page exchanges 1 and 3.
enum class MsmsFaceKind : std::uint8_t { contact = 1, reentrant = 2, toric = 3 };

struct MsmsVertex {
  glm::dvec3 position{0.0}, normal{0.0};  ///< position in Å; normal of unit length, towards the solvent
  std::int32_t face = 0;   ///< 0: a vertex of the analytic surface; -n: on an edge of face n; n: inside face n
  std::uint32_t atom = 0;  ///< the touched atom with the closest sphere, index into Surface::atoms
  std::uint8_t level = 2;  ///< 1: inside a contact face; 3: inside a spheric re-entrant one; 2: all others
};

struct MsmsTriangle {
  std::array<std::uint32_t, 3> corner{};  ///< indices into the vertices, counter-clockwise seen from the solvent
  MsmsFaceKind kind = MsmsFaceKind::contact;
  std::uint32_t face = 0;  ///< number of the face, from 1: toric and re-entrant faces first, contact faces last
};

/// A closed mesh. Vertices of the analytic surface come first, then vertices on edges, then vertices inside faces.
struct MsmsMesh {
  std::vector<MsmsVertex> vertices;
  std::vector<MsmsTriangle> triangles;  ///< in the order of their faces
};

/// Coordinates in files have three decimals. Points nearer together than this (Å) could coincide there.
inline constexpr double kMsmsStep = 0.001;

/// Returns the longest edge (Å) of a mesh with about `density` vertices per Å². density > 0.
double msms_edge(double density);

/// Welds the vertices of edges that are shorter than kMsmsStep, where the mesh remains closed and keeps its genus.
void weld_for_files(MsmsMesh& mesh);

/// Makes the meshes of components, one after another.
class MsmsMeshes {
 public:
  /// mesh: the mesh of `surface` that tessellate() made. All three arguments must outlive this object.
  MsmsMeshes(const Surface& surface, const TriangleMesh& mesh, const ReducedComponents& components);
  ~MsmsMeshes();

  /// Returns the mesh of a component, welded by weld_for_files(). Only one thread may call it at a time.
  MsmsMesh of(std::uint32_t component);

 private:
  class Numbering;
  std::unique_ptr<Numbering> numbering_;
};

/// The spheres of the input file. Some of them may have no ball in the surface.
struct MsmsSpheres {
  std::string file;                    ///< name of the input file, for headers
  std::vector<std::string> names;      ///< one per sphere, for the last column; empty if there is no such column
  std::vector<std::uint32_t> of_atom;  ///< number of the sphere of each of Surface::atoms, from 0
  std::size_t count = 0;               ///< number of spheres
};

/// The lines before the rows of a file. The third line of NanoShaper's form has the number of rows only.
struct MsmsHeader {
  bool wanted = true;          ///< true if the header is written
  double density = 0.0;        ///< requested vertices per Å²
  double probe_radius = 0.0;   ///< Å
  bool of_nanoshaper = false;  ///< true for NanoShaper's form, in which rows of vertices also end with a blank
};

/// Returns the text of a .vert file: position, normal, face, closest sphere (from 1), level, perhaps name.
std::string vert_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header);

/// Returns the text of a .face file: rows of five columns: corners (from 1), kind, face.
std::string face_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header);

/// Returns the mesh as OFF in the form that NanoShaper writes by default: counts in the fourth line, corners from 0.
std::string off_text(const MsmsMesh& mesh);

/// Returns the text of an .area file: a line of titles, then a row for each sphere with its number from 0, its areas in
/// each component (solvent-excluded, solvent-accessible, Å²), and its name. areas: one entry for each component.
std::string area_text(std::span<const AtomAreas> areas, const MsmsSpheres& spheres);

}  // namespace meniscus
