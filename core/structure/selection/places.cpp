// SPDX-License-Identifier: BSD-3-Clause
// Joins residues to places, one shell of neighbours after another.
#include "core/structure/selection/places.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include <glm/vec3.hpp>

#include "core/structure/point_tree.h"

namespace meniscus {

std::vector<bool> first_place(std::span<const Atom> atoms, const std::vector<bool>& selected) {
  using Residue = std::pair<std::uint32_t, std::uint32_t>;
  const auto residue_of = [&](std::size_t n) { return Residue{atoms[n].copy, atoms[n].residue}; };
  const auto in_file = [&](std::size_t n) { return std::pair(atoms[n].copy, atoms[n].index); };
  std::optional<std::size_t> first;
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (selected[n] && (!first || in_file(n) < in_file(*first))) first = n;
  std::vector<bool> place(atoms.size());
  std::set<Residue> reached;
  if (first) reached.insert(residue_of(*first));
  while (!reached.empty()) {
    std::vector<glm::dvec3> points;
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (!selected[n] || place[n] || !reached.contains(residue_of(n))) continue;
      place[n] = true;
      points.push_back(atoms[n].position);
    }
    const PointTree tree(std::move(points));
    reached.clear();
    for (std::size_t n = 0; n < atoms.size(); ++n)
      if (selected[n] && !place[n] && tree.any_within(atoms[n].position, kWidestGap)) reached.insert(residue_of(n));
  }
  return place;
}

}  // namespace meniscus
