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

/// The response of a surface to light. With ambient 1 and specular 0 a pixel has exactly the colour given.
struct Material {
  float ambient = 0.0f;  ///< share in [0, 1] of light that comes evenly from all directions, which hides shapes
  /// Roughness in [0, 1]. 0: light falls off early away from the lamp, as on wax; 1: it stays even, as on chalk.
  float roughness = 0.0f;
  float specular = 0.10f;   ///< strength of the highlight, 0 to 1
  float shininess = 40.0f;  ///< exponent of Blinn and Phong, 1 to 1000; higher values make smaller highlights

  bool operator==(const Material&) const = default;
};

/// The requested differences from the look's material. A missing value is kept.
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

/// The lamps and the light of the sky in addition to the key light.
enum class Lamps {
  studio,  ///< a warm key, a cool fill, a dim bluish sky
  white    ///< all white; a surface that faces the key light has exactly the colour given
};

/// The numbers that a look and a request for one have in common. Number is float or std::optional<float>.
template <typename Number, typename MaterialNumbers>
struct LookNumbers {
  Number light_strength{};  ///< strength of the key light, >= 0
  MaterialNumbers material{};

  /// Strength in [0, 1] of the shade in pockets and clefts. Unless ambient_occlusion_rays is set, it is computed from
  /// maps (core/render/light_maps.h).
  Number ambient_occlusion{};
  Number ambient_occlusion_radius{};  ///< largest distance over which rays find shade, Å
  /// Rays per pixel, over the whole sky, by which the shade is computed instead (core/render/cpu/shadow_rays.h), as
  /// well as the shadows; 0: none.
  Number ambient_occlusion_rays{};

  Number shadows{};          ///< darkness in [0, 1] of the shadows that the key light casts
  Number shadow_softness{};  ///< half the lamp's angular diameter, degrees, below 90; 0: sharp shadows, by rays

  /// Share in [0, 1] by which the farthest atoms fade into the background; the nearest do not.
  Number depth_cue{};

  bool operator==(const LookNumbers&) const = default;
};

/// Light, depth cue and outlines of a picture. Effects are deterministic.
struct Look : LookNumbers<float, Material> {
  Look() {
    light_strength = 1.0f;
    ambient_occlusion_radius = 25.0f;
  }

  glm::vec3 background{1.0f};  ///< sRGB in [0, 1]

  /// Direction towards the key light in the picture's axes (right, up, towards the viewer); any length but 0.
  glm::vec3 light_direction{-0.45f, 0.65f, 0.75f};
  Lamps lamps = Lamps::studio;

  /// Width in pixels, at most 16, of black lines at steps in depth, which are stronger at larger steps, and at borders
  /// of parts (Coloring::part). 0: no lines.
  float silhouettes = 0.0f;
  /// Widths of single kinds of lines: around everything, at steps in depth, at borders of parts. Nothing: the width is
  /// `silhouettes`.
  std::optional<float> outer_lines, inner_lines, part_lines;
  /// Width in pixels of lines around patches (Coloring::in_patch), on the surface, and their colour, sRGB in [0, 1].
  float patch_lines = 0.0f;
  glm::vec3 patch_line_color{0.0f};
  /// The smallest step in depth that gets a line is 0.5 Å plus a length in pixels: this share of the picture's shorter
  /// side, but at least two pixels. Pixels count by their size in Å at that depth, so that close views outline atoms
  /// and distant views domains.
  float line_step = 0.0f;

  /// True: far atoms fade into the background's colour and keep their alpha. False: they become transparent.
  bool depth_cue_keeps_alpha = false;

  bool operator==(const Look&) const = default;

  /// True if an effect changes colours after the rays of the picture are cast.
  bool has_effects() const { return has_shade() || widest_line() > 0.0f || depth_cue > 0.0f; }
  /// True if light is changed after the rays of the picture are cast.
  bool has_shade() const { return ambient_occlusion > 0.0f || maps_lamp(); }

  bool traces_sky() const { return ambient_occlusion > 0.0f && ambient_occlusion_rays > 0.0f; }
  /// True if rays continue from the points that they hit. Such pictures are made on the CPU.
  bool traces_light() const { return traces_sky() || (shadows > 0.0f && shadow_softness == 0.0f); }
  /// True if the visibility of the sky, and that of the lamp, comes from maps (core/render/light_maps.h).
  bool maps_sky() const { return ambient_occlusion > 0.0f && !traces_sky(); }
  bool maps_lamp() const { return shadows > 0.0f && !traces_light(); }
  /// True if highlights are added after the shade: the shade covers them, but is not yet known when the rays are cast.
  bool finishes_highlights() const { return has_shade() && !traces_light(); }

  float widest_silhouette() const {
    return std::max(
        {outer_lines.value_or(silhouettes), inner_lines.value_or(silhouettes), part_lines.value_or(silhouettes)});
  }
  float widest_line() const { return std::max(widest_silhouette(), patch_lines); }
};

inline constexpr float kWidestSilhouette = 16.0f;  ///< pixels

/// Returns the distance in pixels, in whole tiles of 16, around a pixel within which its colour depends on other
/// pixels.
inline int look_reach(const Look& look) { return look.has_shade() || look.widest_line() > 0.0f ? 16 : 0; }

enum class LookPreset {
  publication,  ///< shade, thin lines, slight depth cue, colours as given
  cover,        ///< warm studio light, highlights, deep shade, no lines
  flat,         ///< constant colours, with outer, inner and chain lines of their own widths
  soft,         ///< matt and shaded, no lines and no highlights
  classic       ///< studio light alone: Look{}
};

/// A preset and the requested differences from it. A missing value is that of the preset.
struct LookRequest : LookNumbers<std::optional<float>, MaterialRequest> {
  LookPreset preset = LookPreset::publication;
  std::optional<glm::vec3> light_direction{};
  std::optional<float> silhouettes{};  ///< pixels; all lines except the ones named next
  std::optional<float> outer_lines{}, inner_lines{}, part_lines{};
  std::optional<float> patch_lines{};  ///< pixels
  std::optional<glm::vec3> patch_line_color{};
  /// True: the values of transparent pixels are right for programs that blend in linear light, else in sRGB.
  bool linear_alpha = false;

  /// True if alpha is linear; `classic` always has linear alpha, for compatibility.
  bool has_linear_alpha() const { return linear_alpha || preset == LookPreset::classic; }
};

/// The description of a number of a look.
struct LookNumber {
  std::string_view key;                                      ///< key of its property (core/properties)
  std::optional<float>* (*requested)(LookRequest& request);  ///< returns the number's place in the request, never null
  /// Returns the number in the look; null for the widths of lines, which look_of() copies itself.
  float& (*in)(Look& look);
};

/// Returns the descriptions of all numbers in the order of the help.
std::span<const LookNumber> look_numbers();

/// The changes of colours that light may cause. `free`: any. `kept`: only the lightness changes, so that a colour can
/// be compared with the bar or the swatches that explain it; look_of() then makes lamps white, limits the key light to
/// strength 1, leaves out highlights and the depth cue, and makes shade weaker, so that dark colours can be read.
/// `unfaded`: look_of() leaves out the depth cue only.
enum class Hues : std::uint8_t { free, kept, unfaded };

/// Returns `kept` if the scheme or a rule of `color` colours by a number. Otherwise returns `unfaded` if a rule makes
/// the surface transparent, which dims its content already, or if looks_inside is true: then the surface is cut to show
/// atoms, which must be recognisable at any depth. Otherwise returns `free`.
Hues hues_of(const ColorScheme& color, bool looks_inside);

/// Returns the part of the request that changes more than the lightness of colours in spite of Hues::kept, in words for
/// a message, such as "depth_cue fades them"; empty if there is none.
std::string hue_changes(const LookRequest& request);

/// Returns the look of a request. Widths of lines in a preset grow with picture_size. `background` is nothing if it is
/// transparent; then presets have no depth cue, and a requested one fades colours into white, as on paper. Values of
/// the request have priority over `hues` and are not checked. Patches have lines only if outlines_patches is true.
Look look_of(LookRequest request, glm::ivec2 picture_size, const std::optional<glm::vec3>& background, Hues hues,
             bool outlines_patches = false);

}  // namespace meniscus
