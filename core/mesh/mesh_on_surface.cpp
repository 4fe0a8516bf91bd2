// SPDX-License-Identifier: BSD-3-Clause
// Finds the borders at which faces meet at an angle and the edges that follow them, and keeps positions, links, creases
// and qualities in step while vertices and triangles come, go and move.
#include "core/mesh/mesh_on_surface.h"

#include <tbb/parallel_for.h>

#include "core/math/union_find.h"
#include "core/mesh/remesh_tuning.h"
#include "core/mesh/triangle_mesh.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

struct CreaseAt {
  std::uint32_t border = kNone;  ///< a border that edges at the vertex run along, or kNone
  bool ends = false;  ///< true if creases end or meet here: the crease edges are not just two along one border
};

/// Removes chains that are shorter than an edge; returns true if there were any.
bool drop_short_chains(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge,
                       std::vector<bool>& keep) {
  std::vector<std::array<std::uint32_t, 2>> ends(surface.vertices.size(), {kNone, kNone});
  std::vector<std::uint32_t> degree(surface.vertices.size(), 0);
  UnionFind chains(surface.borders.size());  // arcs that continue one another
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    if (!keep[b]) continue;
    for (const std::uint32_t v : surface.borders[b].vertex) {
      if (v == kNone) continue;
      if (degree[v] < 2) ends[v][degree[v]] = b;
      ++degree[v];
    }
  }
  for (std::size_t v = 0; v < degree.size(); ++v)
    if (degree[v] == 2) chains.unite(ends[v][0], ends[v][1]);
  std::vector<double> edges_long(surface.borders.size(), 0.0);
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    const Border& border = surface.borders[b];
    if (keep[b])
      edges_long[chains.find(b)] += border.radius * border.sweep / edge(arc_point(border, 0.5 * border.sweep));
  }
  bool any = false;
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b)
    if (keep[b] && edges_long[chains.find(b)] < 1.0) keep[b] = false, any = true;
  return any;
}

/// Returns the first border of a face that counts as a crease and that an edge from a to b runs along, or kNone.
std::uint32_t crease_of(const Surface& surface, const SurfaceWalk& walk, const std::vector<bool>& keep,
                        std::uint32_t face, const glm::dvec3& a, const glm::dvec3& b) {
  const auto on_circle = [](const Border& border, const glm::dvec3& x) {
    const glm::dvec3 out = x - border.center;
    return std::abs(glm::dot(out, border.axis)) < RemeshTuning::on_crease &&
           std::abs(glm::length(out) - border.radius) < RemeshTuning::on_crease;
  };
  std::uint32_t found = kNone;
  for_each_half_border(surface, surface.faces[face], [&](HalfBorder half) {
    const std::uint32_t n = border_of(half);
    if (!keep[n] || !on_circle(surface.borders[n], a) || !on_circle(surface.borders[n], b)) return;
    if (walk.on_border(0.5 * (a + b), n)) found = std::min(found, n);
  });
  return found;
}

}  // namespace

std::array<glm::dvec3, 2> crease_normals(const Surface& surface, const Border& border, const glm::dvec3& x) {
  std::array<glm::dvec3, 2> normal{};
  if (border.kind == BorderKind::cusp) {
    for (int side = 0; side < 2; ++side)
      normal[side] = glm::normalize(surface.concave[surface.faces[border.face[side]].patch].center - x);
  } else if (border.kind == BorderKind::contact && surface.probe_radius == 0.0) {
    for (int side = 0; side < 2; ++side) {  // only balls have faces here
      const ConvexPatch& patch = surface.convex[surface.faces[border.face[side]].patch];
      normal[side] = glm::normalize(x - surface.atoms[patch.atom].center);
    }
  }
  return normal;
}

double crease_angle(const Surface& surface, const Border& border) {
  const auto normal = crease_normals(surface, border, arc_point(border, 0.5 * border.sweep));
  return std::atan2(glm::length(glm::cross(normal[0], normal[1])), glm::dot(normal[0], normal[1]));
}

std::vector<bool> creases_to_keep(const Surface& surface, const std::function<double(const glm::dvec3&)>& edge) {
  std::vector<bool> keep(surface.borders.size(), false);
  for (std::uint32_t b = 0; b < surface.borders.size(); ++b) {
    const Border& border = surface.borders[b];
    const double angle = crease_angle(surface, border);
    if (angle == 0.0) continue;
    const double radius = surface.probe_radius > 0.0 ? surface.probe_radius : border.radius;
    keep[b] = std::sin(0.5 * angle) > 0.5 * edge(arc_point(border, 0.5 * border.sweep)) / radius;
  }
  while (drop_short_chains(surface, edge, keep)) {
  }
  return keep;
}

namespace {

/// Marks the half edges that run along a border as creases (HalfEdges::crease()). `links` holds the half edges of
/// `mesh`, whose `face` must be filled. `keep` is true for each border of the surface that counts as a crease.
void mark_creases(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& mesh,
                  const std::vector<bool>& keep, HalfEdges& links) {
  std::vector<bool> with_crease(surface.faces.size(), false);
  for (std::uint32_t b = 0; b < keep.size(); ++b)
    if (keep[b])
      for (const std::uint32_t f : surface.borders[b].face) with_crease[f] = true;
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    const std::uint32_t f = mesh.face[half / 3], g = mesh.face[links.twin(half) / 3];
    if (f == g || half > links.twin(half) || !with_crease[f] || !with_crease[g]) continue;
    // If the probe radius is 0, borders on both sides have the same points; the first one represents both.
    const glm::dvec3 &a = mesh.positions[links.from(half)], &b = mesh.positions[links.to(half)];
    const std::uint32_t border =
        std::min(crease_of(surface, walk, keep, f, a, b), crease_of(surface, walk, keep, g, a, b));
    if (border != kNone) links.set_crease(half, border);
  }
}

std::vector<CreaseAt> creases_at_vertices(const HalfEdges& links) {
  std::vector<CreaseAt> found(links.vertex_count());
  std::vector<std::uint32_t> count(found.size(), 0);
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    const std::uint32_t border = links.crease(half), v = links.from(half);
    if (border == kNone) continue;
    if (count[v]++ > 0 && found[v].border != border) found[v].ends = true;
    found[v].border = border;
  }
  for (std::size_t v = 0; v < found.size(); ++v)
    if (count[v] != 0 && count[v] != 2) found[v].ends = true;
  return found;
}

}  // namespace

bool TriangleQuality::is_folded(std::uint32_t vertex, const glm::dvec3& normal, double size) const {
  const MeshVertex& v = vertices_[vertex];
  return !v.on_crease() && !(glm::dot(normal, v.normal) > v.least_cosine * size);
}

double TriangleQuality::of(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const {
  const glm::dvec3 u = positions_[b] - x, v = positions_[c] - x, w = v - u;
  const glm::dvec3 normal = glm::cross(u, v);
  const double size = glm::length(normal), squares = glm::dot(u, u) + glm::dot(v, v) + glm::dot(w, w);
  if (!(size > 0.0)) return -kFold;
  const double quality = 2.0 * std::sqrt(3.0) * size / squares;
  return is_folded(a, normal, size) || is_folded(b, normal, size) || is_folded(c, normal, size) ? quality - kFold
                                                                                                : quality;
}

double TriangleQuality::of(std::uint32_t triangle) const {
  if (known_[triangle] != kUnknown) return known_[triangle];
  const auto v = links_.corners(triangle);
  return of(v[0], positions_[v[0]], v[1], v[2]);
}

double TriangleQuality::score_around(std::uint32_t vertex) const {
  WorstQuality worst;
  links_.for_each_leaving(vertex, [&](std::uint32_t half) { worst.add(of(half / 3)); });
  return worst.score();
}

double TriangleQuality::score_around(std::uint32_t vertex, const glm::dvec3& x) const {
  WorstQuality worst;
  links_.for_each_leaving(
      vertex, [&](std::uint32_t half) { worst.add(of(vertex, x, links_.to(half), links_.opposite(half))); });
  return worst.score();
}

void TriangleQuality::compute_all() {
  tbb::parallel_for(std::uint32_t{0}, links_.triangle_count(), [&](std::uint32_t t) {
    if (links_.is_alive(3 * t)) known_[t] = static_cast<float>(of(t));
  });
}

void TriangleQuality::forget_all() {
  known_.assign(known_.size(), kUnknown);
  stale_.assign(stale_.size(), 1);
}

std::vector<std::uint8_t> TriangleQuality::take_stale() {
  std::vector<std::uint8_t> stale(stale_.size(), 0);
  stale.swap(stale_);
  return stale;
}

void TriangleQuality::extend() {
  known_.resize(links_.triangle_count(), kUnknown);
  stale_.resize(links_.triangle_count(), 1);
}

void TriangleQuality::compact() {
  std::uint32_t living = 0;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t) {
    if (!links_.is_alive(3 * t)) continue;
    known_[living] = known_[t];
    stale_[living++] = stale_[t];
  }
  known_.resize(living);
  stale_.resize(living);
}

MeshOnSurface::MeshOnSurface(const Surface& surface, SurfaceWalk& walk, const TriangleMesh& base,
                             std::span<const std::uint32_t> vertex_face, const std::vector<bool>& keep, EdgeLength edge)
    : surface_(surface),
      walk_(walk),
      edge_(std::move(edge)),
      links_(base.triangles, static_cast<std::uint32_t>(base.positions.size())),
      positions_(base.positions),
      vertices_(base.positions.size()),
      vertex_count_(surface.components.size(), 0) {
  walk.bar(keep);
  tbb::parallel_for(std::size_t{0}, vertices_.size(), [&](std::size_t n) {
    const auto v = static_cast<std::uint32_t>(n);
    update_vertex(v, {positions_[v], vertex_face[v]}, kNone);
  });
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) ++vertex_count_[component(v)];
  mark_creases(surface, walk, base, keep, links_);
  const std::vector<CreaseAt> creases = creases_at_vertices(links_);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    // The tip of a free spindle has a cone of normals.
    const std::uint32_t tip = surface.faces[vertices_[v].face].tip;
    vertices_[v].crease = creases[v].border;
    vertices_[v].pinned = creases[v].ends || (tip != kNone && positions_[v] == surface.vertices[tip]);
  }
}

/// Sets all attributes of a vertex that follow from its place.
void MeshOnSurface::update_vertex(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t crease) {
  MeshVertex& v = vertices_[vertex];
  positions_[vertex] = at.position;
  v.face = at.face;
  v.crease = crease;
  v.normal = walk_.normal(at);
  v.size = v.scale * static_cast<float>(edge_(at));
  v.least_cosine = least_cosine(vertex);
}

float MeshOnSurface::least_cosine(std::uint32_t vertex) const {
  const double turn = vertices_[vertex].size / std::max(walk_.radius(vertices_[vertex].face), 1e-9);
  return static_cast<float>(std::clamp(1.0 - RemeshTuning::cosine_fall * turn * turn, RemeshTuning::least_cosine,
                                       may_lean_ ? RemeshTuning::least_cosine : RemeshTuning::most_cosine));
}

std::uint32_t MeshOnSurface::component(std::uint32_t vertex) const {
  return surface_.faces[vertices_[vertex].face].component;
}

bool MeshOnSurface::can_spare(std::uint32_t vertex) const {
  return vertex_count_[component(vertex)] > RemeshTuning::fewest_vertices;
}

void MeshOnSurface::allow_lean(bool allowed) {
  may_lean_ = allowed;
  tbb::parallel_for(std::uint32_t{0}, links_.vertex_count(),
                    [&](std::uint32_t v) { vertices_[v].least_cosine = least_cosine(v); });
  quality_.forget_all();
}

void MeshOnSurface::scale_size(std::uint32_t vertex, float factor) {
  vertices_[vertex].scale *= factor;
  vertices_[vertex].size *= factor;
  vertices_[vertex].least_cosine = least_cosine(vertex);
}

/// Marks a vertex as changed, forgets the qualities of its triangles, and lists these in the guard.
void MeshOnSurface::note_changes_around(std::uint32_t vertex) {
  vertices_[vertex].note_change();
  links_.for_each_leaving(vertex, [&](std::uint32_t half) {
    quality_.forget(half / 3);
    if (guard_.is_guarded(vertex)) guard_.add(half / 3);
  });
}

void MeshOnSurface::place(std::uint32_t vertex, const SurfacePoint& at) {
  update_vertex(vertex, at, vertices_[vertex].crease);
  vertices_[vertex].note_change();
}

void MeshOnSurface::move(std::uint32_t vertex, const SurfacePoint& at) {
  update_vertex(vertex, at, vertices_[vertex].crease);
  note_changes_around(vertex);
}

void MeshOnSurface::split(std::uint32_t half, const SurfacePoint& at) {
  const std::uint32_t a = links_.from(half), b = links_.to(half), crease = links_.crease(half);
  links_.split(half);
  add_vertex(a, b, at, crease);
}

void MeshOnSurface::poke(std::uint32_t triangle, const SurfacePoint& at) {
  const auto v = links_.corners(triangle);
  links_.poke(triangle);
  add_vertex(v[0], v[1], at, kNone);
}

/// Sets the attributes of the last vertex, which lies between a and b.
void MeshOnSurface::add_vertex(std::uint32_t a, std::uint32_t b, const SurfacePoint& at, std::uint32_t crease) {
  const std::uint32_t m = links_.vertex_count() - 1;
  positions_.emplace_back();
  vertices_.emplace_back().scale = 0.5f * (vertices_[a].scale + vertices_[b].scale);
  guard_.add_vertex(a, b);
  quality_.extend();
  update_vertex(m, at, crease);
  ++vertex_count_[component(m)];
  note_changes_around(m);
}

void MeshOnSurface::collapse(std::uint32_t half) {
  const std::uint32_t a = links_.from(half), b = links_.to(half);
  guard_.merge_vertex(a, b);
  --vertex_count_[component(a)];
  links_.collapse(half);
  note_changes_around(b);
}

void MeshOnSurface::flip(std::uint32_t half) {
  links_.flip(half);
  for (const std::uint32_t side : {half, links_.twin(half)}) {
    note_changes_around(links_.from(side));
    note_changes_around(links_.opposite(side));
  }
}

void MeshOnSurface::flip(std::uint32_t half, const std::array<double, 2>& qualities) {
  links_.flip(half);
  const std::array<std::uint32_t, 2> triangles{half / 3, links_.twin(half) / 3};
  bool is_guarded = false;
  for (std::size_t n = 0; n < 2; ++n) {
    quality_.remember(triangles[n], qualities[n]);
    quality_.mark_stale(triangles[n]);
    for (const std::uint32_t v : links_.corners(triangles[n])) {
      vertices_[v].note_change();
      is_guarded = is_guarded || guard_.is_guarded(v);
    }
  }
  if (is_guarded)
    for (const std::uint32_t t : triangles) guard_.add(t);
}

void MeshOnSurface::compact() {
  quality_.compact();
  const std::vector<std::uint32_t> old = links_.compact();
  for (std::size_t v = 0; v < old.size(); ++v) {
    positions_[v] = positions_[old[v]];
    vertices_[v] = vertices_[old[v]];
  }
  positions_.resize(old.size());
  vertices_.resize(old.size());
  guard_.compact(old);
}

}  // namespace meniscus
