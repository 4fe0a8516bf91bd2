// SPDX-License-Identifier: BSD-3-Clause
// The options that commands share, and the one way from them to a molecule with its surface and colours.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "app/compute.h"
#include "core/base/output_file.h"
#include "core/base/progress.h"
#include "core/molecule/color_schemes.h"
#include "core/molecule/read_structure.h"

namespace meniscus {

/// What the common options say. Commands keep one of these alive as long as their CLI::App.
struct MoleculeOptions {
  std::string file;
  ReadOptions reading;
  ComputeOptions computing;
  ColorScheme color;
  bool quiet = false;
};

/// Where a command writes, and whether it may replace what is there.
struct OutputOptions {
  std::string path;
  bool force = false;
  Existing existing() const { return force ? Existing::replace : Existing::refuse; }
};

/// A molecule, ready to be drawn or exported; surface.atoms, structure.atoms and coloring.atom have equal order.
struct Molecule {
  Structure structure;
  ComputedSurface computed;
  Coloring coloring;
  const Surface& surface() const { return computed.surface; }
};

/// FILE, --keep-water, --keep-ions, --unknown-element, --quiet.
void add_file_options(CLI::App& command, MoleculeOptions& options);
/// --probe, --device, --verify, --threads.
void add_surface_options(CLI::App& command, MoleculeOptions& options);
/// --color, --color-range.
void add_color_options(CLI::App& command, MoleculeOptions& options);
/// All of the above.
void add_molecule_options(CLI::App& command, MoleculeOptions& options);
/// -o/--output (required, described by `what`) and --force.
void add_output_options(CLI::App& command, OutputOptions& options, const std::string& what);

/// Reads the file and says on stderr, unless quiet, what was read and left out, and each warning.
Structure read_molecule(const MoleculeOptions& options);

/// Reads, computes and colours, in that order; says on stderr what was read and on which device it ran.
Molecule load_molecule(const MoleculeOptions& options);

/// A line on stderr, unless quiet. Control characters are escaped.
void say(const MoleculeOptions& options, const std::string& line);

/// Progress on stderr: a bar on a terminal, plain lines elsewhere, nothing when quiet.
ProgressSink progress_on_stderr(const MoleculeOptions& options);

}  // namespace meniscus
