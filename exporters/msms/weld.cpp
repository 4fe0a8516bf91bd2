// SPDX-License-Identifier: BSD-3-Clause
// Edge collapses under the link condition, with lists of triangles for the few vertices they concern.
#include "exporters/msms/weld.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/index.h"

namespace meniscus {
namespace {

class Welder {
 public:
  Welder(MsmsMesh& mesh, double step) : mesh_(mesh), step_(step), gone_(mesh.vertices.size(), false) {}

  void run() {
    find_short_edges();
    if (short_.empty()) return;
    list_triangles();
    // A collapse may bring other vertices together, so that an edge that could not go now can.
    for (bool again = true; again;) {
      again = false;
      for (auto& [keep, drop] : short_) again = collapse(keep, drop) || again;
    }
    remove_the_gone();
  }

 private:
  struct Edge {
    std::uint32_t keep, drop;
  };

  bool is_short(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 &x = mesh_.vertices[a].position, &y = mesh_.vertices[b].position;
    return glm::distance(x, y) < step_ || glm::round(x / step_) == glm::round(y / step_);
  }

  void find_short_edges() {
    for (const MsmsTriangle& t : mesh_.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t.corner[k], b = t.corner[(k + 1) % 3];
        if (a < b && is_short(a, b)) short_.push_back({a, b});
      }
  }

  // Of the ends of short edges and of their neighbours, which take part in every question.
  void list_triangles() {
    std::vector<bool> wanted(mesh_.vertices.size(), false);
    for (const auto& [a, b] : short_) wanted[a] = wanted[b] = true;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t].corner)
        if (wanted[v]) around_[v].push_back(t);
  }

  static bool has(const MsmsTriangle& t, std::uint32_t v) { return std::ranges::find(t.corner, v) != t.corner.end(); }

  std::vector<std::uint32_t> neighbors(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : around_.at(v))
      for (const std::uint32_t w : mesh_.triangles[t].corner)
        if (w != v) found.push_back(w);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  bool collapse(std::uint32_t keep, std::uint32_t drop) {
    if (keep == drop || gone_[keep] || gone_[drop]) return false;
    std::vector<std::uint32_t> across;
    for (const std::uint32_t t : around_[drop])
      if (has(mesh_.triangles[t], keep)) across.push_back(t);
    if (across.size() != 2) return false;
    const std::vector<std::uint32_t> a = neighbors(keep), b = neighbors(drop);
    std::vector<std::uint32_t> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    if (common.size() != 2 || a.size() + b.size() < 7) return false;  // else nothing but two triangles back to back
    for (const std::uint32_t t : around_[drop]) {
      if (std::ranges::find(across, t) != across.end()) continue;
      for (std::uint32_t& v : mesh_.triangles[t].corner)
        if (v == drop) v = keep;
      around_[keep].push_back(t);
    }
    for (const std::uint32_t t : across) {
      for (const std::uint32_t v : mesh_.triangles[t].corner)
        if (const auto list = around_.find(v); list != around_.end()) std::erase(list->second, t);
      mesh_.triangles[t].face = 0;
    }
    gone_[drop] = true;
    // What was short between the dropped vertex and a third one is so from here.
    for (auto& [first, second] : short_) {
      if (first == drop) first = keep;
      if (second == drop) second = keep;
      if (second < first) std::swap(first, second);
    }
    return true;
  }

  void remove_the_gone() {
    std::erase_if(mesh_.triangles, [](const MsmsTriangle& t) { return t.face == 0; });
    std::vector<std::uint32_t> place(gone_.size(), kNone);
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < gone_.size(); ++v) {
      if (gone_[v]) continue;
      place[v] = next;
      mesh_.vertices[next++] = mesh_.vertices[v];
    }
    mesh_.vertices.resize(next);
    for (MsmsTriangle& t : mesh_.triangles)
      for (std::uint32_t& v : t.corner) v = place[v];
  }

  MsmsMesh& mesh_;
  double step_;
  std::vector<bool> gone_;
  std::vector<Edge> short_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> around_;
};

}  // namespace

void weld_short_edges(MsmsMesh& mesh, double step) { Welder(mesh, step).run(); }

}  // namespace meniscus
