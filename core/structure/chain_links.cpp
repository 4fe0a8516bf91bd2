// SPDX-License-Identifier: BSD-3-Clause
// The ends that residues turn to each other, looked up in a grid.
#include "core/structure/chain_links.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "core/structure/residue_names.h"

namespace meniscus {
namespace {

constexpr double kShortest = 1.0, kLongest = 2.2;

/// An atom by which a residue hangs together with the next or the one before: C and N, O3' and P.
enum class End : std::uint8_t { none, carbonyl, amine, hydroxyl, phosphorus };

bool complementary(End a, End b) {
  return (a == End::carbonyl && b == End::amine) || (a == End::hydroxyl && b == End::phosphorus);
}

class LinkFinder {
 public:
  explicit LinkFinder(std::span<const Atom> atoms) : atoms_(atoms) {
    for (const Atom& atom : atoms) residues_ = std::max<std::size_t>(residues_, atom.residue + std::size_t{1});
    linked_.resize(residues_);
    find_ends();
  }

  void join_by(std::span<const Bond> bonds) {
    for (const auto& [a, b] : bonds) {
      if (complementary(ends_[a], ends_[b]) || complementary(ends_[b], ends_[a])) join(a, b);
    }
  }

  void join_by_distance() {
    for (std::uint32_t n = 0; n < atoms_.size(); ++n) {
      if ((ends_[n] == End::amine || ends_[n] == End::phosphorus) && has_position(n)) cells_[cell_of(n)].push_back(n);
    }
    for (std::uint32_t n = 0; n < atoms_.size(); ++n) {
      if ((ends_[n] == End::carbonyl || ends_[n] == End::hydroxyl) && has_position(n)) join_near(n);
    }
  }

  std::vector<bool> linked() && { return std::move(linked_); }

 private:
  void find_ends() {
    std::vector<bool> amino_acid(residues_), nucleotide(residues_);
    for (const Atom& atom : atoms_) {
      if (atom.name == "CA" || is_chain_cap_name(atom.residue_name)) amino_acid[atom.residue] = true;
      if (atom.name == "C4'" || atom.name == "C4*") nucleotide[atom.residue] = true;
    }
    ends_.resize(atoms_.size(), End::none);
    for (std::size_t n = 0; n < atoms_.size(); ++n) {
      const std::string& name = atoms_[n].name;
      if (amino_acid[atoms_[n].residue] && name == "C") ends_[n] = End::carbonyl;
      if (amino_acid[atoms_[n].residue] && name == "N") ends_[n] = End::amine;
      if (nucleotide[atoms_[n].residue] && name == "P") ends_[n] = End::phosphorus;
      if (nucleotide[atoms_[n].residue] && (name == "O3'" || name == "O3*")) ends_[n] = End::hydroxyl;
    }
  }

  bool has_position(std::uint32_t n) const { return atoms_[n].position != glm::dvec3(0.0); }

  static std::uint64_t key(const glm::dvec3& corner) {
    std::uint64_t result = 0;
    for (int axis = 0; axis < 3; ++axis) result = (result << 21) + static_cast<std::uint64_t>(corner[axis] + (1 << 20));
    return result;
  }

  glm::dvec3 corner_of(std::uint32_t n) const { return glm::floor(atoms_[n].position / kLongest); }
  std::uint64_t cell_of(std::uint32_t n) const { return key(corner_of(n)); }

  void join_near(std::uint32_t n) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key(corner_of(n) + glm::dvec3(x, y, z)));
          if (found == cells_.end()) continue;
          for (const std::uint32_t other : found->second)
            if (bonded(n, other)) join(n, other);
        }
      }
    }
  }

  bool bonded(std::uint32_t a, std::uint32_t b) const {
    const Atom &first = atoms_[a], &second = atoms_[b];
    if (!complementary(ends_[a], ends_[b]) || first.model != second.model) return false;
    if (first.altloc != second.altloc && first.altloc != ' ' && second.altloc != ' ') return false;
    const double distance = glm::distance(first.position, second.position);
    return kShortest <= distance && distance <= kLongest;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    if (atoms_[a].residue == atoms_[b].residue) return;
    linked_[atoms_[a].residue] = linked_[atoms_[b].residue] = true;
  }

  std::span<const Atom> atoms_;
  std::size_t residues_ = 0;
  std::vector<End> ends_;  ///< of the atoms
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  std::vector<bool> linked_;
};

}  // namespace

std::vector<bool> linked_residues(std::span<const Atom> atoms, std::span<const Bond> bonds) {
  LinkFinder finder(atoms);
  finder.join_by(bonds);
  finder.join_by_distance();
  return std::move(finder).linked();
}

}  // namespace meniscus
