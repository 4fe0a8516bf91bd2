// SPDX-License-Identifier: BSD-3-Clause
// Looks up the colour of a number on a scale.
#include "core/color/color_scale.h"

#include <algorithm>
#include <cmath>

#include "core/color/named_colors.h"

namespace meniscus {

glm::vec3 ColorScale::color(double number) const {
  if (std::isnan(number)) return missing_color;
  if (map == ColorMap::categorical) {
    return categorical_color(static_cast<std::size_t>(std::ranges::lower_bound(classes, number) - classes.begin()));
  }
  const double width = range[1] - range[0];
  const double t = width > 0.0 ? (number - range[0]) / width : 0.5;
  return own_map ? own_map->color(t) : mapped_color(map, t);
}

}  // namespace meniscus
