// SPDX-License-Identifier: BSD-3-Clause
// Makes solids of plates, cylinders and spheres around the rings of sugars, and links them.
#include "core/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/structure/sugars.h"

namespace meniscus {
namespace {

constexpr double kLongestLink = 1.75;  // Å; C-O has 1.43, C-N 1.47
constexpr double kEdgeShare = 0.08;    // radius of edges, in kSymbolRadius
constexpr std::uint32_t kConeSides = 48;

/// A sugar that has a symbol.
struct Symbol {
  const Sugar* sugar;
  glm::dvec3 center, up, side;  ///< Å; unit vectors
  std::uint32_t color, second_color, anomeric;
  std::vector<std::uint32_t> atoms;
};

/// A solid has corners, by their coordinates along side, front and up in kSymbolRadius, and faces, by their corners in
/// either orientation.
using Face = std::vector<std::uint32_t>;
struct Solid {
  std::vector<glm::dvec3> corners;
  std::vector<Face> faces;
  std::vector<bool> second;  ///< per face: true if it has the second colour
};

/// Returns a prism with this outline in the plane of side and up, and this half height along the front.
Solid prism(const std::vector<glm::dvec2>& outline, double half_height) {
  Solid solid;
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double z : {-half_height, half_height})
    for (const glm::dvec2& point : outline) solid.corners.emplace_back(point.x, z, point.y);
  Face front, back;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t after = (k + 1) % count;
    front.push_back(k);
    back.insert(back.begin(), count + k);
    solid.faces.push_back({k, count + k, count + after, after});
  }
  solid.faces.push_back(front);
  solid.faces.push_back(back);
  return solid;
}

/// Returns the outline of a regular polygon, or of a star with every other corner at the radius `inner`.
std::vector<glm::dvec2> regular_outline(std::uint32_t count, double inner) {
  std::vector<glm::dvec2> outline;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count, radius = k % 2 == 1 ? inner : 1.0;
    outline.emplace_back(radius * std::sin(angle), radius * std::cos(angle));
  }
  return outline;
}

/// Returns a cube. Halves of different colour meet in the plane of two opposite edges.
Solid cube(bool divided) {
  constexpr double kHalf = 0.8;
  if (!divided) return prism({{-kHalf, -kHalf}, {-kHalf, kHalf}, {kHalf, kHalf}, {kHalf, -kHalf}}, kHalf);
  Solid solid;
  for (const double y : {-kHalf, kHalf})
    for (const glm::dvec2& p : {glm::dvec2(-1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1), glm::dvec2(1, -1)})
      solid.corners.emplace_back(kHalf * p.x, y, kHalf * p.y);
  solid.faces = {{0, 4, 5, 1}, {1, 5, 6, 2}, {0, 1, 2}, {6, 5, 4}, {2, 6, 7, 3}, {3, 7, 4, 0}, {0, 2, 3}, {7, 6, 4}};
  solid.second = {false, false, false, false, true, true, true, true};
  return solid;
}

/// Returns an octahedron; the lower half of a divided one has the second colour.
Solid octahedron(bool divided) {
  Solid solid;
  solid.corners = {{0.85, 0, 0}, {0, 0.85, 0}, {-0.85, 0, 0}, {0, -0.85, 0}, {0, 0, 1.15}, {0, 0, -1.15}};
  for (std::uint32_t k = 0; k < 4; ++k) solid.faces.push_back({k, (k + 1) % 4, 4});
  for (std::uint32_t k = 0; k < 4; ++k) solid.faces.push_back({(k + 1) % 4, k, 5});
  if (divided) solid.second = {false, false, false, false, true, true, true, true};
  return solid;
}

/// Draws the symbols of sugars.
class SymbolDrawer {
 public:
  explicit SymbolDrawer(Shapes& shapes) : shapes_(shapes) {}

  void draw(const Symbol& symbol) {
    switch (symbol.sugar->solid) {
      case SugarSolid::sphere:
        shapes_.spheres.push_back({symbol.center, 0.95 * kSymbolRadius, symbol.color});
        return;
      case SugarSolid::cube:
      case SugarSolid::divided_cube:
        return draw(symbol, cube(symbol.sugar->is_divided()));
      case SugarSolid::diamond:
      case SugarSolid::divided_diamond:
        return draw(symbol, octahedron(symbol.sugar->is_divided()));
      case SugarSolid::star:
        return draw(symbol, prism(regular_outline(10, 0.45), 0.4));
      case SugarSolid::hexagon:
        return draw(symbol, prism(regular_outline(6, 1.0), 0.3));
      case SugarSolid::pentagon:
        return draw(symbol, prism(regular_outline(5, 1.0), 0.3));
      case SugarSolid::cone:
        return draw_cone(symbol);
    }
  }

 private:
  /// Returns the vector with these coordinates along side, front and up.
  static glm::dvec3 to_world(const Symbol& symbol, const glm::dvec3& p) {
    return p.x * symbol.side + p.y * glm::cross(symbol.up, symbol.side) + p.z * symbol.up;
  }

  /// Draws plates on the faces, cylinders along the edges and spheres on the corners: all touch without a step.
  void draw(const Symbol& symbol, const Solid& solid) {
    const double edge = kEdgeShare * kSymbolRadius;
    std::vector<glm::dvec3> corners;
    for (const glm::dvec3& corner : solid.corners)
      corners.push_back(symbol.center + (kSymbolRadius - edge) * to_world(symbol, corner));
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
    std::vector<std::uint32_t> colors(corners.size(), symbol.color);
    for (std::size_t n = 0; n < solid.faces.size(); ++n) {
      const Face& face = solid.faces[n];
      const std::uint32_t color = !solid.second.empty() && solid.second[n] ? symbol.second_color : symbol.color;
      std::vector<glm::dvec3> polygon;
      glm::dvec3 area(0.0);
      for (std::size_t k = 0; k < face.size(); ++k) {
        polygon.push_back(corners[face[k]]);
        area += glm::cross(polygon.back() - corners[face[0]], corners[face[(k + 1) % face.size()]] - corners[face[0]]);
        const std::uint32_t next = face[(k + 1) % face.size()];
        edges.try_emplace({std::min(face[k], next), std::max(face[k], next)}, color);
        colors[face[k]] = color;
      }
      glm::dvec3 middle(0.0);
      for (const glm::dvec3& corner : polygon) middle += corner / double(polygon.size());
      if (glm::dot(area, middle - symbol.center) < 0.0) {
        std::reverse(polygon.begin(), polygon.end());
        area = -area;
      }
      add_plate(shapes_.mesh, polygon, glm::normalize(area), edge, color);
    }
    for (const auto& [ends, color] : edges)
      if (!is_diagonal(solid, ends))
        shapes_.cylinders.push_back({corners[ends.first], corners[ends.second], edge, color, color});
    for (std::size_t n = 0; n < corners.size(); ++n) shapes_.spheres.push_back({corners[n], edge, colors[n]});
  }

  /// True for a line between two halves of one side, where the solid has no edge.
  static bool is_diagonal(const Solid& solid, std::pair<std::uint32_t, std::uint32_t> ends) {
    const glm::dvec3 d = solid.corners[ends.first] - solid.corners[ends.second];
    return !solid.second.empty() && solid.corners.size() == 8 && std::abs(d.x) > 1e-6 && std::abs(d.z) > 1e-6;
  }

  /// Draws a body of revolution with the outline of a triangle with round corners.
  void draw_cone(const Symbol& symbol) {
    const double edge = kEdgeShare * kSymbolRadius, size = kSymbolRadius - edge;
    const glm::dvec2 apex(0.0, 1.05 * size), rim(0.9 * size, -0.75 * size);
    const glm::dvec2 along = glm::normalize(rim - apex), out(-along.y, along.x);
    std::vector<std::pair<glm::dvec2, glm::dvec2>>
        outline;  // points and normals from the apex to the middle of the base
    const auto arc = [&](const glm::dvec2& center, double from, double to) {
      constexpr int kArcSteps = 6;
      for (int n = 0; n <= kArcSteps; ++n) {
        const double angle = from + (to - from) * n / kArcSteps;
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        outline.emplace_back(center + edge * normal, normal);
      }
    };
    const double slope = std::atan2(out.y, out.x);
    arc(apex, 0.5 * std::numbers::pi, slope);
    arc(rim, slope, -0.5 * std::numbers::pi);
    outline.emplace_back(glm::dvec2(0.0, rim.y - edge), glm::dvec2(0.0, -1.0));
    revolve(symbol, outline);
  }

  /// Adds the surface of revolution of an outline with its first and last point on the axis.
  void revolve(const Symbol& symbol, const std::vector<std::pair<glm::dvec2, glm::dvec2>>& outline) {
    MeshShape& mesh = shapes_.mesh;
    const auto add = [&](const std::pair<glm::dvec2, glm::dvec2>& at, double angle) {
      const auto placed = [&](const glm::dvec2& v) {
        return to_world(symbol, {v.x * std::cos(angle), v.x * std::sin(angle), v.y});
      };
      mesh.positions.push_back(symbol.center + placed(at.first));
      mesh.normals.emplace_back(placed(at.second));
      mesh.atoms.push_back(symbol.color);
      return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    const std::uint32_t top = add(outline.front(), 0.0);
    std::uint32_t above = 0;
    for (std::size_t row = 1; row + 1 < outline.size(); ++row) {
      const auto ring = static_cast<std::uint32_t>(mesh.positions.size());
      for (std::uint32_t k = 0; k < kConeSides; ++k) add(outline[row], 2.0 * std::numbers::pi * k / kConeSides);
      for (std::uint32_t k = 0; k < kConeSides; ++k) {
        const std::uint32_t after = (k + 1) % kConeSides;
        if (row == 1) {
          mesh.triangles.push_back({top, ring + k, ring + after});
          continue;
        }
        mesh.triangles.push_back({ring + k, ring + after, above + after});
        mesh.triangles.push_back({ring + k, above + after, above + k});
      }
      above = ring;
    }
    const std::uint32_t bottom = add(outline.back(), 0.0);
    for (std::uint32_t k = 0; k < kConeSides; ++k)
      mesh.triangles.push_back({bottom, above + (k + 1) % kConeSides, above + k});
  }

  Shapes& shapes_;
};

/// Returns the symbols of the sugars with selected rings.
std::vector<Symbol> symbols_of(const Structure& structure, const std::vector<bool>& selected,
                               const std::vector<std::uint32_t>& order) {
  std::vector<Symbol> symbols;
  std::size_t last = 0;
  for (std::size_t first = 0; first < order.size(); first = last) {
    const Atom& head = structure.atoms[order[first]];
    std::vector<Atom> residue;
    for (; last < order.size(); ++last) {
      const Atom& atom = structure.atoms[order[last]];
      if (atom.residue != head.residue || atom.copy != head.copy) break;
      residue.push_back(atom);
    }
    const Sugar* const sugar = sugar_of(residue);
    if (!sugar) continue;
    const SugarRing ring = ring_of(residue);
    bool shown = ring.count > 0;
    glm::dvec3 center(0.0), normal(0.0);
    for (std::uint32_t n = 0; n < ring.count; ++n) {
      shown = shown && selected[order[first + ring.atoms[n]]];
      center += residue[ring.atoms[n]].position / double(ring.count);
    }
    if (!shown) continue;
    for (std::uint32_t n = 0; n < ring.count; ++n)
      normal += glm::cross(residue[ring.atoms[n]].position - center,
                           residue[ring.atoms[(n + 1) % ring.count]].position - center);
    Symbol symbol{sugar, center, residue[ring.atoms[0]].position - center, {}, 0, 0, 0, {}};
    normal = glm::normalize(normal);
    symbol.up = glm::normalize(symbol.up - glm::dot(symbol.up, normal) * normal);
    symbol.side = glm::cross(symbol.up, normal);  // the front of flat symbols is along the ring's normal
    symbol.anomeric = symbol.color = symbol.second_color = order[first + ring.atoms[0]];
    for (std::size_t n = residue.size(); n-- > 0;) {
      symbol.atoms.push_back(order[first + n]);
      const auto end = ring.atoms.begin() + ring.count;
      if (std::find(ring.atoms.begin(), end, n) == end) symbol.second_color = order[first + n];
    }
    symbols.push_back(std::move(symbol));
  }
  return symbols;
}

/// Adds sticks from each symbol to the partner that its anomeric carbon is bonded to in another residue.
void add_links(const Structure& structure, const std::vector<Symbol>& symbols, double radius, Shapes& shapes) {
  std::map<std::uint32_t, std::size_t> symbol_of;
  for (std::size_t n = 0; n < symbols.size(); ++n)
    for (const std::uint32_t atom : symbols[n].atoms) symbol_of[atom] = n;
  for (std::size_t n = 0; n < symbols.size(); ++n) {
    const Symbol& symbol = symbols[n];
    const Atom& carbon = structure.atoms[symbol.anomeric];
    for (std::uint32_t other = 0; other < structure.atoms.size(); ++other) {
      const Atom& atom = structure.atoms[other];
      if ((atom.residue == carbon.residue && atom.copy == carbon.copy) || atom.element == 1 ||
          atom.model != carbon.model)
        continue;
      const glm::dvec3 d = atom.position - carbon.position;
      if (glm::dot(d, d) > kLongestLink * kLongestLink) continue;
      const auto found = symbol_of.find(other);
      if (found != symbol_of.end()) {
        const Symbol& partner = symbols[found->second];
        shapes.cylinders.push_back({symbol.center, partner.center, radius, symbol.color, partner.color});
        continue;
      }
      std::uint32_t end = other;
      for (std::uint32_t near = 0; near < structure.atoms.size(); ++near) {
        const Atom& candidate = structure.atoms[near];
        if (candidate.residue == atom.residue && candidate.copy == atom.copy && candidate.name == "CA") end = near;
      }
      const glm::dvec3& place = structure.atoms[end].position;
      shapes.cylinders.push_back({symbol.center, place, radius, symbol.color, end});
      shapes.spheres.push_back({place, radius, end});
    }
  }
}

}  // namespace

Shapes sugar_symbols(const Structure& structure, const std::vector<bool>& selected, double radius) {
  Shapes shapes;
  const std::vector<Symbol> symbols = symbols_of(structure, selected, file_order(structure.atoms));
  SymbolDrawer drawer(shapes);
  for (const Symbol& symbol : symbols) drawer.draw(symbol);
  add_links(structure, symbols, radius, shapes);
  return shapes;
}

}  // namespace meniscus
