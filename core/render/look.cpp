// SPDX-License-Identifier: BSD-3-Clause
// Defines the presets of the look, and overrides single values of them.
#include "core/render/look.h"

#include "core/base/text.h"
#include "core/color/color_schemes.h"

namespace meniscus {
namespace {

/// Returns the width in pixels of a line that is `width` pixels wide in a picture of 960 pixels.
float line_width(float width, glm::ivec2 picture_size) {
  constexpr float kUsualSide = 960.0f, kThinnest = 0.75f;
  const auto side = static_cast<float>(std::min(picture_size.x, picture_size.y));
  return std::clamp(width * side / kUsualSide, kThinnest, kWidestSilhouette);
}

/// Returns the values that all presets but classic have in common.
Look modern() {
  Look look;
  look.lamps = Lamps::white;
  look.line_step = 0.012f;
  look.depth_cue_keeps_alpha = true;
  return look;
}

Look publication(glm::ivec2 size) {
  Look look = modern();
  look.light_strength = 1.15f;
  look.material = {.ambient = 0.5f, .roughness = 0.35f, .specular = 0.06f, .shininess = 60.0f};
  look.ambient_occlusion = 0.9f;
  look.shadows = 0.35f;
  look.shadow_softness = 12.0f;
  look.outer_lines = line_width(1.8f, size);
  look.inner_lines = line_width(1.2f, size);
  look.part_lines = line_width(1.4f, size);
  look.depth_cue = 0.1f;
  return look;
}

Look cover() {
  Look look = modern();
  look.lamps = Lamps::studio;
  look.light_strength = 1.4f;
  look.material = {.ambient = 0.0f, .roughness = 0.15f, .specular = 0.25f, .shininess = 80.0f};
  look.ambient_occlusion = 1.0f;
  look.depth_cue = 0.1f;
  return look;
}

Look flat(glm::ivec2 size) {
  Look look = modern();
  look.material = {.ambient = 1.0f, .roughness = 0.0f, .specular = 0.0f, .shininess = 40.0f};
  look.line_step = 0.006f;  // there is no shade, so more lines are needed
  look.outer_lines = line_width(3.0f, size);
  look.inner_lines = line_width(1.2f, size);
  look.part_lines = line_width(2.0f, size);
  return look;
}

Look soft() {
  Look look = modern();
  look.material = {.ambient = 0.0f, .roughness = 1.0f, .specular = 0.0f, .shininess = 40.0f};
  look.ambient_occlusion = 1.0f;
  look.depth_cue = 0.1f;
  return look;
}

/// White light times a colour in linear light keeps its hue and its saturation (CIE 1976 h_uv and s_uv). Adding white,
/// as highlights and depth cues do, or light that clips a channel does not. The dark half of a map such as viridis
/// stays legible only if shade takes little of its light.
void keep_hues(Look& look) {
  constexpr float kShadeLeft = 0.6f;
  look.material.ambient = 1.0f - kShadeLeft * (1.0f - look.material.ambient);
  look.ambient_occlusion *= kShadeLeft;
  look.lamps = Lamps::white;
  look.light_strength = 1.0f;
  look.material.specular = 0.0f;
  look.depth_cue = 0.0f;
}

/// Returns the description of a number. member: a function that returns the address of the number in a look or in a
/// request.
template <typename Member>
constexpr LookNumber number(std::string_view key, Member member) {
  return {key, member, [](Look& look) -> float& { return *Member{}(look); }};
}

constexpr LookNumber kNumbers[] = {
    number("look.light_strength", [](auto& look) { return &look.light_strength; }),
    number("look.ambient", [](auto& look) { return &look.material.ambient; }),
    number("look.roughness", [](auto& look) { return &look.material.roughness; }),
    number("look.specular", [](auto& look) { return &look.material.specular; }),
    number("look.shininess", [](auto& look) { return &look.material.shininess; }),
    number("look.ambient_occlusion", [](auto& look) { return &look.ambient_occlusion; }),
    number("look.ambient_occlusion_radius", [](auto& look) { return &look.ambient_occlusion_radius; }),
    number("look.ambient_occlusion_rays", [](auto& look) { return &look.ambient_occlusion_rays; }),
    number("look.shadows", [](auto& look) { return &look.shadows; }),
    number("look.shadow_softness", [](auto& look) { return &look.shadow_softness; }),
    number("look.depth_cue", [](auto& look) { return &look.depth_cue; }),
    {"look.silhouettes", [](LookRequest& look) { return &look.silhouettes; }, nullptr},
    {"look.outer_lines", [](LookRequest& look) { return &look.outer_lines; }, nullptr},
    {"look.inner_lines", [](LookRequest& look) { return &look.inner_lines; }, nullptr},
    {"look.part_lines", [](LookRequest& look) { return &look.part_lines; }, nullptr},
    {"look.patch_lines", [](LookRequest& look) { return &look.patch_lines; }, nullptr},
};

template <typename T, typename U>
void take(const std::optional<T>& asked, U& value) {
  if (asked) value = *asked;
}

/// Returns a preset. Its lines have the given widths in a picture of 960 pixels, and are wider in larger pictures.
Look preset_look(LookPreset preset, glm::ivec2 picture_size) {
  switch (preset) {
    case LookPreset::publication:
      return publication(picture_size);
    case LookPreset::cover:
      return cover();
    case LookPreset::flat:
      return flat(picture_size);
    case LookPreset::soft:
      return soft();
    case LookPreset::classic:
      break;
  }
  return {};
}

}  // namespace

std::span<const LookNumber> look_numbers() { return kNumbers; }

Hues hues_of(const ColorScheme& color, bool looks_inside) {
  if (color.uses_scale()) return Hues::kept;
  const bool seen_through = std::ranges::any_of(
      color.opacities, [](const OpacityRule& rule) { return rule.opacity > 0.0f && rule.opacity < 1.0f; });
  return seen_through || looks_inside ? Hues::unfaded : Hues::free;
}

std::string hue_changes(const LookRequest& request) {
  std::string text;
  const auto add = [&](bool asked, const std::string& words) {
    if (asked) text += (text.empty() ? "" : ", ") + words;
  };
  add(request.depth_cue.value_or(0.0f) > 0.0f, message("@depth-cue@ fades them into the background"));
  add(request.material.specular.value_or(0.0f) > 0.0f, message("@specular@ lays white highlights over them"));
  add(request.light_strength.value_or(1.0f) > 1.0f, message("@light-strength@ above 1 bleaches them"));
  return text;
}

Look look_of(LookRequest request, glm::ivec2 picture_size, const std::optional<glm::vec3>& background, Hues hues,
             bool outlines_patches) {
  Look look = preset_look(request.preset, picture_size);
  if (hues == Hues::kept) keep_hues(look);
  if (hues == Hues::unfaded || !background) look.depth_cue = 0.0f;
  look.background = background.value_or(glm::vec3(1.0f));
  take(request.light_direction, look.light_direction);
  for (const LookNumber& number : look_numbers())
    if (number.in) take(*number.requested(request), number.in(look));
  if (request.silhouettes) {
    look.silhouettes = *request.silhouettes;
    look.outer_lines = look.inner_lines = look.part_lines = {};
  }
  take(request.outer_lines, look.outer_lines);
  take(request.inner_lines, look.inner_lines);
  take(request.part_lines, look.part_lines);
  if (!outlines_patches) return look;
  look.patch_lines = request.patch_lines.value_or(line_width(2.5f, picture_size));
  take(request.patch_line_color, look.patch_line_color);
  return look;
}

}  // namespace meniscus
