// SPDX-License-Identifier: BSD-3-Clause
// A request for a view: a side by name, turns, a zoom, or a camera.
#pragma once

#include "core/camera/camera.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct RigidMotion;

/// The side of a molecule that faces the viewer.
struct ViewDirection {
  enum class Frame {
    file,           ///< an axis of the file's coordinates: the viewer is on that side
    inertia,        ///< principal axes of the atoms' centres, longest first; the third is the axis of the default view
    symmetry,       ///< along the symmetry axis of an assembly
    symmetry_side,  ///< at a right angle to that axis, which points up in the picture
    open,           ///< the side with the best view of the framed atoms (open_side)
    channel         ///< along the straight channel through the framed atoms (channel_end)
  };
  Frame frame = Frame::inertia;
  int axis = 2;           ///< for file and inertia: 0 to 2
  bool opposite = false;  ///< true for the other side

  bool operator==(const ViewDirection&) const = default;
};

/// Parses open, channel, x, y, z (file), 1, 2, 3 (inertia), symmetry, symmetry-side, each with - before it for the
/// other side, and front (3), back (-3), top (2), bottom (-2), right (1), left (-1). Nothing for other words.
std::optional<ViewDirection> parse_view_direction(std::string_view text);

/// Returns these words, for completion and messages.
std::vector<std::string> view_direction_words();

/// Returns the unit axis of most rotations between the motions, towards +z of the file (then +y, +x); of several the
/// one nearest to z. Nothing if there is no rotation: a single copy, or translated ones.
std::optional<glm::dvec3> symmetry_axis(std::span<const RigidMotion> motions);

/// A turn of the molecule, as seen by the viewer, about an axis of the picture: x to the right, y up, z towards the
/// viewer.
struct Turn {
  int axis = 1;          ///< 0: x; 1: y; 2: z
  double degrees = 0.0;  ///< right-handed: y90 moves the front to the right
};

/// Parses "y90", "x-30", "z45.5". Nothing for other texts.
std::optional<Turn> parse_turn(std::string_view text);

/// Returns the axes of a picture after the molecule was turned by each turn in order.
ViewBasis turned(ViewBasis basis, std::span<const Turn> turns);

/// The size and the camera that a user requests.
struct ViewRequest {
  int width = 1280, height = 960;  ///< in pixels
  bool fits = false;               ///< true: the height is chosen so that the picture ends at the molecule
  std::optional<int> margin;       ///< margin of such a picture, in pixels; nothing: 2 mm
  double dots_per_inch = 0.0;      ///< resolution of the printed picture; 0: not set
  std::string camera_file;         ///< path of a camera, or its JSON; empty: a camera that shows all of the surface
  Projection projection = Projection::perspective;  ///< projection of that default camera
  std::optional<ViewDirection> direction;           ///< side for the default camera; nothing: the broad side
  std::vector<Turn> turns;                          ///< turns of the molecule about its middle, for either camera
  std::optional<Selection> zoom_to;                 ///< atoms that should fill the picture; nothing: all shown atoms

  glm::ivec2 size() const { return {width, height}; }
  double aspect() const { return static_cast<double>(width) / height; }
};

glm::dvec3 mean_center(std::span<const Ball> balls);

/// The balls in front of a camera.
struct ViewedBalls {
  std::span<const Ball> shown;         ///< all shown balls; at least one
  std::span<const Ball> framed;        ///< balls that should fill the picture; at least one
  std::optional<glm::dvec3> symmetry;  ///< axis of an assembly, needed for directions of symmetry
  /// The direction in which the viewer looks at the broad side, to tell it from the opposite one; nothing: towards -z.
  std::optional<glm::dvec3> forward{};
};

/// Returns the axes of the picture from that side. The up direction is: for file axes y, but z for ±y so that +x stays
/// right of y; for inertia 1 the second axis, for 2 the axis that is turned away from the default view, for 3 the
/// second; at a right angle to the symmetry axis that axis; for the open side and a channel the direction from
/// open_side() and channel_end(). Throws RequestError if there is no channel to look through.
ViewBasis view_basis(const ViewDirection& direction, const ViewedBalls& balls);

/// Reads the requested camera file, if any. Call it before anything is computed. Throws InputError.
std::optional<Camera> given_camera(const ViewRequest& request);

/// Returns the axes of the picture: the given camera's axes, else the axes of the requested side, else of the broad
/// side of the shown balls; then the requested turns apply. Throws RequestError if the requested side is that of a
/// channel and there is none.
ViewBasis aimed_basis(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls);

/// Returns the given camera, turned about the middle of the shown balls, or a camera that shows all framed balls.
/// Throws RequestError as aimed_basis() does.
Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls);

/// True if certainly no ray of the picture meets anything within `reach` (Å) of a ball. False may be wrong.
bool sees_nothing(const Camera& camera, double aspect, std::span<const Ball> balls, double reach);

}  // namespace meniscus
