// SPDX-License-Identifier: BSD-3-Clause
// Cuts triangles, fills the section between them, and divides it among atoms.
#include "core/mesh/section_mesh.h"

#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/planar_triangulation.h"

namespace meniscus {
namespace {

constexpr int kAttempts = 9;
constexpr double kNudge = 1e-6;     // Å by which the plane moves from one attempt to the next
constexpr double kLargestCell = 8;  // largest lattice cells around borders of parts, in units of the smallest
constexpr int kBorderSteps = 40;    // bisections that locate a border

using Corners = std::array<std::uint32_t, 3>;

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

/// Vertices that were inserted on edges.
class EdgeVertices {
 public:
  /// Returns the vertex of an edge; make(lower, higher) creates it if there is none yet.
  std::uint32_t of(std::uint32_t a, std::uint32_t b, const auto& make) {
    const auto [at, fresh] = vertex_.try_emplace(edge_key(a, b), kNone);
    if (fresh) at->second = make(std::min(a, b), std::max(a, b));
    return at->second;
  }
  /// Returns the vertex of an edge, or kNone.
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const {
    const auto at = vertex_.find(edge_key(a, b));
    return at == vertex_.end() ? kNone : at->second;
  }
  bool empty() const { return vertex_.empty(); }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_;
};

/// Coordinates in a plane, on the grid of a triangulation. Seen against the normal, v is to the left of u.
class PlaneGrid {
 public:
  PlaneGrid(const ClipPlane& plane, std::span<const glm::dvec3> points) : normal_(plane.normal) {
    const glm::dvec3 axis = std::abs(normal_.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    u_ = glm::normalize(glm::cross(axis, normal_));
    v_ = glm::cross(normal_, u_);
    low_ = glm::dvec2(std::numeric_limits<double>::infinity());
    high_ = -low_;
    for (const glm::dvec3& point : points) {
      low_ = glm::min(low_, flat(point));
      high_ = glm::max(high_, flat(point));
    }
    const glm::dvec2 half = 0.5 * (high_ - low_);
    scale_ = 0.98 * double(kGridLimit) / std::max({half.x, half.y, 1e-3});
    base_ = plane.offset * normal_;
  }

  GridPoint at(const glm::dvec3& point) const {
    const glm::dvec2 place = (flat(point) - 0.5 * (low_ + high_)) * scale_;
    return {std::llround(place.x), std::llround(place.y)};
  }
  glm::dvec3 point(const glm::dvec2& flat) const { return base_ + flat.x * u_ + flat.y * v_; }
  bool covers(const glm::dvec2& flat) const {
    return flat.x >= low_.x && flat.y >= low_.y && flat.x <= high_.x && flat.y <= high_.y;
  }
  const glm::dvec2& low() const { return low_; }
  const glm::dvec2& high() const { return high_; }

 private:
  glm::dvec2 flat(const glm::dvec3& point) const { return {glm::dot(point, u_), glm::dot(point, v_)}; }

  glm::dvec3 normal_, u_, v_, base_;
  glm::dvec2 low_, high_;
  double scale_ = 1.0;
};

/// Cuts the solid that earlier planes have left by one more plane.
class Cutter {
 public:
  Cutter(const Solid& solid, const ClipPlane& plane, std::uint32_t number, const CapAtoms& atoms, double border_length)
      : solid_(solid), plane_(plane), number_(number), atoms_(atoms), border_length_(border_length) {}

  /// Returns nothing if the section cannot be triangulated.
  std::optional<Solid> run() {
    result_.positions = solid_.positions;
    result_.normals = solid_.normals;
    for (const glm::dvec3& position : solid_.positions) height_.push_back(height(position));
    for (const SolidPiece& piece : solid_.pieces) cut(piece);
    cut_sharp_edges();
    if (segments_.empty()) return std::move(result_);
    const PlaneGrid grid(plane_, std::span(result_.positions).subspan(first_cut()));
    weld(grid);
    if (!keep_single_segments()) return {};
    if (segments_.empty()) return std::move(result_);
    try {
      if (!fill(grid)) return {};
    } catch (const OpenSurfaceError&) {
      return {};
    }
    return std::move(result_);
  }

 private:
  double height(const glm::dvec3& position) const { return glm::dot(plane_.normal, position) - plane_.offset; }
  std::uint32_t first_cut() const { return static_cast<std::uint32_t>(solid_.positions.size()); }
  /// True if a vertex lies on the side of the plane that is cut away.
  bool is_cut_away(std::uint32_t v) const { return height_[v] >= 0.0; }

  std::uint32_t add_vertex(const glm::dvec3& position, const glm::dvec3& normal) {
    result_.positions.push_back(position);
    result_.normals.push_back(normal);
    return static_cast<std::uint32_t>(result_.positions.size()) - 1;
  }

  /// Returns the vertex where the plane cuts an edge.
  std::uint32_t cut_vertex(std::uint32_t a, std::uint32_t b) {
    return cuts_.of(a, b, [&](std::uint32_t low, std::uint32_t high) {
      const double share = height_[low] / (height_[low] - height_[high]);
      const std::vector<glm::dvec3>&x = solid_.positions, &n = solid_.normals;
      const glm::dvec3 position = x[low] + share * (x[high] - x[low]), normal = n[low] + share * (n[high] - n[low]);
      const double length = glm::length(normal);
      return add_vertex(position - height(position) * plane_.normal, length > 0.0 ? normal / length : n[low]);
    });
  }

  void add(const SolidPiece& piece, const Corners& corner) {
    SolidPiece part = piece;
    part.corner = corner;
    result_.pieces.push_back(part);
  }

  void cut(const SolidPiece& piece) {
    const Corners& c = piece.corner;
    const int count = int(is_cut_away(c[0])) + int(is_cut_away(c[1])) + int(is_cut_away(c[2]));
    if (count == 3) return;
    if (count == 0) return add(piece, c);
    // Find the corner that is alone on its side; the others follow it.
    int k = 0;
    while (is_cut_away(c[k]) != (count == 1)) ++k;
    const std::uint32_t lone = c[k], next = c[(k + 1) % 3], last = c[(k + 2) % 3];
    const std::uint32_t p = cut_vertex(lone, next), q = cut_vertex(last, lone);
    if (count == 2) {
      add(piece, {lone, p, q});
      segments_.push_back({q, p});
      return;
    }
    const std::vector<glm::dvec3>& x = result_.positions;
    const bool across = glm::distance(x[next], x[q]) < glm::distance(x[last], x[p]);
    add(piece, across ? Corners{p, next, q} : Corners{p, next, last});
    add(piece, across ? Corners{next, last, q} : Corners{p, last, q});
    segments_.push_back({p, q});
  }

  void cut_sharp_edges() {
    for (const auto& [a, b] : solid_.sharp_edges) {
      if (is_cut_away(a) && is_cut_away(b)) continue;
      if (!is_cut_away(a) && !is_cut_away(b)) {
        result_.sharp_edges.push_back({a, b});
        continue;
      }
      const std::uint32_t middle = cuts_.find(a, b);
      if (middle != kNone) result_.sharp_edges.push_back({is_cut_away(a) ? b : a, middle});
    }
  }

  /// Merges the vertices at each grid point, and removes the triangles and edges that this degenerates.
  void weld(const PlaneGrid& grid) {
    std::vector<std::tuple<std::int64_t, std::int64_t, std::uint32_t>> order;
    for (std::uint32_t v = first_cut(); v < result_.positions.size(); ++v) {
      const GridPoint at = grid.at(result_.positions[v]);
      order.emplace_back(at.x, at.y, v);
    }
    std::ranges::sort(order);
    std::vector<std::uint32_t> same(order.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
      const auto& [x, y, v] = order[n];
      const bool again = n > 0 && std::tie(x, y) == std::tie(std::get<0>(order[n - 1]), std::get<1>(order[n - 1]));
      same[v - first_cut()] = again ? same[std::get<2>(order[n - 1]) - first_cut()] : v;
    }
    const auto welded = [&](std::uint32_t& v) { v = v < first_cut() ? v : same[v - first_cut()]; };
    for (SolidPiece& piece : result_.pieces) std::ranges::for_each(piece.corner, welded);
    for (auto& segment : segments_) std::ranges::for_each(segment, welded);
    for (auto& edge : result_.sharp_edges) std::ranges::for_each(edge, welded);
    std::erase_if(result_.pieces, [](const SolidPiece& piece) {
      const Corners& c = piece.corner;
      return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
    });
    std::erase_if(segments_, [](const auto& segment) { return segment[0] == segment[1]; });
    std::erase_if(result_.sharp_edges, [](const auto& edge) { return edge[0] == edge[1]; });
  }

  /// Removes segments traversed in both directions, which enclose nothing. Returns false if a segment occurs twice.
  bool keep_single_segments() {
    std::ranges::sort(segments_);
    if (std::ranges::adjacent_find(segments_) != segments_.end()) return false;
    const std::vector<std::array<std::uint32_t, 2>> all = segments_;
    std::erase_if(segments_, [&](const auto& s) { return std::ranges::binary_search(all, std::array{s[1], s[0]}); });
    return true;
  }

  /// Triangulates the section and adds the caps; returns false if segments cross.
  bool fill(const PlaneGrid& grid) {
    PlanarTriangulation plane;
    vertex_ = std::vector<std::uint32_t>(plane.points().size(), kNone);
    std::map<std::uint32_t, int> place;
    for (const auto& segment : segments_)
      for (const std::uint32_t v : segment) place.try_emplace(v, 0);
    std::vector<std::tuple<std::int64_t, std::int64_t, std::uint32_t>> order;
    for (const auto& [v, unused] : place) {
      const GridPoint at = grid.at(result_.positions[v]);
      // Points are inserted row by row, to and fro, so that each is near the last.
      order.emplace_back(at.y >> 23, (at.y >> 23) % 2 == 0 ? at.x : -at.x, v);
    }
    std::ranges::sort(order);
    for (const auto& [row, along, v] : order) {
      place[v] = *plane.insert(grid.at(result_.positions[v]));
      vertex_.push_back(v);
    }
    std::vector<std::array<int, 2>> edges;
    for (const auto& [a, b] : segments_) {
      if (plane.constrain(place[a], place[b], static_cast<int>(edges.size()))) return false;
      edges.push_back({place[a], place[b]});
    }
    if (!plane.fill(edges)) return false;
    if (atoms_.has_parts()) add_lattice(plane, grid);
    add_caps(plane);
    return true;
  }

  /// Inserts points around borders of parts, so that triangles there are small.
  void add_lattice(PlanarTriangulation& plane, const PlaneGrid& grid) {
    const double size = kLargestCell * border_length_;
    const glm::dvec2 extent = grid.high() - grid.low();
    const auto columns = static_cast<std::size_t>(extent.x / size) + 1,
               rows = static_cast<std::size_t>(extent.y / size) + 1;
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t n = 0; n < columns; ++n) {
        const std::size_t column = row % 2 == 0 ? n : columns - 1 - n;
        add_cell(plane, grid, grid.low() + (glm::dvec2(column, row) + 0.5) * size, size);
      }
  }

  /// Inserts the middle of a cell, or divides the cell if a border of parts may pass through it.
  void add_cell(PlanarTriangulation& plane, const PlaneGrid& grid, const glm::dvec2& middle, double size) {
    const double reach = size / std::sqrt(2.0);
    const glm::dvec3 point = grid.point(middle);
    const CapAtoms::Nearest nearest = atoms_.nearest(point);
    if (nearest.distance > atoms_.farthest() + reach) return;
    if (nearest.gap <= 2.0 * reach && size > 1.5 * border_length_) {
      for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
        add_cell(plane, grid, middle + 0.25 * size * corner, 0.5 * size);
      return;
    }
    if (!grid.covers(middle)) return;
    const std::optional<int> place = plane.insert(grid.at(point));
    if (place && *place == static_cast<int>(vertex_.size())) vertex_.push_back(add_vertex(point, plane_.normal));
  }

  /// Adds the triangles of the section, cut where parts are equally near, and cuts the adjacent triangles.
  void add_caps(const PlanarTriangulation& plane) {
    std::vector<std::uint32_t> atom(vertex_.size(), kNone);
    EdgeVertices borders;
    const std::size_t surface_count = result_.pieces.size();
    for (const PlanarTriangulation::Triangle& triangle : plane.triangles()) {
      if (!triangle.inside) continue;
      Corners corner{}, label{};
      for (int k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(triangle.vertex[k]);
        corner[k] = vertex_[v];
        if (atom[v] == kNone) atom[v] = atoms_.nearest(result_.positions[corner[k]]).atom;
        label[k] = atom[v];
      }
      add_cap(corner, label, borders);
    }
    if (borders.empty()) return;
    std::vector<SolidPiece> caps(result_.pieces.begin() + static_cast<std::ptrdiff_t>(surface_count),
                                 result_.pieces.end());
    result_.pieces.resize(surface_count);
    const std::vector<SolidPiece> before = std::move(result_.pieces);
    result_.pieces.clear();
    for (const SolidPiece& piece : before) add_split(piece, borders);
    result_.pieces.insert(result_.pieces.end(), caps.begin(), caps.end());
  }

  /// Returns the vertex of an edge at which the atoms of its ends are equally near.
  std::uint32_t border_vertex(EdgeVertices& borders, std::uint32_t a, std::uint32_t b, std::uint32_t atom_a,
                              std::uint32_t atom_b) {
    return borders.of(a, b, [&](std::uint32_t, std::uint32_t) {
      const glm::dvec3 from = result_.positions[a], to = result_.positions[b];
      double low = 0.0, high = 1.0;
      for (int step = 0; step < kBorderSteps; ++step) {
        const double middle = 0.5 * (low + high);
        const glm::dvec3 x = from + middle * (to - from);
        (atoms_.distance(atom_a, x) < atoms_.distance(atom_b, x) ? low : high) = middle;
      }
      const double share = 0.5 * (low + high);
      return add_vertex(from + share * (to - from), result_.normals[a]);
    });
  }

  /// Adds a triangle of the section, cut along the borders of parts.
  void add_cap(const Corners& corner, const Corners& atom, EdgeVertices& borders) {
    const auto differ = [&](int a, int b) { return atoms_.part(atom[a]) != atoms_.part(atom[b]); };
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t of) {
      result_.pieces.push_back({{a, b, c}, kNone, number_, of});
    };
    Corners middle{kNone, kNone, kNone};  // border vertices of the edges from corner k to the next
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const int n = (k + 1) % 3;
      if (!differ(k, n)) continue;
      middle[k] = border_vertex(borders, corner[k], corner[n], atom[k], atom[n]);
      ++count;
    }
    if (count == 0) {
      put(corner[0], corner[1], corner[2], atom[0]);
    } else if (count == 2) {
      int k = 0;  // the corner that belongs to another part
      while (middle[k] == kNone || middle[(k + 2) % 3] == kNone) ++k;
      const int n = (k + 1) % 3, p = (k + 2) % 3;
      put(corner[k], middle[k], middle[p], atom[k]);
      put(middle[k], corner[n], corner[p], atom[n]);
      put(middle[k], corner[p], middle[p], atom[p]);
    } else {
      const std::vector<glm::dvec3>& x = result_.positions;
      const glm::dvec3 mean = (x[middle[0]] + x[middle[1]] + x[middle[2]]) / 3.0;
      const std::uint32_t center = add_vertex(mean, plane_.normal);
      for (int k = 0; k < 3; ++k) {
        put(corner[k], middle[k], center, atom[k]);
        put(center, middle[(k + 2) % 3], corner[k], atom[k]);
      }
    }
  }

  /// Adds a piece next to a cap, cut at the vertices that were inserted on its rim.
  void add_split(const SolidPiece& piece, const EdgeVertices& borders) {
    const Corners& c = piece.corner;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3], last = c[(k + 2) % 3];
      if (a < first_cut() || b < first_cut()) continue;
      const std::uint32_t middle = borders.find(a, b);
      if (middle == kNone) continue;
      SolidPiece rest = piece;
      rest.corner = {middle, b, last};
      SolidPiece first = piece;
      first.corner = {a, middle, last};
      add_split(first, borders);
      add_split(rest, borders);
      return;
    }
    add(piece, c);
  }

  const Solid& solid_;
  const ClipPlane& plane_;
  std::uint32_t number_;
  const CapAtoms& atoms_;
  double border_length_;

  Solid result_;
  std::vector<double> height_;  // per vertex of solid_: its height (Å) over the plane
  EdgeVertices cuts_;
  // The directed edges of the section: the solid is on their left, seen from where it was cut away.
  std::vector<std::array<std::uint32_t, 2>> segments_;
  std::vector<std::uint32_t> vertex_;  // per vertex of the triangulation: its vertex in the result
};

}  // namespace

Solid cut_solid(const Solid& solid, const ClipPlane& plane, std::uint32_t number, const CapAtoms& atoms,
                double border_length) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    ClipPlane moved = plane;
    moved.offset += kNudge * (attempt % 2 == 0 ? attempt / 2 : -(attempt + 1) / 2);
    if (std::optional<Solid> cut = Cutter(solid, moved, number, atoms, border_length).run()) return *std::move(cut);
  }
  throw OpenSurfaceError("the section of plane {} cannot be triangulated; move the plane a little", number + 1);
}

}  // namespace meniscus
