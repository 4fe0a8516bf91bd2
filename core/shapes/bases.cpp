// SPDX-License-Identifier: BSD-3-Clause
// Finds the rings of bases by the names of their atoms, fills them, and joins them to the backbone.
#include "core/shapes/bases.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "core/shapes/cartoon.h"

namespace meniscus {
namespace {

constexpr double kLongestBaseBond = 2.0;  // Å, in a ring and from a ring to its sugar
constexpr double kLongestRung = 10.0;     // Å; C1' is 4 to 6 from the middle line

/// The atoms that a base is drawn from, as indices into Structure::atoms.
struct Base {
  std::array<std::optional<std::uint32_t>, 10> ring;  ///< by the number in the atom's name; the first entry is not used
  std::array<std::string_view, 10> name;
  std::optional<std::uint32_t> sugar;  ///< C1'
  std::uint32_t residue = 0, copy = 0;
};

/// The letters that the names of ring atoms with each number begin with, the better one first; those of substituents
/// are left out.
constexpr std::array<std::string_view, 10> kLetters{"", "NC", "CN", "NC", "CN", "CN", "CN", "NC", "CN", "NC"};

/// Adds an atom to a base if it is one of its ring or its sugar.
void add_atom(Base& base, const Atom& atom, std::uint32_t place) {
  if (atom.name == "C1'" || atom.name == "C1*") base.sugar = place;
  if (atom.name.size() != 2 || atom.name[1] < '1' || atom.name[1] > '9') return;
  const auto number = static_cast<std::size_t>(atom.name[1] - '0');
  const std::size_t rank = kLetters[number].find(atom.name[0]);
  if (rank == std::string_view::npos) return;
  if (base.ring[number] && kLetters[number].find(base.name[number][0]) <= rank) return;
  base.ring[number] = place;
  base.name[number] = atom.name;
}

/// Returns the selected atoms of bases, residue by residue in the order of the file.
std::vector<Base> bases_of(const std::vector<Atom>& atoms, const std::vector<bool>& selected) {
  std::vector<Base> found;
  const std::vector<std::uint32_t> order = file_order(atoms);
  for (const std::uint32_t n : order) {
    const Atom& atom = atoms[n];
    if (found.empty() || found.back().residue != atom.residue || found.back().copy != atom.copy) {
      found.emplace_back();
      found.back().residue = atom.residue;
      found.back().copy = atom.copy;
    }
    if (selected[n]) add_atom(found.back(), atom, n);
  }
  return found;
}

/// Draws bases with their rungs.
class BaseDrawer {
 public:
  BaseDrawer(const Structure& structure, double radius)
      : structure_(structure), radius_(radius), line_(nucleic_middle_lines(structure)) {
    for (std::size_t n = 0; n < line_.size(); ++n) {
      const Atom& atom = structure.atoms[line_[n].atom];
      range_.try_emplace({atom.copy, atom.residue}, n, n).first->second.second = n;
    }
  }

  void draw(const Base& base) {
    if (!fill_ring(base, {1, 2, 3, 4, 5, 6})) return;
    fill_ring(base, {4, 5, 7, 8, 9});
    if (base.sugar) add_rung(base);
  }

  Shapes shapes;

 private:
  const glm::dvec3& position(std::uint32_t atom) const { return structure_.atoms[atom].position; }

  /// Fills a ring; returns false if it is incomplete or not closed.
  bool fill_ring(const Base& base, std::initializer_list<std::size_t> numbers) {
    std::vector<std::uint32_t> atoms;
    for (const std::size_t number : numbers) {
      if (!base.ring[number]) return false;
      atoms.push_back(*base.ring[number]);
    }
    std::vector<glm::dvec3> polygon;
    glm::dvec3 area(0.0);
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      const glm::dvec3 &here = position(atoms[n]), &next = position(atoms[(n + 1) % atoms.size()]);
      const double length = glm::distance(here, next);
      if (length == 0.0 || length > kLongestBaseBond) return false;
      polygon.push_back(here);
      area += glm::cross(here - position(atoms[0]), next - position(atoms[0]));
    }
    if (glm::length(area) < 1e-3) return false;
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      add_stick(position(atoms[n]), position(atoms[(n + 1) % atoms.size()]), atoms[n], atoms[(n + 1) % atoms.size()]);
      shapes.spheres.push_back({position(atoms[n]), radius_, atoms[n]});
    }
    add_plate(shapes.mesh, polygon, glm::normalize(area), radius_, *base.ring[4]);
    return true;
  }

  /// Adds a rung from the ring's nearest atom by C1' to the middle line.
  void add_rung(const Base& base) {
    const glm::dvec3& sugar = position(*base.sugar);
    std::uint32_t nearest = *base.ring[1];
    for (const std::optional<std::uint32_t>& atom : base.ring)
      if (atom && glm::distance(position(*atom), sugar) < glm::distance(position(nearest), sugar)) nearest = *atom;
    const double length = glm::distance(position(nearest), sugar);
    if (length == 0.0 || length > kLongestBaseBond) return;
    add_stick(position(nearest), sugar, nearest, *base.sugar);
    shapes.spheres.push_back({sugar, radius_, *base.sugar});
    if (const std::optional<MiddlePoint> foot = foot_of(base)) {
      add_stick(sugar, foot->position, *base.sugar, foot->atom);
      shapes.spheres.push_back({foot->position, radius_, foot->atom});
    }
  }

  /// Returns the place where the middle line passes C1', at this residue or on the way to the next; nothing if it is
  /// too far away.
  std::optional<MiddlePoint> foot_of(const Base& base) const {
    const auto own = range_.find({base.copy, base.residue});
    if (own == range_.end()) return {};
    const glm::dvec3& sugar = position(*base.sugar);
    const auto distance = [&](std::size_t n) { return glm::distance(line_[n].position, sugar); };
    std::size_t best = own->second.first;
    const auto try_all = [&](std::size_t first, std::size_t last) {
      for (std::size_t n = first; n <= last; ++n)
        if (distance(n) < distance(best)) best = n;
    };
    try_all(own->second.first, own->second.second);
    // The part of the next residue is far away if it belongs to another piece.
    if (const std::size_t next = own->second.second + 1; next < line_.size()) {
      const Atom& atom = structure_.atoms[line_[next].atom];
      const auto& [first, last] = range_.at({atom.copy, atom.residue});
      try_all(first, last);
    }
    if (distance(best) == 0.0 || distance(best) > kLongestRung) return {};
    return line_[best];
  }

  void add_stick(const glm::dvec3& from, const glm::dvec3& to, std::uint32_t from_atom, std::uint32_t to_atom) {
    shapes.cylinders.push_back({from, to, radius_, from_atom, to_atom});
  }

  const Structure& structure_;
  double radius_;
  std::vector<MiddlePoint> line_;
  // (copy, residue) to the first and last index into line_.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> range_;
};

}  // namespace

Shapes bases(const Structure& structure, const std::vector<bool>& selected, double radius) {
  BaseDrawer drawer(structure, radius);
  for (const Base& base : bases_of(structure.atoms, selected)) drawer.draw(base);
  return std::move(drawer.shapes);
}

}  // namespace meniscus
