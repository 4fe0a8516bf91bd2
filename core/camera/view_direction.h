// SPDX-License-Identifier: BSD-3-Clause
// Sides from which a molecule is seen, by name, and turns of a picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/camera/camera.h"

namespace meniscus {

struct RigidMotion;

/// The side of a molecule that is turned to the viewer.
struct ViewDirection {
  enum class Frame {
    file,      ///< axes of the file's coordinates: the viewer stands on that side of them
    inertia,   ///< principal axes of the atoms' centres, longest first; the third is that of the default view
    symmetry,  ///< along the symmetry axis of an assembly
    beside     ///< at a right angle to it, which is up in the picture
  };
  Frame frame = Frame::inertia;
  int axis = 2;           ///< of a file's frame or of inertia: 0 to 2
  bool opposite = false;  ///< from the other side

  bool operator==(const ViewDirection&) const = default;
};

/// Understands x, y, z (file), 1, 2, 3 (inertia), symmetry, symmetry-side, each with - before it for the other side,
/// and front (3), back (-3), top (2), bottom (-2), right (1), left (-1). Nothing for other words.
std::optional<ViewDirection> parse_view_direction(std::string_view text);

/// Those words, to be proposed.
std::vector<std::string> view_direction_words();

/// Axes of the picture from that side. Up in it are: of file axes y, but z for ±y so that +x stays right of y; of
/// inertia 1 the second axis, of 2 the one that is turned away from the default view, of 3 the second; beside the
/// symmetry axis that axis. There must be a ball. symmetry: the axis, of length 1, which Frame::symmetry and
/// Frame::beside need.
ViewBasis view_basis(const ViewDirection& direction, std::span<const Ball> balls,
                     const std::optional<glm::dvec3>& symmetry);

/// The axis, of length 1, about which most of the motions' rotations relative to each other turn, towards +z of the
/// file (then +y, +x). Of several the one nearest to z. Nothing where none of them turns: one copy, or shifted ones.
std::optional<glm::dvec3> symmetry_axis(std::span<const RigidMotion> motions);

/// A turn of the molecule, as seen, about an axis of the picture: x to the right, y up, z towards the viewer.
struct Turn {
  int axis = 1;
  double degrees = 0.0;  ///< right-handed: y90 brings to the right what was in front
};

/// "y90", "x-30", "z45.5". Nothing for other texts.
std::optional<Turn> parse_turn(std::string_view text);

/// The axes of a picture whose molecule was turned, turn after turn.
ViewBasis turned(ViewBasis basis, std::span<const Turn> turns);

}  // namespace meniscus
