// SPDX-License-Identifier: BSD-3-Clause
// Declares the mesh options.
#include "app/options/mesh_options.h"

#include <map>
#include <vector>

#include <fmt/format.h>

#include "app/options/value_words.h"
#include "app/process/program_error.h"
#include "core/base/text.h"
#include "core/mesh/mesh_fineness.h"
#include "exporters/mesh_files/vertex_numbers.h"

namespace meniscus {
namespace {

/// As CLI11 names the options that exclude each other.
struct FinenessOptions {
  CLI::Option *angstrom, *pixels;
};

FinenessOptions add_tolerances(CLI::App& command, MeshRequest& request) {
  const bool by_pixels = request.tolerance_pixels > 0.0;
  CLI::Option* const angstrom = command.add_option(
      "--tolerance", request.tolerance,
      "Farthest the mesh may be from the surface, in Å" + (by_pixels ? "" : fmt::format(" [{}]", request.tolerance)));
  angstrom->type_name("Å")->check(CLI::Range(kSmallestTolerance, kLargestTolerance));
  CLI::Option* const pixels =
      command.add_option("--tolerance-pixels", request.tolerance_pixels,
                         "The same in pixels of the picture" +
                             (by_pixels ? fmt::format(" [{}]", request.tolerance_pixels) : ", e.g. 0.25"));
  pixels->type_name("PIXELS")->check(CLI::Range(1e-3, 100.0))->excludes(angstrom);
  return {angstrom, pixels};
}

void add_units(CLI::App& command, MeshFileOptions& options) {
  const std::map<std::string, double> units{{"angstrom", 1.0}, {"nanometer", 0.1}};
  CLI::Option* const unit =
      command.add_option("--unit", options.scale, "Unit of the file: angstrom or nanometer [angstrom]");
  unit->type_name("UNIT")->transform(one_of(units));
  command
      .add_option("--scale", options.scale,
                  "Length in the file of 1 Å [1]; 3MF has millimetres and GLB metres, others no unit of their own")
      ->type_name("LENGTH")
      ->check(CLI::Range(kSmallestFileScale, kLargestFileScale).description(""))
      ->excludes(unit);
}

}  // namespace

void add_mesh_options(CLI::App& command, MeshRequest& request) { add_tolerances(command, request); }

const MeshFormat& MeshFileOptions::format_of(const std::string& path) const {
  const MeshFormat* const found = format.empty() ? mesh_format_of_path(path) : mesh_format(format);
  if (!found)
    throw UsageError(fmt::format("{} ends as no mesh file does; --format says which it is: {}", in_quotes(path),
                                 mesh_format_words()));
  return *found;
}

void add_mesh_file_options(CLI::App& command, MeshFileOptions& options) {
  const FinenessOptions tolerances = add_tolerances(command, options.mesh);
  command
      .add_option("--density", options.density, "Instead: vertices per Å², down to one triangle an atom (0.02); even")
      ->type_name("NUMBER")
      ->check(CLI::Range(kSmallestDensity, kLargestDensity))
      ->excludes(tolerances.angstrom)
      ->excludes(tolerances.pixels);
  command.add_flag("--even", options.even, "Nearly equilateral triangles, which reach over borders of patches");
  std::vector<std::string> words;
  for (const MeshFormat& format : mesh_formats()) words.emplace_back(format.word);
  command.add_option("--format", options.format, "Format, if the ending does not say it: " + mesh_format_words())
      ->type_name("WORD")
      ->check(one_of(words));
  std::vector<std::string> names{"usual", "all", "none"};
  for (const VertexNumberKind& kind : vertex_number_kinds()) names.emplace_back(kind.name);
  command
      .add_option("--attributes", options.attributes,
                  "Numbers of vertices in PLY, VTP and GLB, with commas between; docs/meshes.md has them [usual]")
      ->type_name("NAMES")
      ->check(proposes(names));
  add_units(command, options);
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
