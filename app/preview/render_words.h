// SPDX-License-Identifier: BSD-3-Clause
// The command line of `meniscus render` that makes the picture of a preview.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/preview/preview_state.h"

namespace meniscus {

/// What was said to the preview that it does not change: words of its own command line.
struct RenderInput {
  std::vector<std::string> words;         ///< FILE, and what says which of its atoms are taken, and what computes
  std::vector<std::string> number_words;  ///< --color-by-file and its column
  std::vector<std::string> map_words;     ///< --map-file
};

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

/// "meniscus", "render" and all behind them. The picture's name is that of the molecule's file; of a trajectory,
/// frame_#####.png.
std::vector<std::string> render_words(const RenderInput& input, const RenderedView& view);

/// As a shell takes them, in one line.
std::string shell_line(std::span<const std::string> words);

/// As --preset has it.
std::string preset_word(LookPreset preset);

}  // namespace meniscus
