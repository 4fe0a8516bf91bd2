// SPDX-License-Identifier: BSD-3-Clause
// Looks at a whole run before its first frame is made.
#include "core/scene/run_framing.h"

#include <algorithm>

#include <glm/common.hpp>

#include "core/color/color_atoms.h"
#include "core/color/color_key.h"
#include "core/color/named_colors.h"
#include "core/math/box.h"

namespace meniscus {

glm::dvec3 RunFraming::origin() const { return glm::round((low + high) * 0.5e3) / 1e3; }

namespace {

/// Of By::radial in all frames that can be read.
std::optional<std::array<double, 2>> radial_range(FrameRun& frames) {
  std::optional<std::array<double, 2>> range;
  frames.survey([&range](std::uint64_t, std::span<const Ball> balls) {
    std::vector<glm::dvec3> centers;
    for (const Ball& ball : balls) centers.push_back(ball.center);
    const std::vector<double> distances = distances_from_middle(centers);
    const auto [low, high] = std::ranges::minmax(distances);
    range = range ? std::array{std::min((*range)[0], low), std::max((*range)[1], high)} : std::array{low, high};
  });
  return range;
}

}  // namespace

RunFraming run_framing(const ViewRequest& view, const std::optional<Selection>& show, const CameraMotionRequest& motion,
                       const GivenCameras& given, FrameRun& frames) {
  RunFraming framing;
  Box box;
  framing.cameras = run_cameras(view, show, motion, given, frames, &box);
  if (!motion.moves()) framing.cameras.resize(1);
  framing.low = box.low;
  framing.high = box.high;
  return framing;
}

void measure_colors(ColorScheme& color, FrameRun& frames) {
  for (ColorRule& rule : color.rules) measure_colors(rule.paint, frames);
  if (color.by == ColorScheme::By::rmsf)
    color.file = {.path = frames.structure().file, .numbers = fluctuations(frames)};
  if (color.by == ColorScheme::By::radial && !color.range) color.frames_range = radial_range(frames);
}

std::vector<glm::vec3> run_colors(const Structure& structure, const ColorScheme& scheme, const Coloring& beside) {
  std::vector<glm::vec3> colors;
  const auto add = [&](const glm::vec3& color) {
    if (std::ranges::find(colors, color) == colors.end()) colors.push_back(color);
  };
  for (const ColorRule& rule : scheme.rules)  // whatever atoms each means in other frames
    for (const glm::vec3& color : run_colors(structure, rule.paint)) add(color);
  if (scheme.by == ColorScheme::By::component) {
    for (std::size_t n = 0; n < kCategoricalCount; ++n) add(categorical_color(n));
  } else {
    const Coloring coloring = color_atoms(structure, scheme);
    if (coloring.kind) {
      for (const glm::vec3& color : *coloring.kind) add(color);
    } else {
      for (const glm::vec3& color : coloring.atom) add(color);
    }
  }
  for (const glm::vec3& color : beside.atom) add(color);
  return colors;
}

}  // namespace meniscus
