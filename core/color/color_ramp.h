// SPDX-License-Identifier: BSD-3-Clause
// Colour maps of the user's own, from a file.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

/// Colours at rising places, straight lines in sRGB between them.
struct ColorRamp {
  std::vector<double> places;     ///< from 0 to 1, rising
  std::vector<glm::vec3> colors;  ///< as many, at least two; sRGB

  /// At t in [0, 1] (clamped).
  glm::vec3 color(double t) const;
};

/// Reads lines of a colour (#rrggbb, #rgb, a name of CSS), or of a place and a colour with blanks or commas between, #
/// and a blank begin a comment; or a JSON list of colours or of pairs [place, colour]. Places are any rising numbers;
/// they are stretched to [0, 1]. Throws InputError naming the line.
ColorRamp read_color_ramp(const std::string& path);

}  // namespace meniscus
