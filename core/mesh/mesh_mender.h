// SPDX-License-Identifier: BSD-3-Clause
// Single changes of a mesh on a surface, where passes over it left triangles that are bad or not allowed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/mesh_change.h"

namespace meniscus {

/// Whether a triangle may be made.
using Allowed = std::function<bool(const PlacedTriangle&)>;

/// A point of the surface that is near a triangle.
struct PointAtTriangle {
  std::uint32_t triangle = kNone;
  SurfacePoint at;
};

class MeshMender {
 public:
  /// mesh: has to live as long. No change is tried once its guard has done more than so much work.
  MeshMender(MeshOnSurface& mesh, Allowed allowed, std::uint64_t most_work = ~std::uint64_t{0})
      : mesh_(mesh), allowed_(std::move(allowed)), most_work_(most_work) {}

  /// Changes these triangles, and all others with small angles, one by one until they pass through no others, are
  /// allowed and have larger angles, wherever one flip, collapse, split or move does that. No others come to cross or
  /// to be forbidden.
  void mend(std::span<const std::uint32_t> triangles);
  /// The same of these alone, and of what comes about there.
  void mend_only(std::span<const std::uint32_t> triangles);
  /// Puts vertices there, or moves some, where nothing comes to cross by that; they stay there.
  void reach(std::span<const PointAtTriangle> points);

 private:
  /// What a vertex that a change makes or moves will be.
  struct PlacedVertex {
    std::uint32_t vertex = kNone;
    glm::dvec3 normal{0.0};
    double least_cosine = 0.0;
    bool on_crease = false;
  };

  struct Candidate {
    std::ptrdiff_t fewer;  ///< how many are wrong fewer than before
    double gain;           ///< of the score
    MeshChange change;
  };
  using Candidates = std::vector<Candidate>;

  /// What is wrong with triangles that changes would take away, while the mesh stays as it is.
  class WrongNow;

  bool is_wrong(std::uint32_t triangle) const;
  bool is_too_short(std::uint32_t half) const;
  bool may_merge(std::uint32_t half) const;
  template <typename Visit>
  void for_each_change(std::uint32_t triangle, bool steep, const Visit& visit) const;
  template <typename Visit>
  void for_each_place(std::uint32_t vertex, const Visit& visit) const;
  double quality(const PlacedTriangle& triangle, const PlacedVertex& placed, bool steep) const;
  double score_after(const MeshChange& change, bool steep, double bar = -std::numeric_limits<double>::infinity()) const;
  double score_before(const MeshChange& change, bool steep) const;
  std::size_t forbidden(std::span<const PlacedTriangle> made, std::size_t enough) const;
  std::ptrdiff_t fewer_wrong(const Exchange& exchange, WrongNow& now) const;
  bool is_sliver(std::uint32_t triangle) const;
  Candidates better_changes(std::uint32_t triangle) const;
  Candidates righting_changes(std::uint32_t triangle) const;
  static void put_best_first(Candidates& candidates, bool sliver);
  bool make_first(const Candidates& candidates);
  std::vector<std::optional<Candidates>> changes_of_first(std::span<const std::uint32_t> bad,
                                                          std::span<const std::uint8_t> doubtful);
  bool has_changed_around(std::uint32_t triangle) const;
  void mend(std::vector<std::uint32_t> bad, std::vector<std::uint8_t> doubtful);

  MeshOnSurface& mesh_;
  Allowed allowed_;
  std::uint64_t most_work_;
  std::vector<std::uint8_t> changed_;  ///< per vertex: since the round began; what is around it or where it is
};

}  // namespace meniscus
