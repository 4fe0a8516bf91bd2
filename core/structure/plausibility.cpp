// SPDX-License-Identifier: BSD-3-Clause
// Looks for coincident atoms and for coordinates in other units, and sums up warnings of one kind.
#include "core/structure/plausibility.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/text.h"
#include "core/math/ball.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

double nearest_distance(const std::vector<Atom>& atoms, const Atom& of) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Atom& other : atoms) {
    if (&other == &of || other.model != of.model || other.altloc != of.altloc) continue;
    nearest = std::min(nearest, glm::distance(other.position, of.position));
  }
  return nearest;
}

}  // namespace

void warn_of_coincident_atoms(Structure& structure) {
  std::unordered_map<std::string, const Atom*> places;
  std::vector<std::string> cases;
  for (const Atom& atom : structure.atoms) {
    const glm::dvec3 place_of_atom = atom.position + 0.0;  // -0 becomes 0
    std::string key(sizeof(place_of_atom), '\0');
    std::memcpy(key.data(), &place_of_atom, sizeof(place_of_atom));
    if (!structure.added.empty()) key += fmt::format("{}", atom.model);  // superposed files may have atoms in common
    const auto [place, free] = places.try_emplace(std::move(key), &atom);
    if (!free) cases.push_back(fmt::format("{} at {}", label_of(atom), label_of(*place->second)));
  }
  if (cases.empty()) return;
  std::string sentence =
      fmt::format("{} {} at exactly the position of another; the surface treats them as one (first: {})",
                  with_thousands(cases.size()), cases.size() == 1 ? "atom lies" : "atoms lie", cases.front());
  structure.report.warnings.emplace_back(std::move(sentence), std::move(cases));
}

void warn_of_wrong_unit(Structure& structure) {
  constexpr std::size_t kFewest = 8, kSample = 64;
  constexpr double kShortestUsual = 0.5;
  const std::vector<Atom>& atoms = structure.atoms;
  if (atoms.size() < kFewest) return;
  std::vector<double> distances;
  const std::size_t step = (atoms.size() + kSample - 1) / kSample;
  for (std::size_t n = 0; n < atoms.size(); n += step) distances.push_back(nearest_distance(atoms, atoms[n]));
  const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  if (*median >= kShortestUsual) return;
  structure.report.warnings.emplace_back(fmt::format(
      "atoms lie {:.2f} Å from their nearest neighbour (median); are the coordinates in nanometres?", *median));
}

void WarningCollector::add(std::size_t line, std::string_view text) {
  cases_.push_back(fmt::format("line {}, {}", line, in_quotes(text)));
}

void WarningCollector::warn(std::vector<Warning>& warnings, const char* what) {
  if (cases_.empty()) return;
  std::string sentence = fmt::format("{} {} {} (first: {})", with_thousands(cases_.size()),
                                     cases_.size() == 1 ? "atom has" : "atoms have", what, cases_.front());
  warnings.emplace_back(std::move(sentence), std::move(cases_));
  cases_.clear();
}

}  // namespace meniscus
