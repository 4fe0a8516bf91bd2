// SPDX-License-Identifier: BSD-3-Clause
// Finds the donors and acceptors near the selected atoms by their covalent bonds, and tests pairs of them.
#include "core/structure/hydrogen_bonds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <glm/geometric.hpp>

#include "core/math/ball.h"
#include "core/structure/bonds.h"

namespace meniscus {
namespace {

constexpr std::uint8_t kHydrogen = 1, kCarbon = 6, kNitrogen = 7, kOxygen = 8, kSulfur = 16;
// Lengths in Å. Hydrogens are up to 1.35 Å away from sulphur.
constexpr double kLongestOfHeavy = 3.5, kLongestOfHydrogen = 2.5, kReach = 3.9, kNitrogenHydrogen = 1.01;
// Double bonds are shorter than these lengths, bonds of planar nitrogen than the third, and triple bonds than the last.
constexpr double kCarbonyl = 1.30, kSulfonyl = 1.60, kConjugated = 1.42, kNitrile = 1.20;
constexpr double kLargestPyramid = 345.0;  // degrees, the sum of the angles at N; 360 if it is planar

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double both = glm::length(a) * glm::length(b);
  return both > 0.0 ? std::acos(std::clamp(glm::dot(a, b) / both, -1.0, 1.0)) * 180.0 / std::numbers::pi : 0.0;
}

/// Atoms in the order of the file, with their covalent bonds.
class BondedAtoms {
 public:
  explicit BondedAtoms(std::span<const Atom> all) : places_(all.size()) {
    std::iota(places_.begin(), places_.end(), 0u);
    std::ranges::stable_sort(places_, {}, [&](std::uint32_t n) { return std::pair(all[n].copy, all[n].index); });
    for (const std::uint32_t n : places_) atoms_.push_back(all[n]);
    neighbours_.resize(atoms_.size());
    for (const auto& [a, b] : molecule_bonds(atoms_, {})) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
      for (const auto& [hydrogen, heavy] : {std::pair(a, b), std::pair(b, a)})
        if (is(hydrogen, kHydrogen)) with_hydrogens_.insert({atoms_[heavy].copy, atoms_[heavy].residue});
    }
  }

  std::uint32_t place(std::uint32_t n) const { return places_[n]; }
  const glm::dvec3& position(std::uint32_t n) const { return atoms_[n].position; }

  bool accepts(std::uint32_t n) const {
    if (is(n, kOxygen)) return true;
    if (!is(n, kNitrogen)) return false;
    const std::size_t count = neighbours_[n].size();
    if (count == 3) return is_pyramidal(n);
    if (has_known_hydrogens(n)) return count < 3;
    return count == 1 ? bond(n, 0) < kNitrile : count == 2 && !is_amide(n);
  }

  bool donates(std::uint32_t n) const {
    const bool is_nitrogen = is(n, kNitrogen), is_oxygen = is(n, kOxygen);
    if (!is_nitrogen && !is_oxygen && !is(n, kSulfur)) return false;
    if (has_known_hydrogens(n)) return std::ranges::any_of(neighbours_[n], [&](auto m) { return is(m, kHydrogen); });
    const std::size_t count = neighbours_[n].size();
    if (is_oxygen)
      return count == 0 || (count == 1 && is_carbon_or_nitrogen(neighbours_[n][0]) && bond(n, 0) > kCarbonyl);
    if (!is_nitrogen) return false;
    return count == 3   ? is_pyramidal(n)
           : count == 2 ? !is_base_acceptor(n)
                        : count < 2 && (count == 0 || bond(n, 0) >= kNitrile);
  }

  /// True if the distance and the angles are those of a hydrogen bond.
  bool is_bond(std::uint32_t donor, std::uint32_t acceptor) const {
    const Atom &d = atoms_[donor], &a = atoms_[acceptor];
    if (d.model != a.model || (d.residue == a.residue && d.copy == a.copy)) return false;
    if (d.altloc != ' ' && a.altloc != ' ' && d.altloc != a.altloc) return false;
    if (is_joined(donor, acceptor, 3)) return false;
    const auto bonds_by = [&](const glm::dvec3& hydrogen) {
      return glm::distance(hydrogen, a.position) <= kLongestOfHydrogen &&
             degrees_between(d.position - hydrogen, a.position - hydrogen) > 120.0;
    };
    if (has_known_hydrogens(donor))
      return std::ranges::any_of(neighbours_[donor],
                                 [&](std::uint32_t h) { return is(h, kHydrogen) && bonds_by(position(h)); });
    if (const std::optional<glm::dvec3> hydrogen = planar_hydrogen(donor)) return bonds_by(*hydrogen);
    return glm::distance(d.position, a.position) <= kLongestOfHeavy && is_outside(donor, a.position) &&
           is_outside(acceptor, d.position);
  }

 private:
  bool is(std::uint32_t n, std::uint8_t element) const { return atoms_[n].element == element; }
  bool is_carbon_or_nitrogen(std::uint32_t n) const { return is(n, kCarbon) || is(n, kNitrogen); }
  /// Returns the length of a bond of an atom, Å.
  double bond(std::uint32_t n, std::size_t which) const {
    return glm::distance(position(n), position(neighbours_[n][which]));
  }
  bool has_known_hydrogens(std::uint32_t n) const {
    return with_hydrogens_.contains({atoms_[n].copy, atoms_[n].residue});
  }

  bool is_pyramidal(std::uint32_t n) const {
    const auto to = [&](int k) { return position(neighbours_[n][static_cast<std::size_t>(k)]) - position(n); };
    return degrees_between(to(0), to(1)) + degrees_between(to(1), to(2)) + degrees_between(to(2), to(0)) <
           kLargestPyramid;
  }

  /// True for N next to C=O, S=O or P=O, as in peptides and lactams. In a base of a nucleic acid all other ring
  /// nitrogens have no hydrogen.
  bool is_amide(std::uint32_t n) const {
    if (is_ring_nitrogen(n) && atoms_[n].residue_name.find('C') != std::string::npos) return false;  // N3 of cytosine
    return std::ranges::any_of(neighbours_[n], [&](std::uint32_t middle) {
      const double longest = is(middle, kCarbon) ? kCarbonyl : kSulfonyl;
      return std::ranges::any_of(neighbours_[middle], [&](std::uint32_t m) {
        return is(m, kOxygen) && neighbours_[m].size() == 1 && glm::distance(position(middle), position(m)) < longest;
      });
    });
  }
  bool is_ring_nitrogen(std::uint32_t n) const {
    const std::string& name = atoms_[n].name;
    return atoms_[n].kind == AtomClass::polymer && (name == "N1" || name == "N3" || name == "N7");
  }
  bool is_base_acceptor(std::uint32_t n) const { return is_ring_nitrogen(n) && !is_amide(n); }

  std::optional<glm::dvec3> planar_hydrogen(std::uint32_t n) const {
    if (!is(n, kNitrogen) || neighbours_[n].size() != 2 || std::min(bond(n, 0), bond(n, 1)) > kConjugated) return {};
    const auto from = [&](std::size_t k) { return glm::normalize(position(n) - position(neighbours_[n][k])); };
    return position(n) + kNitrogenHydrogen * glm::normalize(from(0) + from(1));
  }

  /// True if a point is more than 90 degrees away from each neighbour of an atom.
  bool is_outside(std::uint32_t n, const glm::dvec3& point) const {
    return std::ranges::all_of(neighbours_[n], [&](std::uint32_t m) {
      return glm::dot(position(m) - position(n), point - position(n)) < 0.0;
    });
  }

  bool is_joined(std::uint32_t from, std::uint32_t to, int bonds) const {
    return from == to || (bonds > 0 && std::ranges::any_of(neighbours_[from], [&](std::uint32_t next) {
                            return is_joined(next, to, bonds - 1);
                          }));
  }

  std::vector<std::uint32_t> places_;
  std::vector<Atom> atoms_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> with_hydrogens_;  ///< copy and residue
};

}  // namespace

std::vector<Bond> hydrogen_bonds(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other) {
  const BondedAtoms bonded(atoms);
  std::vector<std::uint32_t> acceptors;
  std::vector<glm::dvec3> centers;
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    if (!bonded.accepts(n)) continue;
    acceptors.push_back(n);
    centers.push_back(bonded.position(n));
  }
  std::set<Bond> found;  // by ascending place
  std::vector<Bond> bonds;
  if (acceptors.empty()) return bonds;
  const BallGrid grid(centers, kReach);
  for (std::uint32_t d = 0; d < atoms.size(); ++d) {
    const std::uint32_t from = bonded.place(d);
    if (!(one[from] || other[from]) || !bonded.donates(d)) continue;
    grid.for_each_near(bonded.position(d), kReach, [&](std::uint32_t which) {
      const std::uint32_t a = acceptors[which], to = bonded.place(a);
      if (!(one[from] && other[to]) && !(one[to] && other[from])) return;
      if (bonded.is_bond(d, a) && found.insert({std::min(from, to), std::max(from, to)}).second)
        bonds.push_back({from, to});
    });
  }
  std::ranges::sort(bonds);
  return bonds;
}

}  // namespace meniscus
