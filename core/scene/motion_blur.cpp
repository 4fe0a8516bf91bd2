// SPDX-License-Identifier: BSD-3-Clause
// Computes and draws a frame at several moments around it, and takes the mean.
#include "core/scene/motion_blur.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/transition.h"

namespace meniscus {
namespace {

/// The number of grid lines per step and moment: moments lie in the middles of equal parts of the shutter, which is
/// half a step wide.
constexpr int kGridLines = 4;

RunRequest with_moments(const Scene& scene, int moments) {
  if (scene.molecule.interface)
    throw RequestError(
        message("@motion-blur@: pages of an open interface do not move with their atoms; leave one of them out"));
  if (scene.frames.repeat > 1)
    throw RequestError(
        message("@motion-blur@: nothing moves between the repeats of a frame; use @interpolate@, not @repeat@"));
  RunRequest request = scene.frames;
  request.interpolate *= static_cast<std::uint64_t>(kGridLines) * static_cast<std::uint64_t>(moments);
  request.only.clear();
  return request;
}

}  // namespace

MotionBlur::MotionBlur(const Scene& scene, int moments, std::vector<Camera> cameras, const EglContext* context)
    : scene_(scene),
      moments_(moments),
      cameras_(std::move(cameras)),
      run_(scene.molecule, with_moments(scene, moments)),
      builder_(scene.molecule, context) {}

Camera MotionBlur::camera(std::uint64_t place, double later) const {
  if (cameras_.size() == 1) return cameras_.front();
  const std::uint64_t last = cameras_.size() - 1;
  const std::uint64_t other = later < 0.0 ? std::max<std::uint64_t>(place, 1) - 1 : std::min(place + 1, last);
  return camera_between(cameras_[place], cameras_[other], std::abs(later));
}

Framebuffer MotionBlur::draw(std::uint64_t place, StillRenderer& renderer, RenderSettings settings) {
  const std::lock_guard lock(mutex_);
  settings.take_band = {};
  settings.progress = {};
  const std::vector<std::uint64_t>& numbers = run_.numbers();
  const int lines = kGridLines * moments_;
  Framebuffer mean;
  for (int n = 0; n < moments_; ++n) {
    const int line = 2 * n + 1 - moments_;  // number of the grid line, counted from the frame
    const auto at = static_cast<std::int64_t>(place) * lines + line;
    const auto found =
        static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, static_cast<std::int64_t>(numbers.size()) - 1));
    Figure figure = make_figure(builder_.build(run_.at(numbers[found])), scene_.figure);
    Framebuffer drawn = meniscus::draw(renderer, std::move(figure), scene_.figure,
                                       camera(place, static_cast<double>(line) / lines), settings);
    if (mean.color.empty()) {
      mean.size = drawn.size;
      mean.color.assign(drawn.color.size(), glm::vec4(0.0f));
    }
    for (std::size_t p = 0; p < mean.color.size(); ++p) mean.color[p] += drawn.color[p] / static_cast<float>(moments_);
  }
  return mean;
}

}  // namespace meniscus
