// SPDX-License-Identifier: BSD-3-Clause
// What a preview shows as a scene, which `meniscus render` makes the same picture of; and the other way round.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

#include "app/preview/preview_state.h"
#include "core/scene/scene.h"

namespace meniscus {

/// A picture of a preview.
struct RenderedView {
  const PreviewFigure& figure;
  glm::ivec2 size;  ///< pixels, with the legend
  int samples = 1;
  bool transparent = false;                    ///< instead of the background
  std::optional<std::int32_t> model;           ///< that is shown, if the file has several
  std::optional<std::uint64_t> frame;          ///< of a trajectory
  std::optional<std::array<double, 2>> range;  ///< of numbers, where those of one model alone would have another
  double dots_per_inch = 0.0;                  ///< of the printed picture; 0: not said
};

/// begun: the scene that the preview began with, which says what it does not change: the molecule, its run.
Scene rendered_scene(const Scene& begun, const RenderedView& view);

/// What commands change, as a scene has it; no camera. color: with the numbers of its file.
PreviewFigure figure_of(const Scene& scene, const ColorScheme& color);

}  // namespace meniscus
