// SPDX-License-Identifier: BSD-3-Clause
// `meniscus colors`: lists colour schemes and colour maps with their sources.
#include <iostream>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands/command_table.h"
#include "core/base/message.h"
#include "core/color/color_schemes.h"

namespace meniscus {
namespace {

constexpr int kColumn = 24;

void print_row(std::string_view word, std::string_view description, std::string_view source) {
  fmt::print(std::cout, "  {:<{}}{}\n", word, kColumn, with_options(description));
  if (!source.empty()) fmt::print(std::cout, "  {:<{}}  {}\n", "", kColumn, source);
}

void list_colors() {
  fmt::print(std::cout, "--color SCHEME\n");
  for (const ColorSchemeMetadata& scheme : color_schemes()) print_row(scheme.word, scheme.description, scheme.source);
  print_row("red, #rrggbb", "one colour for all: a name of CSS, #rrggbb or #rgb", "CSS Color Module Level 4, W3C");
  print_row("EXPR=COLOR", "any of these but kind and component, for the atoms of an expression", "");
  fmt::print(std::cout, "\n--map MAP, for numbers\n");
  for (const ColorMapMetadata& map : color_maps()) print_row(map.name, map.source, "");
  fmt::print(std::cout,
             "\nNumbers beyond --color-range have the colour of its end. Atoms without a number have --missing-color; "
             "its default is\ngrey #808080 (with cividis, which contains grey, #cc79a7). If all numbers are equal, "
             "they have the colour in the\nmiddle of the map.\n");
}

}  // namespace

void add_colors(CLI::App& command) {
  describe(command, "  meniscus colors");
  command.callback(list_colors);
}

}  // namespace meniscus
