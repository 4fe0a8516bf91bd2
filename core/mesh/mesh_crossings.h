// SPDX-License-Identifier: BSD-3-Clause
// Finds triangles of a mesh that pass through one another, and guards a changing mesh against them.
#pragma once

#include <bit>
#include <cstddef>
#include <utility>

#include "core/base/constants.h"
#include "core/math/box.h"
#include "core/mesh/half_edges.h"

namespace meniscus {

struct Ball;

/// True if two boxes have no point in common.
inline bool are_apart(const Box& a, const Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z ||
         b.low.z > a.high.z;
}
inline double longest_side(const Box& box) {
  const glm::dvec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

/// An unbounded hash grid of boxes (Teschner, Heidelberger, Mueller, Pomeranets & Gross, "Optimized spatial hashing",
/// 2003). Each bucket lists the boxes of some cells.
class BoxGrid {
 public:
  /// `cell` is the side of a cell in Å, `count` about the number of boxes that will be added.
  explicit BoxGrid(double cell = 1.0, std::size_t count = 0)
      : cells_(1.0 / cell), heads_(std::bit_ceil(std::max(2 * count, kFewestBuckets)), kNone) {}

  void add(std::uint32_t number, const Box& box) {
    for_each_bucket(box, [&](std::size_t bucket) {
      std::uint32_t& head = heads_[bucket];
      if (head != kNone && entries_[head].number == number) return;  // already listed by another cell
      entries_.push_back({number, head});
      head = static_cast<std::uint32_t>(entries_.size() - 1);
    });
  }

  /// Calls visit(number) for all boxes that may meet this one; some boxes are visited several times.
  template <typename Visit>
  void for_each_near(const Box& box, const Visit& visit) const {
    for_each_bucket(box, [&](std::size_t bucket) { for_each_in(bucket, visit); });
  }

  std::size_t bucket_count() const { return heads_.size(); }
  std::size_t bucket_of(const glm::dvec3& x) const { return bucket_of_cell(cell_of(x)); }
  template <typename Visit>
  void for_each_in(std::size_t bucket, const Visit& visit) const {
    for (std::uint32_t e = heads_[bucket]; e != kNone; e = entries_[e].next) visit(entries_[e].number);
  }

 private:
  static constexpr std::size_t kFewestBuckets = 64;
  struct Entry {
    std::uint32_t number, next;
  };

  glm::i64vec3 cell_of(const glm::dvec3& x) const {
    const glm::dvec3 at = x * cells_;
    const glm::i64vec3 cut(at);  // truncated towards 0
    return cut - glm::i64vec3(at.x < static_cast<double>(cut.x), at.y < static_cast<double>(cut.y),
                              at.z < static_cast<double>(cut.z));
  }
  /// Maps the cells of a cube of 4 x 4 x 4 to adjacent buckets, so that cells near in space are near in memory.
  std::size_t bucket_of_cell(const glm::i64vec3& cell) const {
    const glm::i64vec3 cube = cell >> std::int64_t{2}, in_cube = cell & std::int64_t{3};
    const auto hash = static_cast<std::size_t>((cube.x * 73856093) ^ (cube.y * 19349663) ^ (cube.z * 83492791));
    const auto place = static_cast<std::size_t>(in_cube.x | (in_cube.y << 2) | (in_cube.z << 4));
    return (hash * 64 + place) & (heads_.size() - 1);
  }
  template <typename Visit>
  void for_each_bucket(const Box& box, const Visit& visit) const {
    const glm::i64vec3 low = cell_of(box.low), high = cell_of(box.high);
    glm::i64vec3 at = low;
    for (at.x = low.x; at.x <= high.x; ++at.x)
      for (at.y = low.y; at.y <= high.y; ++at.y)
        for (at.z = low.z; at.z <= high.z; ++at.z) visit(bucket_of_cell(at));
  }

  double cells_;                      ///< cells per Å
  std::vector<std::uint32_t> heads_;  ///< per bucket: its first entry in entries_, or kNone
  std::vector<Entry> entries_;
};

/// A triangle by the numbers and positions (Å) of its vertices.
struct PlacedTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<glm::dvec3, 3> at{};

  Box box() const { return {glm::min(glm::min(at[0], at[1]), at[2]), glm::max(glm::max(at[0], at[1]), at[2])}; }
};

/// True if two triangles have a point in common other than a shared vertex or edge. Signs of volumes decide.
bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b);

/// Returns for each vertex of a closed mesh true if, seen from some direction, its triangles form one closed fan, all
/// face that direction, and none leans almost at a right angle. No two triangles of such a fan cross.
std::vector<std::uint8_t> flat_fans(const HalfEdges& links, std::span<const glm::dvec3> positions);

/// Returns all pairs of triangles that have a point in common other than a shared vertex or edge, in ascending order.
/// `flat` is a result of flat_fans(), or empty; pairs that share a vertex with a flat fan are not tested. Runs on all
/// cores that TBB may use.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_triangles(
    std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint8_t> flat = {});

/// Returns the pairs among these that contain one of the triangles `some` (ascending); faster if these are few.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings_of(
    std::span<const std::uint32_t> some, std::span<const glm::dvec3> positions,
    std::span<const std::array<std::uint32_t, 3>> triangles);

/// Checks changes of a mesh for crossings around guarded vertices, with the triangles at these in a grid. The grid may
/// still list triangles that have changed or were removed; they are inspected in their present state.
class CrossingGuard {
 public:
  /// Guards nothing at first. `links` and `positions` are those of the guarded mesh and must outlive the guard.
  CrossingGuard(const HalfEdges& links, const std::vector<glm::dvec3>& positions)
      : links_(links), positions_(positions), guards_(links.vertex_count(), 0) {}

  /// Guards the vertices in these balls permanently.
  void guard_balls(std::span<const Ball> places) { mark(places, kPermanent); }
  /// Guards the vertices around these triangles until release().
  void guard_around(std::span<const std::uint32_t> triangles);
  void release();
  bool is_guarded(std::uint32_t vertex) const { return guards_[vertex] != 0; }

  /// Adds a new vertex between a and b, which is guarded if one of these is.
  void add_vertex(std::uint32_t a, std::uint32_t b) { guards_.push_back(guards_[a] | guards_[b]); }
  /// Notes that vertex a is merged into another one, which is then guarded if either was.
  void merge_vertex(std::uint32_t a, std::uint32_t into) { guards_[into] |= guards_[a]; }
  /// Lists a triangle that is new or has moved.
  void add(std::uint32_t triangle);
  /// Renumbers vertices after HalfEdges::compact(), which returned `old_vertices`.
  void compact(std::span<const std::uint32_t> old_vertices);

  /// Returns the number of crossing pairs that exist once `made` replace the triangles `removed`: pairs of the new
  /// triangles, which are neighbours, and pairs of a new triangle and a listed one that remains. Stops counting at
  /// `enough`. Not safe to call from several threads at once.
  std::size_t crossings(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> removed,
                        std::size_t enough = kAll) const;
  PlacedTriangle placed(std::uint32_t triangle) const;
  /// Returns the number of triangles that all calls so far inspected: a measure of cost that is the same for any number
  /// of threads.
  std::uint64_t work() const { return work_; }

 private:
  /// The bits of guards_: whether a vertex is guarded until release(), or permanently.
  static constexpr std::uint8_t kPermanent = 1, kTemporary = 2;
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  void mark(std::span<const Ball> places, std::uint8_t bits);
  void list();
  void list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> removed) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  std::vector<std::uint8_t> guards_;  ///< bits of each vertex
  BoxGrid grid_;
  // The scratch memory of the last query, which is why queries are not thread-safe.
  mutable std::vector<std::pair<Box, PlacedTriangle>> near_;
  mutable std::vector<std::uint32_t> seen_;  ///< per triangle: the number of the query that last met it
  mutable std::uint32_t query_ = 0;
  mutable std::uint64_t work_ = 0;
};

}  // namespace meniscus
