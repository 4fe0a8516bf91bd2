// SPDX-License-Identifier: BSD-3-Clause
// Colours atoms one by one, and numbers their chains.
#include "core/color/color_atoms.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/color/color_scale.h"
#include "core/color/color_maps.h"
#include "core/color/coloring.h"
#include "core/color/lipophilicity.h"
#include "core/color/named_colors.h"
#include "core/color/ordered_classes.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;

std::vector<glm::vec3> by_chain(const Structure& structure) {
  const std::map<std::string, std::size_t> places = places_of_chains(structure);
  std::vector<glm::vec3> colors;
  for (const Atom& atom : structure.atoms) colors.push_back(categorical_color(places.at(chain_of_file(atom))));
  return colors;
}

std::vector<glm::vec3> colors_of(const Structure& structure, const ColorScheme& scheme) {
  if (scheme.by == By::chain) return by_chain(structure);
  std::vector<glm::vec3> colors;
  colors.reserve(structure.atoms.size());
  if (has_ordered_classes(scheme.by)) {
    const ClassedAtoms classed = ordered_classes(structure, scheme.by);
    for (std::size_t a = 0; a < structure.atoms.size(); ++a) colors.push_back(classed.color(a));
    return colors;
  }
  if (scheme.has_scale()) {
    const ColorScale scale = color_scale(structure, scheme);
    for (const double number : scale.value) colors.push_back(scale.color(number));
    return colors;
  }
  for (const Atom& atom : structure.atoms) {
    if (scheme.by == By::fixed)
      colors.push_back(scheme.fixed);
    else if (scheme.by == By::copy)
      colors.push_back(categorical_color(atom.copy));
    else if (scheme.by == By::model)
      colors.push_back(categorical_color(static_cast<std::size_t>(atom.model) - 1));
    else if (scheme.by == By::element)
      colors.push_back(element_color(atom.element));
    else if (scheme.by == By::element_cpk)
      colors.push_back(cpk_color(atom.element));
    else
      colors.push_back(color_from_hex(residue_group(atom.residue_name).color));
  }
  return colors;
}

/// Applies the rules to the atoms of an object.
void paint(const Structure& structure, std::span<const std::uint32_t> atom, const std::vector<ColorRule>& rules,
           Coloring& coloring) {
  for (const ColorRule& rule : rules) {
    const std::vector<bool> meant = rule.atoms.evaluate(structure.atoms);
    if (std::ranges::none_of(meant, std::identity())) continue;
    const std::vector<glm::vec3> colors = colors_of(structure, rule.paint);
    for (std::size_t n = 0; n < atom.size(); ++n)
      if (meant[atom[n]]) coloring.atom[n] = colors[atom[n]];
    if (!coloring.volume) continue;
    coloring.own_color.resize(atom.size(), false);
    for (std::size_t n = 0; n < atom.size(); ++n)
      if (meant[atom[n]]) coloring.own_color[n] = true;
  }
}

/// Returns one opacity per atom; empty without rules.
std::vector<float> opacities_of(const Structure& structure, const std::vector<OpacityRule>& rules) {
  std::vector<float> opacities;
  for (const OpacityRule& rule : rules) {
    opacities.resize(structure.atoms.size(), 1.0f);
    if (!rule.atoms) std::ranges::fill(opacities, rule.opacity);
    if (!rule.atoms) continue;
    const std::vector<bool> meant = rule.atoms->evaluate(structure.atoms);
    for (std::size_t a = 0; a < opacities.size(); ++a)
      if (meant[a]) opacities[a] = rule.opacity;
  }
  return opacities;
}

}  // namespace

Coloring color_atoms(const Structure& structure, const ColorScheme& scheme) {
  std::vector<std::uint32_t> all(structure.atoms.size());
  std::iota(all.begin(), all.end(), 0u);
  return color_object(structure, all, scheme, 0);
}

Coloring color_object(const Structure& structure, std::span<const std::uint32_t> atom, const ColorScheme& scheme,
                      std::size_t object_number) {
  Coloring coloring;
  std::map<std::tuple<std::int32_t, std::uint32_t, std::string_view>, std::uint32_t> chains;
  for (const std::uint32_t a : atom) {
    const Atom& place = structure.atoms[a];
    const auto next = static_cast<std::uint32_t>(chains.size());
    coloring.part.push_back(chains.try_emplace({place.model, place.copy, place.chain}, next).first->second);
  }
  if (scheme.by == By::kind) {
    coloring.atom.assign(atom.size(), default_missing_color(ColorMap::categorical));
    coloring.kind = kPatchKindColors;
  } else if (scheme.by == By::component) {
    coloring.atom.assign(atom.size(), categorical_color(object_number));
  } else if (scheme.of_points()) {
    coloring.atom.assign(atom.size(), scheme.volume->scale.missing_color);
    coloring.volume = scheme.volume;
    if (scheme.by == By::lipophilicity)
      for (const std::uint32_t a : atom)
        coloring.own_color.push_back(
            std::isnan(lipophilicity(structure.atoms[a].residue_name, structure.atoms[a].name)));
  } else if (scheme.by == By::fixed) {
    coloring.atom.assign(atom.size(), scheme.fixed);
  } else {
    const std::vector<glm::vec3> colors = colors_of(structure, scheme);
    for (const std::uint32_t a : atom) coloring.atom.push_back(colors[a]);
  }
  paint(structure, atom, scheme.rules, coloring);
  const std::vector<float> opacities = opacities_of(structure, scheme.opacities);
  if (!opacities.empty())
    for (const std::uint32_t a : atom) coloring.opacity.push_back(opacities[a]);
  return coloring;
}

}  // namespace meniscus
