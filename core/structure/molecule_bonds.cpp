// SPDX-License-Identifier: BSD-3-Clause
// Joins three sources of bonds, and leaves out those that cannot be.
#include "core/structure/molecule_bonds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include <gemmi/elem.hpp>
#include <glm/geometric.hpp>

#include "core/math/ball_grid.h"
#include "core/structure/found_bonds.h"

namespace meniscus {
namespace {

constexpr double kShortestFound = 0.5;  // that of hydrogen to hydrogen, the shortest there is, is 0.74 Å long
constexpr double kSlack = 0.4, kSlackBetweenStandardResidues = 0.2;

class MoleculeBonds {
 public:
  explicit MoleculeBonds(std::span<const Atom> atoms) : atoms_(atoms), standard_(atoms.size()) {
    positions_.reserve(atoms.size());
    for (const Atom& atom : atoms) {
      positions_.push_back(atom.position);
      if (atom.residue >= letter_.size()) letter_.resize(atom.residue + 1, ' ');
      char& letter = letter_[atom.residue];
      if (atom.altloc == ' ' || atom.altloc == letter) continue;
      letter = letter == ' ' ? atom.altloc : kSeveral;
    }
  }

  void add_templates() {
    // Formats without residues have one of all atoms.
    if (std::ranges::all_of(atoms_, [](const Atom& atom) { return atom.residue_name.empty(); })) return;
    for (const Bond& bond : template_bonds(atoms_, positions_, std::nullopt))
      if (add(bond[0], bond[1])) standard_[bond[0]] = standard_[bond[1]] = true;
  }

  void add_listed(std::span<const Bond> listed) {
    if (listed.empty()) return;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> places;  // by copy and place in the file
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
        const double reach = own + radii[atoms_[b].element] + (both_standard ? kSlackBetweenStandardResidues : kSlack);
        const double distance = glm::distance(positions_[a], positions_[b]);
        if (kShortestFound <= distance && distance <= reach) add(b, a);
      });
    }
  }

  std::vector<Bond> take() && {
    std::ranges::sort(bonds_);
    bonds_.erase(std::unique(bonds_.begin(), bonds_.end()), bonds_.end());
    return std::move(bonds_);
  }

 private:
  static constexpr char kSeveral = '\0';

  static bool binds_by_distance(const Atom& atom) {
    return atom.element != 0 && atom.element < 119 && atom.kind != AtomClass::ion;
  }

  bool of_one_molecule(const Atom& a, const Atom& b) const {
    if (a.model != b.model || a.copy != b.copy) return false;
    if (a.altloc == b.altloc || a.altloc == ' ' || b.altloc == ' ') return true;
    return a.residue != b.residue && letter_[a.residue] != kSeveral && letter_[b.residue] != kSeveral;
  }

  bool add(std::uint32_t a, std::uint32_t b) {
    if (a == b || !of_one_molecule(atoms_[a], atoms_[b])) return false;
    if (glm::distance(positions_[a], positions_[b]) > kLongestBond) return false;
    bonds_.push_back({std::min(a, b), std::max(a, b)});
    return true;
  }

  std::span<const Atom> atoms_;
  std::vector<glm::dvec3> positions_;
  std::vector<bool> standard_;  ///< in a bond of a template
  std::vector<char> letter_;    ///< of each residue's alternate location; blank: it has none
  std::vector<Bond> bonds_;
};

}  // namespace

std::vector<Bond> molecule_bonds(std::span<const Atom> atoms, std::span<const Bond> listed) {
  if (atoms.empty()) return {};
  MoleculeBonds bonds(atoms);
  bonds.add_templates();
  bonds.add_listed(listed);
  bonds.add_near();
  return std::move(bonds).take();
}

}  // namespace meniscus
