// SPDX-License-Identifier: BSD-3-Clause
// Makes triangle meshes of a surface, hands out their tables, and writes them as files.
#include "exporters/bindings/c/mesh.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/tessellate.h"
#include "core/scene/outputs.h"
#include "core/scene/surface_request.h"
#include "core/structure/structure.h"
#include "exporters/bindings/c/atom_colors.h"
#include "exporters/bindings/c/device.h"
#include "exporters/bindings/c/guard.h"
#include "exporters/bindings/c/caller_memory.h"
#include "exporters/mesh_files/file_object.h"
#include "exporters/mesh_files/mesh_formats.h"

namespace meniscus::c_api {

namespace {

const meniscus_mesh_options kDefaultMeshOptions{sizeof(meniscus_mesh_options), MENISCUS_MESH_BY_PATCH, 1,
                                                MeshOutput{}.tolerance, MeshOutput{}.density};

meniscus_mesh_options checked(const meniscus_mesh_options* given) {
  const meniscus_mesh_options options =
      given ? read_struct(given, kDefaultMeshOptions, "meniscus_mesh_options") : kDefaultMeshOptions;
  switch (options.method) {
    case MENISCUS_MESH_BY_PATCH:
    case MENISCUS_MESH_EVEN:
      check_number("mesh.tolerance", "tolerance", options.tolerance, "Å");
      if (options.density != kDefaultMeshOptions.density)
        refuse(MENISCUS_USAGE,
               "density is {}, which is only for MENISCUS_MESH_BY_DENSITY; choose that, or leave it at {}",
               options.density, kDefaultMeshOptions.density);
      break;
    case MENISCUS_MESH_BY_DENSITY:
      check_number("mesh.density", "density", options.density, "vertices per Å²");
      if (options.tolerance != kDefaultMeshOptions.tolerance)
        refuse(MENISCUS_USAGE, "tolerance is {} Å, which MENISCUS_MESH_BY_DENSITY does not keep to; leave it at {}",
               options.tolerance, kDefaultMeshOptions.tolerance);
      break;
    default:
      refuse(MENISCUS_USAGE, "method is {}, none of MENISCUS_MESH_BY_PATCH, _EVEN, _BY_DENSITY",
             static_cast<std::int32_t>(options.method));
  }
  return options;
}

MeshFineness fineness_of(const meniscus_mesh_options& wanted) {
  return {wanted.tolerance, {}, wanted.density, wanted.method == MENISCUS_MESH_EVEN};
}

FineMesh make_mesh(const Surface& surface, const meniscus_mesh_options& wanted, const MeshFineness& fineness) {
  if (wanted.method != MENISCUS_MESH_BY_PATCH || wanted.split_colors != 0) return fine_mesh(surface, fineness);
  FineMesh made{tessellate(surface, {wanted.tolerance, false}), {}, {}};
  made.vertex_face = vertex_faces(made.mesh);
  made.vertex_atom = vertex_atoms(made.mesh);
  return made;
}

meniscus_array find_table(const meniscus_mesh& made, std::int32_t table) {
  const TriangleMesh& mesh = made.made.mesh;
  switch (table) {
    case MENISCUS_MESH_POSITIONS:
      return table_of(mesh.positions);
    case MENISCUS_MESH_NORMALS:
      return table_of(mesh.normals);
    case MENISCUS_MESH_TRIANGLES:
      return table_of(mesh.triangles);
    case MENISCUS_MESH_TRIANGLE_ATOMS:
      return table_of(mesh.atom);
    case MENISCUS_MESH_TRIANGLE_KINDS:
      return table_of(mesh.kind);
    case MENISCUS_MESH_TRIANGLE_FACES:
      return table_of(mesh.face);
    case MENISCUS_MESH_TRIANGLE_PATCHES:
      return table_of(mesh.patch);
    case MENISCUS_MESH_TRIANGLE_COMPONENTS:
      return table_of(mesh.component);
    case MENISCUS_MESH_SHARP_CORNERS:
      return table_of(mesh.sharp_corners);
    case MENISCUS_MESH_SHARP_NORMALS:
      return table_of(mesh.sharp_corner_normals);
    case MENISCUS_MESH_VERTEX_ATOMS:
      return table_of(made.made.vertex_atom);
    default:
      refuse(MENISCUS_USAGE, "a mesh has no table {}", table);
  }
}

const meniscus_mesh_file kFileDefaults{sizeof(meniscus_mesh_file),
                                       nullptr,
                                       "usual",
                                       nullptr,
                                       MeshOutput{}.scale,
                                       {kPlainColor.x, kPlainColor.y, kPlainColor.z},
                                       0};

const MeshFormat& format_of(const meniscus_mesh_file& file, const char* path) {
  const MeshFormat* const found = file.format ? mesh_format(file.format) : mesh_format_of_path(path);
  if (!found && file.format)
    refuse(MENISCUS_USAGE, "format is {}, none of {}", in_quotes(file.format), mesh_format_words());
  if (!found)
    refuse(MENISCUS_USAGE, "{} does not end like a mesh file, and format is NULL; the formats are {}", in_quotes(path),
           mesh_format_words());
  return *found;
}

meniscus_mesh_file checked(const meniscus_mesh_file* given) {
  meniscus_mesh_file file = given ? read_struct(given, kFileDefaults, "meniscus_mesh_file") : kFileDefaults;
  check_range("scale", file.scale, kSmallestFileScale, kLargestFileScale);
  if (!file.attributes) file.attributes = kFileDefaults.attributes;
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
  const Coloring coloring = coloring_of({file.color[0], file.color[1], file.color[2]}, file.atom_colors, atoms.size());
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

meniscus_status meniscus_default_mesh_options(meniscus_mesh_options* options) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(options, kDefaultMeshOptions, "meniscus_mesh_options"); });
}

meniscus_status meniscus_surface_mesh(const meniscus_surface* surface, const meniscus_mesh_options* options,
                                      meniscus_mesh** mesh) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    require(mesh, "mesh");
    const meniscus_mesh_options wanted = checked(options);
    auto made = std::make_unique<meniscus_mesh>();
    made->of = surface->finished;
    made->fineness = fineness_of(wanted);
    run_on_threads(made->of->threads, [&] { made->made = make_mesh(made->of->surface, wanted, made->fineness); });
    *mesh = made.release();
  });
}

meniscus_mesh* meniscus_mesh_retain(meniscus_mesh* mesh) { return meniscus::c_api::retain(mesh); }
void meniscus_mesh_release(meniscus_mesh* mesh) { meniscus::c_api::release(mesh); }

meniscus_status meniscus_mesh_table(const meniscus_mesh* mesh, meniscus_mesh_table_id table, meniscus_array* array) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(mesh, "mesh");
    require(array, "array");
    *array = find_table(*mesh, table);
  });
}

meniscus_status meniscus_default_mesh_file(meniscus_mesh_file* file) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(file, kFileDefaults, "meniscus_mesh_file"); });
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
