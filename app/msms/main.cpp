// SPDX-License-Identifier: BSD-3-Clause
// The program `meniscus-msms`: MSMS's command line, files and words for exact surfaces.
#include <chrono>
#include <iostream>
#include <span>
#include <string>

#include "app/msms/arguments.h"
#include "app/msms/chosen_surface.h"
#include "app/msms/report.h"
#include "app/msms/serve.h"
#include "app/msms/spheres.h"
#include "app/msms/write_files.h"
#include "app/process/program_error.h"
#include "app/process/program_main.h"
#include "app/process/standard_streams.h"
#include "core/base/output_file.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {
namespace {

std::string with_extension(const std::string& path, const std::string& extension) {
  return path.ends_with(extension) ? path : path + extension;
}

/// P.vert for component 0, P_k.vert for component k.
std::string mesh_path(const Arguments& arguments, std::size_t component, const char* extension) {
  return arguments.mesh_files + (component ? "_" + std::to_string(component) : "") + extension;
}

void run(const Arguments& arguments, std::chrono::steady_clock::time_point start) {
  const bool mesh_wanted = arguments.mesh && !arguments.mesh_files.empty();
  // Whether they can be written is known before the work begins.
  OutputFiles files;
  protect_input(arguments.spheres);
  if (mesh_wanted)
    for (const char* extension : {".vert", ".face"}) files.begin(mesh_path(arguments, 0, extension));
  const std::string area_path = arguments.area_file.empty() ? "" : with_extension(arguments.area_file, ".area");
  if (!area_path.empty()) files.begin(area_path);

  Spheres spheres = read_spheres(arguments.spheres);
  if (!arguments.hydrogens) leave_out_hydrogens(spheres);
  std::cout << input_lines(arguments, spheres.rows.count, spheres.smallest_radius, spheres.largest_radius);
  ChosenSurface surface(arguments, spheres);
  if (arguments.all_components) std::cout << component_lines(surface.component_count());
  const std::vector<ReducedComponentSize> sizes = surface.sizes();
  if (arguments.area) std::cout << analytic_table(arguments.probe_radius, sizes);
  if (!area_path.empty()) files.write(area_path, area_text(surface.areas(), spheres.rows));
  if (mesh_wanted) {
    surface.triangulate();
    const MsmsHeader header{arguments.header, arguments.density, arguments.probe_radius};
    for (std::size_t c = 0; c < surface.component_count(); ++c) {
      const MsmsMesh mesh = surface.mesh(c);
      files.write(mesh_path(arguments, c, ".vert"), vert_text(mesh, spheres.rows, header));
      files.write(mesh_path(arguments, c, ".face"), face_text(mesh, spheres.rows, header));
    }
  }
  if (arguments.mesh) std::cout << numeric_table(arguments.probe_radius, sizes);
  files.commit();
  std::cout << ending(start);
}

ExitCode run(std::span<const char* const> words) {
  const auto start = std::chrono::steady_clock::now();
  const Arguments arguments = parse_arguments(words);
  if (arguments.help) {
    std::cerr << help_text();
    return kExitOk;
  }
  std::cout << banner();
  if (arguments.port) {
    std::cout.flush();
    serve(*arguments.port);
  } else if (arguments.spheres.empty()) {
    std::cerr << "MSMS: No input stream specified\n";
    return kExitUsage;
  } else {
    run(arguments, start);
  }
  finish_standard_output();
  return kExitOk;
}

}  // namespace
}  // namespace meniscus::msms

int main(int argc, char** argv) {
  using namespace meniscus;
  return program_main("meniscus-msms", [=] { return msms::run(std::span<const char* const>(argv + 1, argv + argc)); });
}
