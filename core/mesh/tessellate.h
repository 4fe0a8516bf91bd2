// SPDX-License-Identifier: BSD-3-Clause
// Triangulates the faces of a surface between shared samples of their borders and joins them to one closed mesh.
#pragma once

#include <map>

#include "core/mesh/border_samples.h"
#include "core/mesh/face_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {

/// Fills faces with triangles, and samples borders more finely where that fails.
class FaceFilling {
 public:
  /// All three arguments must outlive this object. Borders with chords that cross are sampled more finely.
  FaceFilling(const Surface& surface, const EdgeRule& rule, BorderSamples& samples);

  /// Fills these faces of the surface into `meshes`, which has one entry for each face of the surface. If a border is
  /// sampled more finely, the faces at it that were filled before are filled again. A face that shrank to a point or to
  /// one line has no triangles. Throws OpenSurfaceError if borders cross.
  void fill(std::vector<std::uint32_t> faces, std::vector<FaceMesh>& meshes);

 private:
  double edge(const Face& face) const { return rule_.edge(tube_radius(surface_, face)); }
  int frequency(const Face& face) const { return lattice_frequency(edge(face) / tube_radius(surface_, face)); }
  void make_lattices(const std::vector<std::uint32_t>& faces);
  FaceOutline outline(std::uint32_t face) const;
  FaceMesh filled(std::uint32_t face) const;
  void fan(std::uint32_t face, FaceMesh& mesh) const;

  const Surface& surface_;
  const EdgeRule& rule_;
  BorderSamples& samples_;
  std::map<int, SphereLattice> lattices_;
  std::vector<bool> is_requested_;  ///< per face of the surface: true if it was to be filled
};

/// Meshes every face of `surface` between shared samples of its borders, on all cores that TBB may use. The mesh is the
/// same for any number of threads. Throws Error if the tolerance is not a positive number or the edge length is
/// negative, and OpenSurfaceError if the result would not be closed or would not have the areas and volumes of the
/// surface (compare_mesh.h).
TriangleMesh tessellate(const Surface& surface, const MeshOptions& options = {});

/// Meshes the surface and compares the areas of faces and the volumes of components with the sums of their triangles.
/// Where a face is thinner than its borders bend, finer meshes are tried. Throws OpenSurfaceError with the first
/// difference.
void check_by_mesh(const Surface& surface);

}  // namespace meniscus
