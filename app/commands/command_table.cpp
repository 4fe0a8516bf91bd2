// SPDX-License-Identifier: BSD-3-Clause
// The table of commands. A command declares its options when the command line reaches it.
#include "app/commands/command_table.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace meniscus {
namespace {

void add_export(CLI::App& command) { describe(command, "  meniscus export FORMAT --help"); }

/// Returns the rows that have registered themselves, in the order of linking.
std::vector<Command>& registered_exporters() {
  static std::vector<Command> rows;
  return rows;
}

constexpr Command kFarmCommands[] = {
    {"bundle", "Make a folder of frames to render that any machine can work on", add_farm_bundle},
    {"verify", "Check that every frame is complete, of the right size and not blank; then make the film",
     add_farm_verify},
};

constexpr Command kCommands[] = {
    {"surface", "Compute the surface; print area, volume, components, chains, and areas of atoms", add_surface},
    {"pockets", "Find pockets, tunnels and cavities: volume, mouths, depth, the atoms around", add_pockets},
    {"render", "Make a picture of the surface by ray casting its exact patches", add_render},
    {"film", "Make a film that goes from one scene to the next", add_film},
    {"panels", "Make one picture of several, side by side, with letters and one legend", add_panels},
    {"looks", "Make one picture of a molecule in all looks (--preset)", add_looks},
    {"preview", "Show the surface in a browser, and change it", add_preview},
    {"morph", "Make a path from one structure to another, as models of a PDB file", add_morph},
    {"export", "Write the surface for another program", add_export, "Formats", exporters},
    {"farm", "Make films on many machines: make, Slurm, Snakemake, OpenJD, Kubernetes, Flamenco, OpenCue", add_farm,
     "Commands", [] { return std::span<const Command>(kFarmCommands); }},
    {"work", "Make the missing frames of a bundle, or a chunk of them (see meniscus farm)", add_work},
    {"info", "Show what a file contains: models, chains, classes, extent, and the radius of each class of atoms",
     add_info},
    {"formats", "List the file formats that are read, and what is read of each", add_formats},
    {"colors", "List colour schemes and colour maps with their sources", add_colors},
    {"bench", "Time the stages of the surface computation for several files", add_bench},
    {"completion", "Print a script for bash, zsh or fish that completes commands and options", add_completion},
    {"help", "Show a page of help, or search all of it", add_help},
};

}  // namespace

ExportCommand::ExportCommand(const char* name, const char* summary, void (*add)(CLI::App& command)) {
  registered_exporters().push_back({name, summary, add});
}

std::span<const Command> exporters() {
  std::ranges::sort(registered_exporters(), {}, [](const Command& row) { return std::string_view(row.name); });
  return registered_exporters();
}

std::span<const Command> commands() { return kCommands; }

void add_commands(CLI::App& parent, const std::string& heading, std::span<const Command> rows, Declared when) {
  for (const Command& row : rows) {
    CLI::App& command = *parent.add_subcommand(row.name, row.summary)->group(heading);
    if (when == Declared::at_once)
      row.add(command);
    else
      command.preparse_callback([&row, &command](std::size_t) { row.add(command); });
    if (!row.below) continue;
    command.require_subcommand(1);
    add_commands(command, row.heading_below, row.below(), when);
  }
}

void describe(CLI::App& command, const std::string& examples, const std::string& details) {
  command.footer(details.empty() ? examples : examples + "\n\n" + details);
}

}  // namespace meniscus
