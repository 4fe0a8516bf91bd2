// SPDX-License-Identifier: BSD-3-Clause
// Adds the options that say how a surface is coloured, and checks them together.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "app/options/property_options.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;

/// Runs what throws SelectionError or RequestError, so that both name the option.
template <typename Parse>
auto naming(const char* option, const Parse& parse) {
  try {
    return parse();
  } catch (const SelectionError& error) {
    throw SelectionError(fmt::format("{}: {}", option, error.sentence()), error.picture());
  } catch (const RequestError& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

/// A scheme for all, or a rule for some.
void parse_colors(const std::vector<std::string>& texts, ColorScheme& color) {
  for (const std::string& text : texts) {
    if (text.find('=') != std::string::npos) {
      color.rules.push_back(naming("--color", [&] { return parse_color_rule(text); }));
      continue;
    }
    const std::optional<ColorScheme> scheme = parse_color_scheme(text);
    if (!scheme) throw CLI::ValidationError("--color", in_quotes(text) + " is none of " + color_scheme_words());
    color.by = scheme->by;
    color.fixed = scheme->fixed;
  }
}

void parse_map(const std::string& text, ColorScheme& color) {
  color.map = parse_color_map(text);
  if (color.map) return;
  std::string names;
  for (const ColorMapMetadata& map : color_maps()) names.append(names.empty() ? "" : ", ").append(map.name);
  throw CLI::ValidationError("--map", in_quotes(text) + " is none of " + names);
}

void parse_range(const std::string& text, ColorScheme& color) {
  color.range = parse_color_range(text);
  if (!color.range && text != "auto")
    throw CLI::ValidationError("--color-range",
                               in_quotes(text) + " is neither auto nor lo:hi with lo < hi, such as 10:60");
}

void parse_missing(const std::string& text, ColorScheme& color) {
  color.missing = parse_color(text);
  if (!color.missing)
    throw CLI::ValidationError("--missing-color",
                               in_quotes(text) + " is neither a colour's name such as red nor #rrggbb");
}

/// Whether some --color is for all atoms.
bool has_base(const CLI::Option& scheme) {
  return std::ranges::any_of(scheme.results(),
                             [](const std::string& text) { return text.find('=') == std::string::npos; });
}

constexpr const char* kForNumbers =
    "is for colours by a number: bfactor, occupancy, charge, hydrophobicity, index, radial, file, a volume map";

/// What can only be said once all colour options are known, whatever their order.
void check_together(const MoleculeOptions& options, const CLI::Option& scheme, const CLI::Option& file) {
  const ColorScheme& color = options.color;
  if (color.uses_file() && file.empty()) throw CLI::ValidationError("--color", "file needs --color-by-file FILE");
  if (!file.empty() && !scheme.empty() && !color.uses_file())
    throw CLI::ValidationError("--color-by-file", "is itself a --color; leave the other one out");
  if (color.by == By::kind && !color.rules.empty())
    throw CLI::ValidationError("--color", "kind colours patches, EXPR=COLOR atoms; choose another scheme beside it");
  if (color.uses_scale()) return;
  if (!options.map_file.empty()) throw CLI::ValidationError("--map-file", kForNumbers);
  if (color.map || color.range || color.missing) {
    throw CLI::ValidationError(color.map ? "--map" : color.range ? "--color-range" : "--missing-color", kForNumbers);
  }
}

}  // namespace

void add_color_options(CLI::App& command, MoleculeOptions& molecule) {
  ColorScheme& color = molecule.color;
  PropertyOptions options(command);
  const auto parsed_by = [&color](void (*parse)(const std::string&, ColorScheme&)) {
    return [&color, parse](const std::string& text) { parse(text, color); };
  };
  std::vector<std::string> schemes, maps;
  for (const ColorSchemeMetadata& known : color_schemes()) schemes.emplace_back(known.word);
  for (const ColorMapMetadata& known : color_maps()) maps.emplace_back(known.name);
  CLI::Option* const scheme = options.add_list(
      "surface.color", [&color](const std::vector<std::string>& texts) { parse_colors(texts, color); });
  scheme->check(proposes(schemes));
  CLI::Option* const file = options.add("surface.color_by_file", molecule.number_file);
  options.add("surface.color_column", molecule.number_column)->needs(file);
  options.add_parsed("surface.map", parsed_by(parse_map))->check(proposes(maps));
  options.add("surface.map_file", molecule.map_file);
  options.add_parsed("surface.color_range", parsed_by(parse_range));
  CLI::Option* const volume = options.add("surface.color_map_file", molecule.volume_file);
  volume->excludes(file);
  options.add("surface.map_offset", molecule.volume_offset)->needs(volume);
  options.add("surface.color_title", color.title);
  options.add("surface.color_unit", color.unit);
  options.add_parsed("surface.missing_color", parsed_by(parse_missing));
  command.parse_complete_callback([&molecule, scheme, file, volume] {
    // Numbers that no --color speaks of are for all atoms.
    if (!file->empty() && !has_base(*scheme) && !molecule.color.uses_file()) molecule.color.by = By::file;
    if (!volume->empty()) {
      if (has_base(*scheme))
        throw CLI::ValidationError("--color-map-file", "is itself a --color; leave the other one out, but EXPR=COLOR");
      if (!molecule.color.range)
        throw CLI::ValidationError("--color-map-file", "needs --color-range LO:HI, such as -5:5 for kT/e");
      molecule.color.by = By::volume;
    }
    check_together(molecule, *scheme, *file);
  });
}

void add_opacity_option(CLI::App& command, MoleculeOptions& molecule) {
  PropertyOptions(command).add_list("surface.opacity", [&molecule](const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      molecule.color.opacities.push_back(naming("--opacity", [&] { return parse_opacity_rule(text); }));
  });
}

}  // namespace meniscus
