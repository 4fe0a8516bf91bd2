// SPDX-License-Identifier: BSD-3-Clause
// Finds the numbers by which a structure is coloured, and colours its atoms one by one.
#include "core/color/color_schemes.h"

#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/coloring.h"
#include "core/color/lipophilicity.h"
#include "core/color/named_colors.h"
#include "core/color/ordered_classes.h"
#include "core/structure/element_tables.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;

std::vector<glm::vec3> by_chain(const Structure& structure, By by) {
  const std::map<std::string, std::size_t> places = places_of_chains(structure);
  std::vector<glm::vec3> colors;
  for (const Atom& atom : structure.atoms) {
    const std::size_t place = places.at(chain_of_file(atom));
    colors.push_back(by == By::chain_okabe_ito                           ? categorical_color(place)
                     : by == By::chain_element && !has_chain_color(atom) ? cpk_color(atom.element)
                                                                         : chain_color(place));
  }
  return colors;
}

std::vector<glm::vec3> colors_of(const Structure& structure, const ColorScheme& scheme) {
  if (scheme.by == By::automatic) return colors_of(structure, resolved_scheme(structure, scheme));
  const By by = scheme.by;
  if (by == By::chain || by == By::chain_element || by == By::chain_okabe_ito) return by_chain(structure, by);
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
    else if (by == By::element)
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
    const std::vector<bool> meant = rule.atoms.evaluate(structure);
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
    const std::vector<bool> meant = rule.atoms->evaluate(structure);
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

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 2> kPlaces{0.0, 1.0},
    kGrades{1.0, 9.0};  // ranges of positions in a chain, and of ConSurf's grades

[[noreturn]] void no_atom_named(const Structure& structure, const NumberFile& file, const char* what,
                                std::size_t count) {
  throw InputError(file.path, 0, "names {} {}, but none of them is among the atoms used of {}", with_thousands(count),
                   what, structure.file);
}

/// Returns the only chain of polymers, or of all atoms if there are none, for numbers of residues without chains.
std::string only_chain(const Structure& structure, const NumberFile& file) {
  std::set<std::string> chains;
  const bool polymers =
      std::ranges::any_of(structure.atoms, [](const Atom& a) { return a.kind == AtomClass::polymer; });
  for (const Atom& atom : structure.atoms)
    if (!polymers || atom.kind == AtomClass::polymer) chains.insert(chain_of_file(atom));
  if (chains.size() != 1)
    throw InputError(
        file.path, 0,
        "names residues without their chains, but the atoms used of {} belong to {} chains, such as {} and "
        "{}; add a column 'chain'",
        structure.file, chains.size(), in_quotes(*chains.begin()), in_quotes(*std::next(chains.begin())));
  return *chains.begin();
}

std::vector<double> numbers_by_name(const Structure& structure, const NumberFile& file) {
  std::vector<double> numbers(structure.atoms.size(), kMissing);
  bool found = false;
  const std::string chain = file.without_chains ? only_chain(structure, file) : std::string();
  const auto take = [&](const auto& table, const auto& key, double& number) {
    const auto entry = table.find(key);
    if (entry == table.end()) return;
    number = entry->second;
    found = true;
  };
  for (std::size_t a = 0; a < numbers.size(); ++a) {
    const Atom& atom = structure.atoms[a];
    if (!file.by_atom.empty())
      take(file.by_atom, atom.index, numbers[a]);
    else if (!file.without_chains)
      take(file.by_residue, ResidueName{chain_of_file(atom), atom.residue_number, atom.insertion_code}, numbers[a]);
    else if (chain_of_file(atom) == chain)
      take(file.by_residue, ResidueName{{}, atom.residue_number, atom.insertion_code}, numbers[a]);
  }
  if (!found && !file.by_atom.empty()) no_atom_named(structure, file, "atoms", file.by_atom.size());
  if (!found) no_atom_named(structure, file, "residues", file.by_residue.size());
  return numbers;
}

/// Returns the numbers of a file for the atoms in use: by name, or in the order of these atoms, or in the order of all
/// atoms of the molecule's file.
std::vector<double> numbers_of_file(const Structure& structure, const NumberFile& file) {
  if (file.numbers.empty() && !file.empty()) return numbers_by_name(structure, file);
  const auto other_models = structure.report.excluded.find(kExcludedModel);
  const std::size_t read =
      structure.report.read - (other_models == structure.report.excluded.end() ? 0 : other_models->second);
  const std::size_t used = structure.atoms.size(), given = file.numbers.size();
  if (given == used) return file.numbers;
  std::vector<double> numbers;
  for (const Atom& atom : structure.atoms) {
    if (given == read && atom.index < given) numbers.push_back(file.numbers[atom.index]);
  }
  if (numbers.size() != used)
    throw InputError(file.path, 0, "holds {} numbers; {} holds {} atoms, of which {} are used; {}",
                     with_thousands(given), structure.file, with_thousands(read), with_thousands(used), kNumberLayouts);
  return numbers;
}

std::vector<glm::dvec3> positions_of(const Structure& structure) {
  std::vector<glm::dvec3> positions;
  positions.reserve(structure.atoms.size());
  for (const Atom& atom : structure.atoms) positions.push_back(atom.position);
  return positions;
}

/// Returns grades of conservation, from 1 to 9.
std::vector<double> grades_of(const Structure& structure, const NumberFile& file) {
  std::vector<double> grades = numbers_of_file(structure, file);
  for (const double grade : grades)
    if (grade < kGrades[0] || grade > kGrades[1])
      throw InputError(file.path, 0,
                       message("holds {:g}; @color conservation@ takes ConSurf's grades, from 1 (variable) to 9 "
                               "(conserved); @color file@ takes any numbers",
                               grade));
  return grades;
}

/// Returns positions from 0, for the first residue of each chain of polymers, to 1, for its last. Atoms drawn in
/// addition to the surface have them, too, so that sticks and cartoons agree. NaN: not part of a polymer.
std::vector<double> places_in_chains(const Structure& structure) {
  using Chain = std::tuple<std::int32_t, std::uint32_t, std::string_view>;
  std::map<Chain, std::set<std::uint32_t>> residues;
  const auto chain_of = [](const Atom& atom) { return Chain(atom.model, atom.copy, atom.chain); };
  for (const std::vector<Atom>* atoms : {&structure.atoms, &structure.extra_atoms})
    for (const Atom& atom : *atoms)
      if (atom.kind == AtomClass::polymer) residues[chain_of(atom)].insert(atom.residue);
  std::map<std::pair<Chain, std::uint32_t>, double> places;
  for (const auto& [chain, of_chain] : residues) {
    const double last = of_chain.size() > 1 ? static_cast<double>(of_chain.size() - 1) : 1.0;
    double place = 0.0;
    for (const std::uint32_t residue : of_chain) places[{chain, residue}] = place++ / last;
  }
  std::vector<double> numbers;
  for (const Atom& atom : structure.atoms)
    numbers.push_back(atom.kind == AtomClass::polymer ? places[{chain_of(atom), atom.residue}] : kMissing);
  return numbers;
}

/// Returns the names of the first and the last residue of these chains.
std::array<std::string, 2> ends_of_chains(const Structure& structure) {
  const auto any = [&](auto is_of) { return std::ranges::any_of(structure.atoms, is_of); };
  const bool protein = any([](const Atom&atom) { return atom.kind == AtomClass::polymer && atom.name == "CA"; }),
             nucleic = any([](const Atom&atom) {
               return atom.kind == AtomClass::polymer && (atom.name == "C4'" || atom.name == "C4*");
             });
  if (protein && nucleic) return {"N or 5′", "C or 3′"};
  return nucleic ? std::array<std::string, 2>{"5′", "3′"} : std::array<std::string, 2>{"N", "C"};
}

/// Returns one number per atom, NaN if there is none.
std::vector<double> numbers_of(const Structure& structure, const ColorScheme& scheme) {
  if (scheme.by == By::file) return numbers_of_file(structure, scheme.file.of_frame(structure.frame));
  if (scheme.by == By::conservation) return grades_of(structure, scheme.file.of_frame(structure.frame));
  if (scheme.by == By::rainbow) return places_in_chains(structure);
  if (scheme.by == By::radial) return distances_from_middle(positions_of(structure));
  if (scheme.is_measured()) return numbers_of_file(structure, scheme.file);
  const auto number = [&](const Atom& atom) -> double {
    switch (scheme.by) {
      case By::bfactor:
        return atom.b_factor;
      case By::occupancy:
        return atom.occupancy;
      case By::charge:
        return atom.charge;
      case By::hydrophobicity:
        return hydropathy(atom.residue_name);
      default:
        return atom.index;
    }
  };
  std::vector<double> numbers;
  numbers.reserve(structure.atoms.size());
  for (const Atom& atom : structure.atoms) numbers.push_back(number(atom));
  return numbers;
}

/// The title, the unit and the usual map of a scale.
struct ScaleStyle {
  By by;
  std::string_view title, unit;
  ColorMap map = ColorMap::viridis;
};
constexpr ScaleStyle kScaleStyles[] = {
    {By::bfactor, "B-factor", "Å²"},
    {By::occupancy, "occupancy", ""},
    {By::charge, "partial charge", "e", ColorMap::red_white_blue},
    {By::hydrophobicity, "hydrophobicity (Kyte & Doolittle 1982)", "", ColorMap::blue_white_red},
    {By::index, "place in the file", ""},
    {By::radial, "distance from the middle", "Å"},
    {By::rainbow, "place in the chain", "", ColorMap::rainbow},
    {By::conservation, "conservation", "", ColorMap::consurf},
    {By::buried, "buried area", "Å²", ColorMap::ylorrd},
    {By::rmsf, "fluctuation (RMSF)", "Å", ColorMap::ylorrd},
    {By::accessibility, "relative accessibility (Tien et al. 2013)", ""},
    {By::file, "number from file", ""}};

[[noreturn]] void no_numbers(const Structure& structure, const ColorScheme& scheme) {
  switch (scheme.by) {
    case By::bfactor:
      throw InputError(structure.file, 0, message("has no B-factors to colour by; choose another @color@"));
    case By::occupancy:
      throw InputError(structure.file, 0, message("has no occupancies to colour by; choose another @color@"));
    case By::charge:
      throw InputError(structure.file, 0, "has no partial charges to colour by; PQR files have them");
    case By::rmsf:
      throw RequestError(message("@color rmsf@ measures fluctuations over frames; add @frames all@"));
    case By::buried:
      throw RequestError(
          message("buried areas colour the whole surface; choose @color buried@, or another colour for EXPR"));
    case By::accessibility:
      throw InputError(
          structure.file, 0,
          message("has no complete amino acids, so there is no relative accessibility; choose another @color@"));
    case By::rainbow:
      throw InputError(structure.file, 0,
                       message("has no chains of amino acids or nucleotides to colour along; choose another @color@"));
    case By::hydrophobicity:
      throw InputError(
          structure.file, 0,
          message("has no amino acids, so the hydrophobicity scale does not apply; choose another @color@"));
    default:
      throw InputError(scheme.file.path, 0, "all numbers are missing; there is nothing to colour by");
  }
}

std::array<double, 2> automatic_range(const std::vector<double>& defined, By by) {
  if (by == By::hydrophobicity) return {-4.5, 4.5};
  if (by == By::rainbow || by == By::accessibility) return kPlaces;
  if (by == By::conservation) return kGrades;
  const auto [low, high] = std::ranges::minmax(defined);
  if (by == By::buried || by == By::rmsf) return {0.0, high};
  if (by != By::charge) return {low, high};
  const double largest = std::max(std::abs(low), std::abs(high));
  return {-largest, largest};
}

void count_classes(ColorScale& scale, const std::vector<double>& defined, const std::string& file) {
  const std::set<double> different(defined.begin(), defined.end());
  if (different.size() > kCategoricalCount)
    throw InputError(file, 0,
                     message("has {} different numbers, but the categorical map has {} colours; choose another @map@",
                             with_thousands(different.size()), kCategoricalCount));
  scale.classes.assign(different.begin(), different.end());
}

}  // namespace

std::vector<double> distances_from_middle(std::span<const glm::dvec3> points) {
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const glm::dvec3& point : points) distances.push_back(glm::distance(point, middle));
  return distances;
}

ColorScale color_scale(const Structure& structure, const ColorScheme& scheme) {
  if (scheme.by == By::volume) return scheme.volume->scale;
  if (scheme.by == By::lipophilicity) return lipophilicity_scale(scheme);
  ColorScale scale;
  const auto file = std::prev(std::end(kScaleStyles));
  const ScaleStyle& style = *std::ranges::find(std::begin(kScaleStyles), file, scheme.by, &ScaleStyle::by);
  scale.title = scheme.by == By::file && !scheme.file.column.empty() ? scheme.file.column : std::string(style.title);
  scale.unit = std::string(style.unit);
  if (!scheme.title.empty()) scale.title = scheme.title;
  if (!scheme.unit.empty()) scale.unit = scheme.unit;
  scale.map = scheme.map.value_or(style.map);
  scale.own_map = scheme.own_map;
  scale.missing_color = scheme.missing.value_or(default_missing_color(scale.map));
  if (scheme.is_measured() && scheme.file.numbers.empty()) no_numbers(structure, scheme);
  scale.value = numbers_of(structure, scheme);
  std::vector<double> defined;
  std::ranges::copy_if(scale.value, std::back_inserter(defined), [](double number) { return !std::isnan(number); });
  if (defined.empty()) no_numbers(structure, scheme);
  scale.missing = scale.value.size() - defined.size();
  scale.range = scheme.range          ? *scheme.range
                : scheme.frames_range ? *scheme.frames_range
                                      : automatic_range(defined, scheme.by);
  if (scheme.by == By::rainbow && scale.range == kPlaces) scale.ends = ends_of_chains(structure);
  if (scheme.by == By::conservation && scale.range == kGrades) scale.ends = {"variable", "conserved"};
  scale.of_colors = scheme.takes_file() && scheme.file.of_colors;
  if (scale.of_colors) {
    const std::set<double> different(defined.begin(), defined.end());
    scale.classes.assign(different.begin(), different.end());
  } else if (scale.map == ColorMap::categorical) {
    count_classes(scale, defined, structure.file);
  }
  return scale;
}

}  // namespace meniscus
