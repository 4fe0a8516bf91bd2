// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that say how a surface is coloured.
#include <optional>

#include "app/molecule_options.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

void parse_color(const std::string& text, ColorScheme& color) {
  const std::optional<ColorScheme> scheme = parse_color_scheme(text);
  if (!scheme) {
    throw CLI::ValidationError("--color",
                               in_quotes(text) + " is none of element, chain, residue, bfactor, kind, atom, #rrggbb");
  }
  color.by = scheme->by;
  color.fixed = scheme->fixed;
}

}  // namespace

void add_color_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Colour");
  ColorScheme& color = options.color;
  command
      .add_option_function<std::string>(
          "--color", [&color](const std::string& text) { parse_color(text, color); },
          "Colour by element (default), chain, residue, bfactor, kind (of patch), atom, or one #rrggbb")
      ->type_name("SCHEME");
  command
      .add_option_function<std::string>(
          "--color-range",
          [&color](const std::string& text) {
            color.range = parse_color_range(text);
            if (!color.range)
              throw CLI::ValidationError("--color-range",
                                         in_quotes(text) + " is not lo:hi with lo < hi, such as 10:60");
          },
          "B-factors at the two ends of the colour map [smallest:largest]")
      ->type_name("LO:HI");
}

}  // namespace meniscus
