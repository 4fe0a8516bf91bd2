// SPDX-License-Identifier: BSD-3-Clause
// The options that commands share: which atoms, which surface, which colours, where it goes.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/compute.h"
#include "core/base/output_file.h"
#include "core/base/progress.h"
#include "core/structure/atom_groups.h"
#include "core/color/color_schemes.h"
#include "core/structure/formats/read_structure.h"

namespace meniscus {

/// How much is said about the oddities of a file: a line for every atom, a sentence for every kind, nothing.
enum class WarningDetail { full, summary, none };

/// Which closed parts of the surface are taken.
enum class Cavities {
  keep,  ///< all of them
  drop,  ///< those that the outside reaches: no cavities, and nothing that lies in one
  only   ///< the others
};

/// What becomes of the copies of an assembly.
enum class InstanceMode {
  none,     ///< they are atoms like all others, under one surface
  exact,    ///< one copy is computed; refused unless that gives the surface of the whole
  separate  ///< one copy is computed as if alone
};

/// What the surface is divided into.
struct DivisionOptions {
  std::optional<Grouping> groups;  ///< each group of atoms has a surface of its own, as if it were alone
  bool components = false;         ///< each closed part is an object
  Cavities cavities = Cavities::keep;
  InstanceMode instances = InstanceMode::none;
};

/// What the common options say. Commands keep one of these alive as long as their CLI::App.
struct MoleculeOptions {
  std::string file;
  ReadOptions reading;
  std::optional<Selection> show;  ///< of the atoms taken, those whose part of the surface is drawn and exported
  ComputeOptions computing;
  DivisionOptions division;
  ColorScheme color;
  std::string color_file;  ///< --color-by-file, read by load_molecule
  WarningDetail warnings = WarningDetail::summary;
  bool quiet = false;
};

/// Where a command writes, and whether it may replace what is there.
struct OutputOptions {
  std::string path;
  bool force = false;
  Existing existing() const { return force ? Existing::replace : Existing::refuse; }
};

/// FILE and what is taken from it (atom_options.cpp): --model, --altloc, --keep-water, --keep-ions, --unknown-element,
/// --quiet.
void add_atom_options(CLI::App& command, MoleculeOptions& options);
/// Understands an expression that is the value of an option. Throws SelectionError, which names the option.
Selection parse_selection_option(const std::string& option, const std::string& text);
/// FILE alone, and --warnings and --quiet, for commands that take everything.
void add_file_argument(CLI::App& command, MoleculeOptions& options);
void add_warning_options(CLI::App& command, MoleculeOptions& options);
/// Which copies of it there are (assembly_options.cpp): --assembly, --instances. Comes with add_atom_options.
void add_assembly_options(CLI::App& command, MoleculeOptions& options);
/// Which radii they get (radii_options.cpp): --hydrogens, --radii, --radii-file, --radius; part of the above.
void add_radii_options(CLI::App& command, ReadOptions& reading);
/// How the surface is made of them (surface_options.cpp): --surface, --probe, --device, --require-gpu,
/// --verify, --threads.
void add_surface_options(CLI::App& command, MoleculeOptions& options);
void add_probe_option(CLI::App& command, ComputeOptions& computing);
/// Reads CUDA_VISIBLE_DEVICES, and the number of this worker in kWorkerVariable or SLURM_LOCALID: see DeviceChoice.
void add_device_option(CLI::App& command, ComputeOptions& computing);
/// What `meniscus work` tells the programs it starts: from 0, which of the workers on this machine they belong to.
inline constexpr const char* kWorkerVariable = "MENISCUS_WORKER";
/// What is wrong with a probe radius (Å) and what would be right; empty if nothing is.
std::string probe_fault(double radius);
/// Into which objects it is divided (surface_options.cpp): --by, --cavities.
void add_division_options(CLI::App& command, MoleculeOptions& options);
/// How it is coloured (color_options.cpp): --color, --color-by-file, --map, --color-range, --missing-color.
void add_color_options(CLI::App& command, MoleculeOptions& options);
/// All of the above.
void add_molecule_options(CLI::App& command, MoleculeOptions& options);
/// -o/--output (required, described by `what`) and --force.
void add_output_options(CLI::App& command, OutputOptions& options, const std::string& what);

/// Options added while this lives stand under a heading of their own in the help.
class Heading {
 public:
  Heading(CLI::App& command, const char* text);
  ~Heading();
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;

 private:
  CLI::App& command_;
};

/// A line on stderr, unless quiet. Control characters are escaped.
void say(const MoleculeOptions& options, const std::string& line);

/// The warnings about a file on stderr, as detailed as wanted, unless quiet.
void say_warnings(const MoleculeOptions& options, const Structure& structure);

/// Progress on stderr: a bar on a terminal, plain lines elsewhere, nothing when quiet.
ProgressSink progress_on_stderr(const MoleculeOptions& options);

}  // namespace meniscus
