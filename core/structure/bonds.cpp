// SPDX-License-Identifier: BSD-3-Clause
// Collects the bonds of a molecule from its file, from templates of residues, and by distance; and finds nearest images
// in periodic boxes.
#include "core/structure/bonds.h"

#include <numeric>
#include <set>
#include <unordered_map>

#include <gemmi/elem.hpp>
#include <glm/matrix.hpp>

#include "core/math/ball.h"
#include "core/structure/martini.h"
#include "core/structure/residue_names.h"

namespace meniscus {
namespace {

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

/// Returns the vector v + i a + j b that is nearest to the origin. a and b must be reduced (Lagrange 1773).
glm::dvec3 nearest(const glm::dvec3& v, const glm::dvec3& a, const glm::dvec3& b) {
  const double aa = squared(a), ab = glm::dot(a, b), bb = squared(b);
  const double va = glm::dot(v, a), vb = glm::dot(v, b), determinant = aa * bb - ab * ab;
  const double i0 = std::round((va * bb - vb * ab) / determinant), j0 = std::round((vb * aa - va * ab) / determinant);
  glm::dvec3 best = v - i0 * a - j0 * b;
  const glm::dvec3 start = best;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const glm::dvec3 other = start + double(i) * a + double(j) * b;
      if (squared(other) < squared(best)) best = other;
    }
  }
  return best;
}

/// Returns Minkowski-reduced vectors of the same lattice, by greedy reduction, which is exact in three dimensions (I.
/// Semaev, A 3-dimensional lattice reduction algorithm, 2001).
glm::dmat3 reduced(glm::dmat3 v) {
  constexpr int kMostSteps = 1000;  // boxes of simulations need only a few
  for (int step = 0; step < kMostSteps; ++step) {
    if (squared(v[1]) < squared(v[0])) std::swap(v[0], v[1]);
    if (squared(v[2]) < squared(v[1])) std::swap(v[1], v[2]);
    if (squared(v[1]) < squared(v[0])) std::swap(v[0], v[1]);
    const glm::dvec3 shorter = v[1] - std::round(glm::dot(v[1], v[0]) / squared(v[0])) * v[0];
    if (squared(shorter) < squared(v[1])) {
      v[1] = shorter;
      continue;
    }
    const glm::dvec3 last = nearest(v[2], v[0], v[1]);
    if (squared(last) >= squared(v[2])) return v;
    v[2] = last;
  }
  return v;
}

}  // namespace

std::optional<PeriodicCell> PeriodicCell::of(const glm::dmat3& vectors) {
  const double volume = std::abs(glm::determinant(vectors));
  // No box of atoms has shorter or longer edges, and their squares may leave the range of double precision.
  constexpr double kShortestEdge = 1e-6, kLongestEdge = 1e9;
  double lengths = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = glm::length(vectors[axis]);
    if (!(length >= kShortestEdge && length <= kLongestEdge)) return {};
    lengths *= length;
  }
  if (!std::isfinite(volume) || !(volume > 1e-6 * lengths)) return {};
  return PeriodicCell(reduced(vectors));
}

PeriodicCell::PeriodicCell(const glm::dmat3& reduced)
    : vectors_(reduced), inverse_(glm::inverse(reduced)), half_shortest_squared_(0.25 * squared(reduced[0])) {}

// In a Minkowski-reduced basis in three dimensions the nearest image is next to the rounded one.
glm::dvec3 PeriodicCell::shortest(glm::dvec3 d) const {
  if (squared(d) <= half_shortest_squared_) return d;
  const glm::dvec3 fraction = inverse_ * d;
  d -= vectors_ * glm::dvec3(std::round(fraction.x), std::round(fraction.y), std::round(fraction.z));
  if (squared(d) <= half_shortest_squared_) return d;
  glm::dvec3 best = d;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      for (int c = -1; c <= 1; ++c) {
        const glm::dvec3 image = d + vectors_ * glm::dvec3(a, b, c);
        if (squared(image) < squared(best)) best = image;
      }
    }
  }
  return best;
}

namespace {

constexpr std::string_view kBackboneBonds = "N-CA-C-O C-OXT";
constexpr std::string_view kSugarBonds = "OP1-P-OP2 P-OP3 P-O5'-C5'-C4'-C3'-C2'-C1'-O4'-C4' C3'-O3' C2'-O2'";

/// The heavy atoms of residues without their backbone or sugar, as paths of bonded atoms. Names are those of the
/// wwPDB's components.
constexpr std::pair<std::string_view, std::string_view> kSideChainBonds[] = {
    {"ALA", "CA-CB"},
    {"ARG", "CA-CB-CG-CD-NE-CZ-NH1 CZ-NH2"},
    {"ASN", "CA-CB-CG-OD1 CG-ND2"},
    {"ASP", "CA-CB-CG-OD1 CG-OD2"},
    {"CYS", "CA-CB-SG"},
    {"GLN", "CA-CB-CG-CD-OE1 CD-NE2"},
    {"GLU", "CA-CB-CG-CD-OE1 CD-OE2"},
    {"GLY", ""},
    {"HIS", "CA-CB-CG-ND1-CE1-NE2-CD2-CG"},
    {"ILE", "CA-CB-CG1-CD1 CB-CG2"},
    {"LEU", "CA-CB-CG-CD1 CG-CD2"},
    {"LYS", "CA-CB-CG-CD-CE-NZ"},
    {"MET", "CA-CB-CG-SD-CE"},
    {"MSE", "CA-CB-CG-SE-CE"},
    {"PHE", "CA-CB-CG-CD1-CE1-CZ-CE2-CD2-CG"},
    {"PRO", "CA-CB-CG-CD-N"},
    {"SER", "CA-CB-OG"},
    {"THR", "CA-CB-OG1 CB-CG2"},
    {"TRP", "CA-CB-CG-CD1-NE1-CE2-CD2-CG CD2-CE3-CZ3-CH2-CZ2-CE2"},
    {"TYR", "CA-CB-CG-CD1-CE1-CZ-CE2-CD2-CG CZ-OH"},
    {"VAL", "CA-CB-CG1 CB-CG2"},
    {"ACE", "CH3-C-O"},
    {"NME", "N-CH3 N-C"},
    {"NH2", ""},
    {"HOH", ""},
    {"A", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-N6"},
    {"G", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-O6 C2-N2"},
    {"C", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-N4"},
    {"U", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-O4"},
    {"DA", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-N6"},
    {"DG", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-O6 C2-N2"},
    {"DC", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-N4"},
    {"DT", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-O4 C5-C7 C5-C5M"},
};

class BondFinder {
 public:
  BondFinder(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
             const std::optional<PeriodicCell>& cell)
      : atoms_(atoms), positions_(positions), cell_(cell) {
    for (std::uint32_t n = 0; n < atoms.size(); ++n) {
      if (n == 0 || atoms[n].residue != atoms[n - 1].residue) begins_.push_back(n);
    }
    begins_.push_back(static_cast<std::uint32_t>(atoms.size()));
  }

  std::vector<Bond> by_template() {
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      const std::string residue = canonical_residue(atoms_[begins_[r]].residue_name);
      const Names names = names_of(r, residue);
      for (const auto& [name, side_chain] : kSideChainBonds) {
        if (name != residue) continue;
        join_path(names, kBackboneBonds);
        join_path(names, kSugarBonds);
        join_path(names, side_chain);
      }
      join_hydrogens(r);
      if (r > 0 && atoms_[begins_[r]].chain == atoms_[begins_[r - 1]].chain) {
        join(last_names_, "C", names, "N");
        join(last_names_, "O3'", names, "P");
      }
      last_names_ = names;
    }
    return std::move(bonds_);
  }

  std::vector<Bond> by_distance() {
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      const bool continues = r > 0 && atoms_[begins_[r]].chain == atoms_[begins_[r - 1]].chain;
      for (std::uint32_t a = begins_[r]; a < begins_[r + 1]; ++a)
        for (std::uint32_t b = continues ? begins_[r - 1] : begins_[r]; b < a; ++b)
          if (squared_distance(a, b) <= squared_bond_length(a, b)) bonds_.push_back({b, a});
    }
    return std::move(bonds_);
  }

 private:
  using Names = std::unordered_map<std::string, std::uint32_t>;

  Names names_of(std::size_t r, const std::string& residue) const {
    Names names;
    for (std::uint32_t n = begins_[r]; n < begins_[r + 1]; ++n)
      if (atoms_[n].element != 1) names.try_emplace(canonical_atom(residue, atoms_[n].name), n);
    return names;
  }

  double squared_distance(std::uint32_t a, std::uint32_t b) const {
    glm::dvec3 d = positions_[a] - positions_[b];
    if (cell_) d = cell_->shortest(d);
    return glm::dot(d, d);
  }

  double squared_bond_length(std::uint32_t a, std::uint32_t b) const {
    const auto radius = [&](std::uint32_t n) { return gemmi::Element(atoms_[n].element).covalent_r(); };
    if (atoms_[a].element == 1 && atoms_[b].element == 1) return 0.0;
    const double limit = radius(a) + radius(b) + 0.4;
    return limit * limit;
  }

  /// Bonds every two neighbours of the paths "A-B-C D-E" that are both among the names.
  void join_path(const Names& names, std::string_view paths) {
    const std::uint32_t* last = nullptr;
    while (!paths.empty()) {
      const std::size_t end = paths.find_first_of("- ");
      const auto found = names.find(std::string(paths.substr(0, end)));
      const std::uint32_t* atom = found == names.end() ? nullptr : &found->second;
      if (last && atom) bonds_.push_back({*last, *atom});
      last = end != std::string_view::npos && paths[end] == '-' ? atom : nullptr;
      paths.remove_prefix(end == std::string_view::npos ? paths.size() : end + 1);
    }
  }

  void join_hydrogens(std::size_t r) {
    constexpr double kLongestToHydrogen = 1.6;
    for (std::uint32_t h = begins_[r]; h < begins_[r + 1]; ++h) {
      if (atoms_[h].element > 1) continue;  // sites have the element 0, such as the fourth of water models
      std::uint32_t nearest = h;
      double least = kLongestToHydrogen * kLongestToHydrogen;
      for (std::uint32_t n = begins_[r]; n < begins_[r + 1]; ++n) {
        if (atoms_[n].element <= 1 || squared_distance(h, n) > least) continue;
        nearest = n;
        least = squared_distance(h, n);
      }
      if (nearest != h) bonds_.push_back({nearest, h});
    }
  }

  void join(const Names& first, const char* first_name, const Names& second, const char* second_name) {
    constexpr double kLongestLink = 2.2;
    const auto a = first.find(first_name), b = second.find(second_name);
    if (a == first.end() || b == second.end()) return;
    if (squared_distance(a->second, b->second) <= kLongestLink * kLongestLink) bonds_.push_back({a->second, b->second});
  }

  std::span<const Atom> atoms_;
  std::span<const glm::dvec3> positions_;
  const std::optional<PeriodicCell>& cell_;
  std::vector<std::uint32_t> begins_;  ///< first atom of each residue; the last entry is the number of atoms
  Names last_names_;
  std::vector<Bond> bonds_;
};

constexpr double kShortestFound = 0.5;  // Å; the shortest bond of all, between two hydrogens, is 0.74 Å long
constexpr double kSlack = 0.4, kSlackBetweenStandardResidues = 0.2;

class MoleculeBonds {
 public:
  MoleculeBonds(std::span<const Atom> atoms, std::span<const std::int32_t> fully_bonded)
      : atoms_(atoms), fully_bonded_(fully_bonded.begin(), fully_bonded.end()), standard_(atoms.size()) {
    positions_.reserve(atoms.size());
    // First alternate location of each atom of a residue.
    std::map<std::pair<std::uint32_t, std::string_view>, char> letters;
    for (const Atom& atom : atoms) {
      positions_.push_back(atom.position);
      if (atom.altloc == ' ') continue;
      const auto [first, is_new] = letters.try_emplace({atom.residue, atom.name}, atom.altloc);
      if (!is_new && first->second != atom.altloc) several_locations_.insert(atom.residue);
    }
  }

  void add_templates() {
    // Formats without residues put all atoms into one residue without a name.
    if (std::ranges::all_of(atoms_, [](const Atom& atom) { return atom.residue_name.empty(); })) return;
    for (const Bond& bond : template_bonds(atoms_, positions_, std::nullopt))
      if (may_have_more(atoms_[bond[0]]) && add(bond[0], bond[1])) standard_[bond[0]] = standard_[bond[1]] = true;
  }

  void add_listed(std::span<const Bond> listed) {
    if (listed.empty()) return;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> places;  // keys: copy and place in the file
    std::vector<std::uint32_t> copies;
    for (std::uint32_t n = 0; n < atoms_.size(); ++n) {
      places.try_emplace({atoms_[n].copy, atoms_[n].index}, n);
      copies.push_back(atoms_[n].copy);
    }
    std::ranges::sort(copies);
    copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
    for (const std::uint32_t copy : copies) {
      for (const Bond& bond : listed) {
        const auto from = places.find({copy, bond[0]}), to = places.find({copy, bond[1]});
        if (from != places.end() && to != places.end()) add(from->second, to->second);
      }
    }
  }

  void add_near() {
    double largest = 0.0;
    std::array<double, 128> radii{};
    for (const Atom& atom : atoms_) {
      const std::size_t element = std::min<std::size_t>(atom.element, radii.size() - 1);
      radii[element] = gemmi::Element(static_cast<int>(atom.element)).covalent_r();
      largest = std::max(largest, radii[element]);
    }
    const BallGrid grid(positions_, 2.0 * largest + kSlack);
    for (std::uint32_t a = 0; a < atoms_.size(); ++a) {
      if (!binds_by_distance(atoms_[a])) continue;
      const double own = radii[atoms_[a].element];
      grid.for_each_near(positions_[a], own + largest + kSlack, [&](std::uint32_t b) {
        if (b >= a || !binds_by_distance(atoms_[b]) || (atoms_[a].element == 1 && atoms_[b].element == 1)) return;
        const bool both_standard = standard_[a] && standard_[b];
        if (both_standard && atoms_[a].residue == atoms_[b].residue) return;
        const double limit = own + radii[atoms_[b].element] + (both_standard ? kSlackBetweenStandardResidues : kSlack);
        const double distance = glm::distance(positions_[a], positions_[b]);
        if (kShortestFound <= distance && distance <= limit) add(b, a);
      });
    }
  }

  void add_beads() {
    const std::vector<Bond> between_beads = martini_bonds(atoms_);
    bonds_.insert(bonds_.end(), between_beads.begin(), between_beads.end());
  }

  std::vector<Bond> take() && {
    std::ranges::sort(bonds_);
    bonds_.erase(std::unique(bonds_.begin(), bonds_.end()), bonds_.end());
    return std::move(bonds_);
  }

 private:
  bool may_have_more(const Atom& atom) const { return !fully_bonded_.contains(atom.model); }

  bool binds_by_distance(const Atom& atom) const {
    return atom.element != 0 && atom.element < 119 && atom.kind != AtomClass::ion && may_have_more(atom);
  }

  bool of_one_molecule(const Atom& a, const Atom& b) const {
    if (a.model != b.model || a.copy != b.copy) return false;
    if (a.altloc == b.altloc || a.altloc == ' ' || b.altloc == ' ') return true;
    return !several_locations_.contains(a.residue) && !several_locations_.contains(b.residue);
  }

  bool add(std::uint32_t a, std::uint32_t b) {
    if (a == b || !of_one_molecule(atoms_[a], atoms_[b])) return false;
    if (glm::distance(positions_[a], positions_[b]) > kLongestBond) return false;
    bonds_.push_back({std::min(a, b), std::max(a, b)});
    return true;
  }

  std::span<const Atom> atoms_;
  std::set<std::int32_t> fully_bonded_;
  std::vector<glm::dvec3> positions_;
  std::vector<bool> standard_;                 ///< true for atoms with a bond from a template
  std::set<std::uint32_t> several_locations_;  ///< residues with an atom in several alternate locations
  std::vector<Bond> bonds_;
};

}  // namespace

std::vector<Bond> template_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                 const std::optional<PeriodicCell>& cell) {
  return BondFinder(atoms, positions, cell).by_template();
}

std::vector<Bond> guessed_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                const std::optional<PeriodicCell>& cell) {
  return BondFinder(atoms, positions, cell).by_distance();
}

std::vector<Bond> molecule_bonds(std::span<const Atom> atoms, std::span<const Bond> listed,
                                 std::span<const std::int32_t> fully_bonded) {
  if (atoms.empty()) return {};
  MoleculeBonds bonds(atoms, fully_bonded);
  bonds.add_templates();
  bonds.add_listed(listed);
  bonds.add_near();
  if (martini_version(atoms).number != 0) bonds.add_beads();
  return std::move(bonds).take();
}

std::vector<Bond> bonds_in_any_order(std::span<const Atom> atoms, std::span<const Bond> listed,
                                     std::span<const std::int32_t> fully_bonded) {
  std::vector<std::uint32_t> places(atoms.size());
  std::iota(places.begin(), places.end(), 0u);
  std::ranges::stable_sort(places, {}, [&](std::uint32_t n) { return std::pair(atoms[n].copy, atoms[n].index); });
  std::vector<Atom> sorted;
  for (const std::uint32_t n : places) sorted.push_back(atoms[n]);
  std::vector<Bond> bonds = molecule_bonds(sorted, listed, fully_bonded);
  for (auto& [a, b] : bonds) {
    a = places[a];
    b = places[b];
  }
  return bonds;
}

}  // namespace meniscus
