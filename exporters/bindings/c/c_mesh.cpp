// SPDX-License-Identifier: BSD-3-Clause
// Makes triangle meshes of a surface, returns their tables, and writes them to files.

#include "core/base/text.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/tessellate.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/outputs.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_surface.h"
#include "exporters/mesh_files/mesh_formats.h"

/// The object behind the handle of a mesh.
struct meniscus_mesh : meniscus::c_api::Counted {
  std::shared_ptr<const meniscus::c_api::FinishedSurface> surface;
  meniscus::MeshFineness fineness;
  meniscus::FineMesh fine_mesh;
};

namespace meniscus::c_api {

namespace {

const meniscus_mesh_options kDefaultMeshOptions{sizeof(meniscus_mesh_options), MENISCUS_MESH_BY_PATCH, 1,
                                                MeshOutput{}.tolerance, MeshOutput{}.density};

/// Returns the options of a caller, or the defaults for NULL. Refuses impossible options.
meniscus_mesh_options checked(const meniscus_mesh_options* given) {
  const meniscus_mesh_options options = read_options(given, kDefaultMeshOptions, "meniscus_mesh_options");
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

MeshFineness fineness_of(const meniscus_mesh_options& options) {
  return {options.tolerance, {}, options.density, options.method == MENISCUS_MESH_EVEN};
}

FineMesh make_mesh(const Surface& surface, const meniscus_mesh_options& options, const MeshFineness& fineness) {
  if (options.method != MENISCUS_MESH_BY_PATCH || options.split_colors != 0) return fine_mesh(surface, fineness);
  FineMesh result{tessellate(surface, {options.tolerance, false}), {}, {}};
  result.vertex_face = vertex_faces(result.mesh);
  result.vertex_atom = vertex_atoms(result.mesh);
  return result;
}

meniscus_array find_table(const FineMesh& fine_mesh, std::int32_t table) {
  const TriangleMesh& mesh = fine_mesh.mesh;
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
      return table_of(fine_mesh.vertex_atom);
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
  meniscus_mesh_file file = read_options(given, kFileDefaults, "meniscus_mesh_file");
  check_range("scale", file.scale, kSmallestFileScale, kLargestFileScale);
  if (!file.attributes) file.attributes = kFileDefaults.attributes;
  return file;
}

/// Returns the atoms of a surface with their van der Waals radii; the balls of a sas surface are larger by the probe.
/// The indices of atoms are those of the caller's arrays; each atom is a residue, with a number from 1.
std::vector<Atom> bare_atoms(const FinishedSurface& finished) {
  const double probe = finished.kind == SurfaceKind::sas ? finished.probe_radius : 0.0;
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
  const FinishedSurface& finished = *mesh.surface;
  const MeshFormat& format = format_of(file, path);
  const std::vector<std::string> numbers = parse_vertex_numbers(file.attributes, AtomSource::bare);
  const std::vector<Atom> atoms = bare_atoms(finished);
  const Coloring coloring = coloring_of({file.color[0], file.color[1], file.color[2]}, file.atom_colors, atoms.size());
  std::vector<std::uint32_t> places(atoms.size());
  for (std::uint32_t a = 0; a < places.size(); ++a) places[a] = a;
  MeshFileMaker maker(
      {mesh.fineness, format.numbers ? numbers : std::vector<std::string>{}, file.scale, atoms, {}, format.solid},
      about_line(kind_word(finished.kind), file.scale, mesh.fineness));
  maker.add({"surface", finished.whole(), coloring, places}, mesh.fine_mesh);
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
    const meniscus_mesh_options complete = checked(options);
    auto result = std::make_unique<meniscus_mesh>();
    const FinishedSurface& finished = *surface->finished;
    const meniscus::Surface& whole = finished.whole();
    result->surface = surface->finished;
    result->fineness = fineness_of(complete);
    run_on_threads(finished.threads, [&] { result->fine_mesh = make_mesh(whole, complete, result->fineness); });
    *mesh = result.release();
  });
}

meniscus_mesh* meniscus_mesh_retain(meniscus_mesh* mesh) { return meniscus::c_api::retain(mesh); }
void meniscus_mesh_release(meniscus_mesh* mesh) { meniscus::c_api::release(mesh); }

meniscus_status meniscus_mesh_table(const meniscus_mesh* mesh, meniscus_mesh_table_id table, meniscus_array* array) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(mesh, "mesh");
    require(array, "array");
    *array = find_table(mesh->fine_mesh, table);
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
    const meniscus_mesh_file complete = checked(file);
    run_on_threads(mesh->surface->threads, [&] { save(*mesh, path, complete); });
  });
}
