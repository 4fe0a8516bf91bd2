// SPDX-License-Identifier: BSD-3-Clause
// How good the triangles of a mesh on a surface are: near to equilateral, and facing outwards.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/constants.h"
#include "core/mesh/half_edges.h"

namespace meniscus {

/// What a vertex of a mesh on a surface has beside its position.
struct MeshVertex {
  glm::dvec3 normal{0.0};        ///< of the surface
  std::uint32_t face = kNone;    ///< of the surface
  std::uint32_t crease = kNone;  ///< the border that it moves along, or kNone
  float size = 0.0f;             ///< Å, edges wanted around it
  float scale = 1.0f;            ///< what refinements made of that
  float least_cosine = 0.0f;     ///< triangles whose normals have a smaller one with the vertex's are folded over
  bool pinned = false;           ///< stays: creases end or meet here, or it was put here for good
  bool frozen = false;           ///< stays, as edges between two such ones do, but for mending
  bool active = true;            ///< passes change what is around it
  bool changed = true;           ///< since forget_changes()

  /// The surface has no single normal here.
  bool on_crease() const { return crease != kNone || pinned; }
};

/// What a quality falls by if the triangle is folded over.
inline constexpr double kFold = 2.0;

/// Of some triangles how many are folded over, and the worst quality.
class WorstQuality {
 public:
  void add(double quality) {
    if (quality < 0.0) ++folded_, quality += kFold;
    worst_ = std::min(worst_, quality);
  }
  /// The more the better; folds count before anything else.
  double score() const { return worst_ - folded_; }

 private:
  int folded_ = 0;
  double worst_ = 1.0;
};

/// Qualities of triangles, remembered as long as nothing around them changes.
class TriangleQuality {
 public:
  /// All three have to live as long.
  TriangleQuality(const HalfEdges& links, const std::vector<glm::dvec3>& positions,
                  const std::vector<MeshVertex>& vertices)
      : links_(links), positions_(positions), vertices_(vertices) {
    make_room();
  }

  /// Of a triangle of these vertices, the first of them at x; less kFold if it is folded over.
  double of(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const;
  /// The same of a triangle as it is.
  double of(std::uint32_t triangle) const;
  /// Of all triangles around a vertex; as if it were at x.
  double score_around(std::uint32_t vertex) const;
  double score_around(std::uint32_t vertex, const glm::dvec3& x) const;

  /// Finds and remembers all of them.
  void find_all();
  void remember(std::uint32_t triangle, double quality) { known_[triangle] = static_cast<float>(quality); }
  void forget(std::uint32_t triangle) { known_[triangle] = kUnknown, stale_[triangle] = 1; }
  void forget_all();
  /// Marks what has to be asked again whether its edges should be flipped.
  void make_stale(std::uint32_t triangle) { stale_[triangle] = 1; }
  /// Per triangle whether it was stale; none is from now on.
  std::vector<std::uint8_t> take_stale();
  /// For triangles that were added.
  void make_room();
  /// Before HalfEdges::compact().
  void compact();

 private:
  static constexpr float kUnknown = 9.0f;
  bool is_folded(std::uint32_t vertex, const glm::dvec3& normal, double size) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  const std::vector<MeshVertex>& vertices_;
  std::vector<float> known_;  ///< per triangle, or kUnknown
  std::vector<std::uint8_t> stale_;
};

}  // namespace meniscus
