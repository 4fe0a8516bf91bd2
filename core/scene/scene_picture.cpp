// SPDX-License-Identifier: BSD-3-Clause
// Reads a scene's molecule, aims its camera, draws its figure, and finishes the picture.
#include "core/scene/scene_picture.h"

#include <utility>

#include "core/base/error.h"
#include "core/base/message.h"
#include "core/scene/figure_key.h"
#include "core/scene/scene_values.h"
#include "core/scene/seen_atoms.h"
#include "core/scene/settled_selections.h"

namespace meniscus {

PictureLayout::PictureLayout(const Scene& scene, const ColorKey& key) : size(scene.picture) {
  const LegendStyle style = legend_style(scene.legend.style, scene.annotations.letters);
  if (!scene.legend.file.empty()) legend_apart.emplace(key, size.size(), style);
  if (scene.legend.within) legend.emplace(key, size.size(), style);
  if (legend) size.width = legend->molecule_size().x;
  if (legend) size.height = legend->molecule_size().y;
  strips = scene_strips(scene, size.size());
  size.height -= strips.top + strips.bottom;
}

Strips scene_strips(const Scene& scene, glm::ivec2 size) {
  return strips_for(strip_contents(scene.annotations, scene.frames.asked()), scene.annotations.letters, size);
}

SurfaceRequest picture_request(const Scene& scene) {
  SurfaceRequest request = scene.molecule.surface;
  // Volume maps are looked up point by point on the CPU.
  request.cpu = request.cpu || scene.molecule.color.of_points();
  return request;
}

RenderSettings render_settings(const Scene& scene, const PictureLayout& layout) {
  RenderSettings settings;
  settings.size = layout.size.size();
  settings.samples = scene.image.samples;
  settings.aovs = scene.image.aovs;
  settings.mattes = scene.image.cryptomatte;
  settings.look = look_of(scene.look, scene.picture.size(), scene.image.background,
                          hues_of(scene.molecule.color, scene.legend.asked(), uses_atoms(scene.figure.cuts)),
                          scene.molecule.patches.has_value());
  return settings;
}

void check_picture(const Scene& scene) {
  scene.figure.check();
  const auto has_color = [](const FigureObjectRequest& object) { return object.color.has_value(); };
  if (scene.legend.asked() && scene.molecule.color.by == ColorScheme::By::fixed && scene.molecule.color.rules.empty() &&
      std::ranges::none_of(scene.figure.objects, has_color))
    throw RequestError(message("@legend@ has nothing to explain: everything has one colour; choose another @color@"));
}

Framebuffer finished_picture(Framebuffer molecule, const Annotations& annotations, const PictureLayout& layout,
                             const Camera& camera, const std::optional<glm::vec3>& background, bool* lacks_labels) {
  const Strips& strips = layout.strips;
  if (strips.top + strips.bottom > 0)
    molecule = with_margin(molecule, molecule.size + glm::ivec2(0, strips.top + strips.bottom), strips.top,
                           layers_of(molecule));
  const bool is_whole = annotate(molecule, annotations, camera, background, strips);
  if (lacks_labels) *lacks_labels = !is_whole;
  return layout.legend ? layout.legend->add_to(molecule, background) : molecule;
}

SceneFigure made_figure(const Scene& asked, const EglContext* context) {
  if (asked.frames.asked())
    throw RequestError("frames: this makes the picture of one molecule; `meniscus render` makes those of a run");
  if (asked.image.extent)
    throw RequestError("image.extent: this draws the complete surface; `meniscus render` draws without it");
  Scene scene = readied(asked);
  settle_selections(scene);
  scene.molecule.surface.cpu = context == nullptr;
  const GivenCameras given = given_cameras(scene.picture, scene.run_camera);
  Structure structure = read_molecule(scene.molecule);
  ViewAim aim(scene.picture, scene.molecule.show, structure);
  Figure figure = make_figure(MoleculeBuilder(scene.molecule, context).build(std::move(structure)), scene.figure);
  return {std::move(scene), given, std::move(aim), std::move(figure)};
}

Framebuffer scene_picture(const Scene& asked, StillRenderer& renderer, const EglContext* context) {
  check_picture(asked);
  auto [scene, given, aim, figure] = made_figure(asked, context);
  const PictureLayout layout(scene, key_of(figure.molecule, scene.figure, figure.beside));
  const Camera camera = aim.camera(layout.size, given.still, aim.viewed(figure));
  Annotations annotations = annotations_of(scene.annotations, figure.molecule.structure);
  const Survey survey = survey_of(scene, figure.molecule.structure, camera, layout.size.size(), annotations);
  Framebuffer drawn = draw(renderer, std::move(figure), scene.figure, camera, render_settings(scene, layout), survey);
  return finished_picture(std::move(drawn), annotations, layout, camera, scene.image.background);
}

}  // namespace meniscus
