// SPDX-License-Identifier: BSD-3-Clause
// A grid of boxes finds pairs of triangles, signs of volumes decide.
#include "core/mesh/mesh_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace meniscus {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// The middle edge length, times this, is the side of a cell.
constexpr double kCellEdges = 1.5;
/// Unit normals of two triangles with a common edge that are folded onto one another: their product is below this.
constexpr double kFolded = -1.0 + 1e-12;

/// Six times the volume of a tetrahedron; above 0 where d sees a, b, c clockwise.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(a - d, glm::cross(b - d, c - d));
}

bool passes_through(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
  const double at_p = volume(t[0], t[1], t[2], p), at_q = volume(t[0], t[1], t[2], q);
  if ((at_p > 0.0 && at_q > 0.0) || (at_p < 0.0 && at_q < 0.0) || (at_p == 0.0 && at_q == 0.0)) return false;
  const double u = volume(p, q, t[0], t[1]), v = volume(p, q, t[1], t[2]), w = volume(p, q, t[2], t[0]);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

class CrossingSearch {
 public:
  CrossingSearch(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles)
      : positions_(positions), triangles_(triangles), boxes_(triangles.size()) {
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
      const PlacedTriangle x = placed(static_cast<std::uint32_t>(t));
      boxes_[t] = {x.low(), x.high()};
    });
  }

  std::vector<Pair> run() {
    if (triangles_.empty()) return {};
    choose_cells();
    enter_cells();
    tbb::enumerable_thread_specific<std::vector<Pair>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, starts_.size() - 1, 256), [&](const auto& range) {
      auto& mine = found.local();
      for (std::size_t c = range.begin(); c != range.end(); ++c) look_in_cell(c, mine);
    });
    std::vector<Pair> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  struct Bounds {
    glm::dvec3 low{0.0}, high{0.0};
  };
  struct Entry {
    std::uint64_t cell;
    std::uint32_t triangle;
    bool operator<(const Entry& other) const {
      return cell != other.cell ? cell < other.cell : triangle < other.triangle;
    }
  };

  void choose_cells() {
    double sum = 0.0;
    low_ = boxes_.front().low;
    for (const Bounds& box : boxes_) {
      const glm::dvec3 size = box.high - box.low;
      sum += std::max({size.x, size.y, size.z});
      low_ = glm::min(low_, box.low);
    }
    cell_ = std::max(kCellEdges * sum / static_cast<double>(boxes_.size()), 1e-9);
  }
  std::array<std::uint64_t, 3> cell_of(const glm::dvec3& x) const {
    std::array<std::uint64_t, 3> at{};
    for (int k = 0; k < 3; ++k)
      at[k] = std::min<std::uint64_t>(static_cast<std::uint64_t>((x[k] - low_[k]) / cell_), (1u << 21) - 1);
    return at;
  }
  static std::uint64_t key(std::uint64_t x, std::uint64_t y, std::uint64_t z) { return (x << 42) | (y << 21) | z; }

  void enter_cells() {
    std::vector<std::size_t> first(triangles_.size() + 1, 0);
    tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t t) {
      const auto a = cell_of(boxes_[t].low), b = cell_of(boxes_[t].high);
      first[t + 1] = (b[0] - a[0] + 1) * (b[1] - a[1] + 1) * (b[2] - a[2] + 1);
    });
    for (std::size_t t = 0; t < boxes_.size(); ++t) first[t + 1] += first[t];
    entries_.resize(first.back());
    tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t t) {
      const auto a = cell_of(boxes_[t].low), b = cell_of(boxes_[t].high);
      std::size_t at = first[t];
      for (auto x = a[0]; x <= b[0]; ++x)
        for (auto y = a[1]; y <= b[1]; ++y)
          for (auto z = a[2]; z <= b[2]; ++z) entries_[at++] = {key(x, y, z), static_cast<std::uint32_t>(t)};
    });
    tbb::parallel_sort(entries_.begin(), entries_.end());
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (i == 0 || entries_[i].cell != entries_[i - 1].cell) starts_.push_back(i);
    starts_.push_back(entries_.size());
  }

  PlacedTriangle placed(std::uint32_t t) const {
    const Triangle& v = triangles_[t];
    return {v, {positions_[v[0]], positions_[v[1]], positions_[v[2]]}};
  }

  void look_in_cell(std::size_t c, std::vector<Pair>& found) const {
    for (std::size_t i = starts_[c]; i < starts_[c + 1]; ++i)
      for (std::size_t j = i + 1; j < starts_[c + 1]; ++j) {
        const std::uint32_t a = entries_[i].triangle, b = entries_[j].triangle;
        const glm::dvec3 low = glm::max(boxes_[a].low, boxes_[b].low), high = glm::min(boxes_[a].high, boxes_[b].high);
        if (glm::any(glm::greaterThan(low, high))) continue;
        const auto home = cell_of(low);  // boxes that meet do so in several cells; they count in the first
        if (key(home[0], home[1], home[2]) == entries_[i].cell && triangles_cross(placed(a), placed(b)))
          found.emplace_back(a, b);
      }
  }

  std::span<const glm::dvec3> positions_;
  std::span<const Triangle> triangles_;
  std::vector<Bounds> boxes_;
  glm::dvec3 low_{0.0};
  double cell_ = 1.0;
  std::vector<Entry> entries_;
  std::vector<std::size_t> starts_;  // of the cells in entries_, and the end
};

}  // namespace

bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b) {
  std::array<int, 3> shared{};  // places in a
  int count = 0;
  for (int k = 0; k < 3; ++k)
    if (std::find(b.vertex.begin(), b.vertex.end(), a.vertex[k]) != b.vertex.end()) shared[count++] = k;
  const auto &x = a.at, &y = b.at;
  if (count == 0) {
    for (int k = 0; k < 3; ++k)
      if (passes_through(x[k], x[(k + 1) % 3], y) || passes_through(y[k], y[(k + 1) % 3], x)) return true;
    return false;
  }
  if (count == 1) {
    const int i = shared[0];
    const auto j = static_cast<int>(std::find(b.vertex.begin(), b.vertex.end(), a.vertex[i]) - b.vertex.begin());
    return passes_through(x[(i + 1) % 3], x[(i + 2) % 3], y) || passes_through(y[(j + 1) % 3], y[(j + 2) % 3], x);
  }
  const glm::dvec3 n = glm::cross(x[1] - x[0], x[2] - x[0]), m = glm::cross(y[1] - y[0], y[2] - y[0]);
  return !(glm::dot(n, m) > kFolded * glm::length(n) * glm::length(m));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_triangles(std::span<const glm::dvec3> positions,
                                                                        std::span<const Triangle> triangles) {
  return CrossingSearch(positions, triangles).run();
}

}  // namespace meniscus
