// SPDX-License-Identifier: BSD-3-Clause
// Sets the values of presets where a scene has none of its own, and finds values without effect by a table of what each
// of them needs.
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
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

namespace {

bool is_run(const GivenScene& given) { return given.scene.frames.is_requested(); }
bool has_patches(const GivenScene& given) { return given.is_live || given.any({"surface.patches"}); }
bool has_legend(const GivenScene& given) { return given.any({"legend.shown", "legend.file"}); }
bool names_a_scale(const GivenScene& given) { return given.is_live || has_legend(given); }

bool has_letters(const GivenScene& given) {
  return names_a_scale(given) || given.any({"annotations.labels", "annotations.scale_bar", "annotations.panel",
                                            "annotations.title", "annotations.time_stamp", "annotations.curve"});
}

Look resulting_look(const GivenScene& given) { return look_of(given.scene.look, {1, 1}, std::nullopt, Hues::free); }

/// Returns true if the output has shadows. Scenes for POV-Ray and Blender have no shadows of a preset.
bool has_shadows(const GivenScene& given) {
  const std::filesystem::path output = path_of_text(given.scene.output);
  const bool is_picture = output.empty() || (output.has_extension() && output.extension() != ".mns");
  return resulting_look(given).shadows > 0.0f && (is_picture || given.any({"look.shadows"}));
}

/// Returns true unless colours are simply those given. Objects may have a material of their own.
bool is_shaded(const GivenScene& given) {
  return given.any({"figure.object"}) || resulting_look(given).material.ambient < 1.0f;
}

bool has_highlights(const GivenScene& given) {
  return given.any({"figure.object"}) || resulting_look(given).material.specular > 0.0f;
}

bool has_transparent_pixels(const GivenScene& given) {
  const std::string_view output = given.scene.output;
  return given.is_live || (!given.scene.image.background &&
                           (output.ends_with(".png") || output.ends_with(".tif") || output.ends_with(".tiff")));
}

const std::vector<Need>& needs_of_scenes() {
  static const std::vector<Need> kNeeds{
      {{"frames.trajectory_atoms", "frames.trust_atom_order", "frames.select_once", "frames.whole", "frames.superpose",
        "frames.center", "frames.reference", "frames.smooth", "camera.path", "camera.turntable", "camera.follow",
        "annotations.time_stamp", "annotations.curve", "report.csv_series", "report.csv_cavities", "report.plot"},
       is_run,
       "there is no run of frames; add @trajectory FILE@, @frames all@ for the models of FILE, or @repeat N@ to show "
       "one molecule N times",
       true},
      {{"surface.min_patch", "look.patch_lines", "look.patch_line_color"},
       has_patches,
       "there are no patches; add @patches EXPR@"},
      {{"frames.reference"},
       {"frames.superpose", "frames.center"},
       "it is the frame that @superpose@ and @center@ refer to; add one of them",
       true},
      {{"frames.trajectory_atoms", "frames.trust_atom_order"},
       {"frames.trajectory"},
       "the frames are models of FILE itself; add @trajectory FILE@",
       true},
      {{"surface.film_opacity", "surface.patches"},
       [](const GivenScene& given) { return !given.any({"surface.shown"}); },
       "the surface is hidden, and shapes beside it are no films, and have no patches"},
      {{"surface.clip"},
       [](const GivenScene& given) { return !given.any({"surface.shown"}) || given.any({"surface.clip_all"}); },
       "the surface is hidden; add @clip-all@ to cut what is beside it"},
      {{"surface.cap_color", "surface.cap_hatching", "surface.clip_all"},
       {"surface.clip", "camera.look_into"},
       "nothing is cut; add @clip PLANE@"},
      {{"shapes.bare"},
       [](const GivenScene& given) {
         return !given.any({"molecule.select", "molecule.instances", "surface.interface"});
       },
       "beside atoms that are selected, and copies of one surface, only what is named is drawn"},
      {{"surface.film_opacity"}, {"surface.opacity"}, "all of the surface is opaque; add @opacity@"},
      {{"shapes.stick_radius"},
       {"figure.sticks", "figure.balls", "figure.bases", "figure.glycans"},
       "there are no sticks; add @sticks EXPR@, @balls EXPR@ or @bases EXPR@"},
      {{"annotations.lengths"},
       {"figure.hydrogen_bonds", "figure.distance", "figure.object"},
       "there are no dashed lines; add @hydrogen-bonds EXPR@ or @distance 'EXPR to EXPR'@"},
      {{"shapes.tube_radius"}, {"figure.tube"}, "there is no tube; add @tube EXPR@"},
      {{"image.tiff_compression", "image.tiff_bits"},
       [](const GivenScene& given) { return given.scene.output.find(".tif") != std::string::npos; },
       "it is for .tif pictures"},
      {{"image.margin"},
       [](const GivenScene& given) { return given.scene.picture.fits; },
       "it is around the molecule of @size auto@ and @height auto@"},
      {{"legend.title", "legend.size", "legend.place", "legend.names"}, has_legend, "there is no legend; add @legend@"},
      {{"annotations.letter_size", "annotations.letter_color", "annotations.font", "annotations.font_file"},
       has_letters,
       "there are no letters in the picture; add @legend@, @label@, @scale-bar@ or @panel@"},
      {{"surface.color_title", "surface.color_unit"},
       names_a_scale,
       "they name the scale of a legend, and there is none"},
      {{"look.light", "look.light_strength"},
       [](const GivenScene& given) { return is_shaded(given) || has_highlights(given) || has_shadows(given); },
       "with @ambient 1@, as @preset flat@ has it, colours are exactly those given; add a smaller @ambient@"},
      {{"look.roughness"},
       is_shaded,
       "with @ambient 1@, as @preset flat@ has it, nothing is shaded; add a smaller @ambient@"},
      {{"look.shininess"}, has_highlights, "there are no highlights; add @specular@"},
      {{"look.shadow_softness"}, has_shadows, "there are no shadows; add @shadows@"},
      {{"look.ambient_occlusion_radius"},
       [](const GivenScene& given) { return resulting_look(given).traces_sky(); },
       "no rays find shade; add @ambient-occlusion-rays@"},
      {{"look.ambient_occlusion_rays"},
       [](const GivenScene& given) { return resulting_look(given).ambient_occlusion > 0.0f; },
       "no shade is cast; add @ambient-occlusion@"},
      {{"look.linear_alpha"}, has_transparent_pixels, "it is for the edges of transparent .png and .tif pictures"}};
  return kNeeds;
}

/// Returns the last text of a value that was given; empty if there is none.
std::string text_of(const GivenScene& given, std::string_view key) {
  const Property& property = property_of(key);
  const std::vector<std::string> texts =
      given.is_given(key) && is_scene_value(property) ? value_texts(given.scene, property) : std::vector<std::string>();
  return texts.empty() ? "" : texts.back();
}

/// Returns the option of a property in the spelling of the running program.
std::string name_of(std::string_view key) { return option_name(property_of(key).long_option().substr(2)); }

void add_unlikely_values(const GivenScene& given, std::vector<SceneNote>& notes) {
  constexpr double kSmallestUsualProbe = 0.5, kSmallestUsualSide = 200.0;  // Å, pixels
  double number = 0.0;
  if (const std::string probe = text_of(given, "surface.probe");
      parse_number(probe, number) && number > 0.0 && number < kSmallestUsualProbe)
    notes.push_back({message("warning: @probe {}@ is in Å, and no solvent is so small; {} nm would be @probe {:g}@",
                             probe, probe, 10.0 * number)});
  for (const std::string_view side : {"image.width", "image.height"}) {
    const std::string length = text_of(given, side), name = name_of(side);
    if (parse_number(length, number) && number < kSmallestUsualSide)
      notes.push_back(
          {fmt::format("warning: {} {} is in pixels, which makes a small picture; in millimetres it is {} {}mm", name,
                       length, name, length)});
  }
}

}  // namespace

bool GivenScene::any(const std::vector<std::string_view>& keys) const { return std::ranges::any_of(keys, is_given); }

Condition::Condition(std::initializer_list<std::string_view> keys)
    : is_met([any = std::vector(keys)](const GivenScene& given) { return given.any(any); }) {}

std::vector<SceneNote> ineffective_values(const GivenScene& given, std::span<const Need> needs) {
  std::vector<SceneNote> notes;
  const auto add = [&](const Need& need) {
    std::vector<std::string> names;
    for (const std::string_view key : need.keys)
      if (given.is_given(key)) names.push_back(name_of(key));
    if (names.empty() || need.condition.is_met(given)) return;
    notes.push_back({fmt::format("{}{} {} no effect: {}", need.is_refused ? "" : "note: ", fmt::join(names, ", "),
                                 names.size() == 1 ? "has" : "have", with_options(need.missing)),
                     need.is_refused});
  };
  std::ranges::for_each(needs_of_scenes(), add);
  std::ranges::for_each(needs, add);
  add_unlikely_values(given, notes);
  return notes;
}

}  // namespace meniscus
