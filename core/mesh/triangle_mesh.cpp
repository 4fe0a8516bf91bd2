// SPDX-License-Identifier: BSD-3-Clause
// Counts edges, areas and volumes of a triangle mesh, and leaves triangles out.
#include "core/mesh/triangle_mesh.h"
#include "core/color/coloring.h"

#include <numeric>
#include <utility>

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

/// The directed edges with their lower vertex in a range; all edges of a mesh would take as much memory as the mesh.
class EdgeLists {
 public:
  static constexpr std::uint32_t kVertices = 1u << 21;

  /// Lists the edges of the vertices [first, first + kVertices).
  EdgeLists(const TriangleMesh& mesh, std::uint32_t component, std::uint32_t first) : first_(first) {
    const auto last = std::min(std::size_t{first} + kVertices, mesh.positions.size());
    starts_.assign(last - first + 1, 0);
    for_each_edge(mesh, component, [&](std::uint32_t lower, const End&) { ++starts_[lower]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    ends_.resize(starts_.back());
    for_each_edge(mesh, component, [&](std::uint32_t lower, const End& end) { ends_[--starts_[lower]] = end; });
    for (std::size_t v = 0; v + 1 < starts_.size(); ++v)
      std::sort(ends_.begin() + starts_[v], ends_.begin() + starts_[v + 1]);
  }

  std::size_t size() const { return ends_.size(); }

  /// True if each edge is there once in each direction, and none ends where it begins.
  bool is_paired() const {
    for (std::size_t v = 0; v + 1 < starts_.size(); ++v) {
      if ((starts_[v + 1] - starts_[v]) % 2 != 0) return false;
      for (std::size_t i = starts_[v]; i < starts_[v + 1]; i += 2) {
        const bool pair = ends_[i].vertex == ends_[i + 1].vertex && ends_[i].upwards != ends_[i + 1].upwards;
        const bool again = i + 2 < starts_[v + 1] && ends_[i + 2].vertex == ends_[i].vertex;
        if (!pair || again || ends_[i].vertex == first_ + v) return false;
      }
    }
    return true;
  }

 private:
  /// The higher vertex of an edge; `upwards` is 1 if the edge leads to it.
  struct End {
    std::uint32_t vertex : 31, upwards : 1;
    bool operator<(const End& other) const {
      return vertex != other.vertex ? vertex < other.vertex : upwards < other.upwards;
    }
  };

  template <typename Visit>
  void for_each_edge(const TriangleMesh& mesh, std::uint32_t component, const Visit& visit) const {
    const std::size_t count = starts_.size() - 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (component != kNone && mesh.component[i] != component) continue;
      const auto& t = mesh.triangles[i];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t from = t[k], to = t[(k + 1) % 3], lower = std::min(from, to);
        if (lower >= first_ && lower - first_ < count) visit(lower - first_, {std::max(from, to), from < to});
      }
    }
  }

  std::uint32_t first_;
  std::vector<std::uint32_t> starts_;  // per vertex: the start of its list, followed by the end of the last one
  std::vector<End> ends_;
};

/// Keeps the rows of a table that `keep` marks, in order.
template <class T>
void keep_rows(std::vector<T>& table, const std::vector<bool>& keep) {
  std::size_t next = 0;
  for (std::size_t row = 0; row < table.size(); ++row)
    if (keep[row]) table[next++] = table[row];
  table.resize(next);
}

/// Returns the new place of each row that is kept, kNone for others.
std::vector<std::uint32_t> new_places(const std::vector<bool>& keep) {
  std::vector<std::uint32_t> place(keep.size(), kNone);
  std::uint32_t next = 0;
  for (std::size_t row = 0; row < keep.size(); ++row)
    if (keep[row]) place[row] = next++;
  return place;
}

void keep_rows_of_triangles(TriangleMesh& mesh, const std::vector<bool>& keep, const std::vector<bool>& changed) {
  const std::vector<std::uint32_t> place = new_places(keep);
  std::vector<bool> sharp;
  for (std::uint32_t& corner : mesh.sharp_corners) {
    const std::uint32_t t = corner / 3;
    sharp.push_back(keep[t] && (changed.empty() || !changed[t]));
    if (keep[t]) corner = 3 * place[t] + corner % 3;
  }
  keep_rows(mesh.sharp_corners, sharp);
  keep_rows(mesh.sharp_corner_normals, sharp);
  keep_rows(mesh.triangles, keep);
  keep_rows(mesh.kind, keep);
  for (std::vector<std::uint32_t>* table : {&mesh.face, &mesh.patch, &mesh.component, &mesh.atom})
    keep_rows(*table, keep);
}

std::vector<std::uint32_t> keep_used_vertices(TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  std::vector<std::uint32_t> place = new_places(used);
  keep_rows(mesh.positions, used);
  keep_rows(mesh.normals, used);
  for (auto& t : mesh.triangles)
    for (std::uint32_t& v : t) v = place[v];
  std::erase_if(mesh.sharp_edges, [&](const auto& e) { return !used[e[0]] || !used[e[1]]; });
  for (auto& e : mesh.sharp_edges)
    for (std::uint32_t& v : e) v = place[v];
  return place;
}

}  // namespace

std::vector<std::uint32_t> vertex_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> face(mesh.positions.size(), kNone);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;)
    for (const std::uint32_t v : mesh.triangles[t]) face[v] = mesh.face[t];
  return face;
}

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
  std::size_t directed = 0;
  m.closed = true;
  for (std::size_t first = 0; first < mesh.positions.size(); first += EdgeLists::kVertices) {
    const EdgeLists edges(mesh, component, static_cast<std::uint32_t>(first));
    m.closed = m.closed && edges.is_paired();
    directed += edges.size();
  }
  m.closed = m.closed && directed > 0;
  m.edge_count = directed / 2;
  return m;
}

std::vector<std::uint32_t> keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep,
                                          const std::vector<bool>& changed) {
  mesh.corner_count = mesh.border_point_count = 0;
  keep_rows_of_triangles(mesh, keep, changed);
  return keep_used_vertices(mesh);
}

TriangleMesh shown_part(TriangleMesh mesh, const Coloring& coloring) {
  std::vector<bool> shown;
  for (const std::uint32_t a : mesh.atom) shown.push_back(coloring.shows(a));
  if (std::ranges::find(shown, false) == shown.end()) return mesh;
  keep_triangles(mesh, shown);
  mesh.partly_hidden = true;
  return mesh;
}

}  // namespace meniscus
