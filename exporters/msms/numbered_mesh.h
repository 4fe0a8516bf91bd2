// SPDX-License-Identifier: BSD-3-Clause
// Which sphere, face and kind the vertices and triangles of a component are of, numbered as MSMS does.
#pragma once

#include <cstdint>
#include <memory>

#include "core/surface/reduced_components.h"
#include "exporters/msms/msms_mesh.h"

namespace meniscus {

struct TriangleMesh;

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

}  // namespace meniscus
