// SPDX-License-Identifier: BSD-3-Clause
// Looks by name, and what is asked for instead of single parts of one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace meniscus {

struct ColorScheme;
struct Look;

enum class LookPreset {
  publication,  ///< shade, thin lines, some air, colours as given
  cover,        ///< warm studio light, highlights, deep shade, no lines
  flat,         ///< constant colours, with outer, inner and chain lines of their own widths
  soft,         ///< matt and shaded, no lines and no highlights
  classic       ///< studio light alone: Look{}
};

/// A preset and what differs from it. Nothing: as the preset has it.
struct LookRequest {
  LookPreset preset = LookPreset::publication;
  std::optional<glm::vec3> light_direction{};
  std::optional<float> light_strength{}, ambient{}, roughness{}, specular{}, shininess{};
  std::optional<float> ambient_occlusion{}, ambient_occlusion_radius{};
  std::optional<float> silhouettes{};  ///< pixels; of all lines but those named next
  std::optional<float> outer_lines{}, inner_lines{}, part_lines{};
  std::optional<float> depth_cue{};
  bool linear_alpha = false;  ///< transparent edges for programs that blend in linear light

  /// classic keeps what its pictures always were.
  bool has_linear_alpha() const { return linear_alpha || preset == LookPreset::classic; }
};

/// A number of a look: the key of its property (core/properties), where a request has it, and the number itself.
struct LookNumber {
  std::string_view key;
  std::optional<float> LookRequest::*asked;
  float& (*in)(Look& look);  ///< nothing: a width of lines, of which look_of() knows the order
};

/// All of them, in the order of the help.
std::span<const LookNumber> look_numbers();

/// What light may do to colours. `kept`: each changes in lightness alone, so that it is found on the bar or among the
/// swatches that explain it: white lamps, not too bright, no highlights, no fading into the background.
enum class Hues : bool { free, kept };

/// Kept where colours stand for numbers, or a legend explains them.
Hues hues_of(const ColorScheme& color, bool legend);

/// What of the request lets colours change in more than lightness all the same: words for a message, such as
/// "--depth-cue fades them"; empty: nothing.
std::string hue_changes(const LookRequest& request);

/// The lines of a preset are so many pixels wide in a picture of 960 pixels, and wider in larger ones.
Look preset_look(LookPreset preset, glm::ivec2 picture_size);

/// background: nothing for a transparent one, in which what is far takes the colour of white paper. What the request
/// says itself counts before `hues`.
Look look_of(const LookRequest& request, glm::ivec2 picture_size, const std::optional<glm::vec3>& background,
             Hues hues);

}  // namespace meniscus
