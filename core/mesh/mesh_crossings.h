// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh that pass through one another, and a guard that keeps a changing mesh from doing so.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "core/base/constants.h"
#include "core/math/box.h"
#include "core/mesh/half_edges.h"

namespace meniscus {

struct Ball;

/// Have two boxes no point in common?
inline bool are_apart(const Box& a, const Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z ||
         b.low.z > a.high.z;
}
inline double longest_side(const Box& box) {
  const glm::dvec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

/// A grid without bounds (Teschner, Heidelberger, Mueller, Pomeranets & Gross, "Optimized spatial hashing", 2003): each
/// bucket has the boxes of some cells.
class BoxGrid {
 public:
  /// cell: Å, the side of a cell; count: about how many boxes will be added.
  explicit BoxGrid(double cell = 1.0, std::size_t count = 0)
      : cells_(1.0 / cell), heads_(std::bit_ceil(std::max(2 * count, kFewestBuckets)), kNone) {}

  void add(std::uint32_t number, const Box& box) {
    for_each_bucket(box, [&](std::size_t bucket) {
      std::uint32_t& head = heads_[bucket];
      if (head != kNone && entries_[head].number == number) return;  // of another cell
      entries_.push_back({number, head});
      head = static_cast<std::uint32_t>(entries_.size() - 1);
    });
  }

  /// visit(number) for all boxes that may meet this one, some of them several times.
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
    const glm::i64vec3 cut(at);  // towards 0
    return cut - glm::i64vec3(at.x < static_cast<double>(cut.x), at.y < static_cast<double>(cut.y),
                              at.z < static_cast<double>(cut.z));
  }
  /// Cells of a cube of 4 x 4 x 4 have buckets side by side: near in space, near in memory.
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

  double cells_;                      ///< per Å
  std::vector<std::uint32_t> heads_;  ///< per bucket, into entries_, or kNone
  std::vector<Entry> entries_;
};

/// A triangle by the numbers of its vertices and where these are (Å).
struct PlacedTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<glm::dvec3, 3> at{};

  Box box() const { return {glm::min(glm::min(at[0], at[1]), at[2]), glm::max(glm::max(at[0], at[1]), at[2])}; }
};

/// Have these a point in common other than a vertex or edge that both have? Decided by signs of volumes in double
/// precision.
bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b);

/// Per vertex of a closed mesh, whether its triangles go around it once as seen from one direction, from which all look
/// the same way and none leans almost at a right angle: of these no two cross.
std::vector<std::uint8_t> flat_fans(const HalfEdges& links, std::span<const glm::dvec3> positions);

/// All pairs of triangles that have a point in common other than a vertex or edge that both have, in ascending order.
/// flat: of flat_fans(), or nothing; what is known from it is not computed. Runs on all cores TBB may use.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_triangles(
    std::span<const glm::dvec3> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint8_t> flat = {});

/// Those of these pairs in which one of `some` (ascending) is: sooner found where these are few.
std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings_of(
    std::span<const std::uint32_t> some, std::span<const glm::dvec3> positions,
    std::span<const std::array<std::uint32_t, 3>> triangles);

/// Knows which vertices are watched, and the triangles at them, in a grid. Triangles that changed or are gone may still
/// be listed; they are looked at as they are now.
class CrossingGuard {
 public:
  /// Watches nothing. links, positions: of the mesh that it guards; they have to live as long.
  CrossingGuard(const HalfEdges& links, const std::vector<glm::dvec3>& positions)
      : links_(links), positions_(positions), watched_(links.vertex_count(), 0) {}

  /// Watches the vertices in these balls from now on.
  void watch(std::span<const Ball> places) { mark(places, kLasting); }
  /// Watches what is around these triangles until release().
  void watch_around(std::span<const std::uint32_t> triangles);
  void release();
  bool watches(std::uint32_t vertex) const { return watched_[vertex] != 0; }

  /// A vertex that came between these two is watched if one of them is.
  void add_vertex(std::uint32_t a, std::uint32_t b) { watched_.push_back(watched_[a] | watched_[b]); }
  /// So is a vertex that another goes into.
  void merge_vertex(std::uint32_t a, std::uint32_t into) { watched_[into] |= watched_[a]; }
  /// Lists a triangle that is new or has moved.
  void add(std::uint32_t triangle);
  /// After HalfEdges::compact(), which returned this.
  void compact(std::span<const std::uint32_t> old_vertices);

  /// How many pairs of the new triangles, which are neighbours, pass through one another, or of one of them and one
  /// that is listed and stays? `gone` are those that they replace. Once there are `enough`, no more are looked for. Not
  /// for several threads at once.
  std::size_t crossings(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone,
                        std::size_t enough = kAll) const;
  PlacedTriangle placed(std::uint32_t triangle) const;
  /// How many triangles all questions so far looked at: what they cost, the same for any number of threads.
  std::uint64_t work() const { return work_; }

 private:
  /// How a vertex is watched: bits.
  static constexpr std::uint8_t kLasting = 1, kForNow = 2;
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  void mark(std::span<const Ball> places, std::uint8_t how);
  void list();
  void list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> gone) const;

  const HalfEdges& links_;
  const std::vector<glm::dvec3>& positions_;
  std::vector<std::uint8_t> watched_;  ///< per vertex
  BoxGrid grid_;
  // of the last question: not to be asked by two threads
  mutable std::vector<std::pair<Box, PlacedTriangle>> near_;
  mutable std::vector<std::uint32_t> seen_;  ///< per triangle: the number of the question that last met it
  mutable std::uint32_t question_ = 0;
  mutable std::uint64_t work_ = 0;
};

}  // namespace meniscus
