// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of meshes: how fine they are, and their file.
#include "app/options/mesh_options.h"

#include <vector>

#include <fmt/format.h>

#include "app/options/property_options.h"
#include "app/process/program_error.h"
#include "core/base/text.h"
#include "core/mesh/mesh_fineness.h"
#include "core/mesh/mesh_objects.h"
#include "exporters/mesh_files/vertex_numbers.h"

namespace meniscus {
namespace {

/// As CLI11 names the options that exclude each other.
struct FinenessOptions {
  CLI::Option *angstrom, *pixels;
};

/// The help shows the default in the unit that is in force.
FinenessOptions add_tolerances(PropertyOptions& options, MeshRequest& request) {
  const bool by_pixels = request.tolerance_pixels > 0.0;
  const auto with_default = [](const char* key, double value, bool in_force) {
    const std::string help = help_of(property_of(key));
    return in_force ? fmt::format("{} [{}]", help, value) : help;
  };
  CLI::Option* const angstrom = options.add("mesh.tolerance", request.tolerance);
  angstrom->description(with_default("mesh.tolerance", request.tolerance, !by_pixels));
  CLI::Option* const pixels = options.add("mesh.tolerance_pixels", request.tolerance_pixels);
  pixels->description(with_default("mesh.tolerance_pixels", request.tolerance_pixels, by_pixels))->excludes(angstrom);
  return {angstrom, pixels};
}

}  // namespace

void add_mesh_options(CLI::App& command, MeshRequest& request) {
  PropertyOptions options(command);
  add_tolerances(options, request);
}

const MeshFormat& MeshFileOptions::format_of(const std::string& path) const {
  const MeshFormat* const found = format.empty() ? mesh_format_of_path(path) : mesh_format(format);
  if (!found)
    throw UsageError(fmt::format("{} ends as no mesh file does; --format says which it is: {}", in_quotes(path),
                                 mesh_format_words()));
  return *found;
}

void add_mesh_file_options(CLI::App& command, MeshFileOptions& file) {
  PropertyOptions options(command);
  const FinenessOptions tolerances = add_tolerances(options, file.mesh);
  options.add("mesh.density", file.density)->excludes(tolerances.angstrom)->excludes(tolerances.pixels);
  options.add("mesh.even", file.even);
  std::vector<std::string> words;
  for (const MeshFormat& format : mesh_formats()) words.emplace_back(format.word);
  options.add("mesh.format", file.format)
      ->description(help_of(property_of("mesh.format")) + ": " + mesh_format_words())
      ->check(one_of(words));
  std::vector<std::string> names{"usual", "all", "none"};
  for (const VertexNumberKind& kind : vertex_number_kinds()) names.emplace_back(kind.name);
  options.add("mesh.attributes", file.attributes)->check(proposes(names));
  constexpr double kNanometers = 0.1;
  CLI::Option* const unit = options.add_word("mesh.unit", file.scale, {1.0, kNanometers});
  options.add("mesh.scale", file.scale)->excludes(unit);
}

void take_tolerance(const CLI::App& command, MeshRequest& request) {
  if (command.count("--tolerance") > 0) request.tolerance_pixels = 0.0;
}

void take_camera_for_tolerance(const CLI::App& command, bool has_camera, MeshFileOptions& options) {
  const bool asked =
      command.count("--tolerance") + command.count("--tolerance-pixels") + command.count("--density") > 0;
  if (has_camera && !asked) options.mesh.tolerance_pixels = kPixelsOfACamera;
}

}  // namespace meniscus
