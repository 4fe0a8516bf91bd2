// SPDX-License-Identifier: BSD-3-Clause
// Counting edges, areas and volumes of a triangle mesh.
#include "exporters/mesh/triangle_mesh.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace meniscus {

namespace {

/// Calls add(triangle, area, signed volume) for each triangle; volumes are those of cones from the first vertex.
template <typename Add>
void for_each_triangle(const TriangleMesh& mesh, const Add& add) {
  const glm::dvec3 origin = mesh.positions.empty() ? glm::dvec3(0.0) : mesh.positions.front();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const glm::dvec3 a = mesh.positions[t[0]] - origin, b = mesh.positions[t[1]] - origin,
                     c = mesh.positions[t[2]] - origin;
    add(i, 0.5 * glm::length(glm::cross(b - a, c - a)), glm::dot(a, glm::cross(b, c)) / 6.0);
  }
}

void add(double area, double volume, MeshSums& sums) {
  ++sums.triangle_count;
  sums.area += area;
  sums.volume += volume;
}

/// Directed edges, listed by their lower vertex: a mesh has three times as many as triangles.
class EdgeLists {
 public:
  EdgeLists(const TriangleMesh& mesh, std::uint32_t component) : starts_(mesh.positions.size() + 1, 0) {
    for_each_edge(mesh, component, [&](std::uint32_t from, std::uint32_t to) { ++starts_[std::min(from, to) + 1]; });
    for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    ends_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for_each_edge(mesh, component, [&](std::uint32_t from, std::uint32_t to) {
      has_loop_ = has_loop_ || from == to;
      ends_[next[std::min(from, to)]++] = {std::max(from, to), from < to};
    });
    for (std::size_t v = 0; v + 1 < starts_.size(); ++v)
      std::sort(ends_.begin() + std::ptrdiff_t(starts_[v]), ends_.begin() + std::ptrdiff_t(starts_[v + 1]));
  }

  std::size_t size() const { return ends_.size(); }

  /// Every edge is there once in each direction.
  bool closed() const {
    if (ends_.empty() || has_loop_) return false;
    for (std::size_t v = 0; v + 1 < starts_.size(); ++v) {
      if ((starts_[v + 1] - starts_[v]) % 2 != 0) return false;
      for (std::size_t i = starts_[v]; i < starts_[v + 1]; i += 2) {
        const bool pair = ends_[i].vertex == ends_[i + 1].vertex && ends_[i].upwards != ends_[i + 1].upwards;
        const bool again = i + 2 < starts_[v + 1] && ends_[i + 2].vertex == ends_[i].vertex;
        if (!pair || again) return false;
      }
    }
    return true;
  }

 private:
  struct End {
    std::uint32_t vertex : 31, upwards : 1;
    bool operator<(const End& other) const {
      return vertex != other.vertex ? vertex < other.vertex : upwards < other.upwards;
    }
  };

  template <typename Look>
  static void for_each_edge(const TriangleMesh& mesh, std::uint32_t component, const Look& look) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (component != kNone && mesh.component[i] != component) continue;
      const auto& t = mesh.triangles[i];
      for (int k = 0; k < 3; ++k) look(t[k], t[(k + 1) % 3]);
    }
  }

  std::vector<std::size_t> starts_;
  std::vector<End> ends_;
  bool has_loop_ = false;
};

}  // namespace

MeshSums sums_of(const TriangleMesh& mesh) {
  MeshSums sums;
  for_each_triangle(mesh, [&](std::size_t, double area, double volume) { add(area, volume, sums); });
  return sums;
}

std::vector<MeshSums> component_sums(const TriangleMesh& mesh, std::size_t component_count) {
  std::vector<MeshSums> sums(component_count);
  for_each_triangle(mesh,
                    [&](std::size_t t, double area, double volume) { add(area, volume, sums[mesh.component[t]]); });
  return sums;
}

MeshMeasure measure(const TriangleMesh& mesh, std::uint32_t component) {
  MeshMeasure m;
  std::vector<bool> used(mesh.positions.size(), false);
  for_each_triangle(mesh, [&](std::size_t i, double area, double volume) {
    if (component != kNone && mesh.component[i] != component) return;
    m.area += area;
    m.volume += volume;
    ++m.triangle_count;
    for (const std::uint32_t v : mesh.triangles[i]) used[v] = true;
  });
  m.vertex_count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  const EdgeLists edges(mesh, component);
  m.closed = edges.closed();
  m.edge_count = edges.size() / 2;
  return m;
}

}  // namespace meniscus
