// SPDX-License-Identifier: BSD-3-Clause
// Parses lengths, and turns them into pixels once the resolution is known.
#include "core/scene/scene_lengths.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/base/parse_number.h"
#include "core/base/text.h"

namespace meniscus::scene_values {
namespace {

constexpr double kMillimetersPerInch = 25.4, kPointsPerInch = 72.0;

/// Whether it is known how many pixels a length is: of one on paper once the resolution is.
bool is_settled(const Length& length, double dots_per_inch) { return length.per_inch == 0.0 || dots_per_inch > 0.0; }

}  // namespace

double Length::pixels(double dots_per_inch) const {
  if (per_inch == 0.0) return value;
  return value * (dots_per_inch == 0.0 ? kUsualResolution : dots_per_inch) / per_inch;
}

Length parse_length(const std::string& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  const std::string unit = text.substr(end);
  const std::map<std::string, double> per_inch{
      {"in", 1.0}, {"cm", kMillimetersPerInch / 10.0}, {"mm", kMillimetersPerInch}, {"pt", kPointsPerInch}};
  const auto known = per_inch.find(unit);
  Length length;
  if (!parse_number(text.substr(0, end), length.value) || (known == per_inch.end() && !unit.empty() && unit != "px"))
    throw RequestError(in_quotes(text) + " is not a length such as 85mm, 8.5cm, 3.5in, 8pt or 1000px");
  if (known != per_inch.end()) length.per_inch = known->second;
  return length;
}

int side_in_pixels(const std::string& text, double dots_per_inch) {
  const Length length = parse_length(text);
  const double pixels = std::round(length.pixels(dots_per_inch));
  if (is_settled(length, dots_per_inch) && !(pixels >= 1.0 && pixels <= kLargestSide))
    throw RequestError(
        fmt::format("{} makes {:.0f} pixels; a side has 1 to {}", in_quotes(text), pixels, kLargestSide));
  return static_cast<int>(pixels);
}

double pixels_in_range(const Property& property, const std::string& text, double dots_per_inch, const char* what) {
  const Length length = parse_length(text);
  const double pixels = length.pixels(dots_per_inch);
  if (!is_settled(length, dots_per_inch) || property.is_within(pixels)) return pixels;
  throw RequestError(fmt::format("{} makes {:.4g} pixels; {} {} to {}", in_quotes(text), pixels, what, property.lowest,
                                 property.highest));
}

void keep_length(Scene& scene, std::string_view key, const std::string& text) {
  scene.lengths.erase(std::string(key));
  if (parse_length(text).per_inch != 0.0) scene.lengths[std::string(key)] = text;
}

glm::ivec2 size_by_lengths(const Scene& scene) {
  const double shape = usual_scene().picture.aspect(), dots = scene.picture.dots_per_inch;
  const auto wide = scene.lengths.find("image.width"), high = scene.lengths.find("image.height");
  glm::ivec2 size = scene.picture.size();
  if (wide != scene.lengths.end()) {
    size.x = side_in_pixels(wide->second, dots);
    size.y = std::clamp(static_cast<int>(std::lround(size.x / shape)), 1, kLargestSide);
  }
  if (high != scene.lengths.end()) {
    size.y = side_in_pixels(high->second, dots);
    if (wide == scene.lengths.end())
      size.x = std::clamp(static_cast<int>(std::lround(size.y * shape)), 1, kLargestSide);
  }
  return size;
}

bool has_lengths_of_sides(const Scene& scene) {
  return (scene.lengths.contains("image.width") || scene.lengths.contains("image.height")) &&
         size_by_lengths(scene) == scene.picture.size();
}

}  // namespace meniscus::scene_values
