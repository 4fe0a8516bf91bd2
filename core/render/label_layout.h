// SPDX-License-Identifier: BSD-3-Clause
// Places of labels, and of the lines from them to what they name, without overlaps or crossings.
#pragma once

#include <functional>

#include "core/render/lettering.h"

namespace meniscus {

/// A label that has no place yet. Lengths are in pixels.
struct UnplacedLabel {
  glm::dvec2 anchor;  ///< the point that it names
  glm::ivec2 extent;  ///< size of its text
};

/// The surroundings of labels. Lengths are in pixels.
struct LabelGround {
  PixelBox room;                ///< box in which labels may be; it contains the anchors
  std::vector<PixelBox> taken;  ///< boxes of other texts
  double gap = 4.0;             ///< distance between labels, and between a label and its line
  double dot = 3.0;             ///< radius of the dots at anchors, which other labels and their lines avoid
  /// Returns the share of a box, in [0, 1], that the molecule covers.
  std::function<double(const PixelBox&)> covered = [](const PixelBox&) { return 0.0; };
};

/// Returns the start of the line of a label with its text in this box: the point next to the box that is nearest to the
/// anchor.
glm::dvec2 leader_start(const PixelBox& box, const UnplacedLabel& label, const LabelGround& ground);

/// Returns the number of overlaps and crossings of labels and their lines among each other and with taken boxes.
int count_meetings(std::span<const UnplacedLabel> labels, std::span<const PixelBox> boxes, const LabelGround& ground);

/// Returns boxes for the texts, for which count_meetings() is 0. They are near their anchors, preferably next to the
/// molecule instead of in front of it, and preferably away from its middle. The result is deterministic. Returns
/// nothing if no such boxes were found.
std::optional<std::vector<PixelBox>> place_labels(std::span<const UnplacedLabel> labels, const LabelGround& ground);

}  // namespace meniscus
