// SPDX-License-Identifier: BSD-3-Clause
// The table of commands. A command declares its options when the command line reaches it.
#include "app/commands/commands.h"

namespace meniscus {
namespace {

void add_export(CLI::App& command) { describe(command, "  meniscus export FORMAT --help"); }

constexpr Command kFormats[] = {
    {"povray", "Write a POV-Ray scene of the analytic patches, no triangles; prints how to render it",
     add_export_povray},
    {"blender", "Write a file for Blender: closed mesh, analytic patches, atoms, camera (add-on: meniscus_import)",
     add_export_blender},
    {"mitsuba", "Write a Mitsuba 3 scene: meshes as fine as the picture, spheres and cylinders as they are",
     add_export_mitsuba},
    {"pbrt", "Write a pbrt-v4 scene: meshes as fine as the picture, spheres and cylinders as they are",
     add_export_pbrt},
    {"mesh", "Write a closed triangle mesh: STL, 3MF, OBJ, OFF, GLB, VTP, TetGen, DMS or PLY", add_export_mesh},
    {"ply", "Write a closed triangle mesh as binary PLY: the same as export mesh --format ply", add_export_ply},
    {"atoms", "Write the atoms that a surface is computed of, with radii, colours and frames, as arrays",
     add_export_atoms},
};

constexpr Command kFarmCommands[] = {
    {"bundle", "Make a folder that any machine can work on", add_farm_bundle},
    {"status", "Tell how far the frames of a bundle are, how long still, and what failed last", add_farm_status},
    {"log", "Tell what became of a frame, who made it, and what the programs that made it said", add_farm_log},
    {"verify", "Check that every frame is there, whole, of the right size and not blank; then make the film",
     add_farm_verify},
};

constexpr Command kCommands[] = {
    {"surface", "Compute the surface; print area, volume, components, chains, and areas of atoms", add_surface},
    {"pockets", "Find pockets, tunnels and cavities: volume, mouths, depth, the atoms around", add_pockets},
    {"render", "Ray cast a picture of the analytic surface", add_render},
    {"preview", "Look at the surface while it changes, in a window or in a browser", add_preview},
    {"export", "Write the surface for another program", add_export, "Formats", kFormats},
    {"farm", "Make films on many machines: make, Slurm, OpenJD, Flamenco, OpenCue", add_farm, "Commands",
     kFarmCommands},
    {"work", "Make the missing frames of a bundle, or a chunk of them (see meniscus farm)", add_work},
    {"info", "Tell what a file holds: models, chains, classes, extent, and which radius each class of atoms gets",
     add_info},
    {"formats", "List the file formats that are read, and what of them is used", add_formats},
    {"colors", "List colour schemes and colour maps with their sources", add_colors},
    {"bench", "Time the stages of the surface computation for several files", add_bench},
    {"completion", "Print the script by which bash, zsh or fish completes commands, options and their words",
     add_completion},
    {"help", "Show a page of the manual: selections, assemblies, frames, exit-codes, or a command", add_help},
};

}  // namespace

std::span<const Command> commands() { return kCommands; }

void add_commands(CLI::App& parent, const std::string& heading, std::span<const Command> rows, Declared when) {
  for (const Command& row : rows) {
    CLI::App& command = *parent.add_subcommand(row.name, row.summary)->group(heading);
    if (when == Declared::at_once)
      row.add(command);
    else
      command.preparse_callback([&row, &command](std::size_t) { row.add(command); });
    if (row.below.empty()) continue;
    command.require_subcommand(1);
    add_commands(command, row.heading_below, row.below, when);
  }
}

void describe(CLI::App& command, const std::string& examples, const std::string& details) {
  command.footer(details.empty() ? examples : examples + "\n\n" + details);
}

}  // namespace meniscus
