// SPDX-License-Identifier: BSD-3-Clause
// Counts bonds that are too long, residue by residue.
#include "core/trajectory/atom_order.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <gemmi/elem.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/bonds.h"

namespace meniscus {
namespace {

constexpr double kShortest = 0.5;  // Å; shorter means that atoms have no positions yet, for example all at the origin
constexpr double kShortestJump = 8.0;  // Å; a jump across any box is at least as long
constexpr std::size_t kFewest = 3;

bool makes_covalent_bonds(const Atom& atom) {
  return atom.element != 0 && !gemmi::is_metal(gemmi::Element(int{atom.element}).elem);
}

double longest(const Atom& a, const Atom& b) {
  constexpr double kStretch = 1.3;  // vibrations reach 1.15, second neighbours begin at 1.5
  const auto radius = [](const Atom& atom) { return double{gemmi::Element(int{atom.element}).covalent_r()}; };
  return kStretch * (radius(a) + radius(b));
}

std::vector<bool> residues_of(std::span<const Atom> atoms) {
  std::vector<bool> residues;
  for (const Atom& atom : atoms) {
    if (atom.residue >= residues.size()) residues.resize(atom.residue + std::size_t{1});
    residues[atom.residue] = true;
  }
  return residues;
}

/// Returns the bonds of the standard residues among these residues.
std::vector<Bond> standard_bonds(std::span<const Atom> atoms, const std::vector<bool>& residues) {
  std::vector<Atom> part;
  std::vector<std::uint32_t> place;
  std::vector<glm::dvec3> positions;
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    if (atoms[n].residue >= residues.size() || !residues[atoms[n].residue]) continue;
    part.push_back(atoms[n]);
    place.push_back(n);
    positions.push_back(atoms[n].position);
  }
  std::vector<Bond> bonds = template_bonds(part, positions, std::nullopt);
  for (auto& [a, b] : bonds) {
    a = place[a];
    b = place[b];
  }
  return bonds;
}

/// Returns the bonds whose lengths can be compared with the frame.
std::vector<Bond> comparable_bonds(const Topology& topology, std::span<const Atom> used, bool has_positions) {
  const std::vector<Atom>& atoms = topology.atoms;
  const std::vector<bool> residues = residues_of(used);
  const auto wanted = [&](const Atom& atom) { return atom.residue < residues.size() && residues[atom.residue]; };
  std::vector<Bond> bonds = topology.bonds;
  if (has_positions) {
    const std::vector<Bond> standard = standard_bonds(atoms, residues);
    bonds.insert(bonds.end(), standard.begin(), standard.end());
  }
  std::erase_if(bonds, [&](const Bond& bond) {
    const Atom &a = atoms[bond[0]], &b = atoms[bond[1]];
    if (!wanted(a) || !wanted(b)) return true;
    if (!makes_covalent_bonds(a) || !makes_covalent_bonds(b) || (a.element == 1 && b.element == 1)) return true;
    if (!has_positions) return false;
    const double distance = glm::distance(a.position, b.position);
    return distance < kShortest || distance > longest(a, b);
  });
  return bonds;
}

class FrameDistances {
 public:
  explicit FrameDistances(const Frame& frame) : positions_(frame.positions) {
    if (frame.cell) cell_ = PeriodicCell::of(*frame.cell);
    if (cell_ || positions_.empty()) return;
    glm::dvec3 low = positions_.front(), high = low;
    for (const glm::dvec3& x : positions_) {
      low = glm::min(low, x);
      high = glm::max(high, x);
    }
    shortest_jump_ = glm::max(0.5 * (high - low), glm::dvec3(kShortestJump));
  }

  /// Returns the distance (Å) of two atoms, or nothing if they may be on opposite sides of a box that the frame does
  /// not have.
  std::optional<double> between(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 d = positions_[a] - positions_[b];
    if (cell_) return glm::length(cell_->shortest(d));
    if (glm::any(glm::greaterThan(glm::abs(d), shortest_jump_))) return std::nullopt;
    return glm::length(d);
  }

 private:
  const std::vector<glm::dvec3>& positions_;
  std::optional<PeriodicCell> cell_;
  glm::dvec3 shortest_jump_{0.0};  ///< Å, along each axis; a longer distance may be a jump across a box
};

struct Count {
  std::size_t bonds = 0, too_long = 0;
  void add(bool is_too_long) {
    ++bonds;
    too_long += is_too_long ? 1 : 0;
  }
  bool exceeds(std::size_t part) const { return too_long >= kFewest && too_long * part >= bonds; }
};

}  // namespace

void check_atom_order(const Topology& topology, std::span<const Atom> used, const Frame& frame,
                      const ComparedFrame& compared) {
  const FrameDistances distances(frame);
  Count all;
  std::unordered_map<std::uint32_t, Count> residues;
  std::string first;
  for (const auto& [a, b] : comparable_bonds(topology, used, compared.file_has_positions)) {
    const Atom &one = topology.atoms[a], &other = topology.atoms[b];
    const std::optional<double> distance = distances.between(a, b);
    if (!distance) continue;
    const bool too_long = *distance > longest(one, other);
    all.add(too_long);
    residues[one.residue].add(too_long);
    if (other.residue != one.residue) residues[other.residue].add(too_long);
    if (too_long && first.empty())
      first = fmt::format("{} to {} is {:.2f} Å", label_of(one), label_of(other), *distance);
  }
  const auto scattered = std::ranges::count_if(residues, [](const auto& entry) { return entry.second.exceeds(3); });
  if (scattered == 0 && !all.exceeds(10)) return;
  throw InputError(
      compared.trajectory, 0,
      message("frame {}: {} of {} bonds of {} are too long (first: {}); its atoms are in another order, or are "
              "different atoms; write both files from the same atoms, or add @trust-atom-order@ if molecules may come "
              "apart like this",
              compared.number, with_thousands(all.too_long), with_thousands(all.bonds), compared.file, first));
}

}  // namespace meniscus
