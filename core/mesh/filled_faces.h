// SPDX-License-Identifier: BSD-3-Clause
// Faces filled with triangles, each by itself, between samples of borders that both sides of a border share.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/mesh/border_samples.h"
#include "core/mesh/face_mesh.h"

namespace meniscus {

class FaceFilling {
 public:
  /// All three must live as long; borders whose chords tangle are sampled finer.
  FaceFilling(const Surface& surface, const EdgeRule& rule, BorderSamples& samples);

  /// Fills these faces of the surface into `meshes`, one for each face of the surface; a face whose border was sampled
  /// finer is filled again if it was filled before. What shrunk to a point or to one line has no triangles.
  /// Throws OpenSurfaceError where borders cross.
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
  std::vector<bool> asked_;  ///< per face of the surface
};

/// Lists that grew row by row have room for half as much again.
void give_back_room(FaceMesh& mesh);

}  // namespace meniscus
