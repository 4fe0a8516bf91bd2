// SPDX-License-Identifier: BSD-3-Clause
// Meshes of components as MSMS numbers them, and the text of its .vert, .face and .area files.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/atom_areas.h"
#include "core/surface/reduced_components.h"

namespace meniscus {

struct TriangleMesh;

/// Kinds of faces as files of MSMS 2.6 have them; its manual page has 1 and 3 the other way round.
enum class MsmsFaceKind : std::uint8_t { contact = 1, reentrant = 2, toric = 3 };

struct MsmsVertex {
  glm::dvec3 position{0.0}, normal{0.0};  ///< Å; unit, towards the solvent
  std::int32_t face = 0;   ///< 0: a vertex of the analytic surface; -n: on an edge of face n; n: inside face n
  std::uint32_t atom = 0;  ///< the touched atom whose sphere is closest, into Surface::atoms
  std::uint8_t level = 2;  ///< 1: inside a contact face; 3: inside a spheric re-entrant one; 2: all others
};

struct MsmsTriangle {
  std::array<std::uint32_t, 3> corner{};  ///< into the vertices, counter-clockwise seen from the solvent
  MsmsFaceKind kind = MsmsFaceKind::contact;
  std::uint32_t face = 0;  ///< from 1: toric and re-entrant faces first, contact faces last
};

/// Closed. Vertices of the analytic surface come first, then those on edges, then those inside faces.
struct MsmsMesh {
  std::vector<MsmsVertex> vertices;
  std::vector<MsmsTriangle> triangles;  ///< in the order of their faces
};

/// Coordinates in files have three decimals: what lies nearer together would coincide there.
inline constexpr double kMsmsStep = 0.001;

/// The longest edge (Å) of a mesh with about so many vertices per Å². density > 0.
double msms_edge(double density);

/// Welds vertices of an edge that three decimals cannot tell apart, where the mesh stays closed and keeps its genus.
void weld_for_files(MsmsMesh& mesh);

/// The meshes of components, one after another.
class MsmsMeshes {
 public:
  /// `mesh` is of `surface` as tessellate() made it. All three live longer.
  MsmsMeshes(const Surface& surface, const TriangleMesh& mesh, const ReducedComponents& components);
  ~MsmsMeshes();

  /// Vertices of an edge that three decimals cannot tell apart are welded where the mesh stays closed and keeps its
  /// genus. One thread at a time.
  MsmsMesh of(std::uint32_t component);

 private:
  class Numbering;
  std::unique_ptr<Numbering> numbering_;
};

/// The spheres as they were given, some of which may have no ball in the surface.
struct MsmsSpheres {
  std::string file;                    ///< the name given, for headers
  std::vector<std::string> names;      ///< one each, for the last column; empty: no such column
  std::vector<std::uint32_t> of_atom;  ///< per Surface::atoms: which sphere, from 0
  std::size_t count = 0;
};

/// The lines above the rows: those of MSMS, or those of NanoShaper, the third of which is the number of rows alone.
struct MsmsHeader {
  bool wanted = true;
  double density = 0.0;        ///< vertices per Å², as asked
  double probe_radius = 0.0;   ///< Å
  bool of_nanoshaper = false;  ///< rows of vertices end with a blank, too
};

/// Rows of nine columns, ten with names: position, normal, face, closest sphere (from 1), level, name.
std::string vert_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header);

/// Rows of five: corners (from 1), kind, face.
std::string face_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header);

/// The same mesh as OFF, as NanoShaper writes it unless it is asked for the files of MSMS: counts in the fourth line,
/// corners from 0.
std::string off_text(const MsmsMesh& mesh);

/// A line of titles, then a row for each sphere: its number from 0, areas of each component (solvent-excluded,
/// solvent-accessible, Å²), name. areas: one for each component.
std::string area_text(std::span<const AtomAreas> areas, const MsmsSpheres& spheres);

}  // namespace meniscus
