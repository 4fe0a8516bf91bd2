// SPDX-License-Identifier: BSD-3-Clause
// Meshes of the C interface as files: by the writers of the program, for atoms of which no more than balls is known.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/scene/surface_request.h"
#include "exporters/bindings/c/atom_colors.h"
#include "exporters/bindings/c/cpu_threads.h"
#include "exporters/bindings/c/guard.h"
#include "exporters/bindings/c/mesh.h"
#include "exporters/bindings/c/sized_struct.h"
#include "exporters/mesh_files/file_object.h"
#include "exporters/mesh_files/mesh_formats.h"
#include "core/structure/structure.h"

namespace meniscus::c_api {
namespace {

const meniscus_mesh_file kDefaults{sizeof(meniscus_mesh_file), nullptr, "usual", nullptr, 1.0, {0.75f, 0.82f, 0.9f}, 0};

const MeshFormat& format_of(const meniscus_mesh_file& file, const char* path) {
  const MeshFormat* const found = file.format ? mesh_format(file.format) : mesh_format_of_path(path);
  if (!found && file.format)
    refuse(MENISCUS_USAGE, "format is {}, none of {}", in_quotes(file.format), mesh_format_words());
  if (!found)
    refuse(MENISCUS_USAGE, "{} ends as no mesh file does, and format is NULL; there are {}", in_quotes(path),
           mesh_format_words());
  return *found;
}

meniscus_mesh_file checked(const meniscus_mesh_file* given) {
  meniscus_mesh_file file = given ? read_struct(given, kDefaults, "meniscus_mesh_file") : kDefaults;
  check_range("scale", file.scale, kSmallestFileScale, kLargestFileScale);
  if (!file.attributes) file.attributes = kDefaults.attributes;
  return file;
}

SurfaceKind kind_of(const FinishedSurface& finished) {
  return finished.kind == MENISCUS_SES   ? SurfaceKind::ses
         : finished.kind == MENISCUS_SAS ? SurfaceKind::sas
                                         : SurfaceKind::vdw;
}

/// Balls of an accessible surface are larger by the probe. Atoms are numbered as the caller's arrays have them, their
/// residues, too, from 1.
std::vector<Atom> bare_atoms(const FinishedSurface& finished) {
  const double probe = finished.kind == MENISCUS_SAS ? finished.probe_radius : 0.0;
  std::vector<Atom> atoms;
  for (const Ball& ball : finished.surface.atoms) {
    Atom& atom = atoms.emplace_back();
    atom.position = ball.center;
    atom.radius = ball.radius - probe;
    atom.index = static_cast<std::uint32_t>(atoms.size() - 1);
    atom.residue_number = static_cast<std::int32_t>(atoms.size());
  }
  return atoms;
}

void save(const meniscus_mesh& mesh, const char* path, const meniscus_mesh_file& file) {
  const FinishedSurface& finished = *mesh.of;
  const MeshFormat& format = format_of(file, path);
  const std::vector<std::string> numbers = parse_vertex_numbers(file.attributes, AtomSource::bare);
  const std::vector<Atom> atoms = bare_atoms(finished);
  const Coloring coloring = coloring_of(file.color, file.atom_colors, atoms.size());
  std::vector<std::uint32_t> places(atoms.size());
  for (std::uint32_t a = 0; a < places.size(); ++a) places[a] = a;
  MeshFileMaker maker(
      {mesh.fineness, format.numbers ? numbers : std::vector<std::string>{}, file.scale, atoms, {}, format.solid},
      about_line(kind_word(kind_of(finished)), file.scale, mesh.fineness));
  maker.add({"surface", finished.surface, coloring, places}, mesh.made);
  write_mesh_file(format, path, file.replace ? Existing::replace : Existing::refuse, maker.take());
}

}  // namespace
}  // namespace meniscus::c_api

meniscus_status meniscus_default_mesh_file(meniscus_mesh_file* file) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(file, kDefaults, "meniscus_mesh_file"); });
}

meniscus_status meniscus_mesh_save(const meniscus_mesh* mesh, const char* path, const meniscus_mesh_file* file) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(mesh, "mesh");
    require(path, "path");
    const meniscus_mesh_file wanted = checked(file);
    run_on_threads(mesh->of->threads, [&] { save(*mesh, path, wanted); });
  });
}
