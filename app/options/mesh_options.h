// SPDX-License-Identifier: BSD-3-Clause
// The options of exports that write a mesh.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "core/mesh/mesh_objects.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus {

/// What a camera is for: nothing finer can be seen.
inline constexpr double kPixelsOfACamera = 0.5;

/// --tolerance and --tolerance-pixels, with the default that the request has: pixels if it has some, else Å. The
/// request must live as long as the command.
void add_mesh_options(CLI::App& command, MeshRequest& request);
/// A tolerance in Å counts instead of pixels by default. For when the options are read.
void take_tolerance(const CLI::App& command, MeshRequest& request);

/// What `export mesh` says of its file beside that.
struct MeshFileOptions {
  MeshRequest mesh{0.05, 0.0};
  double density = 0.0;  ///< vertices per Å²; 0: by tolerance
  bool even = false;
  std::string format;  ///< empty: by the ending of the output
  std::string attributes = "usual";
  double scale = 1.0;  ///< of the file's unit: what 1 Å is

  /// The format of a file of this name. Throws UsageError where nothing says which it is.
  const MeshFormat& format_of(const std::string& path) const;
};

/// --tolerance, --tolerance-pixels, --density, --even, --format, --attributes, --unit, --scale. `options` must live as
/// long as the command.
void add_mesh_file_options(CLI::App& command, MeshFileOptions& options);

/// Without a tolerance or a density, half a pixel of the camera that was given, if one was.
void take_camera_for_tolerance(const CLI::App& command, bool has_camera, MeshFileOptions& options);

}  // namespace meniscus
