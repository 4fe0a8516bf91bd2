// SPDX-License-Identifier: BSD-3-Clause
// Sets the values of presets where a scene has none of its own.

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

template <typename Entries>
void prepend(Entries& entries, const Entries& first) {
  entries.insert(entries.begin(), first.begin(), first.end());
}

}  // namespace

void take_preset(Scene& scene) {
  const Preset& preset = preset_of(scene.look.preset);
  if (preset.settings.empty()) return;
  const std::string place =
      scene.picture.zoom_to ? scene.picture.zoom_to->text() : fmt::format("first ({})", preset.needs);
  std::string lack;
  if (!scene.picture.zoom_to)
    lack = message("has no {}, which @preset {}@ shows", in_quotes(preset.needs), preset.word);
  if (!lack.empty() && preset.sets("camera.zoom_to")) lack += message("; @zoom-to EXPR@ names other atoms");
  const bool has_camera = !scene.picture.camera_file.empty() || !scene.run_camera.path_file.empty();
  Scene lists;
  for (const PresetSetting& setting : preset.settings) {
    const Property& property = property_of(setting.key);
    if ((has_camera && property.section() == "camera") ||
        (!property.has(repeatable) && !value_texts(scene, property).empty()))
      continue;
    std::string text(setting.text), atoms = place;
    if (setting.key == "figure.object") atoms = nlohmann::json(place).dump(), atoms = atoms.substr(1, atoms.size() - 2);
    for (std::size_t at = 0; (at = text.find('%', at)) != text.npos; at += atoms.size()) text.replace(at, 1, atoms);
    set_value(property.has(repeatable) ? lists : scene, property, std::array{text});
  }
  for (RepresentationRequest& request : lists.figure.representations.requests) request.lack = lack;
  set_value(scene, property_of("look.preset"), std::array{std::string(preset.light)});
  MoleculeRequest& molecule = scene.molecule;
  ColorScheme &color = molecule.color, &under = lists.molecule.color;
  const bool has_color = molecule.color_named || !molecule.number_file.empty() || !molecule.volume_file.empty();
  if (lists.molecule.color_named && !has_color) {
    color.by = under.by;
    color.fixed = under.fixed;
    molecule.color_named = true;
  }
  if (color.by != ColorScheme::By::kind) prepend(color.rules, under.rules);
  prepend(color.opacities, under.opacities);
  if (scene.figure.cuts.empty()) scene.figure.cuts = lists.figure.cuts;
  prepend(scene.figure.representations.requests, lists.figure.representations.requests);
  prepend(scene.figure.objects, lists.figure.objects);
}

}  // namespace meniscus
