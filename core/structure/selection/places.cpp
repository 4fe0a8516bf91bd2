// SPDX-License-Identifier: BSD-3-Clause
// Joins residues to places, one shell of neighbours after another.
#include "core/structure/selection/places.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/text.h"
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

std::string several_places(const Selection& zoom_to, std::span<const Atom> atoms) {
  constexpr std::string_view kFirst = "first ";
  std::string text = zoom_to.text();
  const bool shows_first = text.starts_with(kFirst);
  if (shows_first) text = text.substr(kFirst.size());
  if (text.starts_with('(') && text.find(')') + 1 == text.size()) text = text.substr(1, text.size() - 2);
  std::vector<bool> rest = parse_selection(text).evaluate(atoms);
  std::string name;
  std::vector<glm::dvec3> middles;
  for (int turn = 0; turn < 2; ++turn) {
    const std::vector<bool> place = first_place(atoms, rest);
    const auto head = std::ranges::find(place, true);
    if (head == place.end()) return {};
    const Atom& atom = atoms[static_cast<std::size_t>(head - place.begin())];
    name = fmt::format("resid {}", atom.residue_number);
    if (!atom.chain.empty()) name += " and chain " + atom.chain;
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (rest[n] && !shows_first && atoms[n].kind != AtomClass::ligand) return {};
      if (place[n]) sum += atoms[n].position;
      rest[n] = rest[n] && !place[n];
    }
    middles.push_back(sum / static_cast<double>(std::ranges::count(place, true)));
  }
  return fmt::format("{} is at several places, the first two {:.0f} Å apart, and {}; name one, such as {}",
                     in_quotes(text), glm::distance(middles[0], middles[1]),
                     shows_first ? "the first is shown" : "the picture has all of them", in_quotes(name));
}

}  // namespace meniscus
