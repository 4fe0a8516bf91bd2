// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that say how a surface is coloured.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "app/options/value_words.h"
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

void add_color_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Colour");
  ColorScheme& color = options.color;
  const auto add = [&](const char* name, void (*parse)(const std::string&, ColorScheme&), const char* help,
                       const char* type) {
    CLI::Option* const option = command.add_option_function<std::string>(
        name, [&color, parse](const std::string& text) { parse(text, color); }, help);
    return option->type_name(type);
  };
  std::vector<std::string> schemes, maps;
  for (const ColorSchemeMetadata& known : color_schemes()) schemes.emplace_back(known.word);
  for (const ColorMapMetadata& known : color_maps()) maps.emplace_back(known.name);
  CLI::Option* const scheme =
      command
          .add_option_function<std::vector<std::string>>(
              "--color", [&color](const std::vector<std::string>& texts) { parse_colors(texts, color); },
              "element (default), chain, copy (of an assembly), residue (type), kind (of patch), component, a colour "
              "(red, #rrggbb), element-cpk (darker); or by number: bfactor, occupancy, charge, hydrophobicity (Kyte & "
              "Doolittle 1982), "
              "index, radial (capsids); meniscus colors explains them. Or EXPR=COLOR for some atoms, as in "
              "'ligand=orange'; repeatable, "
              "the last counts")
          ->allow_extra_args(false)
          ->type_name("SCHEME")
          ->check(proposes(schemes));
  CLI::Option* const file = command.add_option(
      "--color-by-file", options.number_file,
      "Colour by numbers from a file: one an atom of FILE or one an atom used; lines of chain, residue and number; or "
      "a CSV table, such as meniscus surface --csv-residues writes; nan, ? or -: missing");
  file->type_name("NUMBERS");
  command.add_option("--color-column", options.number_column, "Column of that table")->needs(file)->type_name("NAME");
  add("--map", parse_map,
      "Of numbers: viridis (default), cividis, magma, blue-white-red (default of hydrophobicity), red-white-blue (of "
      "charge: negative is red), blues and ylorrd (light), consurf (grades 1 to 9), categorical (each number a colour "
      "of "
      "its own)",
      "MAP")
      ->check(proposes(maps));
  command
      .add_option("--map-file", options.map_file,
                  "A map of your own: a colour a line, or a place and a colour; or a JSON list of them")
      ->type_name("FILE");
  add("--color-range", parse_range,
      "Numbers at the ends of the map, or auto (default: smallest and largest; charge symmetric about 0; "
      "hydrophobicity -4.5:4.5)",
      "LO:HI");
  CLI::Option* const volume =
      command
          .add_option("--color-map-file", options.volume_file,
                      "Colour each point of the surface by a volume map, such as a potential of APBS: OpenDX (.dx), "
                      "Gaussian cube, CCP4/MRC; needs --color-range; map red-white-blue unless told otherwise")
          ->excludes(file)
          ->type_name("FILE");
  command
      .add_option(
          "--map-offset", options.volume_offset,
          "Sample that map so many Å outside of the surface, along its normal; 1.4 is where solvent's centres are [0]")
      ->check(CLI::Range(-20.0, 20.0).description(""))
      ->needs(volume)
      ->type_name("Å");
  command.add_option("--color-title", color.title, "Title of the legend's scale")->type_name("TEXT");
  command.add_option("--color-unit", color.unit, "Its unit, such as kT/e")->type_name("TEXT");
  add("--missing-color", parse_missing,
      "Of atoms without a number, and points outside of a volume map [#808080; cividis #cc79a7; consurf #ffff96]",
      "COLOR");
  command.parse_complete_callback([&options, scheme, file, volume] {
    // Numbers that no --color speaks of are for all atoms.
    if (!file->empty() && !has_base(*scheme) && !options.color.uses_file()) options.color.by = By::file;
    if (!volume->empty()) {
      if (has_base(*scheme))
        throw CLI::ValidationError("--color-map-file", "is itself a --color; leave the other one out, but EXPR=COLOR");
      if (!options.color.range)
        throw CLI::ValidationError("--color-map-file", "needs --color-range LO:HI, such as -5:5 for kT/e");
      options.color.by = By::volume;
    }
    check_together(options, *scheme, *file);
  });
}

void add_opacity_option(CLI::App& command, MoleculeOptions& options) {
  command
      .add_option_function<std::vector<std::string>>(
          "--opacity",
          [&options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
              options.color.opacities.push_back(naming("--opacity", [&] { return parse_opacity_rule(text); }));
          },
          "Of atoms, from 0 (hidden) to 1: EXPR=0.4, or a number alone for all of them; repeatable, the last counts")
      ->allow_extra_args(false)
      ->type_name("EXPR=N");
}

}  // namespace meniscus
