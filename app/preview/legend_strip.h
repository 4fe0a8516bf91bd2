// SPDX-License-Identifier: BSD-3-Clause
// The legend of pictures that are drawn again and again: laid out once for a size, beside whatever molecule.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/render/legend.h"

namespace meniscus {

class LegendStrip {
 public:
  /// Throws as Legend does.
  LegendStrip(const ColorKey& key, glm::ivec2 size, const LegendStyle& style, const glm::vec3& background);

  /// Pixels left for the molecule, at the top left.
  glm::ivec2 molecule_size() const { return molecule_size_; }

  /// The whole picture: 8 bit sRGB and alpha per pixel, rows from the top. molecule: of molecule_size(), or of half of
  /// it in both directions; then the picture is half as large, too.
  std::vector<std::uint8_t> around(std::span<const std::uint8_t> molecule, glm::ivec2 size) const;
  /// Of the picture around a molecule of this size.
  glm::ivec2 whole_size(glm::ivec2 size) const;

 private:
  glm::ivec2 size_, molecule_size_;
  std::vector<std::uint8_t> picture_;  ///< of size_, without a molecule
};

}  // namespace meniscus
