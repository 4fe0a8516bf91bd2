// SPDX-License-Identifier: BSD-3-Clause
// Lengths in pictures: in pixels, or in millimetres, inches and points on paper.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include <glm/vec2.hpp>

#include "core/scene/scene_value.h"

namespace meniscus::scene_values {

inline constexpr int kLargestSide = 65535;  // pixels; PNG and EXR readers of other programs stop here
/// Dots per inch of lengths on paper where nothing else is said.
inline constexpr double kUsualResolution = 300.0;

struct Length {
  double value = 0.0;
  double per_inch = 0.0;  ///< 0: pixels

  double pixels(double dots_per_inch) const;
};

/// "85mm", "8.5cm", "3.5in", "8pt", "1000px" or "1000". Throws RequestError.
Length parse_length(const std::string& text);

/// A side of a picture. Throws RequestError for one of no pixel or too many, once the resolution is known.
int side_in_pixels(const std::string& text, double dots_per_inch);
/// Of lines and letters, within the range of the property. what: "a line has". Throws RequestError likewise.
double pixels_in_range(const Property& property, const std::string& text, double dots_per_inch, const char* what);

/// Remembers a length on paper as it was given.
void keep_length(Scene& scene, std::string_view key, const std::string& text);

/// Pixels as a width of lines has them, or as a height of letters, which is whole.
template <typename Number>
Number as_width(double pixels) {
  return static_cast<Number>(std::is_integral_v<Number> ? std::round(pixels) : pixels);
}

template <typename Number>
void read_length(const Property& property, Texts texts, Scene& scene, std::optional<Number>& width, const char* what) {
  width = as_width<Number>(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, what));
  keep_length(scene, property.key, texts.back());
}

/// The text on paper counts as long as it still means that width.
template <typename Number>
Written written_length(const Property& property, const Scene& scene, const std::optional<Number>& width) {
  const auto length = scene.lengths.find(property.key);
  if (width && length != scene.lengths.end() &&
      as_width<Number>(parse_length(length->second).pixels(scene.picture.dots_per_inch)) == *width)
    return {length->second};
  return written(width, {});
}

/// The size that lengths make of sides. One side alone keeps the shape of the usual picture.
glm::ivec2 size_by_lengths(const Scene& scene);
/// Whether the size of the picture is the one that lengths make.
bool has_lengths_of_sides(const Scene& scene);

}  // namespace meniscus::scene_values
