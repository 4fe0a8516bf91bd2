// SPDX-License-Identifier: BSD-3-Clause
// Meshes one face: a constrained Delaunay triangulation, refined until it is within the tolerance.
#include "core/mesh/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/mesh/planar_triangulation.h"

namespace meniscus {
namespace {

/// Segments shorter than this (Å) are not halved further to untangle a rim.
constexpr double kShortestSegment = 1e-6;
constexpr int kRefinementRounds = 12;
constexpr int kPartingRounds = 32;  // to split doubled edges: each round halves some, and one or two are usual
constexpr int kManyRimPoints = 200;
constexpr int kBoxCorners = 4;

/// The plane of a face, laid on the integer grid.
class Grid {
 public:
  explicit Grid(const std::vector<glm::dvec2>& rim) {
    low_ = high_ = rim.front();
    for (const glm::dvec2& p : rim) {
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
    const glm::dvec2 extent = high_ - low_;
    scale_ = (double(kGridLimit) - 16.0) / std::max(0.5 * std::max(extent.x, extent.y), 1e-300);
  }
  bool covers(const glm::dvec2& p) const { return p.x > low_.x && p.y > low_.y && p.x < high_.x && p.y < high_.y; }
  /// True if the integer grid extends to the point, which may lie beyond the rim.
  bool reaches(const glm::dvec2& p) const {
    const glm::dvec2 q = glm::abs(p - 0.5 * (low_ + high_)) * scale_;
    return std::max(q.x, q.y) < double(kGridLimit);
  }
  GridPoint at(const glm::dvec2& p) const {
    const glm::dvec2 q = (p - 0.5 * (low_ + high_)) * scale_;
    return {std::llround(q.x), std::llround(q.y)};
  }

 private:
  glm::dvec2 low_{0.0}, high_{0.0};
  double scale_ = 1.0;
};

/// Triangulates a face by a constrained Delaunay triangulation of its plane.
class FaceFiller {
 public:
  FaceFiller(FaceOutline outline, double tolerance) : outline_(std::move(outline)), tolerance_(tolerance) {}

  FaceMesh run() {
    std::vector<glm::dvec2> flat;
    for (const FacePoint& p : outline_.points) flat.push_back(outline_.domain->flat(p));
    const Grid grid(flat);
    if (insert_rim(grid, flat)) {
      for (const FacePoint& p : outline_.interior) {
        const glm::dvec2 q = outline_.domain->flat(p);
        if (grid.covers(q)) insert(grid.at(q), p);
      }
      if (fill()) {
        refine(grid);
        if (too_coarse_.empty()) return extract();
      } else {
        // The chords of a rim with few points may enclose the wrong side.
        for (int e = 0; e < rim_count() && rim_count() < kManyRimPoints; ++e) request_split(e);
      }
    }
    FaceMesh failed;
    failed.too_coarse = std::move(too_coarse_);
    return failed;
  }

 private:
  int rim_count() const { return static_cast<int>(outline_.points.size()); }

  /// Inserts the rim. Rim points that fall on one grid point are set apart by a few grid steps, some 1e-8 of the face.
  /// Returns false if edges of the rim cross or meet.
  bool insert_rim(const Grid& grid, const std::vector<glm::dvec2>& flat) {
    for (int i = 0; i < rim_count(); ++i) {
      const GridPoint at = grid.at(flat[i]);
      std::optional<int> vertex;
      for (int nudge = 0; nudge < 9 && (!vertex || *vertex < kBoxCorners + i); ++nudge) {
        vertex = plane_.insert({at.x + (nudge % 3), at.y + nudge / 3});
      }
      if (*vertex < kBoxCorners + i) return false;
    }
    for (int e = 0; e < static_cast<int>(outline_.edges.size()); ++e) {
      const auto [a, b] = outline_.edges[e];
      const auto conflict = plane_.constrain(kBoxCorners + a, kBoxCorners + b, e);
      if (!conflict) continue;
      const int other = conflict->segment >= 0 && length(conflict->segment) > length(e) ? conflict->segment : e;
      request_split(other);
      is_blocked_ = true;
    }
    return !is_blocked_;
  }
  double length(int edge) const {
    return glm::distance(outline_.points[outline_.edges[edge][0]].position,
                         outline_.points[outline_.edges[edge][1]].position);
  }
  /// Requests that the border segment of a rim edge is split, unless it is too short.
  void request_split(int edge) {
    const Segment& s = outline_.segments[edge];
    if (s.border != kNone && length(edge) > kShortestSegment) too_coarse_.push_back(s);
  }

  void insert(GridPoint at, const FacePoint& point) {
    const auto vertex = plane_.insert(at);
    if (vertex && *vertex == kBoxCorners + static_cast<int>(outline_.points.size() + inner_.size())) {
      inner_.push_back(point);
    }
  }

  bool fill() {
    std::vector<std::array<int, 2>> edges;
    for (const auto& [a, b] : outline_.edges) edges.push_back({kBoxCorners + a, kBoxCorners + b});
    return plane_.fill(edges);
  }

  const FacePoint& point(int vertex) const {
    const int i = vertex - kBoxCorners;
    return i < rim_count() ? outline_.points[i] : inner_[i - rim_count()];
  }

  /// Splits the longest edge of each triangle that is too far from the surface or, if that is on the rim, the
  /// triangle's middle. Where the new point lies beyond the chord of a rim, as on spindles with contact circles that
  /// bulge in the plane, the rim is split instead.
  void refine(const Grid& grid) {
    for (int round = 0; round < kRefinementRounds; ++round) {
      std::vector<FacePoint> wanted;
      for (const auto& t : plane_.triangles()) {
        if (!t.inside) continue;
        const std::array<const FacePoint*, 3> corner{&point(t.vertex[0]), &point(t.vertex[1]), &point(t.vertex[2])};
        if (outline_.domain->deviation(*corner[0], *corner[1], *corner[2]) <= 0.95 * tolerance_) continue;
        int longest = 0;
        std::array<double, 3> size{};
        for (int k = 0; k < 3; ++k) {
          size[k] = glm::distance(corner[(k + 1) % 3]->position, corner[(k + 2) % 3]->position);
          if (size[k] > size[longest]) longest = k;
        }
        std::array<double, 3> weight{1.0 / 3, 1.0 / 3, 1.0 / 3};
        if (t.segment[longest] < 0) {
          weight = {0.5, 0.5, 0.5};
          weight[longest] = 0.0;
        }
        const FacePoint middle = outline_.domain->between(corner, weight);
        if (!outline_.domain->contains(middle)) continue;
        if (grid.reaches(outline_.domain->flat(middle)))
          wanted.push_back(middle);
        else
          for (const int edge : t.segment)
            if (edge >= 0) request_split(edge);
      }
      if (wanted.empty()) return;
      for (const FacePoint& p : wanted) insert(grid.at(outline_.domain->flat(p)), p);
    }
  }

  FaceMesh extract() {
    FaceMesh mesh;
    mesh.rim = std::move(outline_.names);
    mesh.rim_edges = std::move(outline_.edges);
    std::vector<std::uint32_t> index(outline_.points.size() + inner_.size(), kNone);
    mesh.points = outline_.points;
    for (int i = 0; i < rim_count(); ++i) index[i] = i;
    auto numbered = [&](int vertex) {
      std::uint32_t& i = index[vertex - kBoxCorners];
      if (i == kNone) {
        i = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(point(vertex));
      }
      return i;
    };
    const std::uint32_t rim = static_cast<std::uint32_t>(rim_count());
    for (const auto& t : plane_.triangles()) {
      if (!t.inside) continue;
      const std::array<std::uint32_t, 3> v{numbered(t.vertex[0]), numbered(t.vertex[1]), numbered(t.vertex[2])};
      mesh.triangles.push_back(v);
      for (int k = 0; k < 3; ++k) {
        const auto a = v[(k + 1) % 3], b = v[(k + 2) % 3];
        if (t.segment[k] < 0 && a < b && b < rim) mesh.bridges.push_back({a, b});
      }
    }
    mesh.domain = std::move(outline_.domain);
    return mesh;
  }

  FaceOutline outline_;
  double tolerance_;
  PlanarTriangulation plane_;
  std::vector<FacePoint> inner_;
  std::vector<Segment> too_coarse_;
  bool is_blocked_ = false;
};

}  // namespace

FaceMesh fill_outline(FaceOutline outline, double tolerance) { return FaceFiller(std::move(outline), tolerance).run(); }

FaceMesh fan_outline(FaceOutline outline) {
  FaceMesh mesh;
  mesh.rim = std::move(outline.names);
  mesh.rim_edges = outline.edges;
  mesh.points = std::move(outline.points);
  const auto middle = static_cast<std::uint32_t>(mesh.points.size());
  const FacePoint* a = &mesh.points[0];
  const FacePoint* b = &mesh.points[mesh.points.size() / 3];
  const FacePoint* c = &mesh.points[2 * mesh.points.size() / 3];
  mesh.points.push_back(outline.domain->between({a, b, c}, {1.0 / 3, 1.0 / 3, 1.0 / 3}));
  for (const auto& [from, to] : outline.edges)
    mesh.triangles.push_back({std::uint32_t(from), std::uint32_t(to), middle});
  mesh.domain = std::move(outline.domain);
  return mesh;
}

void split_doubled_edges(FaceMesh& mesh) {
  std::map<BorderPoint, std::uint32_t> first;
  std::vector<std::uint32_t> same(mesh.rim.size());
  for (std::uint32_t i = 0; i < same.size(); ++i) same[i] = first.try_emplace(mesh.rim[i], i).first->second;
  if (first.size() == mesh.rim.size()) return;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  auto ordered = [](std::uint32_t a, std::uint32_t b) { return Edge(std::min(a, b), std::max(a, b)); };
  auto named = [&](std::uint32_t v) { return v < same.size() ? same[v] : v; };
  std::set<Edge> rim;
  for (const auto& [a, b] : mesh.rim_edges) rim.insert(ordered(a, b));
  int round = 0;
  for (bool again = true; again; ++round) {
    if (round == kPartingRounds) throw OpenSurfaceError("edges of the mesh coincide; give another tolerance");
    std::map<Edge, Edge> seen;  // by the names of its ends: the first edge found
    for (const auto& [a, b] : rim) seen.try_emplace(ordered(named(a), named(b)), Edge(a, b));
    std::set<Edge> doubled;
    for (const auto& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        const Edge edge = ordered(t[k], t[(k + 1) % 3]);
        if (rim.contains(edge)) continue;
        const auto [at, fresh] = seen.try_emplace(ordered(named(edge.first), named(edge.second)), edge);
        if (at->first.first == at->first.second || (!fresh && at->second != edge)) doubled.insert(edge);
      }
    }
    for (const auto& [a, b] : doubled) split_edge(mesh, a, b);
    again = !doubled.empty();
  }
}

void split_edge(FaceMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const bool present = std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return std::count(t.begin(), t.end(), a) == 1 && std::count(t.begin(), t.end(), b) == 1;
  });
  if (!present) return;
  const auto middle = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(mesh.domain->between({&mesh.points[a], &mesh.points[b], &mesh.points[b]}, {0.5, 0.5, 0.0}));
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      auto& t = mesh.triangles[i];
      const std::uint32_t u = t[k], w = t[(k + 1) % 3], apex = t[(k + 2) % 3];
      if (!((u == a && w == b) || (u == b && w == a))) continue;
      t = {u, middle, apex};
      mesh.triangles.push_back({middle, w, apex});
      break;
    }
  }
}

}  // namespace meniscus
