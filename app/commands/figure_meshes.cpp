// SPDX-License-Identifier: BSD-3-Clause
// Makes the meshes of a figure for Blender, path tracers and viewers.
#include "app/commands/figure_meshes.h"

#include "app/reports/notes.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/copies.h"

namespace meniscus {
namespace {

constexpr double kManyTriangles = 1e7;

}  // namespace

bool has_fineness(const SceneOptions& options) {
  return options.is_given("mesh.tolerance") || options.is_given("mesh.tolerance_pixels") ||
         options.is_given("mesh.density");
}

double expected_triangles(std::span<const SurfaceObject> objects, const MeshFineness& fineness, CopiesOfMesh copies) {
  double triangles = 0.0;
  for (const SurfaceObject& object : objects)
    triangles += (copies == CopiesOfMesh::own ? static_cast<double>(object.copies.size()) : 1.0) *
                 estimated_triangles(object.surface, fineness);
  return triangles;
}

void warn_of_many(const SceneCommand& command, double expected_triangles) {
  if (expected_triangles > kManyTriangles)
    log_line(command, fmt::format("warning: about {:.0f} million triangles; a larger --tolerance or a smaller "
                                  "--density makes fewer",
                                  expected_triangles / 1e6));
}

std::string fineness_words(const MeshRequest& request, const MeshFineness& fineness) {
  if (fineness.density > 0.0)
    return fmt::format("with {:g} {} per Å²", fineness.density, fineness.density == 1.0 ? "vertex" : "vertices");
  if (fineness.tolerance_at)
    return fmt::format("within {:g} pixels of the surface, {:.4g} Å or more", request.tolerance_pixels,
                       fineness.tolerance);
  return fmt::format("within {:.4g} Å of the surface", fineness.tolerance);
}

void refuse_even_parts(const MeshFineness& fineness, bool has_hidden_atoms, bool is_cut) {
  if (!fineness.even && fineness.density == 0.0) return;
  if (has_hidden_atoms)
    throw RequestError(
        "triangles of an even mesh cross the borders of atoms, so --show cannot cut it; leave --even and --density "
        "out, or choose atoms by --select");
  if (is_cut)
    throw RequestError("planes cut a mesh whose triangles keep to patches; leave --even and --density out, or --clip");
}

std::vector<double> buried_by_chains(const MoleculeRequest& molecule, const Structure& structure,
                                     std::vector<std::string>& names, bool all) {
  const auto wanted = std::ranges::find(names, "buried_area");
  if (wanted == names.end()) return {};
  if (!structure.instances.empty()) {
    if (!all) throw RequestError("areas buried between copies need copies made of atoms; leave --instances out");
    names.erase(wanted);
    return {};
  }
  SurfaceComputer computer(molecule.surface);
  return buried_areas(structure, group_atoms(structure, Grouping::chain), computer, molecule.surface.kind);
}

TakenProperties blender_properties() {
  return figure_properties().with({"look.shadows", "look.shadow_softness", "frames.fps", "mesh.tolerance",
                                   "mesh.tolerance_pixels", "mesh.density", "mesh.even", "mesh.attributes"},
                                  {{{"frames.fps"},
                                    [](const GivenScene& given) { return given.scene.frames.is_requested(); },
                                    "there is no run of frames"}});
}

void check_blender(const Scene& scene) { check_caps_of_map(scene, "a .mns file has no values of the map on caps"); }

blender::Shot blender_shot(const Scene& scene, const Camera& camera) {
  return {camera, scene.picture.width, scene.picture.height, scene.look.shadows.value_or(0.0f),
          look_of(scene.look, glm::ivec2(1), std::nullopt, Hues::free).shadow_softness};
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

blender::Provenance provenance_of(const Molecule& molecule) {
  return {file_name(molecule.structure.file), molecule.structure.radii_set, molecule.device, key_of(molecule)};
}

blender::CutFile cut_file(const SceneCommand& command, const FigureFrame& frame) {
  const Figure& figure = frame.figure;
  return {surface_planes(command.scene.figure, figure.extras.cut_atoms, frame.camera, figure.molecule.objects),
          command.scene.figure.cap};
}

namespace {

/// Meshes the objects of a cut surface, with caps.
std::vector<blender::MeshedObject> cut_objects(const SceneCommand& command, Molecule& molecule,
                                               const blender::CutFile& cut, double tolerance) {
  std::vector<blender::MeshedObject> objects;
  for (const SurfaceObject& object : molecule.objects) {
    CappedMesh made = capped_mesh(object, cut.planes, cut.style.color.has_value(), tolerance);
    objects.push_back({object,
                       std::move(made.mesh),
                       blender::atom_attributes(molecule.structure, object.atom),
                       {},
                       command.scene.figure.thickens,
                       std::move(made.cap_plane)});
  }
  return objects;
}

/// Returns the velocities of the vertices of one object.
std::vector<glm::dvec3> velocities_of(const SurfaceObject& object, const TriangleMesh& mesh,
                                      std::span<const glm::dvec3> velocities) {
  std::vector<glm::dvec3> atoms;
  for (const std::uint32_t atom : object.atom) atoms.push_back(velocities[atom]);
  return vertex_velocities(object.surface, mesh, atoms);
}

/// Meshes the objects of a whole surface; with velocities if there are any.
std::vector<blender::MeshedObject> whole_objects(const SceneCommand& command, const Molecule& molecule,
                                                 const MeshFineness& fineness, std::span<const glm::dvec3> velocities) {
  std::vector<blender::MeshedObject> objects;
  for (const SurfaceObject& object : molecule.objects) {
    FineMesh made = fine_mesh(object.surface, fineness);
    if (object.coloring.hides_some()) made = {shown_part(std::move(made.mesh), object.coloring), {}, {}};
    std::vector<glm::dvec3> moving;
    if (!velocities.empty()) moving = velocities_of(object, made.mesh, velocities);
    objects.push_back({object, std::move(made.mesh), blender::atom_attributes(molecule.structure, object.atom),
                       std::move(moving), command.scene.figure.thickens});
    objects.back().vertex_face = std::move(made.vertex_face);
  }
  return objects;
}

/// Adds meshes of objects with materials of their own, kept in `made`.
void add_more(const SceneCommand& command, const Figure& figure, const Camera& camera, double tolerance,
              std::vector<ShapeObject>& made, std::vector<blender::MeshedObject>& objects) {
  Structure shown;
  shown.atoms = shown_atoms(figure.molecule.structure);
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  made.reserve(figure.extras.objects.size());  // objects refer to them
  for (std::size_t n = 0; n < figure.extras.objects.size(); ++n) {
    const FigureObject& object = figure.extras.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    const FigureObjectRequest& request = request_of(command.scene.figure.objects, n);
    const PictureObject requested = picture_object(object, request, camera, balls);
    std::vector<std::uint32_t> cap_plane;
    if (!object.surface) {
      made.push_back(shape_object(shown.atoms, object.shapes, tolerance));
    } else {
      CappedMesh capped = capped_mesh(*object.surface, requested.clip, requested.cap.color.has_value(), tolerance);
      cap_plane = std::move(capped.cap_plane);
      made.push_back({*object.surface, std::move(capped.mesh)});
    }
    SurfaceObject& own = made.back().object;
    own.name = request.is_companion ? "ligands and ions" : fmt::format("object {}", n + 1);
    TriangleMesh& mesh = made.back().mesh;
    if (!object.surface && own.coloring.hides_some()) mesh = shown_part(std::move(mesh), own.coloring);
    objects.push_back({own,
                       std::move(mesh),
                       blender::atom_attributes(shown, own.atom),
                       {},
                       requested.thickens,
                       std::move(cap_plane),
                       blender::CutFile{requested.clip, requested.cap},
                       requested.material});
  }
}

/// Adds an object for the shapes next to the surface, kept in `made`. Vertices move with the atom of their triangles.
void add_extra_shapes(const Structure& structure, const ColoredShapes& shapes, double tolerance,
                      std::span<const glm::dvec3> velocities, std::optional<ShapeObject>& made,
                      std::vector<blender::MeshedObject>& objects) {
  if (shapes.empty()) return;
  Structure shown;
  shown.atoms = shown_atoms(structure);
  made = shape_object(shown.atoms, shapes, tolerance);
  std::vector<glm::dvec3> moving;
  if (!velocities.empty())
    for (const std::uint32_t atom : vertex_atoms(made->mesh)) moving.push_back(velocities[made->object.atom[atom]]);
  objects.push_back({made->object, made->mesh, blender::atom_attributes(shown, made->object.atom), std::move(moving)});
}

bool is_empty(const std::vector<blender::MeshedObject>& objects) {
  return std::ranges::all_of(objects, [](const blender::MeshedObject& each) { return each.mesh.triangles.empty(); });
}

}  // namespace

void mesh_figure(const SceneCommand& command, FigureFrame& frame, const blender::CutFile& cut,
                 const MeshFineness& fineness, FigureMeshes& made) {
  Molecule& molecule = frame.figure.molecule;
  const FigureExtras& extras = frame.figure.extras;
  // Vertices at a cut have no velocities: caps stay in place.
  const std::span<const glm::dvec3> velocities =
      cut.planes.empty() ? std::span<const glm::dvec3>(frame.velocities) : std::span<const glm::dvec3>{};
  if (!command.scene.figure.hides_surface) {
    const bool hides =
        std::ranges::any_of(molecule.objects, [](const SurfaceObject& o) { return o.coloring.hides_some(); });
    refuse_even_parts(fineness, hides, !cut.planes.empty());
    merge_copies(molecule.objects, !cut.planes.empty());
    made.objects = cut.planes.empty() ? whole_objects(command, molecule, fineness, velocities)
                                      : cut_objects(command, molecule, cut, fineness.tolerance);
    if (extras.empty() && is_empty(made.objects))
      throw RequestError("no part of the surface is shown, so there is no mesh to write");
  }
  add_extra_shapes(molecule.structure, extras.shapes, fineness.tolerance, velocities, made.extras, made.objects);
  add_more(command, frame.figure, frame.camera, fineness.tolerance, made.more, made.objects);
  if (is_empty(made.objects)) throw RequestError("the surface is not shown, and there is nothing beside it");
}

std::string add_numbers(const SceneCommand& command, blender::SurfaceNumbers wanted, const Structure& structure,
                        std::vector<blender::MeshedObject>& objects) {
  const std::vector<double> buried =
      buried_by_chains(command.scene.molecule, structure, wanted.names, command.scene.mesh.attributes == "all");
  std::string left_out;
  for (blender::MeshedObject& object : objects) {
    const std::string note = blender::add_surface_numbers(object, wanted, buried);
    if (left_out.empty()) left_out = note;
  }
  return left_out;
}

namespace {

// Returns the middle of the balls, rounded to three decimals.
glm::dvec3 rounded_center(std::span<const Ball> balls) {
  Box box;
  for (const Ball& ball : balls) box.include(ball.center);
  return glm::round((box.low + box.high) * 0.5e3) / 1e3;
}

// Returns the visible part of a surface, with caps where planes cut it.
path_tracers::SceneItem item_of(const SurfaceObject& object, std::span<const ClipPlane> planes, const CapStyle& cap,
                                double tolerance, const glm::dvec3& origin) {
  const CappedMesh shown = capped_mesh(object, planes, cap.color.has_value(), tolerance);
  std::optional<path_tracers::CapRows> caps;
  if (!planes.empty()) caps = {shown.cap_plane.size(), cap.color};
  return path_tracers::surface_item(object, shown.mesh, origin, caps);
}

void add_surface(const Scene& requested, Figure figure, double tolerance, path_tracers::PathTracerScene& scene) {
  std::vector<SurfaceObject>& objects = figure.molecule.objects;
  const std::vector<ClipPlane> planes =
      surface_planes(requested.figure, figure.extras.cut_atoms, scene.camera, objects);
  merge_copies(objects, !planes.empty());
  for (const SurfaceObject& object : objects)
    scene.items.push_back(item_of(object, planes, requested.figure.cap, tolerance, scene.origin));
}

// Adds objects with materials of their own.
void add_more(const Scene& requested, const Figure& figure, std::span<const Atom> atoms, double tolerance,
              path_tracers::PathTracerScene& scene) {
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  for (std::size_t n = 0; n < figure.extras.objects.size(); ++n) {
    const FigureObject& object = figure.extras.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    if (!object.surface) {
      scene.items.push_back(path_tracers::shapes_item(atoms, object.shapes, scene.origin));
      continue;
    }
    const PictureObject shown = picture_object(object, request_of(requested.figure.objects, n), scene.camera, balls);
    scene.items.push_back(item_of(*object.surface, shown.clip, shown.cap, tolerance, scene.origin));
  }
}

}  // namespace

TakenProperties traced_properties() {
  return figure_properties().with({"look.material", "mesh.tolerance", "mesh.tolerance_pixels"});
}

TracedFigure traced_figure(const FigureRun& run, FigureFrame frame) {
  const Scene& requested = run.scene();
  Figure& figure = frame.figure;
  const std::vector<Ball> balls = run.is_run() ? standing_balls(run.structure()) : figure.balls();
  const double tolerance = tolerance_of(requested.mesh, requested.picture.size(), run.camera(0), balls);
  path_tracers::PathTracerScene scene;
  scene.origin = run.is_run() ? run.framing().origin() : rounded_center(balls);
  scene.camera = frame.camera;
  scene.width = requested.picture.width;
  scene.height = requested.picture.height;
  const std::vector<Atom> atoms = shown_atoms(figure.molecule.structure);
  scene.items.push_back(path_tracers::shapes_item(atoms, figure.extras.shapes, scene.origin));
  add_more(requested, figure, atoms, tolerance, scene);
  if (!requested.figure.hides_surface) add_surface(requested, std::move(figure), tolerance, scene);
  return {std::move(scene), tolerance};
}

}  // namespace meniscus
