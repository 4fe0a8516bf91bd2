// SPDX-License-Identifier: BSD-3-Clause
// Edge collapses under the link condition and edge flips, with lists of triangles for the few vertices they concern.
#include "exporters/mesh/weld.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>

#include "core/base/index.h"

namespace meniscus {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// An edge that was flipped leaves one that makes other triangles flat at times.
constexpr int kRounds = 12;

class Welder {
 public:
  Welder(std::span<const glm::dvec3> positions, std::vector<Triangle>& triangles, double step, double scale)
      : positions_(positions), triangles_(triangles), step_(step), scale_(scale) {
    made_.into.resize(positions.size());
    std::iota(made_.into.begin(), made_.into.end(), 0u);
    made_.gone.assign(triangles.size(), false);
  }

  void join_short_edges() {
    find_short_edges();
    if (short_.empty()) return;
    list_triangles();
    // A collapse may bring other vertices together, so that an edge that could not go now can.
    for (bool again = true; again;) {
      again = false;
      for (auto& [keep, drop] : short_) again = collapse(keep, drop) || again;
    }
  }

  /// changed(t, from): triangle t now covers what `from` did.
  template <typename Changed>
  void flip_flat_triangles(const Changed& changed) {
    for (int round = 0; round < kRounds; ++round) {
      find_flat_triangles();
      if (flat_.empty()) return;
      short_.clear();
      list_triangles();
      bool any = false;
      for (const std::uint32_t t : flat_) any = flip(t, changed) || any;
      if (!any) break;
    }
    find_flat_triangles();
    made_.flat = flat_.size();
  }

  Welding take() { return std::move(made_); }

 private:
  struct Edge {
    std::uint32_t keep, drop;
  };

  /// Whole numbers, so that what is said of them is exact.
  glm::i64vec3 steps(std::uint32_t v) const { return glm::i64vec3(glm::round(positions_[v] / step_)); }

  bool is_short(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(positions_[a], positions_[b]) < step_ || steps(a) == steps(b);
  }

  bool is_flat(const Triangle& t) const {
    const glm::i64vec3 a = steps(t[0]), u = steps(t[1]) - a, v = steps(t[2]) - a;
    if (u.y * v.z == u.z * v.y && u.z * v.x == u.x * v.z && u.x * v.y == u.y * v.x) return true;
    const auto single = [this](std::uint32_t corner) { return glm::vec3(scale_ * positions_[corner]); };
    const glm::vec3 x = single(t[0]);
    return glm::cross(single(t[1]) - x, single(t[2]) - x) == glm::vec3(0.0f);
  }

  glm::dvec3 normal(const Triangle& t) const {
    return glm::cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
  }

  void find_short_edges() {
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (a < b && is_short(a, b)) short_.push_back({a, b});
      }
  }

  void find_flat_triangles() {
    flat_.clear();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (!made_.gone[t] && is_flat(triangles_[t])) flat_.push_back(t);
  }

  // Of the ends of short edges and the corners of flat triangles, which take part in every question.
  void list_triangles() {
    around_.clear();
    std::vector<bool> wanted(positions_.size(), false);
    for (const auto& [a, b] : short_) wanted[a] = wanted[b] = true;
    for (const std::uint32_t t : flat_)
      for (const std::uint32_t v : triangles_[t]) wanted[v] = true;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (!made_.gone[t])
        for (const std::uint32_t v : triangles_[t])
          if (wanted[v]) around_[v].push_back(t);
  }

  static bool has(const Triangle& t, std::uint32_t v) { return std::ranges::find(t, v) != t.end(); }

  std::vector<std::uint32_t> neighbors(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : around_.at(v))
      for (const std::uint32_t w : triangles_[t])
        if (w != v) found.push_back(w);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void take_from_lists(std::uint32_t t) {
    for (const std::uint32_t v : triangles_[t])
      if (const auto list = around_.find(v); list != around_.end()) std::erase(list->second, t);
  }

  void put_on_lists(std::uint32_t t) {
    for (const std::uint32_t v : triangles_[t])
      if (const auto list = around_.find(v); list != around_.end()) list->second.push_back(t);
  }

  std::vector<std::uint32_t> triangles_at(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : around_.at(a))
      if (has(triangles_[t], b)) found.push_back(t);
    return found;
  }

  bool is_gone(std::uint32_t v) const { return made_.into[v] != v; }

  bool collapse(std::uint32_t keep, std::uint32_t drop) {
    if (keep == drop || is_gone(keep) || is_gone(drop)) return false;
    const std::vector<std::uint32_t> across = triangles_at(drop, keep);
    if (across.size() != 2) return false;
    const std::vector<std::uint32_t> a = neighbors(keep), b = neighbors(drop);
    std::vector<std::uint32_t> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    if (common.size() != 2 || a.size() + b.size() < 7) return false;  // else nothing but two triangles back to back
    for (const std::uint32_t t : across) {
      take_from_lists(t);
      made_.gone[t] = true;
    }
    for (const std::uint32_t t : around_[drop]) {
      for (std::uint32_t& v : triangles_[t])
        if (v == drop) v = keep;
      around_[keep].push_back(t);
    }
    around_[drop].clear();
    made_.into[drop] = keep;
    ++made_.joined;
    // What was short between the dropped vertex and a third one is so from here.
    for (auto& [first, second] : short_) {
      if (first == drop) first = keep;
      if (second == drop) second = keep;
      if (second < first) std::swap(first, second);
    }
    return true;
  }

  // Turns a flat triangle so that its longest edge is its first.
  Triangle from_longest_edge(std::uint32_t t) const {
    Triangle turned = triangles_[t], longest = turned;
    double most = -1.0;
    for (int k = 0; k < 3; ++k) {
      const double length = glm::distance(positions_[turned[0]], positions_[turned[1]]);
      if (length > most) {
        most = length;
        longest = turned;
      }
      turned = {turned[1], turned[2], turned[0]};
    }
    return longest;
  }

  template <typename Changed>
  bool flip(std::uint32_t t, const Changed& changed) {
    if (!is_flat(triangles_[t])) return false;  // a flip before has mended it
    const auto [a, b, c] = from_longest_edge(t);
    const std::vector<std::uint32_t> at = triangles_at(a, b);
    if (at.size() != 2) return false;
    const std::uint32_t other = at[0] == t ? at[1] : at[0];
    const Triangle before = triangles_[other];
    const std::uint32_t d = *std::ranges::find_if(before, [a = a, b = b](std::uint32_t v) { return v != a && v != b; });
    if (d == c || !triangles_at(c, d).empty()) return false;
    const Triangle first{a, d, c}, second{d, b, c};
    const bool had_area = !is_flat(before);
    const int flat_after = int(is_flat(first)) + int(is_flat(second)), flat_now = 1 + int(!had_area);
    if (flat_after >= flat_now) return false;
    if (had_area && (glm::dot(normal(first), normal(before)) <= 0.0 || glm::dot(normal(second), normal(before)) <= 0.0))
      return false;
    take_from_lists(t);
    take_from_lists(other);
    triangles_[t] = first;
    triangles_[other] = second;
    put_on_lists(t);
    put_on_lists(other);
    changed(t, other);
    ++made_.flipped;
    return true;
  }

  std::span<const glm::dvec3> positions_;
  std::vector<Triangle>& triangles_;
  double step_, scale_;
  Welding made_;
  std::vector<Edge> short_;
  std::vector<std::uint32_t> flat_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> around_;
};

/// To the vertex at the end of the chain.
void follow(std::vector<std::uint32_t>& into) {
  for (std::uint32_t& v : into)
    while (into[v] != v) v = into[v];
}

}  // namespace

Welding weld_short_edges(std::span<const glm::dvec3> positions, std::vector<Triangle>& triangles, double step) {
  Welder welder(positions, triangles, step, 1.0);
  welder.join_short_edges();
  Welding made = welder.take();
  follow(made.into);
  return made;
}

Welding weld(TriangleMesh& mesh, double step, double scale) {
  Welder welder(mesh.positions, mesh.triangles, step, scale);
  welder.join_short_edges();
  std::vector<bool> flipped(mesh.triangles.size(), false);
  welder.flip_flat_triangles([&](std::uint32_t t, std::uint32_t from) {
    flipped[t] = flipped[from] = true;
    mesh.kind[t] = mesh.kind[from];
    for (std::vector<std::uint32_t>* table : {&mesh.face, &mesh.patch, &mesh.component, &mesh.atom})
      (*table)[t] = (*table)[from];
  });
  Welding made = welder.take();
  follow(made.into);
  for (auto& edge : mesh.sharp_edges)
    for (std::uint32_t& v : edge) v = made.into[v];
  std::erase_if(mesh.sharp_edges, [](const auto& edge) { return edge[0] == edge[1]; });
  std::vector<bool> keep = made.gone;
  keep.flip();
  const std::vector<std::uint32_t> place = keep_triangles(mesh, keep, flipped);
  for (std::uint32_t& v : made.into) v = place[v];
  return made;
}

}  // namespace meniscus
