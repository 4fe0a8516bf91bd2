// SPDX-License-Identifier: BSD-3-Clause
// The look of a picture: light, shade, lines and materials; presets by name, and single values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct ColorScheme;

/// How a surface answers the light. With ambient 1 and specular 0 a pixel is exactly of the colour given.
struct Material {
  float ambient = 0.0f;     ///< share in [0, 1] of light that comes evenly from everywhere, so that nothing is modelled
  float roughness = 0.0f;   ///< in [0, 1]: from light that falls off early, as on wax, to an even one, as on chalk
  float specular = 0.10f;   ///< strength of the highlight, 0 to 1
  float shininess = 40.0f;  ///< how small it is: the exponent of Blinn and Phong, 1 to 1000

  bool operator==(const Material&) const = default;
};

/// What differs from a look's material. Nothing: as the look has it.
struct MaterialRequest {
  std::optional<float> ambient{}, roughness{}, specular{}, shininess{};

  bool operator==(const MaterialRequest&) const = default;
  bool empty() const { return !ambient && !roughness && !specular && !shininess; }
  Material over(Material material) const {
    material.ambient = ambient.value_or(material.ambient);
    material.roughness = roughness.value_or(material.roughness);
    material.specular = specular.value_or(material.specular);
    material.shininess = shininess.value_or(material.shininess);
    return material;
  }
};

/// Which lamps and how much sky there are beside the key light.
enum class Lamps {
  studio,  ///< a warm key, a cool fill, a dim bluish sky
  white    ///< all white, so bright together that a surface that faces the key light is of the colour given
};

/// The numbers that a look and a request for one have in common: floats, or optional ones.
template <typename Number, typename MaterialNumbers>
struct LookNumbers {
  Number light_strength{};  ///< of the key light, >= 0
  MaterialNumbers material{};

  /// Strength in [0, 1] of the shade in pockets and clefts. It is found in the picture alone (ground-truth ambient
  /// occlusion, Jimenez et al. 2016): what the picture does not show casts no shade.
  Number ambient_occlusion{};
  Number ambient_occlusion_radius{};  ///< largest distance at which shade is cast, Å
  /// Rays per pixel towards all of the sky (core/render/cpu/shadow_rays.h) that find the shade if there are any. They
  /// meet everything that is drawn, even outside of the picture.
  Number ambient_occlusion_rays{};

  Number shadows{};          ///< darkness in [0, 1] of the shadows that the key light casts
  Number shadow_softness{};  ///< half the lamp's angular diameter, degrees, below 90; 0: sharp shadows

  /// Share in [0, 1] by which the farthest atoms fade into the background; the nearest do not.
  Number depth_cue{};

  bool operator==(const LookNumbers&) const = default;
};

/// Light, depth cue and outlines of a picture. Effects are deterministic.
struct Look : LookNumbers<float, Material> {
  Look() {
    light_strength = 1.0f;
    ambient_occlusion_radius = 8.0f;
  }

  glm::vec3 background{1.0f};  ///< sRGB in [0, 1]

  /// Towards the key light, in the picture's axes (right, up, towards the viewer); any length but 0.
  glm::vec3 light_direction{-0.45f, 0.65f, 0.75f};
  Lamps lamps = Lamps::studio;

  /// Width in pixels, at most 16, of black lines where something is in front of something else, the stronger the
  /// farther, and where parts meet (Coloring::part). 0: none.
  float silhouettes = 0.0f;
  /// The same of single kinds of lines: around all, around what is in front of something else, where parts meet.
  /// Nothing: silhouettes.
  std::optional<float> outer_lines, inner_lines, part_lines;
  /// Width in pixels of lines around patches (Coloring::in_patch), on the surface, and their colour, sRGB in [0, 1].
  float patch_lines = 0.0f;
  glm::vec3 patch_line_color{0.0f};
  /// How far something must be in front of something else for a line between them, as a share of what the picture's
  /// shorter side shows, and half an Å: so that atoms are outlined close by, and domains from afar. 0: of two pixels.
  float line_step = 0.0f;

  /// True: far atoms take the background's colour and stay as opaque as they are. False: they get transparent.
  bool depth_cue_keeps_alpha = false;

  bool operator==(const Look&) const = default;

  /// True if colours change after they are cast.
  bool has_effects() const { return ambient_occlusion > 0.0f || widest_line() > 0.0f || depth_cue > 0.0f; }

  bool traces_sky() const { return ambient_occlusion > 0.0f && ambient_occlusion_rays > 0.0f; }
  /// Highlights are added once shade is known, unless the rays that cast them know it already.
  bool finishes_highlights() const { return ambient_occlusion > 0.0f && !traces_light(); }
  /// True if rays go on from where they meet something: such pictures are made on the CPU.
  bool traces_light() const { return shadows > 0.0f || traces_sky(); }

  float widest_silhouette() const {
    return std::max(
        {outer_lines.value_or(silhouettes), inner_lines.value_or(silhouettes), part_lines.value_or(silhouettes)});
  }
  float widest_line() const { return std::max(widest_silhouette(), patch_lines); }
};

inline constexpr float kWidestSilhouette = 16.0f;  ///< pixels

/// Pixels across a texel of the map of depths that shade is found from: a pixel each, up to pictures so large that a
/// map of kShadeMapSide says the same.
inline float shade_texel_edge(glm::ivec2 picture_size) {
  constexpr int kLargestOwnMap = 2048, kShadeMapSide = 1024;
  const int side = picture_size.x > picture_size.y ? picture_size.x : picture_size.y;
  return side <= kLargestOwnMap ? 1.0f : static_cast<float>(side) / kShadeMapSide;
}

/// How far around a pixel shade depends on the picture's own pixels instead of that map: some texels.
inline int near_shade_reach(glm::ivec2 picture_size) {
  const float edge = shade_texel_edge(picture_size);
  return edge == 1.0f ? 0 : static_cast<int>(8.0f * edge);
}

/// How far around a pixel its colour depends on pixels of its own size, in whole tiles of 16; in pixels.
inline int look_reach(const Look& look, glm::ivec2 picture_size) {
  if (look.ambient_occlusion > 0.0f) return (near_shade_reach(picture_size) + 15) / 16 * 16 + 16;
  return look.widest_line() > 0.0f ? 16 : 0;
}

enum class LookPreset {
  publication,  ///< shade, thin lines, some air, colours as given
  cover,        ///< warm studio light, highlights, deep shade, no lines
  flat,         ///< constant colours, with outer, inner and chain lines of their own widths
  soft,         ///< matt and shaded, no lines and no highlights
  classic       ///< studio light alone: Look{}
};

/// A preset and what differs from it. Nothing: as the preset has it.
struct LookRequest : LookNumbers<std::optional<float>, MaterialRequest> {
  LookPreset preset = LookPreset::publication;
  std::optional<glm::vec3> light_direction{};
  std::optional<float> silhouettes{};  ///< pixels; of all lines but those named next
  std::optional<float> outer_lines{}, inner_lines{}, part_lines{};
  std::optional<float> patch_lines{};  ///< pixels
  std::optional<glm::vec3> patch_line_color{};
  bool linear_alpha = false;  ///< transparent edges for programs that blend in linear light

  /// Returns true if alpha is linear; `classic` keeps it so for compatibility.
  bool has_linear_alpha() const { return linear_alpha || preset == LookPreset::classic; }
};

/// A number of a look.
struct LookNumber {
  std::string_view key;  ///< of its property (core/properties)
  std::optional<float>* (*asked)(LookRequest& request);
  float& (*in)(Look& look);  ///< null for a width of lines, of which look_of() knows the order
};

/// All of them, in the order of the help.
std::span<const LookNumber> look_numbers();

/// What light may do to colours. `kept`: each changes in lightness alone, so that it is found on the bar or among the
/// swatches that explain it: white lamps, not too bright, no highlights, no fading into the background. `unfaded`: the
/// last alone.
enum class Hues : std::uint8_t { free, kept, unfaded };

/// Kept where colours stand for numbers, or a legend explains them; unfaded where a surface is seen through, which
/// covers what lies in it already, or cut so that some atoms are seen, which are looked for in its depth
/// (looks_inside).
Hues hues_of(const ColorScheme& color, bool legend, bool looks_inside);

/// What of the request lets colours change in more than lightness all the same: words for a message, such as
/// "depth_cue fades them"; empty: nothing.
std::string hue_changes(const LookRequest& request);

/// background: nothing for a transparent one, in which what is far takes the colour of white paper. What the request
/// says itself counts before `hues`. outlines_patches: without it there are no lines around any.
Look look_of(LookRequest request, glm::ivec2 picture_size, const std::optional<glm::vec3>& background, Hues hues,
             bool outlines_patches = false);

}  // namespace meniscus
