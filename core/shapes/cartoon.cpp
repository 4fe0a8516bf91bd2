// SPDX-License-Identifier: BSD-3-Clause
// Sweeps ellipses along splines through the backbone, and joins the filled rings of bases to them.
#include "core/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/structure/secondary_structure.h"

namespace meniscus {
namespace {

constexpr int kSteps = 8;             // sections between two residues
constexpr std::uint32_t kSides = 16;  // points of a section
constexpr int kCapRings = 3;          // rings of vertices on a round end
// Å; steps between bonded residues are 3.8 and 5 to 7.5.
constexpr double kLongestStep = 4.5, kLongestPhosphateStep = 8.5;
constexpr double kShortestStep = 0.5;  // Å; residues that are nearer are duplicates
// Half widths, and half the thickness of what is flat, in radii.
constexpr double kHelixWidth = 3.0, kStrandWidth = 2.8, kArrowWidth = 4.6, kBandWidth = 2.8, kFlatness = 0.6;
constexpr double kArrowStep = 0.05;  // Å, the length of an arrow's shoulder

/// A residue that the middle line goes through.
struct Guide {
  std::uint32_t atom;
  glm::dvec3 position;
  std::optional<glm::dvec3> beside;  ///< O of the peptide, or C1' of the nucleotide
  bool nucleic;
  SecondaryStructure kind;
  glm::dvec3 side{0.0};  ///< unit vector along the width; zero if it is not known
};

bool is_any(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the guides of all residues with selected guide atoms, in the order of their file.
std::vector<Guide> guides_of(std::span<const Atom> atoms, const std::vector<bool>& selected) {
  const std::vector<std::uint32_t> order = file_order(atoms);
  std::vector<Atom> sorted;
  for (const std::uint32_t n : order) sorted.push_back(atoms[n]);
  const std::vector<SecondaryStructure> kinds = secondary_structure(sorted);
  std::vector<Guide> guides;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const Atom& head = sorted[first];
    std::optional<std::size_t> alpha, phosphorus, first_oxygen, sugar, oxygen, base;
    for (; last < order.size() && sorted[last].residue == head.residue && sorted[last].copy == head.copy; ++last) {
      const Atom& atom = sorted[last];
      if (is_any(atom.name, {"O", "O1", "OT1", "OC1"}) && !oxygen) oxygen = last;
      if (is_any(atom.name, {"C1'", "C1*"}) && !base) base = last;
      if (!selected[order[last]] || atom.kind == AtomClass::ion || atom.kind == AtomClass::water) continue;
      const bool bead = atom.name == "BB" && atom.element == 0;  // Martini's bead for the backbone of a residue
      if (((atom.name == "CA" && atom.element == 6) || bead) && !alpha) alpha = last;
      if (atom.name == "P" && !phosphorus) phosphorus = last;
      if (is_any(atom.name, {"O5'", "O5*"}) && !first_oxygen) first_oxygen = last;
      if (is_any(atom.name, {"C4'", "C4*"}) && !sugar) sugar = last;
    }
    const std::optional<std::size_t> start = phosphorus ? phosphorus : first_oxygen ? first_oxygen : sugar;
    const std::optional<std::size_t> guide = alpha ? alpha : sugar ? start : sugar;
    if (!guide) continue;
    guides.push_back({order[*guide], sorted[*guide].position, {}, !alpha, kinds[*guide]});
    if (const auto beside = alpha ? oxygen : base) guides.back().beside = sorted[*beside].position;
  }
  return guides;
}

/// Divides guides into unbroken pieces, and drops duplicates.
std::vector<std::vector<Guide>> pieces_of(std::span<const Atom> atoms, const std::vector<Guide>& guides) {
  std::vector<std::vector<Guide>> pieces;
  for (const Guide& guide : guides) {
    const Atom& atom = atoms[guide.atom];
    if (!pieces.empty()) {
      const Guide& before = pieces.back().back();
      const Atom& last = atoms[before.atom];
      const double step = glm::distance(before.position, guide.position);
      const bool same = atom.chain == last.chain && atom.model == last.model && atom.copy == last.copy;
      if (same && step < kShortestStep) continue;
      if (same && guide.nucleic == before.nucleic && step <= (guide.nucleic ? kLongestPhosphateStep : kLongestStep)) {
        pieces.back().push_back(guide);
        continue;
      }
    }
    pieces.push_back({guide});
  }
  return pieces;
}

/// Returns a unit vector perpendicular to v.
glm::dvec3 any_normal_to(const glm::dvec3& v) {
  const glm::dvec3 helper = std::abs(v.x) < 0.6 * glm::length(v) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(v, helper));
}

/// Sets the directions along the width: in the peptide planes, across the way to the bases, or else across the curve.
/// From one to the next they never turn around.
void find_sides(std::vector<Guide>& piece) {
  glm::dvec3 last(0.0);
  for (std::size_t n = 0; n < piece.size(); ++n) {
    const glm::dvec3 &before = piece[n > 0 ? n - 1 : n].position, &here = piece[n].position,
                     &behind = piece[n + 1 < piece.size() ? n + 1 : n].position;
    glm::dvec3 side(0.0);
    if (piece[n].beside && piece[n].nucleic) {
      side = glm::cross(behind - before, *piece[n].beside - here);
    } else if (piece[n].beside) {
      const glm::dvec3 along = n + 1 < piece.size() ? behind - here : here - before;
      side = glm::cross(glm::cross(along, *piece[n].beside - here), along);
    } else {
      side = glm::cross(behind - before, before + behind - 2.0 * here);
    }
    const double length = glm::length(side);
    if (length < 1e-6) continue;
    side /= length;
    if (glm::dot(side, last) < 0.0) side = -side;
    last = piece[n].side = side;
  }
}

/// Smooths strands, which zigzag from residue to residue, so that their ribbon goes through the middle, and the
/// directions of bands of nucleic acids.
void smooth_ribbons(std::vector<Guide>& piece) {
  const std::vector<Guide> given = piece;
  for (std::size_t n = 1; n + 1 < piece.size(); ++n) {
    const bool is_strand = given[n].kind == SecondaryStructure::strand;
    if (!is_strand && !given[n].nucleic) continue;
    if (is_strand) piece[n].position = 0.25 * (given[n - 1].position + 2.0 * given[n].position + given[n + 1].position);
    const glm::dvec3 side = given[n - 1].side + 2.0 * given[n].side + given[n + 1].side;
    if (glm::length(side) > 1e-6) piece[n].side = glm::normalize(side);
  }
}

/// The frame of an ellipse (Å): its width is along `side`, its height along `tangent` x `side`.
struct Section {
  glm::dvec3 center, tangent, side;
  double half_width, half_height;
  std::uint32_t atom;
};

/// Sweeps an ellipse along the spline through a piece.
class Sweep {
 public:
  Sweep(const std::vector<Guide>& piece, double radius) : piece_(piece), radius_(radius) { add_sections(); }

  const std::vector<Section>& sections() const { return sections_; }

  /// Appends a body with round ends to the mesh.
  void add_to(MeshShape& mesh) const {
    const Section &first = sections_.front(), &last = sections_.back();
    std::uint32_t ring = add_start_cap(mesh, first, -1.0);
    for (std::size_t n = 0; n < sections_.size(); ++n) {
      const std::uint32_t next = add_ring(mesh, sections_[n], 1.0, 0.0);
      add_band(mesh, ring, next);
      ring = next;
    }
    add_end_cap(mesh, last, ring);
  }

 private:
  /// Returns half the width and half the height of a residue's ribbon or tube.
  glm::dvec2 half_size(std::size_t n) const {
    if (piece_[n].nucleic) return radius_ * glm::dvec2(kBandWidth, kFlatness);
    if (piece_[n].kind == SecondaryStructure::helix) return radius_ * glm::dvec2(kHelixWidth, kFlatness);
    if (piece_[n].kind == SecondaryStructure::strand) return radius_ * glm::dvec2(kStrandWidth, kFlatness);
    return glm::dvec2(radius_);
  }

  /// True for the last residue of a strand before another kind or the end: an arrow leads to it.
  bool ends_strand(std::size_t n) const {
    return piece_[n].kind == SecondaryStructure::strand && n > 0 && piece_[n - 1].kind == SecondaryStructure::strand &&
           (n + 1 == piece_.size() || piece_[n + 1].kind != SecondaryStructure::strand);
  }

  /// Adds the sections of the whole piece.
  void add_sections() {
    const std::size_t last = piece_.size() - 1;
    for (std::size_t n = 0; n < last; ++n) {
      const bool arrow = ends_strand(n + 1);
      if (arrow) add_section(n, -kArrowStep / glm::distance(piece_[n].position, piece_[n + 1].position), half_size(n));
      const glm::dvec2 tube(radius_), shoulder = radius_ * glm::dvec2(kArrowWidth, kFlatness);
      for (int step = 0; step < kSteps; ++step) {
        const double t = double(step) / kSteps;
        const double smooth = t * t * (3.0 - 2.0 * t);
        if (arrow)
          add_section(n, t, glm::mix(shoulder, tube, t));
        else
          add_section(n, t, glm::mix(ends_strand(n) ? tube : half_size(n), half_size(n + 1), smooth));
      }
    }
    add_section(last - 1, 1.0, ends_strand(last) ? glm::dvec2(radius_) : half_size(last));
  }

  /// Adds a section at the share t of the way from residue n to the next; t may be a little less than 0.
  void add_section(std::size_t n, double t, const glm::dvec2& half) {
    const auto point = [&](std::ptrdiff_t k) {
      const auto count = static_cast<std::ptrdiff_t>(piece_.size());
      if (k < 0) return 2.0 * piece_[0].position - piece_[1].position;
      if (k >= count) return 2.0 * piece_[count - 1].position - piece_[count - 2].position;
      return piece_[k].position;
    };
    const auto k = static_cast<std::ptrdiff_t>(n);
    const glm::dvec3 a = point(k - 1), b = point(k), c = point(k + 1), d = point(k + 2);
    const glm::dvec3 p1 = 0.5 * (c - a), p2 = a - 2.5 * b + 2.0 * c - 0.5 * d, p3 = 0.5 * (d - a) + 1.5 * (b - c);
    Section section{};
    section.center = b + t * (p1 + t * (p2 + t * p3));
    glm::dvec3 tangent = p1 + t * (2.0 * p2 + t * 3.0 * p3);
    if (glm::length(tangent) < 1e-6) tangent = c - b;
    section.tangent = glm::normalize(tangent);
    const double share = std::clamp(t, 0.0, 1.0);
    glm::dvec3 side = (1.0 - share) * piece_[n].side + share * piece_[n + 1].side;
    side -= glm::dot(side, section.tangent) * section.tangent;
    if (glm::length(side) < 0.1 && !sections_.empty()) {
      side = sections_.back().side;
      side -= glm::dot(side, section.tangent) * section.tangent;
    }
    section.side = glm::length(side) < 1e-3 ? any_normal_to(section.tangent) : glm::normalize(side);
    section.half_width = half.x;
    section.half_height = half.y;
    section.atom = piece_[t < 0.5 ? n : n + 1].atom;
    sections_.push_back(section);
  }

  /// Adds the ellipse, scaled by `share` and moved by `shift` half heights along the tangent; returns its first vertex.
  std::uint32_t add_ring(MeshShape& mesh, const Section& s, double share, double shift) const {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::dvec3 up = glm::cross(s.tangent, s.side);
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides, x = std::cos(angle), y = std::sin(angle);
      add_vertex(
          mesh,
          s.center + share * (s.half_width * x * s.side + s.half_height * y * up) + shift * s.half_height * s.tangent,
          share * (x / s.half_width * s.side + y / s.half_height * up) + shift / s.half_height * s.tangent, s.atom);
    }
    return first;
  }

  static void add_vertex(MeshShape& mesh, const glm::dvec3& position, const glm::dvec3& normal, std::uint32_t atom) {
    mesh.positions.push_back(position);
    mesh.normals.emplace_back(glm::normalize(normal));
    mesh.atoms.push_back(atom);
  }

  /// Adds the triangles between two rings of vertices.
  static void add_band(MeshShape& mesh, std::uint32_t low, std::uint32_t high) {
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t after = (k + 1) % kSides;
      mesh.triangles.push_back({low + k, low + after, high + after});
      mesh.triangles.push_back({low + k, high + after, high + k});
    }
  }

  /// Adds a round end before the first section; returns its last ring.
  std::uint32_t add_start_cap(MeshShape& mesh, const Section& s, double direction) const {
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    add_vertex(mesh, s.center + direction * s.half_height * s.tangent, direction * s.tangent, s.atom);
    std::uint32_t ring = 0;
    for (int n = kCapRings; n > 0; --n) {
      const double angle = 0.5 * std::numbers::pi * n / (kCapRings + 1);
      const std::uint32_t next = add_ring(mesh, s, std::cos(angle), direction * std::sin(angle));
      if (n == kCapRings)
        for (std::uint32_t k = 0; k < kSides; ++k) mesh.triangles.push_back({tip, next + (k + 1) % kSides, next + k});
      else
        add_band(mesh, ring, next);
      ring = next;
    }
    return ring;
  }

  /// Adds a round end after the last section, from its ring on.
  void add_end_cap(MeshShape& mesh, const Section& s, std::uint32_t ring) const {
    for (int n = 1; n <= kCapRings; ++n) {
      const double angle = 0.5 * std::numbers::pi * n / (kCapRings + 1);
      const std::uint32_t next = add_ring(mesh, s, std::cos(angle), std::sin(angle));
      add_band(mesh, ring, next);
      ring = next;
    }
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    add_vertex(mesh, s.center + s.half_height * s.tangent, s.tangent, s.atom);
    for (std::uint32_t k = 0; k < kSides; ++k) mesh.triangles.push_back({tip, ring + k, ring + (k + 1) % kSides});
  }

  const std::vector<Guide>& piece_;
  double radius_;
  std::vector<Section> sections_;
};

}  // namespace

std::vector<std::uint32_t> file_order(std::span<const Atom> atoms) {
  std::vector<std::uint32_t> order(atoms.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(atoms[a].copy, atoms[a].index) < std::pair(atoms[b].copy, atoms[b].index);
  });
  return order;
}

std::vector<MiddlePoint> nucleic_middle_lines(const Structure& structure) {
  const std::vector<bool> all(structure.atoms.size(), true);
  std::vector<MiddlePoint> points;
  for (std::vector<Guide>& piece : pieces_of(structure.atoms, guides_of(structure.atoms, all))) {
    if (!piece[0].nucleic) continue;
    if (piece.size() == 1) {
      points.push_back({piece[0].position, piece[0].atom});
      continue;
    }
    const Sweep sweep(piece, kTubeRadius);
    for (const Section& section : sweep.sections()) points.push_back({section.center, section.atom});
  }
  return points;
}

Shapes backbone(const Structure& structure, const std::vector<bool>& selected, double radius) {
  Shapes shapes;
  for (std::vector<Guide>& piece : pieces_of(structure.atoms, guides_of(structure.atoms, selected))) {
    if (piece.size() == 1) {
      shapes.spheres.push_back({piece[0].position, radius, piece[0].atom});
      continue;
    }
    find_sides(piece);
    smooth_ribbons(piece);
    Sweep(piece, radius).add_to(shapes.mesh);
  }
  return shapes;
}

namespace {

constexpr double kLongestBaseBond = 2.0;  // Å, in a ring and from a ring to its sugar
constexpr double kLongestRung = 10.0;     // Å; C1' is 4 to 6 from the middle line

/// The atoms that a base is drawn from, as indices into Structure::atoms.
struct Base {
  std::array<std::optional<std::uint32_t>, 10> ring;  ///< index: number in the atom's name; the first entry is not used
  std::array<std::string_view, 10> name;
  std::optional<std::uint32_t> sugar;  ///< C1'
  std::uint32_t residue = 0, copy = 0;
};

/// The letters that the names of ring atoms with each number begin with, the better one first; the letters of
/// substituents are left out.
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

Shapes cartoon(const Structure& structure, const std::vector<bool>& selected, double tube_radius, double base_radius) {
  Shapes shapes = backbone(structure, selected, tube_radius);
  std::vector<bool> polymer(selected.size());
  for (std::size_t n = 0; n < polymer.size(); ++n)
    polymer[n] = selected[n] && structure.atoms[n].kind == AtomClass::polymer;
  append(shapes, bases(structure, polymer, base_radius));
  return shapes;
}

Shapes bases(const Structure& structure, const std::vector<bool>& selected, double radius) {
  std::vector<Base> found = bases_of(structure.atoms, selected);
  std::erase_if(found, [](const Base& base) { return !base.ring[1]; });
  if (found.empty()) return {};
  BaseDrawer drawer(structure, radius);
  for (const Base& base : found) drawer.draw(base);
  return std::move(drawer.shapes);
}

}  // namespace meniscus
