// SPDX-License-Identifier: BSD-3-Clause
// Finds triangles that pass through one another in a finished mesh, and refuses changes that would make some.
#include "core/mesh/mesh_crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/math/ball.h"
#include "core/mesh/remesh_tuning.h"

namespace meniscus {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The side of a grid cell in units of the mean longest side of the boxes.
constexpr double kCellSides = 1.5;
/// Two triangles with a common edge are folded onto one another if the product of their unit normals is not above this.
constexpr double kFolded = -1.0 + 1e-12;
/// The cosine between the normals of a flat fan's triangles and the direction that it is seen from is above this.
constexpr double kLeastFlat = 0.2;

/// Returns six times the volume of a tetrahedron; above 0 if d sees a, b, c clockwise.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(a - d, glm::cross(b - d, c - d));
}

/// True if the segment from p to q meets the triangle. The signs of `at_p` and `at_q` show on which sides of the
/// triangle's plane p and q are.
bool passes_through(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t, double at_p,
                    double at_q) {
  if ((at_p > 0.0 && at_q > 0.0) || (at_p < 0.0 && at_q < 0.0) || (at_p == 0.0 && at_q == 0.0)) return false;
  const double u = volume(p, q, t[0], t[1]), v = volume(p, q, t[1], t[2]), w = volume(p, q, t[2], t[0]);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

/// True if the fan of a vertex is flat, see flat_fans().
bool is_flat_fan(const HalfEdges& links, std::span<const glm::dvec3> positions, std::uint32_t vertex) {
  const glm::dvec3& x = positions[vertex];
  const auto normal = [&](std::uint32_t half) {
    return glm::cross(positions[links.to(half)] - x, positions[links.opposite(half)] - x);
  };
  glm::dvec3 direction(0.0);
  links.for_each_leaving(vertex, [&](std::uint32_t half) { direction += normal(half); });
  const double least = kLeastFlat * kLeastFlat * glm::dot(direction, direction);
  const bool faces_one_way = links.all_leaving(vertex, [&](std::uint32_t half) {
    const glm::dvec3 n = normal(half);
    const double along = glm::dot(n, direction);
    return along > 0.0 && along * along > least * glm::dot(n, n);
  });
  if (!faces_one_way) return false;
  const glm::dvec3 side = glm::cross(direction, positions[links.to(links.leaving(vertex))] - x);
  int turns = 0;  // number of times that the fan goes over to this side
  links.for_each_leaving(vertex, [&](std::uint32_t half) {
    const bool before = glm::dot(positions[links.to(half)] - x, side) < 0.0;
    turns += before && !(glm::dot(positions[links.opposite(half)] - x, side) < 0.0);
  });
  return turns == 1;
}

bool passes_through(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
  return passes_through(p, q, t, volume(t[0], t[1], t[2], p), volume(t[0], t[1], t[2], q));
}

/// Returns numbers whose signs show on which side of a triangle's plane each corner of another triangle is.
std::array<double, 3> sides_of(const std::array<glm::dvec3, 3>& triangle, const std::array<glm::dvec3, 3>& other) {
  const auto side = [&](const glm::dvec3& x) { return volume(triangle[0], triangle[1], triangle[2], x); };
  return {side(other[0]), side(other[1]), side(other[2])};
}
bool is_one_side(const std::array<double, 3>& sides) {
  return (sides[0] > 0.0 && sides[1] > 0.0 && sides[2] > 0.0) || (sides[0] < 0.0 && sides[1] < 0.0 && sides[2] < 0.0);
}

/// True if two triangles without a common corner meet.
bool cross_apart(const std::array<glm::dvec3, 3>& x, const std::array<glm::dvec3, 3>& y) {
  const std::array<double, 3> at_y = sides_of(x, y);
  if (is_one_side(at_y)) return false;
  const std::array<double, 3> at_x = sides_of(y, x);
  if (is_one_side(at_x)) return false;
  for (int k = 0, l = 1; k < 3; ++k, l = (l + 1) % 3)
    if (passes_through(x[k], x[l], y, at_x[k], at_x[l]) || passes_through(y[k], y[l], x, at_y[k], at_y[l])) return true;
  return false;
}

/// Searches a mesh for crossing triangles by a grid of their boxes.
class CrossingSearch {
 public:
  CrossingSearch(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                 std::span<const std::uint8_t> flat)
      : positions_(positions), triangles_(triangles), flat_(flat), boxes_(triangles.size()) {
    tbb::parallel_for(std::size_t{0}, triangles.size(),
                      [&](std::size_t t) { boxes_[t] = placed(static_cast<std::uint32_t>(t)).box(); });
  }

  std::vector<Pair> run() {
    if (triangles_.empty()) return {};
    make_grid(triangles_.size());
    for (std::uint32_t t = 0; t < boxes_.size(); ++t) grid_.add(t, boxes_[t]);
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid_.bucket_count(), 256), [&](const auto& range) {
      Scratch& mine = scratches.local();
      for (std::size_t bucket = range.begin(); bucket != range.end(); ++bucket) search(bucket, mine);
    });
    return all_found(scratches);
  }

  /// Returns the crossing pairs with one of `some`.
  std::vector<Pair> run(std::span<const std::uint32_t> some) {
    if (some.empty()) return {};
    make_grid(some.size());
    for (const std::uint32_t t : some) grid_.add(t, boxes_[t]);
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(boxes_.size()), [&](std::uint32_t t) {
      grid_.for_each_near(boxes_[t], [&](std::uint32_t u) {
        if (t != u && !are_apart(boxes_[t], boxes_[u]) &&
            triangles_cross(placed(std::min(t, u)), placed(std::max(t, u))))
          scratches.local().found.emplace_back(std::min(t, u), std::max(t, u));
      });
    });
    std::vector<Pair> all = all_found(scratches);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  /// The scratch memory of a thread.
  struct Scratch {
    std::vector<Pair> found;
    std::vector<std::pair<Box, std::uint32_t>> here;  ///< triangles of a bucket
  };

  void make_grid(std::size_t count) {
    double sum = 0.0;
    for (const Box& box : boxes_) sum += longest_side(box);
    grid_ = BoxGrid(std::max(kCellSides * sum / static_cast<double>(boxes_.size()), 1e-9), count);
  }
  static std::vector<Pair> all_found(const tbb::enumerable_thread_specific<Scratch>& scratches) {
    std::vector<Pair> all;
    for (const Scratch& some : scratches) all.insert(all.end(), some.found.begin(), some.found.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  PlacedTriangle placed(std::uint32_t t) const {
    const Triangle& v = triangles_[t];
    return {v, {positions_[v[0]], positions_[v[1]], positions_[v[2]]}};
  }

  /// True if two triangles share a vertex with a flat fan, so that they do not cross.
  bool have_flat_fan(std::uint32_t t, std::uint32_t u) const {
    if (flat_.empty()) return false;
    const Triangle& other = triangles_[u];
    return std::ranges::any_of(
        triangles_[t], [&](std::uint32_t v) { return (v == other[0] || v == other[1] || v == other[2]) && flat_[v]; });
  }

  /// Finds the crossing pairs in a bucket.
  void search(std::size_t bucket, Scratch& scratch) const {
    scratch.here.clear();
    grid_.for_each_in(bucket, [&](std::uint32_t t) { scratch.here.emplace_back(boxes_[t], t); });
    for (std::size_t i = 0; i < scratch.here.size(); ++i)
      for (std::size_t j = i + 1; j < scratch.here.size(); ++j) {
        const auto& [box, t] = scratch.here[i];
        const auto& [other, u] = scratch.here[j];
        if (are_apart(box, other) || have_flat_fan(t, u)) continue;
        const auto [a, b] = std::minmax(t, u);
        // Boxes may meet in several cells; their pair counts in the first of these.
        const glm::dvec3 low = glm::max(box.low, other.low);
        if (grid_.bucket_of(low) == bucket && triangles_cross(placed(a), placed(b))) scratch.found.emplace_back(a, b);
      }
  }

  std::span<const glm::dvec3> positions_;
  std::span<const Triangle> triangles_;
  std::span<const std::uint8_t> flat_;  ///< per vertex, or empty
  std::vector<Box> boxes_;
  BoxGrid grid_;
};

}  // namespace

bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b) {
  std::array<int, 3> shared{};  // corners of a that are corners of b, too
  int count = 0;
  for (int k = 0; k < 3; ++k)
    if (std::find(b.vertex.begin(), b.vertex.end(), a.vertex[k]) != b.vertex.end()) shared[count++] = k;
  const auto &x = a.at, &y = b.at;
  if (count == 0) return cross_apart(x, y);
  if (count == 1) {
    const int i = shared[0];
    const auto j = static_cast<int>(std::find(b.vertex.begin(), b.vertex.end(), a.vertex[i]) - b.vertex.begin());
    return passes_through(x[(i + 1) % 3], x[(i + 2) % 3], y) || passes_through(y[(j + 1) % 3], y[(j + 2) % 3], x);
  }
  const glm::dvec3 n = glm::cross(x[1] - x[0], x[2] - x[0]), m = glm::cross(y[1] - y[0], y[2] - y[0]);
  const double product = glm::dot(n, m);
  return !(product > 0.0) && !(product > kFolded * glm::length(n) * glm::length(m));
}

std::vector<std::uint8_t> flat_fans(const HalfEdges& links, std::span<const glm::dvec3> positions) {
  std::vector<std::uint8_t> flat(links.vertex_count(), 0);
  tbb::parallel_for(std::uint32_t{0}, links.vertex_count(), [&](std::uint32_t v) {
    if (links.is_vertex_alive(v)) flat[v] = is_flat_fan(links, positions, v);
  });
  return flat;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_triangles(std::span<const glm::dvec3> positions,
                                                                        std::span<const Triangle> triangles,
                                                                        std::span<const std::uint8_t> flat) {
  return CrossingSearch(positions, triangles, flat).run();
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings_of(std::span<const std::uint32_t> some,
                                                                  std::span<const glm::dvec3> positions,
                                                                  std::span<const Triangle> triangles) {
  return CrossingSearch(positions, triangles, {}).run(some);
}

namespace {

/// The side of a grid cell in units of the mean longest side of the listed triangles' boxes.
constexpr double kGuardCellSides = 1.2;

/// True if these neighbouring triangles all face one way and so project side by side onto a plane.
bool unfolds(std::span<const PlacedTriangle> triangles) {
  glm::dvec3 sum(0.0);
  const auto normal = [](const PlacedTriangle& x) { return glm::cross(x.at[1] - x.at[0], x.at[2] - x.at[0]); };
  for (const PlacedTriangle& x : triangles) sum += normal(x);
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const PlacedTriangle& x) { return glm::dot(normal(x), sum) > 0.0; });
}

}  // namespace

PlacedTriangle CrossingGuard::placed(std::uint32_t triangle) const {
  const auto v = links_.corners(triangle);
  return {v, {positions_[v[0]], positions_[v[1]], positions_[v[2]]}};
}

/// Marks the vertices in the balls with these bits.
void CrossingGuard::mark(std::span<const Ball> places, std::uint8_t bits) {
  if (!places.empty()) {
    std::vector<Box> boxes;
    for (const Ball& place : places) boxes.push_back({place.center - place.radius, place.center + place.radius});
    const BoxTree tree(boxes);
    tbb::parallel_for(std::size_t{0}, positions_.size(), [&](std::size_t v) {
      constexpr double kInside = 1e-9;
      tree.nearest(positions_[v], kInside, [&](std::uint32_t p, double limit) {
        if (glm::distance(positions_[v], places[p].center) > places[p].radius) return limit;
        guards_[v] |= bits;
        return 0.0;
      });
    });
  }
  list();
}

void CrossingGuard::guard_around(std::span<const std::uint32_t> triangles) {
  std::vector<Ball> places;
  for (const std::uint32_t t : triangles) {
    const PlacedTriangle x = placed(t);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::distance(x.at[k], x.at[(k + 1) % 3]));
    places.push_back({(x.at[0] + x.at[1] + x.at[2]) / 3.0, RemeshTuning::mending_radius * longest});
  }
  mark(places, kTemporary);
}

void CrossingGuard::release() {
  for (std::uint8_t& bits : guards_) bits &= kPermanent;
  list();
}

void CrossingGuard::compact(std::span<const std::uint32_t> old_vertices) {
  for (std::size_t v = 0; v < old_vertices.size(); ++v) guards_[v] = guards_[old_vertices[v]];
  guards_.resize(old_vertices.size());
  list();
}

/// Clears the grid, and lists the triangles that have a guarded vertex.
void CrossingGuard::list() {
  std::vector<std::uint32_t> listed;
  double sum = 0.0;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t) {
    if (!links_.is_alive(3 * t)) continue;
    const auto v = links_.corners(t);
    if (!guards_[v[0]] && !guards_[v[1]] && !guards_[v[2]]) continue;
    listed.push_back(t);
    sum += longest_side(placed(t).box());
  }
  const double mean = listed.empty() ? 1.0 : sum / static_cast<double>(listed.size());
  grid_ = BoxGrid(std::max(kGuardCellSides * mean, 1e-6), listed.size());
  for (const std::uint32_t t : listed) add(t);
}

void CrossingGuard::add(std::uint32_t triangle) { grid_.add(triangle, placed(triangle).box()); }

/// Finds the listed triangles that remain and have boxes that meet the box around all new triangles.
void CrossingGuard::list_near(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> removed) const {
  near_.clear();
  seen_.resize(links_.triangle_count(), 0);
  ++query_;
  for (const std::uint32_t t : removed) seen_[t] = query_;
  Box all = made[0].box();
  for (const PlacedTriangle& x : made) {
    const Box box = x.box();
    all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  }
  grid_.for_each_near(all, [&](std::uint32_t t) {
    ++work_;
    if (std::exchange(seen_[t], query_) == query_ || !links_.is_alive(3 * t)) return;
    const PlacedTriangle other = placed(t);
    const Box box = other.box();
    if (!are_apart(all, box)) near_.emplace_back(box, other);
  });
}

std::size_t CrossingGuard::crossings(std::span<const PlacedTriangle> made, std::span<const std::uint32_t> removed,
                                     std::size_t enough) const {
  if (made.empty()) return 0;
  std::size_t count = 0;
  if (!unfolds(made))
    for (std::size_t i = 0; i < made.size(); ++i)
      for (std::size_t j = i + 1; j < made.size(); ++j) count += triangles_cross(made[i], made[j]);
  if (count >= enough) return count;
  list_near(made, removed);
  for (const PlacedTriangle& x : made) {
    const Box box = x.box();
    work_ += near_.size();
    for (const auto& [other_box, other] : near_) count += !are_apart(box, other_box) && triangles_cross(x, other);
    if (count >= enough) return count;
  }
  return count;
}

}  // namespace meniscus
