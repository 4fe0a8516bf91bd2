// SPDX-License-Identifier: BSD-3-Clause
// Converts scenes and figures to data for POV-Ray.
#include "app/commands/povray_figures.h"

#include <fmt/format.h>

#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "core/color/color_maps.h"
#include "core/queries/copies.h"

namespace meniscus {

TakenProperties povray_properties() {
  return figure_properties().with({"look.shadows", "look.shadow_softness", "look.material", "look.comments"});
}

povray::SceneOptions povray_options(const Scene& scene, Existing existing) {
  using enum povray::Material;
  povray::SceneOptions options;
  options.width = scene.picture.width;
  options.height = scene.picture.height;
  options.material = meaning_of(scene.renderer.material, "povray.material", {opaque, ghost, glass, wax, flat});
  options.shadows = scene.look.shadows.value_or(0.0f);
  options.shadow_softness = scene.look.shadow_softness.value_or(0.0f);
  options.existing = existing;
  options.cut.style = scene.figure.cap;
  options.film = scene.figure.thickens;
  return options;
}

void check_povray(const Scene& scene) {
  if (scene.figure.thickens && scene.molecule.volume_offset != 0.0)
    throw UsageError("--map-offset: scenes for POV-Ray cannot combine it with --film-opacity; leave one of them out");
}

std::vector<povray::SceneObject> povray_objects(const Figure& figure, const FigureRequest& request,
                                                const Camera& camera, bool keeps_empty) {
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  std::vector<povray::SceneObject> more;
  for (std::size_t n = 0; n < figure.beside.objects.size(); ++n) {
    const FigureObject& object = figure.beside.objects[n];
    if (!keeps_empty && !object.surface && object.shapes.empty()) continue;
    const PictureObject shown = picture_object(object, request.objects[n], camera, balls);
    povray::SceneObject& made = more.emplace_back();
    if (object.surface)
      made.surface = &*object.surface;
    else
      made.shapes = &object.shapes;
    made.cut = {shown.clip, shown.cap};
    made.film = shown.thickens;
    made.material = shown.material;
  }
  return more;
}

povray::SurfaceCut povray_cut(const Figure& figure, const FigureRequest& request, const Camera& camera) {
  return {surface_planes(request, figure.beside.cut_atoms, camera, figure.molecule.objects), request.cap};
}

std::vector<std::string> comment_names(const Scene& scene, const Structure& structure) {
  std::vector<std::string> names;
  if (!scene.renderer.comments) return names;
  for (const Atom& atom : shown_atoms(structure)) {
    if (atom.residue_name.empty()) {  // numbered like --csv and selections
      names.push_back(fmt::format("{} index {}", atom.name, atom.index));
      names.back().erase(0, names.back().find_first_not_of(' '));
      continue;
    }
    const std::string code = atom.insertion_code == ' ' ? std::string() : std::string(1, atom.insertion_code);
    names.push_back(fmt::format("{} {} {}{} {}", atom.chain, atom.residue_name, atom.residue_number, code, atom.name));
    names.back().erase(0, names.back().find_first_not_of(' '));
  }
  return names;
}

}  // namespace meniscus
