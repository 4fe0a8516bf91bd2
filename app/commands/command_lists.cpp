// SPDX-License-Identifier: BSD-3-Clause
// `meniscus formats`: lists the file formats that are read, and their contents.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include "app/commands/command_table.h"
#include "app/options/property_options.h"
#include "core/base/message.h"
#include "core/base/text_file.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/trajectory_formats.h"

namespace meniscus {
namespace {

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

}  // namespace

void add_formats(CLI::App& command) {
  describe(command,
           "  meniscus formats\n"
           "  meniscus formats --json");
  auto json = std::make_shared<bool>(false);
  PropertyOptions(command).add("report.json", *json);
  command.callback([json] { *json ? print_json() : print_table(); });
}

}  // namespace meniscus
