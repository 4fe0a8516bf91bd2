// SPDX-License-Identifier: BSD-3-Clause
// Improves a mesh on a surface by single changes where passes over it left triangles that are bad or not allowed.
#pragma once

#include "core/mesh/mesh_change.h"

namespace meniscus {

/// True if a triangle may be made.
using Allowed = std::function<bool(const PlacedTriangle&)>;

/// A triangle and a point of the surface that is near it.
struct PointAtTriangle {
  std::uint32_t triangle = kNone;
  SurfacePoint at;
};

/// Tries small changes at bad triangles and makes the best ones.
class MeshMender {
 public:
  /// `mesh` must outlive the mender. No change is tried once CrossingGuard::work() of the mesh exceeds `most_work`.
  MeshMender(MeshOnSurface& mesh, Allowed allowed, std::uint64_t most_work = ~std::uint64_t{0})
      : mesh_(mesh), allowed_(std::move(allowed)), most_work_(most_work) {}

  /// Changes these triangles, and all others with small angles, one by one until they cross no others, are allowed and
  /// have larger angles, as far as one flip, collapse, split or move achieves that. No other triangles come to cross or
  /// to be forbidden.
  void mend(std::span<const std::uint32_t> triangles);
  /// Does the same for these triangles only, and for those that replace them.
  void mend_only(std::span<const std::uint32_t> triangles);
  /// Inserts vertices at these points, or moves vertices there, where nothing comes to cross; they are pinned.
  void insert_points(std::span<const PointAtTriangle> points);

 private:
  /// The attributes of a vertex that a change inserts or moves.
  struct PlacedVertex {
    std::uint32_t vertex = kNone;
    glm::dvec3 normal{0.0};
    double least_cosine = 0.0;
    bool on_crease = false;
  };

  struct Candidate {
    std::ptrdiff_t fewer_faults;  ///< number of faults that the change removes
    double gain;                  ///< increase of the score
    MeshChange change;
  };
  using Candidates = std::vector<Candidate>;

  /// Caches the faults of triangles that changes would remove, while the mesh stays as it is.
  class FaultCache;

  bool is_faulty(std::uint32_t triangle) const;
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
  std::ptrdiff_t fault_reduction(const TriangleExchange& exchange, FaultCache& faults) const;
  bool is_sliver(std::uint32_t triangle) const;
  Candidates better_changes(std::uint32_t triangle) const;
  Candidates repairing_changes(std::uint32_t triangle) const;
  static void sort_candidates(Candidates& candidates, bool sliver);
  bool apply_first(const Candidates& candidates);
  std::vector<std::optional<Candidates>> find_independent_changes(std::span<const std::uint32_t> bad,
                                                                  std::span<const std::uint8_t> doubtful);
  bool has_changed_around(std::uint32_t triangle) const;
  void mend(std::vector<std::uint32_t> bad, std::vector<std::uint8_t> doubtful);

  MeshOnSurface& mesh_;
  Allowed allowed_;
  std::uint64_t most_work_;
  /// Per vertex: nonzero if its neighbourhood or place has changed since the round began.
  std::vector<std::uint8_t> changed_;
};

}  // namespace meniscus
