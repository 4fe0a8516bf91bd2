// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export`: a table of formats, each of which is a command of its own.
#include "app/commands/commands.h"

namespace meniscus {
namespace {

/// One row a format; its file is app/export_<name>.cpp.
constexpr Command kFormats[] = {
    {"povray", add_export_povray}, {"blender", add_export_blender}, {"mitsuba", add_export_mitsuba},
    {"pbrt", add_export_pbrt},     {"mesh", add_export_mesh},       {"ply", add_export_ply},
    {"atoms", add_export_atoms},
};

}  // namespace

void add_export(CLI::App& command) {
  describe(command, "Write the surface for another program", "  meniscus export FORMAT --help");
  command.require_subcommand(1);
  for (const Command& format : kFormats) format.add(*command.add_subcommand(format.name)->group("Formats"));
}

}  // namespace meniscus
