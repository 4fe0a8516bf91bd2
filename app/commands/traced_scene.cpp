// SPDX-License-Identifier: BSD-3-Clause
// Makes meshes, spheres and cylinders from a figure's surface and from everything drawn in addition.
#include "app/commands/traced_scene.h"

#include <optional>
#include <utility>
#include <vector>

#include "core/mesh/mesh_objects.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/copies.h"
#include "core/scene/copied_atoms.h"
#include "exporters/path_tracers/scene_folder.h"

namespace meniscus {
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

void add_surface(const Scene& asked, Figure figure, double tolerance, path_tracers::Scene& scene) {
  std::vector<SurfaceObject>& objects = figure.molecule.objects;
  const std::vector<ClipPlane> planes = surface_planes(asked.figure, figure.beside.cut_atoms, scene.camera, objects);
  settle_copies(objects, !planes.empty());
  for (const SurfaceObject& object : objects)
    scene.items.push_back(item_of(object, planes, asked.figure.cap, tolerance, scene.origin));
}

// Adds objects with materials of their own.
void add_more(const Scene& asked, const Figure& figure, std::span<const Atom> atoms, double tolerance,
              path_tracers::Scene& scene) {
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!object.surface && object.shapes.empty()) continue;
    if (!object.surface) {
      scene.items.push_back(path_tracers::shapes_item(atoms, object.shapes, scene.origin));
      continue;
    }
    const PictureObject shown = picture_object(object, asked.figure.objects[n], scene.camera, balls);
    scene.items.push_back(item_of(*object.surface, shown.clip, shown.cap, tolerance, scene.origin));
  }
}

}  // namespace

TakenProperties traced_properties() {
  return figure_properties().with({"look.material", "mesh.tolerance", "mesh.tolerance_pixels"});
}

TracedScene traced_scene(const FigureRun& run, FigureFrame frame) {
  const Scene& asked = run.scene();
  Figure& figure = frame.figure;
  const std::vector<Ball> balls = run.is_run() ? standing_balls(run.structure()) : figure.balls();
  const double tolerance = tolerance_of(asked.mesh, asked.picture.size(), run.camera(0), balls);
  path_tracers::Scene scene;
  scene.origin = run.is_run() ? run.framing().origin() : rounded_center(balls);
  scene.camera = frame.camera;
  scene.width = asked.picture.width;
  scene.height = asked.picture.height;
  const std::vector<Atom> atoms = shown_atoms(figure.molecule.structure);
  scene.items.push_back(path_tracers::shapes_item(atoms, figure.beside.shapes, scene.origin));
  add_more(asked, figure, atoms, tolerance, scene);
  if (!asked.figure.hides_surface) add_surface(asked, std::move(figure), tolerance, scene);
  return {std::move(scene), tolerance};
}

}  // namespace meniscus
