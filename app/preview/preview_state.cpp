// SPDX-License-Identifier: BSD-3-Clause
// Remembers figures for undo and redo, and converts figures to scenes and back.
#include "app/preview/preview_state.h"

#include <nlohmann/json.hpp>

#include "core/camera/camera_json.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostSteps = 100;

/// Returns the reason why a preview cannot show a scheme, with the command that can; empty: the preview shows it.
std::string who_shows(ColorScheme::By scheme, bool has_numbers) {
  using By = ColorScheme::By;
  if (scheme == By::component) return "parts of the surface have no atoms of their own; use meniscus render";
  if (scheme == By::volume) return "volume maps are for render and export mesh";
  if (scheme == By::lipophilicity) return "potentials at points of the surface are for render and export";
  if (scheme == By::buried) return "areas that are buried between groups are measured by meniscus render and export";
  if (scheme == By::accessibility) return "accessible areas of residues are measured by meniscus render and export";
  if (scheme == By::rmsf && !has_numbers)
    return "fluctuations are measured once, over all frames; begin the preview with --color rmsf and --trajectory or "
           "--frames";
  return {};
}

void require_shown(const ColorScheme& color) {
  if (const std::string who = who_shows(color.by, !color.file.empty()); !who.empty())
    throw RequestError("colour by {} needs more than atoms: {}", in_quotes(scheme_word(color)), who);
}

}  // namespace

void require_previewed(const ColorScheme& color) {
  require_shown(color);
  for (const ColorRule& rule : color.rules) require_shown(rule.paint);
}

bool is_previewed(ColorScheme::By scheme) { return who_shows(scheme, false).empty(); }

void EditHistory::note(std::string_view kind, const PreviewFigure& before) {
  future_.clear();
  if (!kind.empty() && kind == kind_) return;
  kind_ = kind;
  past_.push_back(before);
  if (past_.size() > kMostSteps) past_.pop_front();
}

void EditHistory::move(const PreviewFigure& now, std::deque<PreviewFigure>& from, std::deque<PreviewFigure>& to) {
  end_step();
  to.push_back(now);
  from.pop_back();
}

Scene rendered_scene(const PreviewFigure& figure, const RenderedView& view) {
  using By = ColorScheme::By;
  Scene scene = figure;
  scene.picture.camera_file = camera_object(figure.camera).dump();
  if (!figure.has_size || view.size != figure.picture.size()) {
    scene.picture.width = view.size.x;
    scene.picture.height = view.size.y;
    scene.lengths.erase("image.width");
    scene.lengths.erase("image.height");
  }
  scene.image.samples = view.samples;
  scene.image.background = figure.shown_background();
  if (view.transparent) scene.image.background.reset();
  MoleculeRequest& molecule = scene.molecule;
  if (view.model) {
    molecule.reading.model = {};
    molecule.reading.model.number = *view.model;
  }
  scene.output.clear();
  if (view.frame) {
    scene.frames.only = fmt::format("{}", *view.frame);
    scene.output = "frame_#####.png";
  }
  molecule.surface.probe_named = molecule.surface.kind != SurfaceKind::vdw;
  molecule.color_named = molecule.color.by != By::file;
  ColorScheme& color = molecule.color;
  if (!color.uses_file()) molecule.number_file = molecule.number_column = "";
  if (!color.uses_scale() || !color.own_map) molecule.map_file.clear();
  if (!color.uses_scale()) {
    color.map.reset();
    color.range.reset();
    color.missing.reset();
  } else if (!color.range) {
    color.range = view.range;
  }
  return scene;
}

std::uint64_t KeptScene::held(double rate) const {
  return std::max<std::uint64_t>(static_cast<std::uint64_t>(std::llround(hold * rate)), 1);
}

std::uint64_t KeptScene::between(double rate) const {
  return static_cast<std::uint64_t>(std::llround(transition * rate));
}

PreviewFigure::PreviewFigure(Scene scene) : Scene(std::move(scene)), preset(look.preset) {
  camera.projection = picture.projection;
  ViewRequest size;
  size.width = picture.width;
  size.height = picture.height;
  size.dots_per_inch = picture.dots_per_inch;
  picture = std::move(size);
}

LookRequest look_request(LookRequest asked, Look look, bool outlines_patches) {
  for (const LookNumber& number : look_numbers())
    if (number.in) *number.requested(asked) = number.in(look);
  asked.light_direction = look.light_direction;
  asked.silhouettes = look.silhouettes;
  asked.outer_lines = look.outer_lines;
  asked.inner_lines = look.inner_lines;
  asked.part_lines = look.part_lines;
  if (outlines_patches) {
    asked.patch_lines = look.patch_lines;
    asked.patch_line_color = look.patch_line_color;
  }
  return asked;
}

}  // namespace meniscus
