// SPDX-License-Identifier: BSD-3-Clause
// Removes short edges from a mesh by collapses under the link condition, and flat triangles by flips.
#include "core/mesh/weld.h"

#include <numeric>
#include <optional>
#include <utility>

#include <glm/gtc/type_precision.hpp>

#include "core/base/constants.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// The most rounds of flips: the edge that a flip makes may in turn make other triangles flat.
constexpr int kRounds = 12;
/// The length of fins that are never removed.
constexpr double kNoFin = -1.0;

/// Welds short edges and flat triangles. It links only the triangles at the ends of short edges and at the corners of
/// flat triangles, which are few in a mesh. Vertices without a single closed fan stay as they are.
class Welder {
 public:
  /// A file holds `scale` times the positions in single precision; 0: the positions as they are. `longest_fin` is the
  /// largest distance (Å) from what remains to the tip of a fin that is removed.
  Welder(std::span<const glm::dvec3> positions, std::vector<Triangle>& triangles, double step, double scale,
         double longest_fin)
      : positions_(positions), triangles_(triangles), step_(step), scale_(scale), longest_fin_(longest_fin) {
    result_.into.resize(positions.size());
    std::iota(result_.into.begin(), result_.into.end(), 0u);
    result_.removed.assign(triangles.size(), false);
  }

  void join_short_edges() {
    find_short_edges();
    if (short_.empty()) return;
    link_triangles();
    // A collapse may bring other vertices together, so that an edge that could not be collapsed before now can be. The
    // edges that then are left may be held by fins.
    for (const double longest_fin : {kNoFin, longest_fin_})
      for (bool again = true; again;) {
        again = false;
        for (auto& [keep, drop] : short_) again = collapse(keep, drop, longest_fin) || again;
      }
    put_back_triangles();
  }

  /// Flips the longest edges of flat triangles in rounds. Calls changed(t, from) if triangle t now covers `from`.
  template <typename Changed>
  void flip_flat_triangles(const Changed& changed) {
    for (int round = 0; round < kRounds; ++round) {
      find_flat_triangles();
      if (flat_.empty()) return;
      short_.clear();
      link_triangles();
      bool any = false;
      for (const std::uint32_t t : flat_) {
        const auto local = static_cast<std::uint32_t>(std::ranges::lower_bound(part_, t) - part_.begin());
        if (links_->is_alive(3 * local)) any = flip(local, changed) || any;
      }
      put_back_triangles();
      if (!any) break;
    }
    find_flat_triangles();
    result_.flat = flat_.size();
  }

  Welding take() { return std::move(result_); }

 private:
  struct Edge {
    std::uint32_t keep, drop;
  };

  /// A fin next to a short edge: a triangle (a, b, tip) with two more at its tip, (tip, a, foot) and (b, tip, foot),
  /// which lie back to back. While it is there, the ends of the edge have three common neighbours. The foot may be the
  /// next tip.
  struct Fin {
    std::uint32_t half = 0;           ///< half-edge of the short edge, in the first triangle
    std::vector<std::uint32_t> tips;  ///< vertices
    std::uint32_t foot = 0;           ///< vertex at the foot of the last tip
  };

  /// Returns a position as the file holds it.
  glm::vec3 single(std::uint32_t v) const { return glm::vec3(scale_ * positions_[v]); }

  /// Returns a position in whole steps, for exact comparisons.
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
      if (!result_.removed[t] && is_flat(triangles_[t])) flat_.push_back(t);
  }

  /// Links the triangles at short edges and at flat triangles.
  void link_triangles() {
    linked_.assign(positions_.size(), false);
    for (const auto& [a, b] : short_) linked_[a] = linked_[b] = true;
    for (const std::uint32_t t : flat_)
      for (const std::uint32_t v : triangles_[t]) linked_[v] = true;
    part_.clear();
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      if (result_.removed[t] || !(linked_[a] || linked_[b] || linked_[c])) continue;
      part_.push_back(t);
      triangles.push_back(triangles_[t]);
    }
    const CornerLists corners(triangles, static_cast<std::uint32_t>(positions_.size()));
    links_ = HalfEdges::of_part(triangles, corners);
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t)
        if (linked_[v] && !is_closed_fan(triangles, corners.at(v))) linked_[v] = false;
  }

  /// Copies the linked triangles back to the mesh.
  void put_back_triangles() {
    for (std::uint32_t local = 0; local < part_.size(); ++local) {
      if (links_->is_alive(3 * local))
        triangles_[part_[local]] = links_->corners(local);
      else
        result_.removed[part_[local]] = true;
    }
  }

  bool may_change(std::uint32_t v) const { return linked_[v] && links_->is_vertex_alive(v); }

  /// True if the mesh keeps its topology when two vertices are merged, once this many tips of fins next to them are
  /// removed. `to_come` is 0 for two vertices with an edge; for others it is 2, as an edge would give each of them one
  /// more neighbour.
  bool can_join(const CommonNeighbors& neighbors, std::size_t to_come, std::size_t tips) const {
    // With a sum below 7, nothing but two triangles back to back would remain.
    return neighbors.common == 2 + tips && neighbors.sum + to_come - 2 * tips >= 7;
  }

  /// Returns the fin at a half-edge of a short edge, with at most `most` tips and perhaps none.
  Fin fin_at(std::uint32_t half, std::size_t most) const {
    Fin fin{half, {}, links_->opposite(half)};
    std::uint32_t to_tip = HalfEdges::next(half), from_tip = HalfEdges::last(half);
    while (fin.tips.size() < most) {
      const std::uint32_t first = links_->twin(to_tip), second = links_->twin(from_tip);
      const std::uint32_t foot = links_->opposite(first);
      if (links_->opposite(second) != foot) break;
      fin.tips.push_back(fin.foot);
      fin.foot = foot;
      to_tip = HalfEdges::next(first);
      from_tip = HalfEdges::last(second);
    }
    return fin;
  }

  /// Returns the largest distance (Å) of the tips of a fin from what remains, the edge from a to its foot.
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

  /// Merges the vertex `drop` into `keep` after removing the fins that prevent it; returns true if it did.
  bool collapse(std::uint32_t keep, std::uint32_t drop, double longest_fin) {
    if (keep == drop || !may_change(keep) || !may_change(drop)) return false;
    const std::uint32_t half = links_->between(drop, keep);
    if (half == kNone) return false;
    const CommonNeighbors neighbors = common_neighbors(*links_, keep, drop);
    std::size_t tips = 0;
    std::vector<Fin> fins;
    const auto [first, second] = std::minmax({half, links_->twin(half)});
    for (const std::uint32_t side : {first, second}) {
      if (longest_fin < 0.0 || neighbors.common <= 2 + tips) continue;
      const Fin fin = fin_at(side, neighbors.common - 2 - tips);
      if (fin.tips.empty() || length(fin, keep) > longest_fin) continue;
      tips += fin.tips.size();
      fins.push_back(fin);
    }
    if (!can_join(neighbors, 0, tips)) return false;
    for (const Fin& fin : fins)
      for (std::size_t n = 0; n < fin.tips.size(); ++n) links_->unpoke(fin.half);
    links_->collapse(half);
    result_.fins += tips;
    result_.into[drop] = keep;
    ++result_.joined;
    // Edges that were short at the dropped vertex are short at the other one from now on.
    for (auto& [one, other] : short_) {
      if (one == drop) one = keep;
      if (other == drop) other = keep;
      if (other < one) std::swap(one, other);
    }
    return true;
  }

  /// Returns the half-edge of a triangle's longest edge; of equal ones the first.
  std::uint32_t longest_edge(std::uint32_t t) const {
    std::uint32_t longest = 3 * t;
    double most = -1.0;
    for (std::uint32_t half = 3 * t; half < 3 * t + 3; ++half) {
      const double length = glm::distance(positions_[links_->from(half)], positions_[links_->to(half)]);
      if (length > most) {
        most = length;
        longest = half;
      }
    }
    return longest;
  }

  /// Flips the longest edge of a flat triangle if fewer are flat then, or if the new edge can be collapsed; returns
  /// true if it did.
  template <typename Changed>
  bool flip(std::uint32_t t, const Changed& changed) {
    if (!is_flat(links_->corners(t))) return false;  // an earlier flip has mended it
    const std::uint32_t half = longest_edge(t), other = links_->twin(half);
    const std::uint32_t a = links_->from(half), b = links_->to(half), c = links_->opposite(half);
    if (!may_change(a) || !may_change(b) || !may_change(c) || !links_->can_flip(half)) return false;
    const Triangle before = links_->corners(other / 3);
    const std::uint32_t d = links_->opposite(other);
    const Triangle first{a, d, c}, second{d, b, c};
    const bool had_area = !is_flat(before);
    const int flat_after = int(is_flat(first)) + int(is_flat(second)), flat_now = 1 + int(!had_area);
    const bool joins = !had_area && is_short(c, d) && may_change(d) && can_join(common_neighbors(*links_, c, d), 2, 0);
    if (flat_after >= flat_now && !joins) return false;
    if (had_area && (glm::dot(normal(first), normal(before)) <= 0.0 || glm::dot(normal(second), normal(before)) <= 0.0))
      return false;
    links_->flip(half);
    // The corners follow the order of `first` and `second`, because the written file depends on it.
    links_->put_first(HalfEdges::last(half));
    links_->put_first(HalfEdges::next(other));
    changed(part_[t], part_[other / 3]);
    if (joins)
      collapse(std::min(c, d), std::max(c, d), kNoFin);
    else
      ++result_.flipped;
    return true;
  }

  std::span<const glm::dvec3> positions_;
  std::vector<Triangle>& triangles_;
  double step_, scale_, longest_fin_;
  Welding result_;
  std::vector<Edge> short_;
  std::vector<std::uint32_t> flat_;
  std::vector<std::uint32_t> part_;  ///< the linked triangles, ascending
  std::optional<HalfEdges> links_;   ///< half-edges of these; vertices have their numbers in the mesh
  std::vector<bool> linked_;         ///< per vertex: true if all its triangles are linked and form a closed fan
};

/// Replaces each vertex by the one at the end of its chain.
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
  std::vector<bool> keep = made.removed;
  keep.flip();
  const std::vector<std::uint32_t> place = keep_triangles(mesh, keep, flipped);
  for (std::uint32_t& v : made.into) v = place[v];
  return made;
}

}  // namespace meniscus
