// SPDX-License-Identifier: BSD-3-Clause
// A constrained Delaunay triangulation on an integer grid, where every decision is exact.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace meniscus {

/// A point of the grid. Its coordinates must lie within +-kGridLimit so that the in-circle test fits into 128 bits.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  bool operator==(const GridPoint&) const = default;
};
inline constexpr std::int64_t kGridLimit = std::int64_t{1} << 28;

/// Returns twice the signed area of a, b, c, exactly: positive when counter-clockwise.
std::int64_t orientation(GridPoint a, GridPoint b, GridPoint c);

/// True if d lies strictly inside the circle through the counter-clockwise a, b, c. The decision is exact.
bool inside_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d);

/// An incremental Delaunay triangulation (Lawson 1977) with constrained edges recovered by flips (Sloan 1993). Vertices
/// 0..3 are the corners of a box around the grid; the caller's vertices follow. Every call ends: points off the grid,
/// and figures that no flips untangle, cause an OpenSurfaceError.
class PlanarTriangulation {
 public:
  struct Triangle {
    std::array<int, 3> vertex{};
    std::array<int, 3> neighbor{-1, -1, -1};  ///< across the edge opposite vertex k, or -1
    std::array<int, 3> segment{-1, -1, -1};   ///< the constraint on the edge opposite vertex k, or -1
    bool inside = false;                      ///< true if fill() marked the triangle
  };
  /// The reason why a constraint cannot be drawn: it meets another one (`segment`), or it runs through a vertex.
  struct Conflict {
    int segment = -1;
    int vertex = -1;
  };

  PlanarTriangulation();

  /// Inserts a point and returns its vertex, or the vertex that already lies there. Returns nothing if the point lies
  /// on a constrained edge.
  std::optional<int> insert(GridPoint point);

  /// Makes the straight edge from a to b part of the triangulation, named `segment` (>= 0). Returns a conflict if that
  /// is impossible.
  std::optional<Conflict> constrain(int a, int b, int segment);

  /// Marks the triangles left of the directed edges, up to the constrained ones. Returns false if they spill over one
  /// of these edges.
  bool fill(const std::vector<std::array<int, 2>>& directed_edges);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<GridPoint>& points() const { return points_; }

 private:
  struct Edge {
    int triangle;
    int side;
  };
  /// An edge that may have to be flipped, and the triangle that had it on its rim when it was listed.
  struct Suspect {
    int from, to;
    int triangle = 0;
  };
  [[noreturn]] static void refuse();
  int locate(GridPoint point) const;
  std::optional<Edge> find_edge(int a, int b) const;
  std::optional<Edge> find_edge(const Suspect& edge) const;
  std::vector<int> star(int vertex) const;
  void set(int triangle, std::array<int, 3> vertex, std::array<int, 3> neighbor, std::array<int, 3> segment,
           bool inside);
  void relink(int triangle, int old_neighbor, int new_neighbor);
  int add_triangle();
  void split_triangle(int triangle, int vertex);
  void split_edge(Edge edge, int vertex);
  void flip(Edge edge);
  void legalize(std::vector<Suspect>& edges);
  std::optional<Conflict> crossed_edges(int a, int b, std::vector<std::array<int, 2>>& edges) const;

  std::vector<GridPoint> points_;
  std::vector<int> triangle_of_;  ///< a triangle at each vertex
  std::vector<Triangle> triangles_;
  std::vector<Suspect> edges_;  ///< scratch of insert()
  mutable int last_ = 0;        ///< the triangle where the last search ended
};

}  // namespace meniscus
