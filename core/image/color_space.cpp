// SPDX-License-Identifier: BSD-3-Clause
// The sRGB transfer function.
#include "core/image/color_space.h"

#include <algorithm>
#include <cmath>

namespace meniscus {

float linear_from_srgb(float value) {
  value = std::clamp(value, 0.0f, 1.0f);
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float value) {
  value = std::clamp(value, 0.0f, 1.0f);
  return value <= 0.0031308f ? value * 12.92f : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

}  // namespace meniscus
