// SPDX-License-Identifier: BSD-3-Clause
// Triangulates points and segments of the plane exactly: insertion, flips, recovery of constraints.
#include "core/mesh/planar_triangulation.h"

#include <deque>

#include "core/base/error.h"

namespace meniscus {
namespace {

__extension__ using Wide = __int128;

constexpr int next(int k) { return k == 2 ? 0 : k + 1; }
constexpr int previous(int k) { return k == 0 ? 2 : k - 1; }

}  // namespace

std::int64_t orientation(GridPoint a, GridPoint b, GridPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const std::int64_t lift_a = ax * ax + ay * ay, lift_b = bx * bx + by * by, lift_c = cx * cx + cy * cy;
  return Wide(lift_a) * (bx * cy - by * cx) + Wide(lift_b) * (cx * ay - cy * ax) + Wide(lift_c) * (ax * by - ay * bx) >
         0;
}

void PlanarTriangulation::refuse() {
  throw OpenSurfaceError("a face of the mesh cannot be triangulated; give another tolerance");
}

PlanarTriangulation::PlanarTriangulation() {
  constexpr std::size_t kUsualPoints = 64;
  points_.reserve(kUsualPoints);
  triangle_of_.reserve(kUsualPoints);
  triangles_.reserve(2 * kUsualPoints);
  const std::int64_t m = kGridLimit + kGridLimit / 2;
  points_ = {{-m, -m}, {m, -m}, {m, m}, {-m, m}};
  triangle_of_ = {0, 0, 0, 1};
  triangles_.resize(2);
  triangles_[0] = {{0, 1, 2}, {-1, 1, -1}, {-1, -1, -1}, false};
  triangles_[1] = {{0, 2, 3}, {-1, -1, 0}, {-1, -1, -1}, false};
}

int PlanarTriangulation::locate(GridPoint point) const {
  int t = last_;
  // A walk through a constrained triangulation may go in circles; after a while all triangles are tried instead.
  for (std::size_t step = 0; step < 2 * triangles_.size() + 8; ++step) {
    const Triangle& triangle = triangles_[t];
    int go = -1;
    for (int i = 0; i < 3 && go < 0; ++i) {
      const int k = (i + int(step)) % 3;
      if (triangle.neighbor[k] >= 0 &&
          orientation(points_[triangle.vertex[next(k)]], points_[triangle.vertex[previous(k)]], point) < 0) {
        go = triangle.neighbor[k];
      }
    }
    if (go < 0) return last_ = t;
    t = go;
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& v = triangles_[i].vertex;
    if (orientation(points_[v[0]], points_[v[1]], point) >= 0 &&
        orientation(points_[v[1]], points_[v[2]], point) >= 0 &&
        orientation(points_[v[2]], points_[v[0]], point) >= 0) {
      return last_ = int(i);
    }
  }
  refuse();  // the point is outside of the grid, or not a number
}

void PlanarTriangulation::set(int triangle, std::array<int, 3> vertex, std::array<int, 3> neighbor,
                              std::array<int, 3> segment, bool inside) {
  triangles_[triangle] = {vertex, neighbor, segment, inside};
  for (int v : vertex) triangle_of_[v] = triangle;
}

void PlanarTriangulation::relink(int triangle, int old_neighbor, int new_neighbor) {
  if (triangle < 0) return;
  for (int& n : triangles_[triangle].neighbor) {
    if (n == old_neighbor) {
      n = new_neighbor;
      return;
    }
  }
}

int PlanarTriangulation::add_triangle() {
  triangles_.emplace_back();
  return int(triangles_.size()) - 1;
}

void PlanarTriangulation::split_triangle(int triangle, int vertex) {
  const Triangle old = triangles_[triangle];
  const int t0 = triangle, t1 = add_triangle(), t2 = add_triangle();
  const auto& v = old.vertex;
  set(t0, {vertex, v[1], v[2]}, {old.neighbor[0], t1, t2}, {old.segment[0], -1, -1}, old.inside);
  set(t1, {vertex, v[2], v[0]}, {old.neighbor[1], t2, t0}, {old.segment[1], -1, -1}, old.inside);
  set(t2, {vertex, v[0], v[1]}, {old.neighbor[2], t0, t1}, {old.segment[2], -1, -1}, old.inside);
  relink(old.neighbor[1], t0, t1);
  relink(old.neighbor[2], t0, t2);
}

void PlanarTriangulation::split_edge(Edge edge, int vertex) {
  const int t = edge.triangle, k = edge.side;
  const Triangle a = triangles_[t];
  const int u = a.neighbor[k];
  const int p = a.vertex[k], q = a.vertex[next(k)], r = a.vertex[previous(k)];
  if (u < 0) {  // this edge is on the rim of the box, where no point is inserted
    split_triangle(t, vertex);
    return;
  }
  const Triangle b = triangles_[u];
  int j = 0;
  while (b.neighbor[j] != t) ++j;
  const int s = b.vertex[j];
  const int t1 = add_triangle(), u1 = add_triangle();
  // p is above the edge q-r, s below it.
  const int a_pq = a.neighbor[previous(k)], a_rp = a.neighbor[next(k)];
  const int b_qs = b.neighbor[next(j)], b_sr = b.neighbor[previous(j)];
  const int seg_pq = a.segment[previous(k)], seg_rp = a.segment[next(k)];
  const int seg_qs = b.segment[next(j)], seg_sr = b.segment[previous(j)];
  set(t, {vertex, p, q}, {a_pq, u, t1}, {seg_pq, -1, -1}, a.inside);
  set(t1, {vertex, r, p}, {a_rp, t, u1}, {seg_rp, -1, -1}, a.inside);
  set(u, {vertex, q, s}, {b_qs, u1, t}, {seg_qs, -1, -1}, b.inside);
  set(u1, {vertex, s, r}, {b_sr, t1, u}, {seg_sr, -1, -1}, b.inside);
  relink(a_rp, t, t1);
  relink(b_sr, u, u1);
}

void PlanarTriangulation::flip(Edge edge) {
  const int t = edge.triangle, k = edge.side;
  const Triangle a = triangles_[t];
  const int u = a.neighbor[k];
  const Triangle b = triangles_[u];
  int j = 0;
  while (b.neighbor[j] != t) ++j;
  const int p = a.vertex[k], q = a.vertex[next(k)], r = a.vertex[previous(k)], s = b.vertex[j];
  const int a_pq = a.neighbor[previous(k)], a_rp = a.neighbor[next(k)];
  const int b_qs = b.neighbor[next(j)], b_sr = b.neighbor[previous(j)];
  set(t, {p, q, s}, {b_qs, u, a_pq}, {b.segment[next(j)], -1, a.segment[previous(k)]}, a.inside);
  set(u, {p, s, r}, {b_sr, a_rp, t}, {b.segment[previous(j)], a.segment[next(k)], -1}, a.inside);
  relink(b_qs, u, t);
  relink(a_rp, t, u);
}

std::vector<int> PlanarTriangulation::star(int vertex) const {
  std::vector<int> triangles;
  const int first = triangle_of_[vertex];
  int t = first;
  do {
    triangles.push_back(t);
    int i = 0;
    while (triangles_[t].vertex[i] != vertex) ++i;
    t = triangles_[t].neighbor[next(i)];
  } while (t >= 0 && t != first);
  if (t == first) return triangles;
  t = first;  // the vertex is a corner of the box: walk the other way, too
  while (true) {
    int i = 0;
    while (triangles_[t].vertex[i] != vertex) ++i;
    t = triangles_[t].neighbor[previous(i)];
    if (t < 0) return triangles;
    triangles.push_back(t);
  }
}

std::optional<PlanarTriangulation::Edge> PlanarTriangulation::find_edge(int a, int b) const {
  const int first = triangle_of_[a];
  for (int turn = 0, t = first; turn < 2; ++turn) {  // first counter-clockwise; from the box's rim clockwise, too
    do {
      int i = 0;
      while (triangles_[t].vertex[i] != a) ++i;
      if (triangles_[t].vertex[next(i)] == b) return Edge{t, previous(i)};
      t = triangles_[t].neighbor[turn == 0 ? next(i) : previous(i)];
    } while (t >= 0 && t != first);
    if (t == first) return std::nullopt;
    t = first;
  }
  return std::nullopt;
}

std::optional<PlanarTriangulation::Edge> PlanarTriangulation::find_edge(const Suspect& edge) const {
  const auto& v = triangles_[edge.triangle].vertex;
  for (int i = 0; i < 3; ++i)
    if (v[i] == edge.from && v[next(i)] == edge.to) return Edge{edge.triangle, previous(i)};
  return find_edge(edge.from, edge.to);
}

void PlanarTriangulation::legalize(std::vector<Suspect>& edges) {
  // Each flip makes the triangulation more Delaunay, so flips end; refuse() throws if they ever do not.
  const std::size_t most_flips = 64 + 16 * triangles_.size();
  for (std::size_t flips = 0; !edges.empty();) {
    const auto edge = find_edge(edges.back());
    const int a = edges.back().from, b = edges.back().to;
    edges.pop_back();
    if (!edge) continue;
    const Triangle& t = triangles_[edge->triangle];
    const int u = t.neighbor[edge->side];
    if (u < 0 || t.segment[edge->side] >= 0) continue;
    int j = 0;
    while (triangles_[u].neighbor[j] != edge->triangle) ++j;
    const int p = t.vertex[edge->side], s = triangles_[u].vertex[j];
    if (!inside_circle(points_[t.vertex[0]], points_[t.vertex[1]], points_[t.vertex[2]], points_[s])) continue;
    flip(*edge);
    if (++flips > most_flips) refuse();
    const int left = edge->triangle;
    edges.insert(edges.end(), {{p, a, left}, {a, s, left}, {s, b, u}, {b, p, u}});
  }
}

std::optional<int> PlanarTriangulation::insert(GridPoint point) {
  for (const std::int64_t c : {point.x, point.y})
    if (c < -kGridLimit || c > kGridLimit) refuse();  // a point that was not a number lies far outside
  const int t = locate(point);
  const Triangle triangle = triangles_[t];
  int on = -1;
  for (int k = 0; k < 3; ++k) {
    if (points_[triangle.vertex[k]] == point) return triangle.vertex[k];
    if (orientation(points_[triangle.vertex[next(k)]], points_[triangle.vertex[previous(k)]], point) == 0) on = k;
  }
  if (on >= 0 && triangle.segment[on] >= 0) return std::nullopt;
  const int vertex = int(points_.size());
  points_.push_back(point);
  triangle_of_.push_back(-1);
  std::vector<Suspect>& edges = edges_;
  edges.clear();
  const int added = int(triangles_.size());
  if (on >= 0) {
    const int u = triangle.neighbor[on];
    if (u >= 0) {
      const auto& w = triangles_[u].vertex;
      for (int k = 0; k < 3; ++k) edges.push_back({w[k], w[next(k)]});
    }
    split_edge({t, on}, vertex);
  } else {
    split_triangle(t, vertex);
  }
  const std::array<int, 3> with_edge{added + 1, t, added};
  for (int k = 0; k < 3; ++k) edges.push_back({triangle.vertex[k], triangle.vertex[next(k)], with_edge[k]});
  legalize(edges);
  return vertex;
}

std::optional<PlanarTriangulation::Conflict> PlanarTriangulation::crossed_edges(
    int a, int b, std::vector<std::array<int, 2>>& edges) const {
  const GridPoint from = points_[a], to = points_[b];
  int t = -1, side = -1;
  for (int candidate : star(a)) {
    int i = 0;
    while (triangles_[candidate].vertex[i] != a) ++i;
    const int right = triangles_[candidate].vertex[next(i)], left = triangles_[candidate].vertex[previous(i)];
    const std::int64_t o_right = orientation(from, points_[right], to), o_left = orientation(from, points_[left], to);
    if (o_right > 0 && o_left < 0) {
      t = candidate;
      side = i;
      break;
    }
    const GridPoint r = points_[right];
    if (o_right == 0 && (r.x - from.x) * (to.x - from.x) + (r.y - from.y) * (to.y - from.y) > 0) {
      return Conflict{-1, right};
    }
  }
  if (t < 0) refuse();
  for (std::size_t step = 0;; ++step) {
    if (step > triangles_.size()) refuse();
    const Triangle& triangle = triangles_[t];
    if (triangle.segment[side] >= 0) return Conflict{triangle.segment[side], -1};
    const int right = triangle.vertex[next(side)], left = triangle.vertex[previous(side)];
    edges.push_back({right, left});
    const int u = triangle.neighbor[side];
    int j = 0;
    while (triangles_[u].neighbor[j] != t) ++j;
    const int apex = triangles_[u].vertex[j];
    if (apex == b) return std::nullopt;
    const std::int64_t o = orientation(from, to, points_[apex]);
    if (o == 0) return Conflict{-1, apex};
    const int passed = o > 0 ? left : right;  // the line leaves u through the edge opposite this vertex
    side = 0;
    while (triangles_[u].vertex[side] != passed) ++side;
    t = u;
  }
}

std::optional<PlanarTriangulation::Conflict> PlanarTriangulation::constrain(int a, int b, int segment) {
  auto mark = [&](int from, int to) {
    const auto edge = find_edge(from, to);
    if (edge) triangles_[edge->triangle].segment[edge->side] = segment;
    return edge.has_value();
  };
  if (const auto edge = find_edge(a, b)) {
    const int present = triangles_[edge->triangle].segment[edge->side];
    if (present >= 0) return Conflict{present, -1};
  } else {
    std::vector<std::array<int, 2>> crossing;
    std::vector<Suspect> fresh;
    if (const auto conflict = crossed_edges(a, b, crossing)) return conflict;
    std::deque<std::array<int, 2>> queue(crossing.begin(), crossing.end());
    const std::size_t most_turns = 1024 + 16 * crossing.size() * crossing.size();
    for (std::size_t turns = 0; !queue.empty(); ++turns) {
      if (turns > most_turns) refuse();
      const auto [u, w] = queue.front();
      queue.pop_front();
      const auto edge_uw = find_edge(u, w);
      const Triangle& t = triangles_[edge_uw->triangle];
      const int p = t.vertex[edge_uw->side];
      const Triangle& n = triangles_[t.neighbor[edge_uw->side]];
      int j = 0;
      while (n.neighbor[j] != edge_uw->triangle) ++j;
      const int q = n.vertex[j];
      const auto side_u = orientation(points_[p], points_[q], points_[u]);
      const auto side_w = orientation(points_[p], points_[q], points_[w]);
      if (side_u == 0 || side_w == 0 || (side_u > 0) == (side_w > 0)) {  // the quadrilateral is not convex yet
        queue.push_back({u, w});
        continue;
      }
      flip(*edge_uw);
      const bool touches = p == a || p == b || q == a || q == b;
      if (!touches && (orientation(points_[a], points_[b], points_[p]) > 0) !=
                          (orientation(points_[a], points_[b], points_[q]) > 0)) {
        queue.push_back({p, q});
      } else {
        fresh.push_back({p, q});
      }
    }
    mark(a, b);
    mark(b, a);
    legalize(fresh);
  }
  mark(a, b);
  mark(b, a);
  return std::nullopt;
}

bool PlanarTriangulation::fill(const std::vector<std::array<int, 2>>& directed_edges) {
  for (Triangle& t : triangles_) t.inside = false;
  std::vector<int> stack;
  for (const auto& [a, b] : directed_edges) {
    const auto edge = find_edge(a, b);
    if (!edge) return false;
    stack.push_back(edge->triangle);
  }
  while (!stack.empty()) {
    Triangle& t = triangles_[stack.back()];
    stack.pop_back();
    if (t.inside) continue;
    t.inside = true;
    for (int k = 0; k < 3; ++k) {
      if (t.neighbor[k] < 0) return false;
      if (t.segment[k] < 0) stack.push_back(t.neighbor[k]);
    }
  }
  for (const auto& [a, b] : directed_edges) {
    const auto right = find_edge(b, a);
    if (!right || triangles_[right->triangle].inside) return false;
  }
  return true;
}

}  // namespace meniscus
