// SPDX-License-Identifier: BSD-3-Clause
// Joins the shares of chosen atoms that meet.
#include "core/queries/atom_patches.h"

#include <algorithm>
#include <map>

#include "core/math/union_find.h"
#include "core/surface/atom_areas.h"
#include "core/surface/compute_surface.h"

namespace meniscus {

std::vector<AtomPatch> atom_patches(const Surface& surface, const std::vector<bool>& chosen) {
  require_borders(surface);
  const AtomShares all = atom_shares(surface);
  UnionFind joined(all.shares.size());
  for (const auto& [a, b] : all.meetings)
    if (chosen[all.shares[a].atom] && chosen[all.shares[b].atom]) joined.unite(a, b);
  std::map<std::uint32_t, std::map<std::uint32_t, double>> areas;  // Å², by patch and by atom
  for (std::uint32_t n = 0; n < all.shares.size(); ++n) {
    const AtomShare& share = all.shares[n];
    if (chosen[share.atom] && share.area > 0.0) areas[joined.find(n)][share.atom] += share.area;
  }
  std::vector<AtomPatch> patches;
  for (const auto& [first, by_atom] : areas) {
    AtomPatch& patch = patches.emplace_back();
    for (const auto& [atom, area] : by_atom) {
      patch.area += area;
      patch.atoms.push_back(atom);
      patch.areas.push_back(area);
    }
  }
  std::ranges::stable_sort(patches, [](const AtomPatch& a, const AtomPatch& b) {
    return a.area != b.area ? a.area > b.area : a.atoms.front() < b.atoms.front();
  });
  return patches;
}

std::vector<bool> atoms_of_patches(const Surface& surface, std::vector<bool> chosen, double least) {
  if (least <= 0.0) return chosen;
  const std::vector<AtomPatch> patches = atom_patches(surface, chosen);
  UnionFind joined(chosen.size());
  for (const AtomPatch& patch : patches)
    for (const std::uint32_t atom : patch.atoms) joined.unite(patch.atoms.front(), atom);
  std::vector<bool> is_large(chosen.size(), false);
  for (const AtomPatch& patch : patches)
    if (patch.area >= least) is_large[joined.find(patch.atoms.front())] = true;
  for (std::uint32_t atom = 0; atom < chosen.size(); ++atom) chosen[atom] = chosen[atom] && is_large[joined.find(atom)];
  return chosen;
}

}  // namespace meniscus
