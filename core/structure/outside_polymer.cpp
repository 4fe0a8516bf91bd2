// SPDX-License-Identifier: BSD-3-Clause
// Separates ligands, lipids and ions from polymers and from the sugars that are bound to polymers.
#include "core/structure/outside_polymer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <glm/vec3.hpp>

#include "core/math/ball.h"
#include "core/structure/bonds.h"
#include "core/structure/residue_names.h"
#include "core/structure/sugars.h"

namespace meniscus {
namespace {

using Part = OutsidePolymer::Part;

constexpr std::size_t kFewMolecules = 20;      // more molecules of one name are solvent, salt or a membrane
constexpr std::size_t kLargeLigand = 40;       // heavy atoms; chlorophyll has 65, and a photosystem has 96 of it
constexpr std::size_t kWatersPerResidue = 10;  // crystals have up to about one

/// The atoms [first, last) of one residue.
struct Residue {
  std::size_t first, last;
};

std::vector<Residue> residues_of(std::span<const Atom> atoms) {
  std::vector<Residue> residues;
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    const bool is_new =
        n == 0 || atoms[n].residue != atoms[n - 1].residue || atoms[n].residue_name != atoms[n - 1].residue_name;
    if (is_new) residues.push_back({n, n});
    residues.back().last = n + 1;
  }
  return residues;
}

/// Returns, per residue, true if it is a sugar that is bound to a polymer.
std::vector<bool> bound_sugars(std::span<const Atom> atoms, std::span<const Residue> residues,
                               std::span<const Bond> listed) {
  constexpr std::uint32_t kPolymer = 0xffffffffu;  // the place of all residues of polymers together
  std::vector<bool> bound(residues.size());
  std::vector<Atom> near;              // the atoms of sugars, then the atoms of polymers that may be bound to them
  std::vector<std::uint32_t> residue;  // of each atom in `near`
  std::vector<glm::dvec3> positions;
  for (std::uint32_t r = 0; r < residues.size(); ++r) {
    const std::span<const Atom> own = atoms.subspan(residues[r].first, residues[r].last - residues[r].first);
    if (own.front().kind != AtomClass::ligand || !sugar_of(own)) continue;
    for (const Atom& atom : own) {
      near.push_back(atom);
      residue.push_back(r);
      positions.push_back(atom.position);
    }
  }
  if (near.empty()) return bound;
  const BallGrid grid(positions, kLongestBond);
  for (const Atom& atom : atoms) {
    if (atom.kind != AtomClass::polymer) continue;
    if (!grid.any_near(atom.position, kLongestBond, [](std::uint32_t) { return true; })) continue;
    near.push_back(atom);
    residue.push_back(kPolymer);
  }
  const std::vector<Bond> bonds = molecule_bonds(near, listed);
  const auto is_bound = [&](std::uint32_t atom) { return residue[atom] == kPolymer || bound[residue[atom]]; };
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b] : bonds) {
      if (is_bound(a) == is_bound(b)) continue;
      bound[residue[is_bound(a) ? b : a]] = true;
      grows = true;
    }
  }
  return bound;
}

}  // namespace

OutsidePolymer outside_polymer(std::span<const Atom> atoms, std::span<const Bond> bonds) {
  OutsidePolymer outside;
  const std::vector<Residue> residues = residues_of(atoms);
  const auto head = [&](const Residue& residue) -> const Atom& { return atoms[residue.first]; };
  const auto count = [&](AtomClass kind) {
    return static_cast<std::size_t>(
        std::ranges::count_if(residues, [&](const Residue& residue) { return head(residue).kind == kind; }));
  };
  const std::size_t polymer = count(AtomClass::polymer);
  if (polymer == 0) return outside;
  outside.part.assign(atoms.size(), Part::inside);
  outside.drawn.assign(atoms.size(), false);
  const bool in_water = count(AtomClass::water) > kWatersPerResidue * polymer;
  const std::vector<bool> bound = bound_sugars(atoms, residues, bonds);
  std::map<std::pair<std::int32_t, std::string>, std::vector<Residue>> by_name;
  for (std::size_t r = 0; r < residues.size(); ++r) {
    const Atom& first = head(residues[r]);
    const bool is_ligand = first.kind == AtomClass::ligand && !bound[r];
    if (!is_ligand && (first.kind != AtomClass::ion || in_water)) continue;
    const bool is_of_membrane =
        is_ligand && is_lipid(atoms.subspan(residues[r].first, residues[r].last - residues[r].first));
    by_name[{first.model, is_of_membrane ? "" : first.residue_name}].push_back(residues[r]);
    if (!is_ligand) continue;
    for (std::size_t n = residues[r].first; n < residues[r].last; ++n)
      outside.part[n] = is_of_membrane ? Part::lipid : Part::ligand;
  }
  for (const auto& [name, molecules] : by_name) {
    const bool is_of_membrane = outside.part[molecules.front().first] == Part::lipid;
    for (const Residue& molecule : molecules) {
      const std::span<const Atom> own = atoms.subspan(molecule.first, molecule.last - molecule.first);
      const auto heavy = std::ranges::count_if(own, [](const Atom& atom) { return atom.element != 1; });
      if (molecules.size() > kFewMolecules && (is_of_membrane || static_cast<std::size_t>(heavy) < kLargeLigand))
        continue;
      for (std::size_t n = molecule.first; n < molecule.last; ++n) outside.drawn[n] = true;
    }
  }
  return outside;
}

bool has_only_ions(std::span<const Atom> atoms) {
  return std::ranges::all_of(
      atoms, [](const Atom& atom) { return atom.kind == AtomClass::ion || atom.kind == AtomClass::water; });
}

}  // namespace meniscus
