// SPDX-License-Identifier: BSD-3-Clause
// Finds donors and acceptors by their covalent bonds, and tests pairs of them.

#include <numbers>
#include <set>

#include "core/math/ball.h"
#include "core/structure/bonds.h"

namespace meniscus {
namespace {

constexpr std::uint8_t kProton = 1, kNitrogen = 7, kOxygen = 8, kSulfur = 16;
constexpr double kReach = 3.9;  // Å; S-H is 1.35 Å long
// Lengths in Å. C=O is shorter than the first, S=O than the second, planar N's bonds than the third, C≡N than the last.
constexpr double kCarbonyl = 1.30, kSulfonyl = 1.60, kConjugated = 1.42, kNitrile = 1.20;

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

class BondedAtoms {
 public:
  explicit BondedAtoms(std::span<const Atom> atoms) : atoms_(atoms), neighbours_(atoms.size()) {
    for (const auto& [a, b] : bonds_in_any_order(atoms)) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
    for (const Atom& atom : atoms)
      if (atom.element == kProton) with_hydrogens_.insert({atom.copy, atom.residue});
  }

  bool accepts(std::uint32_t n) const {
    if (!is(n, kNitrogen)) return is(n, kOxygen);
    const std::size_t count = neighbours_[n].size();
    if (count == 3) return is_pyramidal(n);
    if (has_hydrogens(n)) return count < 3;
    return count == 2 ? !is_amide(n) : count == 1 && bond(n) < kNitrile;
  }

  bool donates(std::uint32_t n) const {
    const std::size_t count = neighbours_[n].size();
    if (has_hydrogens(n))
      return (is(n, kNitrogen) || is(n, kOxygen) || is(n, kSulfur)) &&
             std::ranges::any_of(neighbours_[n], [&](std::uint32_t m) { return is(m, kProton); });
    if (is(n, kOxygen))
      return count == 0 || (count == 1 && atoms_[neighbours_[n][0]].element <= kNitrogen && bond(n) > kCarbonyl);
    if (!is(n, kNitrogen) || count > 3) return false;
    if (count == 3) return is_pyramidal(n);
    return count == 2 ? !is_in_base(n) || is_amide(n) : count == 0 || bond(n) >= kNitrile;
  }

  /// True if the distance and the angles of a donor and an acceptor meet the criterion of hydrogen_bonds().
  bool is_bond(std::uint32_t donor, std::uint32_t acceptor) const {
    const Atom &d = atoms_[donor], &a = atoms_[acceptor];
    if ((d.residue == a.residue && d.copy == a.copy) || is_joined(donor, acceptor, 3)) return false;
    if (d.altloc != ' ' && a.altloc != ' ' && d.altloc != a.altloc) return false;
    const auto bonds_by = [&](const glm::dvec3& hydrogen) {
      return glm::distance(hydrogen, a.position) <= 2.5 &&
             degrees_between(d.position - hydrogen, a.position - hydrogen) > 120.0;
    };
    if (has_hydrogens(donor))
      return std::ranges::any_of(neighbours_[donor],
                                 [&](std::uint32_t h) { return is(h, kProton) && bonds_by(atoms_[h].position); });
    if (is(donor, kNitrogen) && neighbours_[donor].size() == 2 && std::min(bond(donor), bond(donor, 1)) < kConjugated)
      return bonds_by(d.position - 1.01 * glm::normalize(glm::normalize(to(donor, 0)) + glm::normalize(to(donor, 1))));
    return glm::distance(d.position, a.position) <= 3.5 && is_outside(donor, a) && is_outside(acceptor, d);
  }

 private:
  bool is(std::uint32_t n, std::uint8_t element) const { return atoms_[n].element == element; }
  bool has_hydrogens(std::uint32_t n) const { return with_hydrogens_.contains({atoms_[n].copy, atoms_[n].residue}); }
  /// Returns the vector from an atom to one of its neighbours, Å.
  glm::dvec3 to(std::uint32_t n, std::size_t which) const {
    return atoms_[neighbours_[n][which]].position - atoms_[n].position;
  }
  double bond(std::uint32_t n, std::size_t which = 0) const { return glm::length(to(n, which)); }

  /// True if the three bonds of an atom are not in a plane. In a plane their angles are 360 degrees together.
  bool is_pyramidal(std::uint32_t n) const {
    const auto angle = [&](std::size_t a, std::size_t b) { return degrees_between(to(n, a), to(n, b)); };
    return angle(0, 1) + angle(1, 2) + angle(2, 0) < 345.0;
  }

  /// True for N1, N3 and N7 of bases, which have a hydrogen only if they are in an amide.
  bool is_in_base(std::uint32_t n) const {
    const std::string& name = atoms_[n].name;
    return atoms_[n].kind == AtomClass::polymer && (name == "N1" || name == "N3" || name == "N7");
  }

  /// True for N next to C=O or S=O, except for N3 of cytosine, whose electrons are elsewhere.
  bool is_amide(std::uint32_t n) const {
    if (is_in_base(n) && atoms_[n].residue_name.find('C') != std::string::npos) return false;
    return std::ranges::any_of(neighbours_[n], [&](std::uint32_t middle) {
      return std::ranges::any_of(neighbours_[middle], [&](std::uint32_t end) {
        return is(end, kOxygen) && neighbours_[end].size() == 1 &&
               bond(end) < (is(middle, kSulfur) ? kSulfonyl : kCarbonyl);
      });
    });
  }

  /// True if another atom is more than 90 degrees away from each neighbour of an atom.
  bool is_outside(std::uint32_t n, const Atom& other) const {
    return std::ranges::all_of(neighbours_[n], [&](std::uint32_t m) {
      return glm::dot(atoms_[m].position - atoms_[n].position, other.position - atoms_[n].position) < 0.0;
    });
  }

  bool is_joined(std::uint32_t from, std::uint32_t end, int bonds) const {
    const auto is_next = [&](std::uint32_t next) { return is_joined(next, end, bonds - 1); };
    return from == end || (bonds > 0 && std::ranges::any_of(neighbours_[from], is_next));
  }

  std::span<const Atom> atoms_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> with_hydrogens_;  ///< copy and residue
};

}  // namespace

std::vector<Bond> hydrogen_bonds(const Structure& structure, const std::vector<bool>& one,
                                 const std::vector<bool>& other) {
  const std::vector<Atom>& atoms = structure.atoms;
  const BondedAtoms bonded(atoms);
  std::vector<glm::dvec3> centers;
  for (const Atom& atom : atoms) centers.push_back(atom.position);
  std::set<Bond> found;  // in ascending order of atoms
  std::vector<Bond> bonds;
  if (atoms.empty()) return bonds;
  const BallGrid grid(centers, kReach);
  for (std::uint32_t d = 0; d < atoms.size(); ++d) {
    if (!(one[d] || other[d]) || !bonded.donates(d)) continue;
    grid.for_each_near(centers[d], kReach, [&](std::uint32_t a) {
      if (!(one[d] && other[a]) && !(one[a] && other[d])) return;
      if (structure.added.empty() && atoms[d].model != atoms[a].model) return;
      if (bonded.accepts(a) && bonded.is_bond(d, a) && found.insert({std::min(d, a), std::max(d, a)}).second)
        bonds.push_back({d, a});
    });
  }
  std::ranges::sort(bonds);
  return bonds;
}

std::optional<Bond> closest_pair(std::span<const Atom> atoms, const std::vector<bool>& one,
                                 const std::vector<bool>& other) {
  std::vector<std::pair<double, std::uint32_t>> right;  // in ascending order of x
  for (std::uint32_t n = 0; n < atoms.size(); ++n)
    if (other[n]) right.emplace_back(atoms[n].position.x, n);
  std::ranges::sort(right);
  std::pair best{HUGE_VAL, Bond{}};  // squared distance and pair
  for (std::uint32_t a = 0; a < atoms.size(); ++a) {
    if (!one[a]) continue;
    const glm::dvec3& place = atoms[a].position;
    const auto low = std::ranges::lower_bound(right, std::pair(place.x - std::sqrt(best.first), 0u));
    for (auto b = low; b != right.end() && b->first - place.x <= std::sqrt(best.first); ++b) {
      const glm::dvec3 way = atoms[b->second].position - place;
      if (b->second != a) best = std::min(best, std::pair{glm::dot(way, way), Bond{a, b->second}});
    }
  }
  return std::isinf(best.first) ? std::nullopt : std::optional(best.second);
}

}  // namespace meniscus
