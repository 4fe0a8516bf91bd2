// SPDX-License-Identifier: BSD-3-Clause
// Walks molecules bond by bond.
#include "core/trajectory/whole_molecules.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/periodic_cell.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kUnseen = 0xffffffffu;

/// Neighbours of each atom, one list behind the other.
struct Neighbors {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> atom;

  Neighbors(std::size_t count, std::span<const Bond> bonds) : begin(count + 1), atom(2 * bonds.size()) {
    for (const Bond& bond : bonds)
      for (const std::uint32_t end : bond) ++begin[end + 1];
    for (std::size_t n = 0; n < count; ++n) begin[n + 1] += begin[n];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (const auto& [a, b] : bonds) {
      atom[next[a]++] = b;
      atom[next[b]++] = a;
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t a) const {
    return std::span(atom).subspan(begin[a], begin[a + 1] - begin[a]);
  }
};

/// A residue in several pieces: nobody could say where they belong.
void refuse_pieces(std::span<const Atom> atoms, std::span<const std::uint32_t> molecule,
                   const std::vector<bool>& is_taken, const std::string& file) {
  for (std::size_t n = 1; n < atoms.size(); ++n) {
    const bool same_residue = atoms[n].residue == atoms[n - 1].residue;
    if (!same_residue || molecule[n] == molecule[n - 1]) continue;
    if (!is_taken[molecule[n]] && !is_taken[molecule[n - 1]]) continue;
    throw InputError(file, 0,
                     fmt::format("no bond is known between {} and the rest of its residue, so nobody can tell how to "
                                 "make it whole; give a topology that lists bonds (PSF, PDB with CONECT), choose "
                                 "--whole guess (bonds by distance), or leave it out by --select",
                                 label_of(atoms[n])));
  }
}

glm::dvec3 center_of(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> atoms) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t a : atoms) sum += positions[a];
  return sum / static_cast<double>(atoms.size());
}

}  // namespace

WholeMolecules::WholeMolecules(std::span<const Atom> atoms, std::span<const Bond> bonds,
                               std::span<const std::uint32_t> wanted, const std::string& file) {
  const Neighbors neighbors(atoms.size(), bonds);
  std::vector<std::uint32_t> molecule(atoms.size(), kUnseen);
  std::vector<std::vector<Step>> molecules;
  for (std::uint32_t first = 0; first < atoms.size(); ++first) {
    if (molecule[first] != kUnseen) continue;
    const auto number = static_cast<std::uint32_t>(molecules.size());
    std::vector<Step>& steps = molecules.emplace_back();
    molecule[first] = number;
    steps.push_back({first, first});
    for (std::size_t n = 0; n < steps.size(); ++n) {  // breadth first
      const std::uint32_t from = steps[n].atom;
      for (const std::uint32_t next : neighbors.of(from)) {
        if (molecule[next] != kUnseen) continue;
        molecule[next] = number;
        steps.push_back({next, from});
      }
    }
  }
  std::vector<bool> is_taken(molecules.size());
  for (const std::uint32_t a : wanted) is_taken[molecule[a]] = true;
  refuse_pieces(atoms, molecule, is_taken, file);
  std::vector<std::uint32_t> taken;
  for (std::uint32_t number = 0; number < molecules.size(); ++number)
    if (is_taken[number]) taken.push_back(number);
  std::ranges::stable_sort(taken,
                           [&](std::uint32_t a, std::uint32_t b) { return molecules[a].size() > molecules[b].size(); });
  begins_.push_back(0);
  for (const std::uint32_t number : taken) {
    steps_.insert(steps_.end(), molecules[number].begin(), molecules[number].end());
    begins_.push_back(steps_.size());
  }
  for (const Bond& bond : bonds)
    if (is_taken[molecule[bond[0]]]) bonds_.push_back(bond);
}

void WholeMolecules::apply(const glm::dmat3& vectors, std::vector<glm::dvec3>& positions,
                           const std::string& where) const {
  const std::optional<PeriodicCell> cell = PeriodicCell::of(vectors);
  if (!cell) throw InputError(where, 0, "has a periodic box without volume; leave --whole away");
  for (const auto& [atom, from] : steps_)
    if (atom != from) positions[atom] = positions[from] + cell->shortest(positions[atom] - positions[from]);
  // A bond that no step went along closes a ring; through the box it would join the molecule with its own image.
  for (const auto& [a, b] : bonds_) {
    const glm::dvec3 bond = positions[b] - positions[a];
    // Equal but for rounding, or a vector of the lattice apart, which is longer than any bond.
    if (glm::length(bond - cell->shortest(bond)) > 1e-3) {
      throw InputError(where, 0,
                       fmt::format("atoms {} and {} are bonded across the periodic box to an image of their own "
                                   "molecule, which has no whole; leave --whole away",
                                   a + 1, b + 1));
    }
  }
  std::vector<std::uint32_t> atoms;
  glm::dvec3 anchor(0.0);
  for (std::size_t m = 0; m + 1 < begins_.size(); ++m) {
    atoms.clear();
    for (std::size_t n = begins_[m]; n < begins_[m + 1]; ++n) atoms.push_back(steps_[n].atom);
    const glm::dvec3 center = center_of(positions, atoms);
    if (m == 0) anchor = center;
    const glm::dvec3 shift = cell->shortest(center - anchor) - (center - anchor);
    for (const std::uint32_t a : atoms) positions[a] += shift;
  }
}

}  // namespace meniscus
