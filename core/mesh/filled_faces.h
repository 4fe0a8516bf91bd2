// SPDX-License-Identifier: BSD-3-Clause
// Fills faces with triangles, each by itself, between border samples that both sides of a border share.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/mesh/border_samples.h"
#include "core/mesh/face_mesh.h"

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

/// Frees the unused capacity of lists that grew row by row, which is up to half of their size.
void shrink_lists(FaceMesh& mesh);

}  // namespace meniscus
