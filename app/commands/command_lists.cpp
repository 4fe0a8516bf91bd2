// SPDX-License-Identifier: BSD-3-Clause
// Commands that print lists: colours, file formats, completion scripts.

#include <iostream>

#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include "app/commands/command_table.h"
#include "app/options/command_tree.h"
#include "app/options/property_options.h"
#include "app/process/program_main.h"
#include "app/reports/command_manual.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/color_schemes.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/trajectory_formats.h"

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

constexpr std::size_t kIndent = 18, kWidth = 100;

void print_wrapped(std::string_view heading, std::string_view text) {
  fmt::print(std::cout, "  {:<{}}{}\n", heading, kIndent - 2, wrapped(with_options(text), kWidth - kIndent, kIndent));
}

void print_format(const FormatMetadata& metadata) {
  fmt::print(std::cout, "{:<{}}{}\n", metadata.name, kIndent, metadata.extensions);
  print_wrapped("what", metadata.description);
  print_wrapped("read", metadata.reads);
  if (!metadata.reference.empty()) print_wrapped("reference", metadata.reference);
  fmt::print(std::cout, "\n");
}

void print_table() {
  for (const Reader* reader : readers()) print_format(reader->metadata);
  fmt::print(std::cout,
             "All of them plain or packed with gzip, from a file or from standard input (-). The content says which\n"
             "format it is; a name that clearly says another one is an error.\n\nTrajectories (--trajectory):\n\n");
  for (const TrajectoryFormat* format : trajectory_formats()) print_format(format->metadata);
}

nlohmann::ordered_json json_of(const FormatMetadata& metadata, const char* kind) {
  return {{"name", metadata.name},
          {"kind", kind},
          {"extensions", fields_of(metadata.extensions)},
          {"description", with_options(metadata.description)},
          {"reads", with_options(metadata.reads)},
          {"reference", metadata.reference}};
}

void print_json() {
  nlohmann::ordered_json formats = nlohmann::ordered_json::array();
  for (const Reader* reader : readers()) formats.push_back(json_of(reader->metadata, "structure"));
  for (const TrajectoryFormat* format : trajectory_formats())
    formats.push_back(json_of(format->metadata, "trajectory"));
  fmt::print(std::cout, "{}\n", formats.dump(2));
}

struct Shell {
  const char* name;
  std::string (*completion)(const CommandEntry& program);
};

constexpr Shell kShells[] = {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};

void run(const CLI::App& program, const std::string& name) {
  for (const Shell& shell : kShells) {
    if (name != shell.name) continue;
    std::cout << shell.completion(command_tree(program));
    return;
  }
  throw UsageError(in_quotes(name) + " is not a supported shell; choose bash, zsh or fish");
}

}  // namespace

void add_colors(CLI::App& command) {
  describe(command, "  meniscus colors");
  command.callback(list_colors);
}

void add_formats(CLI::App& command) {
  describe(command,
           "  meniscus formats\n"
           "  meniscus formats --json");
  auto json = std::make_shared<bool>(false);
  PropertyOptions(command).add("report.json", *json);
  command.callback([json] { *json ? print_json() : print_table(); });
}

void add_completion(CLI::App& command) {
  describe(command,
           "  source <(meniscus completion bash)                 in ~/.bashrc\n"
           "  meniscus completion zsh >~/.zfunc/_meniscus        a folder of $fpath\n"
           "  meniscus completion fish >~/.config/fish/completions/meniscus.fish\n\n"
           "The package of a system installs all three.");
  auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(proposes({"bash", "zsh", "fish"}))
      ->type_name("");
  command.callback([shell, &command] { run(*command.get_parent(), *shell); });
}

}  // namespace meniscus
