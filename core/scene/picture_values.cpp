// SPDX-License-Identifier: BSD-3-Clause
// Binds the values of the look, the camera, the picture, its annotations and its files.
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/color/named_colors.h"
#include "core/scene/scene_lengths.h"
#include "core/scene/scene_value.h"

namespace meniscus::scene_values {
namespace {

// Look, camera and picture.

void read_light(const Property&, Texts texts, Scene& scene) {
  std::array<float, 3> parts{};
  std::size_t count = 0;
  std::string_view left = texts.back();
  bool is_read = true;
  while (is_read && !left.empty() && count < parts.size()) {
    const std::size_t comma = std::min(left.find(','), left.size());
    is_read = parse_single(left.substr(0, comma), parts[count++]);
    left.remove_prefix(std::min(comma + 1, left.size()));
  }
  const float length = std::hypot(parts[0], parts[1], parts[2]);
  if (!is_read || count != parts.size() || !left.empty() || !std::isfinite(length) || length < 1e-6f)
    throw RequestError("expected a direction: three numbers that are not all 0, such as -1,1,1");
  scene.look.light_direction = glm::vec3(parts[0], parts[1], parts[2]);
}

Written write_light(const Property&, const Scene& scene) {
  const auto& light = scene.look.light_direction;
  if (!light) return {};
  return {fmt::format("{},{},{}", light->x, light->y, light->z)};
}

void read_patch_line_color(const Property&, Texts texts, Scene& scene) {
  scene.look.patch_line_color = parse_color(texts.back());
  if (!scene.look.patch_line_color)
    throw RequestError(in_quotes(texts.back()) + " is not a colour: give a name such as red, or #rrggbb");
}

Written write_patch_line_color(const Property&, const Scene& scene) {
  if (!scene.look.patch_line_color) return {};
  return {hex_color(*scene.look.patch_line_color)};
}

void read_view(const Property&, Texts texts, Scene& scene) {
  scene.picture.direction = parse_view_direction(texts.back());
  if (!scene.picture.direction)
    throw RequestError(
        fmt::format("{} is not one of {}", in_quotes(texts.back()), fmt::join(view_direction_words(), ", ")));
}

Written write_view(const Property&, const Scene& scene) {
  if (!scene.picture.direction) return {};
  for (const std::string& word : view_direction_words())
    if (parse_view_direction(word) == scene.picture.direction) return {word};
  return {};
}

void read_turns(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) {
    const std::optional<Turn> turn = parse_turn(text);
    if (!turn)
      throw RequestError(in_quotes(text) +
                         " is not an axis of the picture (x, y, z) followed by degrees, such as y90 or x-30");
    scene.picture.turns.push_back(*turn);
  }
}

Written write_turns(const Property&, const Scene& scene) {
  Written texts;
  for (const Turn& turn : scene.picture.turns) texts.push_back(fmt::format("{}{}", "xyz"[turn.axis], turn.degrees));
  return texts;
}

void read_background(const Property&, Texts texts, Scene& scene) {
  std::optional<glm::vec3>& color = scene.image.background;
  const std::string& text = texts.back();
  color.reset();
  scene.film.transparent = text == "transparent";
  if (scene.film.transparent) return;
  color = parse_color(text);
  if (!color)
    throw RequestError(in_quotes(text) +
                       " is not a background: give transparent, a colour's name such as grey, or #rrggbb");
}

Written write_background(const Property&, const Scene& scene) {
  if (!scene.image.background) return scene.film.transparent ? Written{"transparent"} : Written();
  return {hex_color(*scene.image.background)};
}

void read_extent(const Property& property, Texts texts, Scene& scene) {
  constexpr Extent kMeanings[] = {Extent::visible, Extent::complete, Extent::paper};
  scene.image.extent = kMeanings[place_of_word(words_of(property), texts.back())];
}

Written write_extent(const Property& property, const Scene& scene) {
  constexpr Extent kMeanings[] = {Extent::visible, Extent::complete, Extent::paper};
  if (!scene.image.extent) return {};
  return {words_of(property)[static_cast<std::size_t>(std::ranges::find(kMeanings, *scene.image.extent) - kMeanings)]};
}

// Sizes and letters.

void read_size(const Property&, Texts texts, Scene& scene) {
  const std::string_view text = texts.back();
  const std::size_t cross = text.find('x');
  const auto parse_side = [](std::string_view digits, int& side) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    return error == std::errc() && end == digits.data() + digits.size() && side >= 1 && side <= kLargestSide;
  };
  if (cross == std::string::npos || !parse_side(text.substr(0, cross), scene.picture.width) ||
      !parse_side(text.substr(cross + 1), scene.picture.height))
    throw RequestError(fmt::format("{} is not WIDTHxHEIGHT in pixels, 1 to {} each, such as 1920x1080", in_quotes(text),
                                   kLargestSide));
  scene.lengths.erase("image.width");
  scene.lengths.erase("image.height");
}

Written write_size(const Property&, const Scene& scene) {
  if (scene.picture.size() == usual_scene().picture.size() || has_lengths_of_sides(scene)) return {};
  return {fmt::format("{}x{}", scene.picture.width, scene.picture.height)};
}

void read_side(const Property& property, Texts texts, Scene& scene) {
  side_in_pixels(texts.back(), scene.picture.dots_per_inch);
  scene.lengths[std::string(property.key)] = texts.back();
}

Written write_side(const Property& property, const Scene& scene) {
  const auto length = scene.lengths.find(property.key);
  if (length == scene.lengths.end() || !has_lengths_of_sides(scene)) return {};
  return {length->second};
}

template <typename Member>
constexpr SceneValue line_width(std::string_view key, Member) {
  return {
      key,
      [](const Property& property, Texts texts, Scene& scene) {
        Member{}(scene) =
            static_cast<float>(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, "a line has"));
        keep_length(scene, property.key, texts.back());
      },
      [](const Property& property, const Scene& scene) { return written_line(scene, property.key, Member{}(scene)); }};
}

template <typename Member>
constexpr SceneValue letter_height(std::string_view key, Member) {
  return {key,
          [](const Property& property, Texts texts, Scene& scene) {
            Member{}(scene) = static_cast<int>(
                std::round(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, "letters have")));
            keep_length(scene, property.key, texts.back());
          },
          [](const Property& property, const Scene& scene) -> Written {
            const std::optional<int>& height = Member{}(scene);
            if (!height) return {};
            const auto length = scene.lengths.find(property.key);
            if (length != scene.lengths.end() &&
                std::round(parse_length(length->second).pixels(scene.picture.dots_per_inch)) == *height)
              return {length->second};
            return {fmt::format("{}", *height)};
          }};
}

void read_letter_color(const Property&, Texts texts, Scene& scene) {
  std::optional<glm::vec3>& color = scene.annotations.letters.color;
  color = parse_color(texts.back());
  if (!color && texts.back() != "auto")
    throw RequestError(in_quotes(texts.back()) +
                       " is not a colour of letters: give auto, a colour's name such as white, or #rrggbb");
}

Written write_letter_color(const Property&, const Scene& scene) {
  const std::optional<glm::vec3>& color = scene.annotations.letters.color;
  if (!color) return {};
  return {hex_color(*color)};
}

void read_scale_bar(const Property&, Texts texts, Scene& scene) { parse_scale_bar(texts.back(), scene.annotations); }

Written write_scale_bar(const Property&, const Scene& scene) {
  if (!scene.annotations.scale_bar) return {};
  return {scene.annotations.bar_length ? fmt::format("{}", *scene.annotations.bar_length) : "auto"};
}

void read_labels(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) scene.annotations.labels.push_back(parse_label(text));
}

Written write_labels(const Property&, const Scene& scene) {
  Written texts;
  for (const LabelRequest& label : scene.annotations.labels) texts.push_back(label.atoms.text() + "=" + label.text);
  return texts;
}

void read_unit(const Property& property, Texts texts, Scene& scene) {
  constexpr double kNanometers = 0.1;
  scene.mesh.scale = place_of_word(words_of(property), texts.back()) == 0 ? 1.0 : kNanometers;
}

constexpr auto kPictureRows = std::to_array<SceneValue>({
    worded<LookPreset::publication, LookPreset::cover, LookPreset::flat, LookPreset::soft, LookPreset::classic>(
        "look.preset", [](auto& s) -> auto& { return s.look.preset; }),
    {"look.light", read_light, write_light},
    plain(
        "look.light_strength", [](auto& s) -> auto& { return s.look.light_strength; }),
    plain(
        "look.ambient", [](auto& s) -> auto& { return s.look.ambient; }),
    plain(
        "look.roughness", [](auto& s) -> auto& { return s.look.roughness; }),
    plain(
        "look.specular", [](auto& s) -> auto& { return s.look.specular; }),
    plain(
        "look.shininess", [](auto& s) -> auto& { return s.look.shininess; }),
    plain(
        "look.ambient_occlusion", [](auto& s) -> auto& { return s.look.ambient_occlusion; }),
    plain(
        "look.ambient_occlusion_radius", [](auto& s) -> auto& { return s.look.ambient_occlusion_radius; }),
    plain(
        "look.ambient_occlusion_rays", [](auto& s) -> auto& { return s.look.ambient_occlusion_rays; }),
    plain(
        "look.shadows", [](auto& s) -> auto& { return s.look.shadows; }),
    plain(
        "look.shadow_softness", [](auto& s) -> auto& { return s.look.shadow_softness; }),
    line_width(
        "look.silhouettes", [](auto& s) -> auto& { return s.look.silhouettes; }),
    line_width(
        "look.outer_lines", [](auto& s) -> auto& { return s.look.outer_lines; }),
    line_width(
        "look.inner_lines", [](auto& s) -> auto& { return s.look.inner_lines; }),
    line_width(
        "look.part_lines", [](auto& s) -> auto& { return s.look.part_lines; }),
    line_width(
        "look.patch_lines", [](auto& s) -> auto& { return s.look.patch_lines; }),
    {"look.patch_line_color", read_patch_line_color, write_patch_line_color},
    plain(
        "look.depth_cue", [](auto& s) -> auto& { return s.look.depth_cue; }),
    plain(
        "look.linear_alpha", [](auto& s) -> auto& { return s.look.linear_alpha; }),
    plain(
        "look.material", [](auto& s) -> auto& { return s.renderer.material; }),
    plain(
        "look.comments", [](auto& s) -> auto& { return s.renderer.comments; }),

    plain(
        "camera.from", [](auto& s) -> auto& { return s.picture.camera_file; }),
    worded<Projection::perspective, Projection::orthographic>(
        "camera.projection", [](auto& s) -> auto& { return s.picture.projection; }),
    {"camera.view", read_view, write_view},
    {"camera.turn", read_turns, write_turns},
    plain(
        "camera.zoom_to", [](auto& s) -> auto& { return s.picture.zoom_to; }),
    plain(
        "camera.path", [](auto& s) -> auto& { return s.run_camera.path_file; }),
    plain(
        "camera.turntable", [](auto& s) -> auto& { return s.run_camera.turns; }),
    plain(
        "camera.follow", [](auto& s) -> auto& { return s.run_camera.follow; }),
    {"image.size", read_size, write_size},
    {"image.width", read_side, write_side},
    {"image.height", read_side, write_side},
    plain(
        "image.dpi", [](auto& s) -> auto& { return s.picture.dots_per_inch; }),
    plain(
        "frames.motion_blur", [](auto& s) -> auto& { return s.image.motion_blur; }),
    plain(
        "image.samples", [](auto& s) -> auto& { return s.image.samples; }),
    {"image.background", read_background, write_background},
    plain(
        "image.aovs", [](auto& s) -> auto& { return s.image.aovs; }),
    plain(
        "image.cryptomatte", [](auto& s) -> auto& { return s.image.cryptomatte; }),
    worded<Primaries::rec709, Primaries::ap1>(
        "image.color_space", [](auto& s) -> auto& { return s.image.primaries; }),
    {"image.extent", read_extent, write_extent},

    plain(
        "legend.shown", [](auto& s) -> auto& { return s.legend.within; }),
    plain(
        "legend.file", [](auto& s) -> auto& { return s.legend.file; }),
    plain(
        "legend.title", [](auto& s) -> auto& { return s.legend.style.title; }),
    letter_height(
        "legend.size", [](auto& s) -> auto& { return s.legend.style.letters; }),
    worded<LegendStyle::Place::automatic, LegendStyle::Place::right, LegendStyle::Place::below>(
        "legend.place", [](auto& s) -> auto& { return s.legend.style.place; }),
    plain(
        "legend.names", [](auto& s) -> auto& { return s.legend.style.names; }),
    letter_height(
        "annotations.letter_size", [](auto& s) -> auto& { return s.annotations.letters.all; }),
    letter_height(
        "annotations.label_size", [](auto& s) -> auto& { return s.annotations.letters.labels; }),
    letter_height(
        "annotations.scale_bar_size", [](auto& s) -> auto& { return s.annotations.letters.scale_bar; }),
    letter_height(
        "annotations.panel_size", [](auto& s) -> auto& { return s.annotations.letters.panel; }),
    {"annotations.letter_color", read_letter_color, write_letter_color},
    plain(
        "annotations.panel", [](auto& s) -> auto& { return s.annotations.panel; }),
    plain(
        "annotations.title", [](auto& s) -> auto& { return s.annotations.title; }),
    {"annotations.scale_bar", read_scale_bar, write_scale_bar},
    {"annotations.labels", read_labels, write_labels},
    plain(
        "annotations.time_stamp", [](auto& s) -> auto& { return s.annotations.time_stamp; }),
    plain(
        "annotations.curve", [](auto& s) -> auto& { return s.annotations.curve; }),
    plain(
        "annotations.curve_column", [](auto& s) -> auto& { return s.annotations.curve_column; }),

    plain(
        "mesh.tolerance", [](auto& s) -> auto& { return s.mesh.tolerance; }),
    plain(
        "mesh.tolerance_pixels", [](auto& s) -> auto& { return s.mesh.tolerance_pixels; }),
    plain(
        "mesh.density", [](auto& s) -> auto& { return s.mesh.density; }),
    plain(
        "mesh.even", [](auto& s) -> auto& { return s.mesh.even; }),
    plain(
        "mesh.format", [](auto& s) -> auto& { return s.mesh.format; }),
    plain(
        "mesh.attributes", [](auto& s) -> auto& { return s.mesh.attributes; }),
    {"mesh.unit", read_unit, [](const Property&, const Scene&) { return Written(); }},
    plain(
        "mesh.scale", [](auto& s) -> auto& { return s.mesh.scale; }),
    plain(
        "output.file", [](auto& s) -> auto& { return s.output; }),
});

}  // namespace

std::span<const SceneValue> picture_values() { return kPictureRows; }

}  // namespace meniscus::scene_values
