// SPDX-License-Identifier: BSD-3-Clause
// Writes a grid as a density file of POV-Ray, and its colours as a colour map of POV-Ray.
#include "exporters/povray/volume_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "exporters/povray/scene_templates.h"

namespace meniscus::povray {
namespace {

constexpr std::size_t kFlushValues = std::size_t{1} << 18;
constexpr std::size_t kMostDensityPoints = 65'535;  // per axis
/// The number of steps of a colour map. POV-Ray's colour maps have at most 256 entries and interpolate linear light
/// between them.
constexpr std::size_t kMapSteps = 200;

/// Appends the lowest `count` bytes of a value in big-endian order.
void push_bytes(std::string& bytes, std::uint32_t value, int count) {
  for (int n = count - 1; n >= 0; --n) bytes.push_back(static_cast<char>(value >> 8 * n & 0xff));
}

}  // namespace

void write_density(const VolumeGrid& grid, const std::function<void(std::string_view)>& write) {
  const auto& size = grid.frame().size;
  if (std::ranges::any_of(size, [](std::size_t points) { return points > kMostDensityPoints; }))
    throw RequestError(fmt::format("--color-map-file: POV-Ray's density files have at most {} points along an axis",
                                   with_thousands(kMostDensityPoints)));
  const auto [low, high] = std::ranges::minmax(grid.values());
  const double width = static_cast<double>(high) - low;
  std::string bytes;
  for (const std::size_t points : size) push_bytes(bytes, static_cast<std::uint32_t>(points), 2);
  // The first axis of a density file runs fastest.
  for (std::size_t z = 0; z < size[2]; ++z)
    for (std::size_t y = 0; y < size[1]; ++y)
      for (std::size_t x = 0; x < size[0]; ++x) {
        const double value = grid.values()[(x * size[1] + y) * size[2] + z];
        const double share = width > 0.0 ? (value - low) / width : 0.0;
        push_bytes(bytes, static_cast<std::uint32_t>(std::llround(share * std::numeric_limits<std::uint32_t>::max())),
                   4);
        if (bytes.size() < 4 * kFlushValues) continue;
        write(bytes);
        bytes.clear();
      }
  write(bytes);
}

void append_map(SceneText& out, const VolumePaint& paint, std::string_view file, const glm::dvec3& origin) {
  const VolumeFrame& frame = paint.grid.frame();
  const std::array<double, 2>& range = paint.scale.range;
  const auto [low, high] = std::ranges::minmax(paint.grid.values());
  // A density file fills the unit cube with its n-th value of N at n/N. After the last value, the first is repeated.
  SceneText matrix;
  glm::dvec3 valid_extent(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto points = static_cast<double>(frame.size[axis]);
    valid_extent[axis] = (points - 1.0) / points;
    const glm::dvec3 edge = points * frame.step[axis];
    for (int k = 0; k < 3; ++k) matrix.full(edge[k]).literal(",");
  }
  const glm::dvec3 corner = frame.origin - origin;
  matrix.full(corner.x).literal(",").full(corner.y).literal(",").full(corner.z);
  SceneText colors;
  for (std::size_t n = 0; n <= kMapSteps; ++n) {
    const double share = static_cast<double>(n) / kMapSteps;
    colors.literal(n == 0 ? "" : ",\n").literal("    srgb ");
    colors.direction(glm::dvec3(paint.scale.color((1.0 - share) * range[0] + share * range[1])));
  }
  const auto text_of = [](const auto& append) {
    SceneText text;
    append(text);
    return text.text();
  };
  const auto number = [&](double value) { return text_of([&](SceneText& text) { text.full(value); }); };
  out.literal(
      filled(template_text(povray_templates(), "map.inc"),
             {{"LOW", number(low)},
              {"HIGH", number(high)},
              {"FROM", number(range[0])},
              {"TO", number(range[1])},
              {"MATRIX", matrix.text()},
              {"REACH", text_of([&](SceneText& text) { text.full_vector(valid_extent); })},
              {"MISSING", text_of([&](SceneText& text) { text.direction(glm::dvec3(paint.scale.missing_color)); })},
              {"COUNT", std::to_string(kMapSteps + 1)},
              {"COLORS", colors.text()},
              {"FILE", std::string(file)}}));
}

}  // namespace meniscus::povray
