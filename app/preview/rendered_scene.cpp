// SPDX-License-Identifier: BSD-3-Clause
// Copies the figure of a preview into a scene, and back.
#include "app/preview/rendered_scene.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "core/camera/camera_json.h"

namespace meniscus {
namespace {

void take_colors(const RenderedView& view, MoleculeRequest& molecule) {
  using By = ColorScheme::By;
  ColorScheme& color = molecule.color;
  color = view.figure.color;
  molecule.color_named = view.figure.patch_kinds || color.by != By::file;
  if (view.figure.patch_kinds) {
    color.by = By::kind;
    color.rules.clear();
  }
  if (!color.uses_file()) molecule.number_file = molecule.number_column = "";
  if (!color.uses_scale() || !color.own_map) molecule.map_file.clear();
  if (!color.uses_scale()) {
    color.map.reset();
    color.range.reset();
    color.missing.reset();
  } else if (!color.range) {
    color.range = view.range;
  }
}

}  // namespace

Scene rendered_scene(const Scene& begun, const RenderedView& view) {
  const PreviewFigure& figure = view.figure;
  Scene scene = begun;
  scene.picture = {};
  scene.picture.width = view.size.x;
  scene.picture.height = view.size.y;
  scene.picture.dots_per_inch = view.dots_per_inch;
  scene.picture.camera_file = camera_object(figure.camera).dump();
  scene.lengths.erase("image.width");
  scene.lengths.erase("image.height");
  scene.image.samples = view.samples;
  scene.image.background.reset();
  if (!view.transparent) scene.image.background = figure.background;
  if (view.model) {
    scene.molecule.reading.model = {};
    scene.molecule.reading.model.number = *view.model;
  }
  scene.output.clear();
  if (view.frame) {
    scene.frames.only = fmt::format("{}", *view.frame);
    scene.output = "frame_#####.png";
  }
  scene.molecule.surface.kind = figure.kind;
  scene.molecule.surface.probe_radius = figure.probe_radius;
  scene.molecule.surface.probe_named = figure.kind != SurfaceKind::vdw;
  scene.molecule.show = figure.show;
  take_colors(view, scene.molecule);
  scene.figure = figure.figure;
  scene.look = figure.look;
  scene.legend.within = figure.legend;
  scene.legend.style = figure.legend_style;
  return scene;
}

PreviewFigure figure_of(const Scene& scene, const ColorScheme& color) {
  PreviewFigure figure;
  figure.camera.projection = scene.picture.projection;
  figure.kind = scene.molecule.surface.kind;
  figure.probe_radius = scene.molecule.surface.probe_radius;
  figure.show = scene.molecule.show;
  figure.color = color;
  figure.figure = scene.figure;
  figure.look = scene.look;
  if (scene.image.background) figure.background = *scene.image.background;
  figure.legend = scene.legend.within;
  figure.legend_style = scene.legend.style;
  return figure;
}

}  // namespace meniscus
