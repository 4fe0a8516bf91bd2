// SPDX-License-Identifier: BSD-3-Clause
// Finds numbers, ranges and names of what a structure is coloured by.
#include "core/color/color_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/named_colors.h"
#include "core/structure/radii.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;

/// The numbers of a file for the atoms in use: given for each of these, or for each atom of the molecule's file.
std::vector<double> numbers_of_file(const Structure& structure, const NumberFile& file) {
  const auto other_models = structure.report.excluded.find(kExcludedModel);
  const std::size_t read =
      structure.report.read - (other_models == structure.report.excluded.end() ? 0 : other_models->second);
  const std::size_t used = structure.atoms.size(), given = file.numbers.size();
  if (given == used) return file.numbers;
  std::vector<double> numbers;
  for (const Atom& atom : structure.atoms) {
    if (given == read && atom.index < given) numbers.push_back(file.numbers[atom.index]);
  }
  if (numbers.size() != used) {
    throw InputError(file.path, 0,
                     fmt::format("holds {} numbers; {} holds {} atoms, of which {} are used; give as many as either",
                                 with_thousands(given), structure.file, with_thousands(read), with_thousands(used)));
  }
  return numbers;
}

/// One number an atom, NaN where there is none.
std::vector<double> numbers_of(const Structure& structure, const ColorScheme& scheme) {
  if (scheme.by == By::file) return numbers_of_file(structure, scheme.file);
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

struct ScaleWords {
  std::string_view title, unit;
};

ScaleWords words_of(By by) {
  switch (by) {
    case By::bfactor:
      return {"B-factor", "Å²"};
    case By::occupancy:
      return {"occupancy", ""};
    case By::charge:
      return {"partial charge", "e"};
    case By::hydrophobicity:
      return {"hydrophobicity (Kyte & Doolittle 1982)", ""};
    case By::index:
      return {"place in the file", ""};
    default:
      return {"number from file", ""};
  }
}

[[noreturn]] void no_numbers(const Structure& structure, const ColorScheme& scheme) {
  switch (scheme.by) {
    case By::bfactor:
      throw InputError(structure.file, 0, "has no B-factors to colour by; choose another --color");
    case By::occupancy:
      throw InputError(structure.file, 0, "has no occupancies to colour by; choose another --color");
    case By::charge:
      throw InputError(structure.file, 0, "has no partial charges to colour by; PQR files have them");
    case By::hydrophobicity:
      throw InputError(structure.file, 0,
                       "has no amino acids, which the hydrophobicity scale is for; choose another --color");
    default:
      throw InputError(scheme.file.path, 0, "all numbers are missing; there is nothing to colour by");
  }
}

ColorMap default_map(By by) {
  if (by == By::charge) return ColorMap::red_white_blue;
  return by == By::hydrophobicity ? ColorMap::blue_white_red : ColorMap::viridis;
}

std::array<double, 2> automatic_range(const std::vector<double>& defined, By by) {
  if (by == By::hydrophobicity) return {-4.5, 4.5};
  const auto [low, high] = std::ranges::minmax(defined);
  if (by != By::charge) return {low, high};
  const double largest = std::max(std::abs(low), std::abs(high));
  return {-largest, largest};
}

void count_classes(ColorScale& scale, const std::vector<double>& defined, const std::string& file) {
  const std::set<double> different(defined.begin(), defined.end());
  if (different.size() > kCategoricalCount) {
    throw InputError(file, 0,
                     fmt::format("has {} different numbers to colour by, the categorical map {} colours; choose "
                                 "another --map",
                                 with_thousands(different.size()), kCategoricalCount));
  }
  scale.classes.assign(different.begin(), different.end());
}

std::string class_title(By by) {
  return by == By::element ? "element" : by == By::chain ? "chain" : by == By::copy ? "copy" : "residue type";
}

/// Adds a class unless it is there already.
class ClassList {
 public:
  explicit ClassList(ColorKey& key) : key_(key) {}
  void add(const std::string& name, const glm::vec3& color) {
    if (seen_.insert(name).second) key_.classes.push_back({name, color});
  }
  /// The colour of the next new class.
  glm::vec3 next_color() const { return categorical_color(seen_.size()); }

 private:
  ColorKey& key_;
  std::set<std::string> seen_;
};

}  // namespace

glm::vec3 ColorScale::color(double number) const {
  if (std::isnan(number)) return missing_color;
  if (map == ColorMap::categorical) {
    return categorical_color(static_cast<std::size_t>(std::ranges::lower_bound(classes, number) - classes.begin()));
  }
  const double width = range[1] - range[0];
  return mapped_color(map, width > 0.0 ? (number - range[0]) / width : 0.5);
}

ColorScale color_scale(const Structure& structure, const ColorScheme& scheme) {
  ColorScale scale;
  const ScaleWords words = words_of(scheme.by);
  scale.title = std::string(words.title);
  scale.unit = std::string(words.unit);
  scale.map = scheme.map.value_or(default_map(scheme.by));
  scale.missing_color = scheme.missing.value_or(default_missing_color(scale.map));
  scale.value = numbers_of(structure, scheme);
  std::vector<double> defined;
  std::ranges::copy_if(scale.value, std::back_inserter(defined), [](double number) { return !std::isnan(number); });
  if (defined.empty()) no_numbers(structure, scheme);
  scale.missing = scale.value.size() - defined.size();
  scale.range = scheme.range ? *scheme.range : automatic_range(defined, scheme.by);
  if (scale.map == ColorMap::categorical) count_classes(scale, defined, structure.file);
  return scale;
}

ColorKey color_key(const Structure& structure, const ColorScheme& scheme, std::span<const std::string> object_names) {
  ColorKey key;
  ClassList classes(key);
  if (scheme.has_scale()) {
    key.scale = color_scale(structure, scheme);
  } else if (scheme.by == By::kind) {
    key.title = "kind of patch";
    constexpr std::array<const char*, 3> kNames{"convex", "toroidal", "concave"};
    for (std::size_t n = 0; n < kNames.size(); ++n) classes.add(kNames[n], kPatchKindColors[n]);
  } else if (scheme.by == By::component) {
    key.title = "component";
    for (std::size_t n = 0; n < object_names.size(); ++n)
      key.classes.push_back({object_names[n], categorical_color(n)});
  } else if (scheme.by != By::fixed) {
    key.title = class_title(scheme.by);
    for (const Atom& atom : structure.atoms) {
      if (scheme.by == By::element)
        classes.add(atom.element == 0 ? "unknown" : element_symbol(atom.element), element_color(atom.element));
      else if (scheme.by == By::chain)
        classes.add(chain_of_file(atom), classes.next_color());
      else if (scheme.by == By::copy)
        classes.add(fmt::format("copy {}", atom.copy + 1), categorical_color(atom.copy));
      else
        classes.add(std::string(residue_group(atom.residue_name).name),
                    color_from_hex(residue_group(atom.residue_name).color));
    }
  }
  for (const ColorRule& rule : scheme.rules)
    if (rule.paint.by == By::fixed) key.classes.push_back({rule.atoms.text(), rule.paint.fixed});
  return key;
}

}  // namespace meniscus
