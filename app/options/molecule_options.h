// SPDX-License-Identifier: BSD-3-Clause
// The options that commands share: which atoms, which surface, which colours, where it goes.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "core/base/output_file.h"
#include "core/base/progress.h"
#include "core/scene/molecule.h"

namespace meniscus {

/// How much is said about the oddities of a file: a line for every atom, a sentence for every kind, nothing.
enum class WarningDetail { full, summary, none };

/// What the common options say: a molecule, and how much is told of it. Commands keep one of these alive as long as
/// their CLI::App.
struct MoleculeOptions : MoleculeRequest {
  WarningDetail warnings = WarningDetail::summary;
  bool quiet = false;
};

/// Where a command writes, and whether it may replace what is there.
struct OutputOptions {
  std::string path;
  bool force = false;
  Existing existing() const { return force ? Existing::replace : Existing::refuse; }
};

/// FILE and what is taken from it: --model, --altloc, --select, --keep-water, ...; radii and assemblies.
void add_atom_options(CLI::App& command, MoleculeOptions& options);
/// FILE alone, and --warnings and --quiet, for commands that take everything.
void add_file_argument(CLI::App& command, MoleculeOptions& options);
void add_warning_options(CLI::App& command, MoleculeOptions& options);
/// How the surface is made of them (surface_options.cpp): --surface, --probe, --device, --require-gpu,
/// --verify, --threads.
void add_surface_options(CLI::App& command, MoleculeOptions& options);
void add_kind_option(CLI::App& command, SurfaceRequest& surface);
void add_probe_option(CLI::App& command, SurfaceRequest& surface);
void add_threads_option(CLI::App& command, SurfaceRequest& surface);
/// Reads CUDA_VISIBLE_DEVICES, the number of this worker in kWorkerVariable or SLURM_LOCALID, and kKernelVariable: see
/// DeviceChoice.
void add_device_option(CLI::App& command, SurfaceRequest& surface);
/// What `meniscus work` tells the programs it starts: from 0, which of the workers on this machine they belong to.
inline constexpr const char* kWorkerVariable = "MENISCUS_WORKER";
/// "off": compiled kernels are not kept beside other caches of the user.
inline constexpr const char* kKernelVariable = "MENISCUS_KERNEL_CACHE";
/// Into which objects it is divided (surface_options.cpp): --by, --cavities.
void add_division_options(CLI::App& command, MoleculeOptions& options);
/// How it is coloured (color_options.cpp): --color, --color-by-file, --map, --color-range, --missing-color.
void add_color_options(CLI::App& command, MoleculeOptions& options);
/// How much of what lies behind it is seen through it (color_options.cpp): --opacity.
void add_opacity_option(CLI::App& command, MoleculeOptions& options);
/// All of the above but the last.
void add_molecule_options(CLI::App& command, MoleculeOptions& options);
/// Must an output be named?
enum class OutputName { required, optional };
/// -o/--output (described by `what`) and --force.
void add_output_options(CLI::App& command, OutputOptions& options, const std::string& what,
                        OutputName name = OutputName::required);

}  // namespace meniscus
