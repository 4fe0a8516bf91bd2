// SPDX-License-Identifier: BSD-3-Clause
// Files of numbers to colour by, the words of colours, maps and ranges, and their colours.
#include <cmath>

#include "core/base/error.h"
#include "core/color/color_schemes.h"
#include "core/color/coloring.h"
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

void require_color(const glm::vec3& color) {
  for (int c = 0; c < 3; ++c) require(color[c] >= 0.0F && color[c] <= 1.0F, "colours are between 0 and 1");
}

void check_colors(const ColorScheme& scheme) {
  Structure structure;
  structure.atoms = sample_atoms();
  try {
    const Coloring coloring = color_atoms(structure, scheme);
    require(coloring.atom.size() == structure.atoms.size(), "one colour an atom");
    for (const glm::vec3& color : coloring.atom) require_color(color);
  } catch (const InputError& error) {
    require_clear(error);
  }
}

/// Checks words in the form of option values.
void check_words(std::string_view text) {
  if (const auto color = parse_color(text)) require_color(*color);
  try {
    ColorScheme scheme;
    scheme.rules.push_back(parse_color_rule(text));
    check_colors(scheme);
  } catch (const RequestError& error) {
    require_clear(error);
  } catch (const SelectionError& error) {
    require_clear(error);
  }
  if (const auto range = parse_color_range(text))
    require(std::isfinite((*range)[0]) && std::isfinite((*range)[1]) && (*range)[0] < (*range)[1], "ranges rise");
  parse_color_map(text);
  if (const auto scheme = parse_color_scheme(text)) check_colors(*scheme);
}

/// Colours by the number file, repeated or cut to the number of atoms, with every map.
void check_numbers(NumberFile file) {
  const std::size_t given = file.numbers.size(), needed = sample_atoms().size();
  file.numbers.resize(needed);
  for (std::size_t n = given; n < needed; ++n) file.numbers[n] = file.numbers[n - given];
  ColorScheme scheme;
  scheme.by = ColorScheme::By::file;
  scheme.file = std::move(file);
  for (const ColorMapMetadata& map : color_maps()) {
    scheme.map = map.map;
    check_colors(scheme);
  }
}

void run_colors(std::string_view bytes) {
  static const ScratchFile scratch("numbers.txt");
  check_words(bytes);
  try {
    const NumberFile file = read_number_file(scratch.write(bytes));
    for (const double number : file.numbers) require(!std::isinf(number), "numbers are finite or missing");
    check_numbers(file);
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

const Registration registered_colors{"colors", run_colors};

}  // namespace
}  // namespace meniscus::fuzz
