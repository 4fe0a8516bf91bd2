// SPDX-License-Identifier: BSD-3-Clause
// Edge collapses under the link condition and edge flips, with lists of triangles for the few vertices they concern.
#include "core/mesh/weld.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
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
constexpr double kNoFin = -1.0;

class Welder {
 public:
  /// scale: a file holds that many times the positions in single precision; 0: the positions as they are. longest_fin:
  /// Å from what stays to the tip of a fin that goes.
  Welder(std::span<const glm::dvec3> positions, std::vector<Triangle>& triangles, double step, double scale,
         double longest_fin)
      : positions_(positions), triangles_(triangles), step_(step), scale_(scale), longest_fin_(longest_fin) {
    made_.into.resize(positions.size());
    std::iota(made_.into.begin(), made_.into.end(), 0u);
    made_.gone.assign(triangles.size(), false);
  }

  void join_short_edges() {
    find_short_edges();
    if (short_.empty()) return;
    list_triangles();
    // A collapse may bring other vertices together, so that an edge that could not go now can. What then is left, fins
    // may keep.
    for (const double longest_fin : {kNoFin, longest_fin_})
      for (bool again = true; again;) {
        again = false;
        for (auto& [keep, drop] : short_) again = collapse(keep, drop, longest_fin) || again;
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
      for (const std::uint32_t t : flat_)
        if (!made_.gone[t]) any = flip(t, changed) || any;
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

  /// Beside a short edge a triangle (a, b, tip) with two more at its tip, (tip, a, foot) and (b, tip, foot), which lie
  /// back to back. While it is there, the ends of the edge have three neighbours in common. The foot may be the next
  /// tip.
  struct Fin {
    std::uint32_t end = 0;             ///< triangle
    std::vector<std::uint32_t> sides;  ///< triangles, two a tip
    std::vector<std::uint32_t> tips;   ///< vertices
    std::uint32_t foot = 0;            ///< vertex: of the last tip
  };

  glm::vec3 single(std::uint32_t v) const { return glm::vec3(scale_ * positions_[v]); }

  /// Whole numbers, so that what is said of them is exact.
  glm::i64vec3 steps(std::uint32_t v) const {
    const glm::dvec3 written = scale_ > 0.0 ? glm::dvec3(single(v)) / scale_ : positions_[v];
    return glm::i64vec3(glm::round(written / step_));
  }

  bool is_short(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(positions_[a], positions_[b]) < step_ || steps(a) == steps(b);
  }

  bool is_flat(const Triangle& t) const {
    const glm::i64vec3 a = steps(t[0]), u = steps(t[1]) - a, v = steps(t[2]) - a;
    if (u.y * v.z == u.z * v.y && u.z * v.x == u.x * v.z && u.x * v.y == u.y * v.x) return true;
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
  static std::uint32_t third_corner(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    return *std::ranges::find_if(t, [a, b](std::uint32_t v) { return v != a && v != b; });
  }

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

  void remove(std::uint32_t t) {
    take_from_lists(t);
    made_.gone[t] = true;
  }

  std::vector<std::uint32_t> common_neighbors(std::uint32_t a, std::uint32_t b) const {
    const std::vector<std::uint32_t> of_a = neighbors(a), of_b = neighbors(b);
    std::vector<std::uint32_t> common;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
    return common;
  }

  /// Whether the mesh stays what it is where two vertices become one that have an edge, or would have one, once so many
  /// tips of fins beside it are gone.
  bool can_join(std::uint32_t a, std::uint32_t b, std::size_t tips) const {
    if (!around_.contains(a) || !around_.contains(b)) return false;
    if (common_neighbors(a, b).size() != 2 + tips) return false;
    const std::vector<std::uint32_t> of_a = neighbors(a), of_b = neighbors(b);
    const std::size_t edge_to_come = std::ranges::binary_search(of_a, b) ? 0 : 2;
    return of_a.size() + of_b.size() + edge_to_come - 2 * tips >= 7;  // else nothing but two triangles back to back
  }

  /// The triangle beside t at an edge.
  std::optional<std::uint32_t> beside(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> found = triangles_at(a, b);
    std::erase(found, t);
    return found.size() == 1 ? std::optional(found[0]) : std::nullopt;
  }

  /// With at most so many tips; perhaps none.
  Fin fin_at(std::uint32_t end, std::uint32_t a, std::uint32_t b, std::size_t most) const {
    Fin fin{end, {}, {}, third_corner(triangles_[end], a, b)};
    for (std::uint32_t last_a = end, last_b = end; fin.tips.size() < most;) {
      const auto side_a = beside(last_a, a, fin.foot), side_b = beside(last_b, b, fin.foot);
      if (!side_a || !side_b) break;
      const std::uint32_t foot = third_corner(triangles_[*side_a], a, fin.foot);
      if (third_corner(triangles_[*side_b], b, fin.foot) != foot) break;
      fin.tips.push_back(fin.foot);
      fin.sides.insert(fin.sides.end(), {*side_a, *side_b});
      fin.foot = foot;
      last_a = *side_a;
      last_b = *side_b;
    }
    return fin;
  }

  /// How far its tips are at most from what stays, the edge from a to its foot.
  double length(const Fin& fin, std::uint32_t a) const {
    const glm::dvec3 to_foot = positions_[fin.foot] - positions_[a];
    double longest = 0.0;
    for (const std::uint32_t tip : fin.tips) {
      const glm::dvec3 to_tip = positions_[tip] - positions_[a];
      const double share = std::clamp(glm::dot(to_tip, to_foot) / glm::dot(to_foot, to_foot), 0.0, 1.0);
      longest = std::max(longest, glm::distance(to_tip, share * to_foot));
    }
    return longest;
  }

  /// One triangle instead of those at its tips.
  void take_out(const Fin& fin) {
    for (const std::uint32_t t : fin.sides) remove(t);
    take_from_lists(fin.end);
    std::ranges::replace(triangles_[fin.end], fin.tips.front(), fin.foot);
    put_on_lists(fin.end);
    made_.fins += fin.tips.size();
  }

  bool collapse(std::uint32_t keep, std::uint32_t drop, double longest_fin) {
    if (keep == drop || is_gone(keep) || is_gone(drop)) return false;
    const std::vector<std::uint32_t> across = triangles_at(drop, keep);
    if (across.size() != 2) return false;
    const std::size_t common = common_neighbors(keep, drop).size();
    std::size_t tips = 0;
    std::vector<Fin> fins;
    for (const std::uint32_t t : across) {
      if (longest_fin < 0.0 || common <= 2 + tips) continue;
      const Fin fin = fin_at(t, keep, drop, common - 2 - tips);
      if (fin.tips.empty() || length(fin, keep) > longest_fin) continue;
      tips += fin.tips.size();
      fins.push_back(fin);
    }
    if (!can_join(keep, drop, tips)) return false;
    for (const Fin& fin : fins) take_out(fin);
    for (const std::uint32_t t : across) remove(t);
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
    const std::uint32_t d = third_corner(before, a, b);
    if (d == c || !triangles_at(c, d).empty()) return false;
    const Triangle first{a, d, c}, second{d, b, c};
    const bool had_area = !is_flat(before);
    const int flat_after = int(is_flat(first)) + int(is_flat(second)), flat_now = 1 + int(!had_area);
    const bool joins = !had_area && is_short(c, d) && can_join(c, d, 0);
    if (flat_after >= flat_now && !joins) return false;
    if (had_area && (glm::dot(normal(first), normal(before)) <= 0.0 || glm::dot(normal(second), normal(before)) <= 0.0))
      return false;
    take_from_lists(t);
    take_from_lists(other);
    triangles_[t] = first;
    triangles_[other] = second;
    put_on_lists(t);
    put_on_lists(other);
    changed(t, other);
    if (joins)
      collapse(std::min(c, d), std::max(c, d), kNoFin);
    else
      ++made_.flipped;
    return true;
  }

  std::span<const glm::dvec3> positions_;
  std::vector<Triangle>& triangles_;
  double step_, scale_, longest_fin_;
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
  Welder welder(positions, triangles, step, 0.0, kNoFin);
  welder.join_short_edges();
  Welding made = welder.take();
  follow(made.into);
  return made;
}

Welding weld(TriangleMesh& mesh, double step, double scale) {
  Welder welder(mesh.positions, mesh.triangles, step, scale, mesh.tolerance);
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
