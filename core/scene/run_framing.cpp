// SPDX-License-Identifier: BSD-3-Clause
// Reads a whole run before its first frame is made.
#include "core/scene/run_framing.h"

#include <algorithm>

#include <glm/common.hpp>

#include "core/base/message.h"
#include "core/color/color_atoms.h"
#include "core/color/color_scale.h"
#include "core/color/named_colors.h"
#include "core/base/error.h"
#include "core/math/box.h"

namespace meniscus {

glm::dvec3 RunFraming::origin() const { return glm::round((extent.surface.low + extent.surface.high) * 0.5e3) / 1e3; }

namespace {

/// Of By::radial in all frames that can be read.
std::optional<std::array<double, 2>> radial_range(ShownFrames& frames) {
  std::optional<std::array<double, 2>> range;
  frames.survey([&range](std::uint64_t, const Structure&, const Structure& shown) {
    std::vector<glm::dvec3> centers;
    for (const Atom& atom : shown.atoms) centers.push_back(atom.position);
    const std::vector<double> distances = distances_from_middle(centers);
    const auto [low, high] = std::ranges::minmax(distances);
    range = range ? std::array{std::min((*range)[0], low), std::max((*range)[1], high)} : std::array{low, high};
  });
  return range;
}

/// What a scheme says of all atoms that any frame may have, and so of each frame alike: the range of numbers that atoms
/// have by themselves.
void share_colors(ColorScheme& color, const FrameRun& frames) {
  const bool is_categorical = color.map == ColorMap::categorical && !color.own_map;
  if ((color.by == ColorScheme::By::buried || color.by == ColorScheme::By::accessibility) && is_categorical)
    throw RequestError(
        message("@map categorical@ gives each number of a picture its own colour, but areas change from frame to "
                "frame; choose another @map@"));
  if (!frames.atoms_change() || !color.has_scale() || color.of_points()) return;
  if (is_categorical)
    throw RequestError(
        message("@map categorical@ gives each number of a picture its own colour, but @select@ chooses other atoms in "
                "each frame; choose another @map@, or add @select-once@"));
  if (color.range || color.by == ColorScheme::By::radial || color.is_measured()) return;
  if (color.takes_file())
    throw RequestError(message(
        "@color-by-file@ needs @color-range LO:HI@ or @select-once@ where @select@ chooses other atoms in each frame"));
  color.frames_range = color_scale(frames.reach(), color).range;
}

/// Of a scheme without its rules, but for what is buried.
void measure_scheme(ColorScheme& color, ShownFrames& frames) {
  FrameRun& run = frames.run();
  share_colors(color, run);
  if (color.by == ColorScheme::By::rmsf) color.file = {.path = run.structure().file, .numbers = fluctuations(run)};
  if (color.by == ColorScheme::By::radial && !color.range) color.frames_range = radial_range(frames);
}

}  // namespace

RunFraming run_framing(const ViewRequest& view, const CameraMotionRequest& motion, const GivenCameras& given,
                       ShownFrames& frames) {
  RunFraming framing;
  framing.cameras = run_cameras(view, motion, given, frames, &framing.extent);
  if (!motion.moves()) framing.cameras.resize(1);
  return framing;
}

void measure_colors(ColorScheme& color, ShownFrames& frames) {
  measure_scheme(color, frames);
  for (ColorRule& rule : color.rules) measure_scheme(rule.paint, frames);
  if (color.by != ColorScheme::By::buried && color.by != ColorScheme::By::accessibility) return;
  // The numbers come with each frame.
  const Structure& reach = frames.run().reach();
  color.file = {.path = reach.file, .numbers = std::vector<double>(reach.atoms.size(), 0.0)};
  if (color.by == ColorScheme::By::accessibility) return;
  if (!color.range) color.frames_range = std::array{0.0, frames.most_buried()};
}

Structure numbered_reach(const FrameRun& frames) {
  Structure reach = frames.reach();
  reach.frame = frames.structure().frame;
  return reach;
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
