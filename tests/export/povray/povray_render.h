// SPDX-License-Identifier: BSD-3-Clause
// Runs POV-Ray on an exported scene and reads the buffers it renders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus::testing {

struct PovrayRun {
  int exit_code = -1;
  std::string log;
  std::size_t finite_objects = 0;  ///< POV-Ray's own count
  std::size_t infinite_objects = 0;
  std::vector<std::string> warnings;  ///< lines that warn, without those about the user's missing configuration
};

/// Runs `povray ARGUMENTS` in `folder`, without a window.
PovrayRun run_povray(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// The largest count of layers: 16 bits distinguish no more.
inline constexpr int kMostLayers = 255;

/// Values of the buffer include, one entry a pixel, rows from the top. Where nothing was hit only `hit` counts.
struct Buffers {
  int width = 0, height = 0;
  std::vector<char> hit;
  std::vector<glm::dvec3> position;  ///< Å, in the scene's coordinates
  std::vector<glm::dvec3> normal;    ///< on the viewer's side
  std::vector<int> kind, color;
  std::vector<int> layers;  ///< surface layers along the whole ray; kMostLayers: at least so many
};

/// Renders the four buffers of the scene `name` of width x height pixels in one run of POV-Ray.
Buffers render_buffers(const std::filesystem::path& folder, const std::string& name, int width, int height,
                       PovrayRun* run = nullptr);

/// Returns the pixels of an image as RGBA in [0, 1], without colour conversion.
std::vector<glm::dvec3> read_rgb(const std::filesystem::path& file, std::vector<double>* alpha = nullptr);

void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace meniscus::testing
