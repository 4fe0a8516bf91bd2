// SPDX-License-Identifier: BSD-3-Clause
// Lengths in pictures: in pixels, or in millimetres, inches and points on paper.
#pragma once

#include "core/scene/scene_value.h"

namespace meniscus::scene_values {

inline constexpr int kLargestSide = 65535;  // pixels; PNG and EXR readers of other programs accept no more
/// The default resolution of lengths on paper, dots per inch.
inline constexpr double kUsualResolution = 300.0;

/// A length in pixels or on paper.
struct Length {
  double value = 0.0;
  double per_inch = 0.0;  ///< units per inch; 0: pixels

  /// Returns the length in pixels. A resolution of 0 is not known; kUsualResolution is then used.
  double pixels(double dots_per_inch) const;
};

/// Parses "85mm", "8.5cm", "3.5in", "8pt", "1000px" or "1000". Throws RequestError.
Length parse_length(const std::string& text);

/// Returns a side of a picture in pixels. Throws RequestError if it has no pixel or too many, provided that the
/// resolution is known.
int side_in_pixels(const std::string& text, double dots_per_inch);
/// Returns a length of lines or letters in pixels. what: the subject of the message, "a line has". Throws RequestError
/// if it is outside of the property's range, provided that the resolution is known.
double pixels_in_range(const Property& property, const std::string& text, double dots_per_inch, const char* what);

/// Keeps the text of a length on paper in the scene.
void keep_length(Scene& scene, std::string_view key, const std::string& text);

/// Converts pixels to the type of a width: widths of lines may be fractions, heights of letters are whole numbers.
template <typename Number>
Number as_width(double pixels) {
  return static_cast<Number>(std::is_integral_v<Number> ? std::round(pixels) : pixels);
}

template <typename Number>
void read_length(const Property& property, Texts texts, Scene& scene, std::optional<Number>& width, const char* what) {
  width = as_width<Number>(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, what));
  keep_length(scene, property.key, texts.back());
}

/// Returns the text of a width. A kept length on paper is used as long as it still equals the width.
template <typename Number>
Written written_length(const Property& property, const Scene& scene, const std::optional<Number>& width) {
  const auto length = scene.lengths.find(property.key);
  if (width && length != scene.lengths.end() &&
      as_width<Number>(parse_length(length->second).pixels(scene.picture.dots_per_inch)) == *width)
    return {length->second};
  return written(width, {});
}

/// Gives all lengths on paper their values in pixels. Throws ValueError for lengths that the properties cannot have.
void complete_lengths(Scene& scene);

/// Returns the size in pixels that lengths of sides give. If only one side is given, the picture has the default aspect
/// ratio.
glm::ivec2 size_by_lengths(const Scene& scene);
/// True if the size of the picture is size_by_lengths(), except for a height that follows from the molecule.
bool has_lengths_of_sides(const Scene& scene);

}  // namespace meniscus::scene_values
