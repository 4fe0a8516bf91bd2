// SPDX-License-Identifier: BSD-3-Clause
// The program `meniscus-nanoshaper`: NanoShaper's configuration file and its files of triangles for exact surfaces.
#include <cstdint>
#include <iostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/msms/shaper_settings.h"
#include "app/msms/spheres.h"
#include "app/msms/write_files.h"
#include "app/process/program_error.h"
#include "app/process/program_main.h"
#include "app/process/standard_streams.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/mesh/even_mesh.h"
#include "core/surface/compute_surface.h"
#include "exporters/msms/msms_files.h"
#include "exporters/msms/numbered_mesh.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus::msms {
namespace {

constexpr const char* kHelp = R"(meniscus-nanoshaper [FILE]: exact solvent-excluded surfaces where NanoShaper is called

Reads FILE (surfaceConfiguration.prm) and writes even triangles of the whole surface into the current folder, or where
Root_FileName says: triangulatedSurf.vert and triangulatedSurf.face where Save_Mesh_MSMS_Format is true,
triangulatedSurf.off where it is false, all three where it is not given. Keys: XYZR_FileName, Probe_Radius (1.4),
Grid_scale (2: 1.5 times its square are the vertices per square Angstrom), Cavity_Detection_Filling (false) and
Conditional_Volume_Filling_Value (11.4). Refused is what asks for another result: a Surface but ses, an Operative_Mode
but normal, PLY, maps. Other keys change nothing; unknown ones are named on standard error.
Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 bad input, 5 too large, 6 output not written, 7 not closed.
)";

MsmsFaceKind kind_of(PatchKind kind) {
  if (kind == PatchKind::convex) return MsmsFaceKind::contact;
  return kind == PatchKind::concave ? MsmsFaceKind::reentrant : MsmsFaceKind::toric;
}

/// Cavities that are to be filled have no triangles.
std::vector<bool> components_that_stay(const Surface& surface, const ShaperSettings& settings) {
  std::vector<bool> stays;
  for (const Component& component : surface.components)
    stays.push_back(!settings.fill_cavities || component.kind == ComponentKind::outer ||
                    -component.volume >= settings.smallest_cavity);
  return stays;
}

MsmsMesh rows_of(const FineMesh& even, const std::vector<bool>& stays) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> row(even.mesh.positions.size(), kUnused);
  MsmsMesh rows;
  for (std::size_t t = 0; t < even.mesh.triangles.size(); ++t) {
    if (!stays[even.mesh.component[t]]) continue;
    MsmsTriangle triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = even.mesh.triangles[t][c];
      if (row[vertex] == kUnused) {
        row[vertex] = static_cast<std::uint32_t>(rows.vertices.size());
        rows.vertices.push_back(
            {even.mesh.positions[vertex], even.mesh.normals[vertex], 0, even.vertex_atom[vertex], 0});
      }
      triangle.corner[c] = row[vertex];
    }
    triangle.kind = kind_of(even.mesh.kind[t]);
    triangle.face = even.mesh.face[t] + 1;
    rows.triangles.push_back(triangle);
  }
  weld_for_files(rows);
  return rows;
}

ExitCode run(std::span<const char* const> words) {
  std::string path = "surfaceConfiguration.prm";
  if (words.size() == 1) path = words.front();
  if (words.size() == 1 && (path == "-h" || path == "--help")) {
    std::cout << kHelp;
    finish_standard_output();
    return kExitOk;
  }
  if (words.size() > 1 || path.starts_with('-')) throw UsageError("give one configuration file, or none; see --help");
  const ShaperSettings settings = read_shaper_settings(path);
  for (const std::string& key : settings.unknown_keys)
    fmt::print(std::cerr, "meniscus-nanoshaper: warning: {}: {} is no key of NanoShaper and changes nothing\n",
               escaped(path), in_quotes(key));
  const std::string vert = settings.root + "triangulatedSurf.vert", face = settings.root + "triangulatedSurf.face",
                    off = settings.root + "triangulatedSurf.off";
  OutputFiles files;
  for (const std::string& input : {path, settings.spheres}) protect_input(input);
  if (settings.msms_files)
    for (const std::string& name : {vert, face}) files.begin(name);
  if (settings.off_file) files.begin(off);
  Spheres spheres = read_spheres(settings.spheres);
  spheres.rows.names.clear();  // nine columns, always
  const Surface surface = compute_surface_cpu(spheres.balls, settings.probe_radius);
  require_closed(surface);
  EvenMeshOptions fineness;
  fineness.density = shaper_density(settings.grid_scale);
  const MsmsMesh mesh = rows_of(even_mesh(surface, fineness), components_that_stay(surface, settings));
  const MsmsHeader header{true, fineness.density, settings.probe_radius};
  if (settings.msms_files) {
    files.write(vert, vert_text(mesh, spheres.rows, header));
    files.write(face, face_text(mesh, spheres.rows, header));
  }
  if (settings.off_file) files.write(off, off_text(mesh));
  fmt::print(std::cout, "{}: {} spheres, {} vertices, {} triangles\n", escaped(settings.spheres), spheres.rows.count,
             mesh.vertices.size(), mesh.triangles.size());
  finish_standard_output();
  files.commit();
  return kExitOk;
}

}  // namespace
}  // namespace meniscus::msms

int main(int argc, char** argv) {
  using namespace meniscus;
  return program_main("meniscus-nanoshaper",
                      [=] { return msms::run(std::span<const char* const>(argv + 1, argv + argc)); });
}
