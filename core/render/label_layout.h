// SPDX-License-Identifier: BSD-3-Clause
// Places for labels and the lines that lead from them to what they name, none of which meet.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "core/render/lettering.h"

namespace meniscus {

/// A label without a place. Pixels.
struct UnplacedLabel {
  glm::dvec2 anchor;  ///< what it names
  glm::ivec2 extent;  ///< of its text
};

/// What there is around labels. Pixels.
struct LabelGround {
  PixelBox room;                ///< where labels may be; anchors are within
  std::vector<PixelBox> taken;  ///< by what is written already
  double gap = 4.0;             ///< between labels, and between a label and its line
  double dot = 3.0;             ///< radius of the dots at anchors, which labels and the lines of others keep clear of
  /// The share of a box behind which there is the molecule, in [0, 1].
  std::function<double(const PixelBox&)> covered = [](const PixelBox&) { return 0.0; };
};

/// Where the line of a label begins whose text is in this box: beside it, at the point next to the anchor.
glm::dvec2 leader_start(const PixelBox& box, const UnplacedLabel& label, const LabelGround& ground);

/// How many pairs of labels, of their lines, and of these and what is taken, overlap or cross.
int count_meetings(std::span<const UnplacedLabel> labels, std::span<const PixelBox> boxes, const LabelGround& ground);

/// Boxes for the texts, for which count_meetings() is 0: near their anchors, rather beside the molecule than in front
/// of it, and rather away from its middle. The same for the same labels. Nothing if none were found.
std::optional<std::vector<PixelBox>> place_labels(std::span<const UnplacedLabel> labels, const LabelGround& ground);

}  // namespace meniscus
