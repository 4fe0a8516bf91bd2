// SPDX-License-Identifier: BSD-3-Clause
// Binds the values of the look, the camera, the picture, its annotations and its files.
#include <charconv>

#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/named_colors.h"
#include "core/scene/scene_value.h"
#include "core/scene/scene_values.h"

namespace meniscus::scene_values {
namespace {

// The values of look, camera and picture follow.

glm::vec3 direction_of(const std::string& text) {
  std::array<float, 3> parts{};
  std::size_t count = 0;
  std::string_view left = text;
  bool is_read = true;
  while (is_read && !left.empty() && count < parts.size()) {
    const std::size_t comma = std::min(left.find(','), left.size());
    is_read = parse_single(left.substr(0, comma), parts[count++]);
    left.remove_prefix(std::min(comma + 1, left.size()));
  }
  const float length = std::hypot(parts[0], parts[1], parts[2]);
  if (!is_read || count != parts.size() || !left.empty() || !std::isfinite(length) || length < 1e-6f)
    throw RequestError("expected a direction: three numbers that are not all 0, such as -1,1,1");
  return {parts[0], parts[1], parts[2]};
}

std::string direction_text(const glm::vec3& light) { return fmt::format("{},{},{}", light.x, light.y, light.z); }

ViewDirection view_of(const std::string& text) {
  if (const std::optional<ViewDirection> view = parse_view_direction(text)) return *view;
  throw RequestError("{} is not one of {}", in_quotes(text), fmt::join(view_direction_words(), ", "));
}

std::string view_text(const ViewDirection& view) {
  const std::vector<std::string> words = view_direction_words();
  return *std::ranges::find(words, std::optional(view), parse_view_direction);
}

Turn turn_of(const std::string& text) {
  if (const std::optional<Turn> turn = parse_turn(text)) return *turn;
  throw RequestError(in_quotes(text) +
                     " is not an axis of the picture (x, y, z) followed by degrees, such as y90 or x-30");
}

std::string turn_text(const Turn& turn) { return fmt::format("{}{}", "xyz"[turn.axis], turn.degrees); }

void read_background(const Property&, Texts texts, Scene& scene) {
  scene.image.background = parse_color_or("transparent", texts.back());
  scene.film.transparent = !scene.image.background;
}

Written write_background(const Property&, const Scene& scene) {
  if (!scene.image.background) return scene.film.transparent ? Written{"transparent"} : Written();
  return {hex_color(*scene.image.background)};
}

void reset_background(const Property&, Scene& scene) {
  scene.image.background.reset();
  scene.film.transparent = false;
}

// The values of sizes and letters follow.

void read_size(const Property&, Texts texts, Scene& scene) {
  const std::string_view text = texts.back();
  scene.picture.fits = text == "auto";
  if (scene.picture.fits) return;
  const std::size_t cross = text.find('x');
  const auto parse_side = [](std::string_view digits, int& side) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    return error == std::errc() && end == digits.data() + digits.size() && side >= 1 && side <= kLargestSide;
  };
  if (cross == std::string::npos || !parse_side(text.substr(0, cross), scene.picture.width) ||
      !parse_side(text.substr(cross + 1), scene.picture.height))
    throw RequestError("{} is not WIDTHxHEIGHT in pixels, 1 to {} each, such as 1920x1080", in_quotes(text),
                       kLargestSide);
  scene.lengths.erase("image.width");
  scene.lengths.erase("image.height");
}

Written write_size(const Property&, const Scene& scene) {
  if (scene.picture.fits && !has_lengths_of_sides(scene)) return {"auto"};
  if (scene.picture.size() == usual_scene().picture.size() || has_lengths_of_sides(scene)) return {};
  return {fmt::format("{}x{}", scene.picture.width, scene.picture.height)};
}

void reset_size(const Property&, Scene& scene) {
  scene.picture.fits = false;
  scene.picture.width = usual_scene().picture.width;
  scene.picture.height = usual_scene().picture.height;
  scene.lengths.erase("image.width");
  scene.lengths.erase("image.height");
}

void read_side(const Property& property, Texts texts, Scene& scene) {
  const bool is_height = property.key == "image.height";
  if (is_height) scene.picture.fits = texts.back() == "auto";
  if (is_height && scene.picture.fits) return;
  side_in_pixels(texts.back(), scene.picture.dots_per_inch);
  scene.lengths[std::string(property.key)] = texts.back();
}

Written write_side(const Property& property, const Scene& scene) {
  const auto length = scene.lengths.find(property.key);
  if (!has_lengths_of_sides(scene)) return {};
  if (length != scene.lengths.end()) return {length->second};
  return property.key == "image.height" && scene.picture.fits ? Written{"auto"} : Written();
}

void reset_side(const Property& property, Scene& scene) {
  if (property.key == "image.height") scene.picture.fits = false;
  scene.lengths.erase(std::string(property.key));
}

void read_margin(const Property& property, Texts texts, Scene& scene) {
  read_length(property, texts, scene, scene.picture.margin, "a margin has");
}

Written write_margin(const Property& property, const Scene& scene) {
  return written_length(property, scene, scene.picture.margin);
}

std::optional<float>& number_of(const Property& property, LookRequest& look) {
  return *std::ranges::find(look_numbers(), property.key, &LookNumber::key)->requested(look);
}

/// Reads a number of the look; widths of lines are lengths.
void read_look_number(const Property& property, Texts texts, Scene& scene) {
  std::optional<float>& number = number_of(property, scene.look);
  if (property.type == ValueType::number) return read(property, texts, number);
  read_length(property, texts, scene, number, "a line has");
}

Written write_look_number(const Property& property, const Scene& scene) {
  LookRequest look = scene.look;
  return written_length(property, scene, number_of(property, look));
}

void reset_look_number(const Property& property, Scene& scene) {
  number_of(property, scene.look).reset();
  scene.lengths.erase(std::string(property.key));
}

template <typename Member>
constexpr SceneValue letter_height(std::string_view key, Member) {
  return {
      key,
      [](const Property& property, Texts texts, Scene& scene) {
        read_length(property, texts, scene, *Member{}(scene), "letters have");
      },
      [](const Property& property, const Scene& scene) { return written_length(property, scene, *Member{}(scene)); },
      [](const Property& property, Scene& scene) {
        Member{}(scene)->reset();
        scene.lengths.erase(std::string(property.key));
      }};
}

std::optional<glm::vec3> auto_or_color(const std::string& text) { return parse_color_or("auto", text); }

void read_scale_bar(const Property&, Texts texts, Scene& scene) { parse_scale_bar(texts.back(), scene.annotations); }

Written write_scale_bar(const Property&, const Scene& scene) {
  if (!scene.annotations.scale_bar) return {};
  return {scene.annotations.bar_length ? fmt::format("{}", *scene.annotations.bar_length) : "auto"};
}

void reset_scale_bar(const Property&, Scene& scene) {
  scene.annotations.scale_bar = false;
  scene.annotations.bar_length.reset();
}

std::string label_text(const LabelRequest& label) { return label.atoms.text() + "=" + label.text; }

void read_unit(const Property& property, Texts texts, Scene& scene) {
  constexpr double kNanometers = 0.1;
  scene.mesh.scale = place_of_word(words_of(property), texts.back()) == 0 ? 1.0 : kNanometers;
}

constexpr auto kPictureRows = std::to_array<SceneValue>({
    worded<LookPreset::publication, LookPreset::cover, LookPreset::flat, LookPreset::soft, LookPreset::classic, kGhost,
           kGoodsell, kPocket, kRibbon>("look.preset", [](auto& s) { return &s.look.preset; }),
    coded<direction_of, direction_text>("look.light", [](auto& s) { return &s.look.light_direction; }),
    coded<parse_any_color, hex_color>("look.patch_line_color", [](auto& s) { return &s.look.patch_line_color; }),
    plain("look.linear_alpha", [](auto& s) { return &s.look.linear_alpha; }),
    plain("look.material", [](auto& s) { return &s.renderer.material; }),
    plain("look.comments", [](auto& s) { return &s.renderer.comments; }),

    plain("camera.from", [](auto& s) { return &s.picture.camera_file; }),
    worded<Projection::perspective, Projection::orthographic>("camera.projection",
                                                              [](auto& s) { return &s.picture.projection; }),
    coded<view_of, view_text>("camera.view", [](auto& s) { return &s.picture.direction; }),
    coded<turn_of, turn_text>("camera.turn", [](auto& s) { return &s.picture.turns; }),
    plain("camera.zoom_to", [](auto& s) { return &s.picture.zoom_to; }),
    plain("camera.path", [](auto& s) { return &s.run_camera.path_file; }),
    plain("camera.turntable", [](auto& s) { return &s.run_camera.turns; }),
    plain("camera.follow", [](auto& s) { return &s.run_camera.follow; }),
    {"image.size", read_size, write_size, reset_size},
    {"image.width", read_side, write_side, reset_side},
    {"image.height", read_side, write_side, reset_side},
    {"image.margin", read_margin, write_margin},
    plain("image.dpi", [](auto& s) { return &s.picture.dots_per_inch; }),
    plain("frames.motion_blur", [](auto& s) { return &s.image.motion_blur; }),
    plain("image.samples", [](auto& s) { return &s.image.samples; }),
    {"image.background", read_background, write_background, reset_background},
    plain("image.aovs", [](auto& s) { return &s.image.aovs; }),
    plain("image.cryptomatte", [](auto& s) { return &s.image.cryptomatte; }),
    worded<Primaries::rec709, Primaries::ap1>("image.color_space", [](auto& s) { return &s.image.primaries; }),
    worded<TiffCompression::none, TiffCompression::lzw, TiffCompression::zip>(
        "image.tiff_compression", [](auto& s) { return &s.image.tiff.compression; }),
    worded<8, 16>("image.tiff_bits", [](auto& s) { return &s.image.tiff.bits; }),
    worded<Extent::visible, Extent::complete, Extent::paper>("image.extent", [](auto& s) { return &s.image.extent; }),

    plain("legend.shown", [](auto& s) { return &s.legend.within; }),
    plain("legend.file", [](auto& s) { return &s.legend.file; }),
    plain("legend.title", [](auto& s) { return &s.legend.style.title; }),
    letter_height("legend.size", [](auto& s) { return &s.legend.style.letters; }),
    worded<LegendStyle::Place::automatic, LegendStyle::Place::right, LegendStyle::Place::below>(
        "legend.place", [](auto& s) { return &s.legend.style.place; }),
    plain("legend.names", [](auto& s) { return &s.legend.style.names; }),
    letter_height("annotations.letter_size", [](auto& s) { return &s.annotations.letters.all; }),
    letter_height("annotations.label_size", [](auto& s) { return &s.annotations.letters.labels; }),
    letter_height("annotations.scale_bar_size", [](auto& s) { return &s.annotations.letters.scale_bar; }),
    letter_height("annotations.panel_size", [](auto& s) { return &s.annotations.letters.panel; }),
    plain("annotations.font", [](auto& s) { return &s.annotations.letters.font.family; }),
    plain("annotations.font_file", [](auto& s) { return &s.annotations.letters.font.file; }),
    coded<auto_or_color, hex_color>("annotations.letter_color", [](auto& s) { return &s.annotations.letters.color; }),
    plain("annotations.panel", [](auto& s) { return &s.annotations.panel; }),
    plain("annotations.title", [](auto& s) { return &s.annotations.title; }),
    {"annotations.scale_bar", read_scale_bar, write_scale_bar, reset_scale_bar},
    coded<parse_label, label_text>("annotations.labels", [](auto& s) { return &s.annotations.labels; }),
    plain("annotations.lengths", [](auto& s) { return &s.annotations.hides_lengths; }),
    plain("annotations.time_stamp", [](auto& s) { return &s.annotations.time_stamp; }),
    plain("annotations.curve", [](auto& s) { return &s.annotations.curve; }),
    plain("annotations.curve_column", [](auto& s) { return &s.annotations.curve_column; }),

    plain("mesh.tolerance", [](auto& s) { return &s.mesh.tolerance; }),
    plain("mesh.tolerance_pixels", [](auto& s) { return &s.mesh.tolerance_pixels; }),
    plain("mesh.density", [](auto& s) { return &s.mesh.density; }),
    plain("mesh.even", [](auto& s) { return &s.mesh.even; }),
    plain("mesh.format", [](auto& s) { return &s.mesh.format; }),
    plain("mesh.attributes", [](auto& s) { return &s.mesh.attributes; }),
    {"mesh.unit", read_unit, [](const Property&, const Scene&) { return Written(); }},
    plain("mesh.scale", [](auto& s) { return &s.mesh.scale; }),
    plain("output.file", [](auto& s) { return &s.output; }),
});

}  // namespace

std::span<const SceneValue> picture_values() {
  static const std::vector<SceneValue> rows = [] {
    std::vector<SceneValue> all(kPictureRows.begin(), kPictureRows.end());
    for (const LookNumber& number : look_numbers())
      all.push_back({number.key, read_look_number, write_look_number, reset_look_number});
    return all;
  }();
  return rows;
}

}  // namespace meniscus::scene_values
