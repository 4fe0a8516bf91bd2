// SPDX-License-Identifier: BSD-3-Clause
// Finds hydrogen bonds by energy, turns and bridges by these bonds, and helices and ladders by turns and bridges.
#include "core/structure/secondary_structure.h"

#include "core/math/ball.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kNoResidue = std::numeric_limits<std::uint32_t>::max();

/// The energy of a hydrogen bond by Kabsch and Sander: charges of 0.42 e and 0.20 e on C, O and N, H; 332 kcal/mol
/// Å/e². A bond is below -0.5 kcal/mol.
constexpr double kCoupling = 0.42 * 0.20 * 332.0;
constexpr double kBondEnergy = -0.5, kLeastEnergy = -9.9;
constexpr double kShortestContact = 0.5;       // Å; a shorter one has the least energy
constexpr double kFarthestAlphaCarbons = 9.0;  // Å, between two residues with a hydrogen bond
constexpr double kLongestPeptideBond = 2.5;    // Å
constexpr std::uint32_t kWidestGap = 6;        // residues between two ladders that a bulge separates

/// A residue with a complete backbone.
struct BackboneResidue {
  std::uint32_t first_atom, last_atom;
  glm::dvec3 n, ca, c, o;
  std::optional<glm::dvec3> h;  ///< none in proline and in the first residue of a chain
  bool follows = false;         ///< true if it is bonded to the previous residue
};

enum class Bridge : std::uint8_t { none, parallel, antiparallel };

/// Consecutive bridges of one kind. `to` is in the order of its chain.
struct Ladder {
  Bridge kind;
  std::vector<std::uint32_t> from, to;
};

class HydrogenBondPatterns {
 public:
  explicit HydrogenBondPatterns(std::span<const Atom> atoms) : atoms_(atoms) {
    collect_residues();
    kinds_.assign(residues_.size(), SecondaryStructure::coil);
    if (residues_.empty()) return;
    find_hydrogen_bonds();
    mark_strands();
    mark_helices();
  }

  std::vector<SecondaryStructure> per_atom() const {
    std::vector<SecondaryStructure> result(atoms_.size(), SecondaryStructure::coil);
    for (std::size_t r = 0; r < residues_.size(); ++r)
      std::fill(result.begin() + residues_[r].first_atom, result.begin() + residues_[r].last_atom, kinds_[r]);
    return result;
  }

 private:
  void collect_residues() {
    std::uint32_t last = 0;
    const auto count = static_cast<std::uint32_t>(atoms_.size());
    for (std::uint32_t first = 0; first < count; first = last) {
      const Atom& head = atoms_[first];
      while (last < count && atoms_[last].residue == head.residue && atoms_[last].copy == head.copy) ++last;
      add_residue(first, last);
    }
  }

  void add_residue(std::uint32_t first, std::uint32_t last) {
    std::array<const Atom*, 4> found{};
    constexpr std::array<const char*, 4> kNames{"N", "CA", "C", "O"};
    for (std::uint32_t n = first; n < last; ++n) {
      for (std::size_t k = 0; k < kNames.size(); ++k) {
        const bool named = atoms_[n].name == kNames[k] ||
                           (k == 3 && (atoms_[n].name == "O1" || atoms_[n].name == "OT1" || atoms_[n].name == "OC1"));
        if (named && !found[k] && atoms_[n].kind != AtomClass::ion) found[k] = &atoms_[n];
      }
    }
    if (std::any_of(found.begin(), found.end(), [](const Atom* atom) { return atom == nullptr; })) return;
    BackboneResidue residue{first, last, found[0]->position, found[1]->position, found[2]->position, found[3]->position,
                            {},    false};
    if (!residues_.empty()) {
      const BackboneResidue& before = residues_.back();
      const Atom &here = atoms_[first], &there = atoms_[before.first_atom];
      residue.follows = here.model == there.model && here.copy == there.copy && here.chain == there.chain &&
                        glm::distance(before.c, residue.n) <= kLongestPeptideBond;
      const glm::dvec3 along = before.c - before.o;
      if (residue.follows && atoms_[first].residue_name != "PRO" && glm::length(along) > 0.0)
        residue.h = residue.n + glm::normalize(along);
    }
    residues_.push_back(residue);
  }

  static double energy(const BackboneResidue& donor, const BackboneResidue& acceptor) {
    const double ho = glm::distance(*donor.h, acceptor.o), hc = glm::distance(*donor.h, acceptor.c);
    const double nc = glm::distance(donor.n, acceptor.c), no = glm::distance(donor.n, acceptor.o);
    if (std::min({ho, hc, nc, no}) < kShortestContact) return kLeastEnergy;
    return std::max(kLeastEnergy, kCoupling * (1.0 / no + 1.0 / hc - 1.0 / ho - 1.0 / nc));
  }

  /// Finds the two best acceptors of each donor, and numbers the chains.
  void find_hydrogen_bonds() {
    std::vector<glm::dvec3> alpha_carbons;
    for (const BackboneResidue& residue : residues_) alpha_carbons.push_back(residue.ca);
    acceptors_.assign(residues_.size(), {kNoResidue, kNoResidue});
    const BallGrid grid(alpha_carbons, kFarthestAlphaCarbons);
    for (std::uint32_t d = 0; d < residues_.size(); ++d) {
      if (!residues_[d].h) continue;
      std::array<double, 2> best{0.0, 0.0};
      std::array<std::uint32_t, 2>& acceptors = acceptors_[d];
      grid.for_each_near(residues_[d].ca, kFarthestAlphaCarbons, [&](std::uint32_t a) {
        if (a == d || a + 1 == d) return;  // the previous residue contains the donor's own peptide group
        const double found = energy(residues_[d], residues_[a]);
        if (found < best[0]) {
          best = {found, best[0]};
          acceptors = {a, acceptors[0]};
        } else if (found < best[1]) {
          best[1] = found;
          acceptors[1] = a;
        }
      });
      for (std::size_t k = 0; k < 2; ++k)
        if (best[k] >= kBondEnergy) acceptors[k] = kNoResidue;
    }
    chain_.resize(residues_.size());
    for (std::uint32_t r = 0; r < residues_.size(); ++r)
      chain_[r] = r == 0 ? 0 : chain_[r - 1] + (residues_[r].follows ? 0u : 1u);
  }

  bool bonded(std::uint32_t donor, std::uint32_t acceptor) const {
    return acceptors_[donor][0] == acceptor || acceptors_[donor][1] == acceptor;
  }

  bool unbroken(std::uint32_t a, std::uint32_t b) const { return chain_[a] == chain_[b]; }

  Bridge bridge(std::uint32_t i, std::uint32_t j) const {
    if (!unbroken(i - 1, i + 1) || !unbroken(j - 1, j + 1)) return Bridge::none;
    if ((bonded(i + 1, j) && bonded(j, i - 1)) || (bonded(j + 1, i) && bonded(i, j - 1))) return Bridge::parallel;
    if ((bonded(i + 1, j - 1) && bonded(j + 1, i - 1)) || (bonded(j, i) && bonded(i, j))) return Bridge::antiparallel;
    return Bridge::none;
  }

  /// Returns all residues after i that may form a bridge with it. Every bridge needs a hydrogen bond from i or i + 1 to
  /// its partner or to the residue before that.
  std::vector<std::uint32_t> partners_of(std::uint32_t i) const {
    std::vector<std::uint32_t> partners;
    for (const std::uint32_t donor : {i, i + 1}) {
      for (const std::uint32_t acceptor : acceptors_[donor]) {
        if (acceptor == kNoResidue) continue;
        for (const std::uint32_t j : {acceptor, acceptor + 1})
          if (j >= i + 3 && j + 1 < residues_.size()) partners.push_back(j);
      }
    }
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    return partners;
  }

  static bool extend(Ladder& ladder, Bridge kind, std::uint32_t i, std::uint32_t j) {
    if (ladder.kind != kind || ladder.from.back() + 1 != i) return false;
    if (kind == Bridge::parallel && ladder.to.back() + 1 == j) {
      ladder.to.push_back(j);
    } else if (kind == Bridge::antiparallel && j + 1 == ladder.to.front()) {
      ladder.to.insert(ladder.to.begin(), j);
    } else {
      return false;
    }
    ladder.from.push_back(i);
    return true;
  }

  std::vector<Ladder> ladders() const {
    std::vector<Ladder> found;
    std::vector<std::size_t> open;  // ladders that contain residue i - 1
    const auto count = static_cast<std::uint32_t>(residues_.size());
    for (std::uint32_t i = 1; i + 4 < count; ++i) {
      std::erase_if(open, [&](std::size_t n) { return found[n].from.back() + 1 < i; });
      for (const std::uint32_t j : partners_of(i)) {
        const Bridge kind = bridge(i, j);
        if (kind == Bridge::none) continue;
        if (std::any_of(open.begin(), open.end(), [&](std::size_t n) { return extend(found[n], kind, i, j); }))
          continue;
        open.push_back(found.size());
        found.push_back({kind, {i}, {j}});
      }
    }
    return found;
  }

  /// True if the second ladder may continue the first one after a bulge.
  bool bulge(const Ladder& first, const Ladder& second) const {
    const auto [i, i_end] = std::pair(first.from.front(), first.from.back());
    const auto [j, j_end] = std::pair(first.to.front(), first.to.back());
    const auto [k, k_end] = std::pair(second.from.front(), second.from.back());
    const auto [l, l_end] = std::pair(second.to.front(), second.to.back());
    if (first.kind != second.kind || !unbroken(std::min(i, k), std::max(i_end, k_end)) ||
        !unbroken(std::min(j, l), std::max(j_end, l_end)) || k <= i_end || k - i_end >= kWidestGap)
      return false;
    const bool parallel = first.kind == Bridge::parallel;
    const std::int64_t gap = parallel ? std::int64_t{l} - j_end : std::int64_t{j} - l_end;
    return (gap >= 0 && gap < kWidestGap && k - i_end < 3) || (gap >= 0 && gap < 3);
  }

  void mark_strands() {
    std::vector<Ladder> found = ladders();
    std::sort(found.begin(), found.end(),
              [](const Ladder& a, const Ladder& b) { return a.from.front() < b.from.front(); });
    for (std::size_t a = 0; a < found.size(); ++a) {
      for (std::size_t b = a + 1; b < found.size() && found[b].from.front() < found[a].from.back() + kWidestGap; ++b) {
        if (!bulge(found[a], found[b])) continue;
        Ladder &first = found[a], &second = found[b];
        first.from.insert(first.from.end(), second.from.begin(), second.from.end());
        first.to.insert(first.kind == Bridge::parallel ? first.to.end() : first.to.begin(), second.to.begin(),
                        second.to.end());
        found.erase(found.begin() + static_cast<std::ptrdiff_t>(b--));
      }
    }
    for (const Ladder& ladder : found) {
      if (ladder.from.size() < 2) continue;
      mark(ladder.from.front(), ladder.from.back(), SecondaryStructure::strand);
      mark(ladder.to.front(), ladder.to.back(), SecondaryStructure::strand);
    }
  }

  void mark(std::uint32_t first, std::uint32_t last, SecondaryStructure kind) {
    std::fill(kinds_.begin() + first, kinds_.begin() + last + 1, kind);
  }

  /// Marks helices. A turn is a hydrogen bond from i + length to i, and two consecutive turns begin a helix. Helices of
  /// 4 replace strands. Helices of 3 and 5 are marked only where all their residues are coil.
  void mark_helices() {
    const auto count = static_cast<std::uint32_t>(residues_.size());
    const auto turn = [&](std::uint32_t i, std::uint32_t length) {
      return i + length < count && unbroken(i, i + length) && bonded(i + length, i);
    };
    for (const std::uint32_t length : {4u, 3u, 5u}) {
      std::vector<std::uint32_t> begins;
      for (std::uint32_t i = 1; i + length < count; ++i) {
        if (!turn(i, length) || !turn(i - 1, length)) continue;
        const bool taken = std::any_of(kinds_.begin() + i, kinds_.begin() + i + length,
                                       [&](SecondaryStructure kind) { return kind != SecondaryStructure::coil; });
        if (length == 4 || !taken) begins.push_back(i);
      }
      for (const std::uint32_t i : begins) mark(i, i + length - 1, SecondaryStructure::helix);
    }
  }

  std::span<const Atom> atoms_;
  std::vector<BackboneResidue> residues_;
  std::vector<std::array<std::uint32_t, 2>> acceptors_;
  std::vector<std::uint32_t> chain_;  ///< number of the unbroken piece that each residue belongs to
  std::vector<SecondaryStructure> kinds_;
};

}  // namespace

void mark_secondary_structure(std::vector<Atom>& atoms, std::span<const SecondaryRange> ranges) {
  if (ranges.empty()) return;
  std::map<std::string, std::vector<const SecondaryRange*>, std::less<>> of_chain;
  for (const SecondaryRange& range : ranges) of_chain[range.chain].push_back(&range);
  bool any = false;
  const Atom* last = nullptr;
  for (Atom& atom : atoms) {
    if (atom.kind != AtomClass::polymer) continue;
    if (last && last->residue == atom.residue) {
      atom.secondary = last->secondary;
      continue;
    }
    last = &atom;
    const auto found = of_chain.find(atom.chain);
    if (found == of_chain.end()) continue;
    const SecondaryRange::Residue residue{atom.residue_number, atom.insertion_code};
    for (const SecondaryRange* range : found->second)
      if (range->first <= residue && residue <= range->last) atom.secondary = range->kind;
    any = any || atom.secondary != SecondaryStructure::unknown;
  }
  if (!any) return;
  for (Atom& atom : atoms)
    if (atom.secondary == SecondaryStructure::unknown) atom.secondary = SecondaryStructure::coil;
}

std::vector<SecondaryStructure> secondary_structure(std::span<const Atom> atoms) {
  std::vector<SecondaryStructure> result;
  std::map<std::int32_t, std::vector<std::uint32_t>> unknown;  // atoms of models without secondary structure
  for (std::uint32_t n = 0; n < atoms.size(); ++n) unknown[atoms[n].model].push_back(n);
  for (const Atom& atom : atoms) {
    result.push_back(atom.secondary);
    if (atom.secondary != SecondaryStructure::unknown) unknown.erase(atom.model);
  }
  if (unknown.size() == 1 && unknown.begin()->second.size() == atoms.size())
    return HydrogenBondPatterns(atoms).per_atom();
  for (const auto& [model, places] : unknown) {
    std::vector<Atom> own;
    for (const std::uint32_t place : places) own.push_back(atoms[place]);
    const std::vector<SecondaryStructure> found = HydrogenBondPatterns(own).per_atom();
    for (std::size_t n = 0; n < places.size(); ++n) result[places[n]] = found[n];
  }
  return result;
}

void assign_secondary_structure(std::vector<Atom>& atoms) {
  const std::vector<SecondaryStructure> kinds = secondary_structure(atoms);
  for (std::size_t n = 0; n < atoms.size(); ++n) atoms[n].secondary = kinds[n];
}

}  // namespace meniscus
