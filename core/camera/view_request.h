// SPDX-License-Identifier: BSD-3-Clause
// A request for a view: a side by name, turns, a zoom, or a camera.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct RigidMotion;

/// The side of a molecule that is turned to the viewer.
struct ViewDirection {
  enum class Frame {
    file,      ///< axes of the file's coordinates: the viewer is on that side of them
    inertia,   ///< principal axes of the atoms' centres, longest first; the third is that of the default view
    symmetry,  ///< along the symmetry axis of an assembly
    beside,    ///< at a right angle to it, which is up in the picture
    open,      ///< from where what fills the picture is hidden least (open_side)
    channel    ///< along the straight channel through what fills the picture (channel_end)
  };
  Frame frame = Frame::inertia;
  int axis = 2;           ///< of a file's frame or of inertia: 0 to 2
  bool opposite = false;  ///< from the other side

  bool operator==(const ViewDirection&) const = default;
};

/// Understands open, channel, x, y, z (file), 1, 2, 3 (inertia), symmetry, symmetry-side, each with - before it for the
/// other side, and front (3), back (-3), top (2), bottom (-2), right (1), left (-1). Nothing for other words.
std::optional<ViewDirection> parse_view_direction(std::string_view text);

/// Those words, to be proposed.
std::vector<std::string> view_direction_words();

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

/// A size and a camera.
struct ViewRequest {
  int width = 1280, height = 960;                   ///< pixels
  double dots_per_inch = 0.0;                       ///< of the printed picture; 0: not said
  std::string camera_file;                          ///< or a camera's JSON; empty: one that shows all of the surface
  Projection projection = Projection::perspective;  ///< of that default camera
  std::optional<ViewDirection> direction;           ///< of it; nothing: the broad side
  std::vector<Turn> turns;                          ///< of what either camera sees, about the middle of it
  std::optional<Selection> zoom_to;                 ///< atoms that should fill the picture; nothing: all that are shown

  glm::ivec2 size() const { return {width, height}; }
  double aspect() const { return static_cast<double>(width) / height; }
};

/// What is before a camera.
struct ViewedBalls {
  std::span<const Ball> shown;         ///< at least one
  std::span<const Ball> framed;        ///< those that should fill the picture; at least one
  std::optional<glm::dvec3> symmetry;  ///< axis of an assembly, needed if the direction is along or beside it
};

/// Axes of the picture from that side. Up in it are: of file axes y, but z for ±y so that +x stays right of y; of
/// inertia 1 the second axis, of 2 the one that is turned away from the default view, of 3 the second; beside the
/// symmetry axis that axis; of the open side and a channel what open_side() and channel_end() say. Throws RequestError
/// where nothing can be seen through.
ViewBasis view_basis(const ViewDirection& direction, const ViewedBalls& balls);

/// The camera of the file, if one is named. Ask for it before anything is computed. Throws InputError.
std::optional<Camera> given_camera(const ViewRequest& request);

/// Axes of the picture: those of the camera given, else of the side asked for, else of the broad side of what is shown;
/// turned as asked. Throws as view_basis() does; so does view_camera().
ViewBasis aimed_basis(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls);

/// The camera given, turned about the middle of what is shown, or one that shows all that is framed.
Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls);

/// Is it certain that no ray of the picture meets anything within `reach` (Å) of a ball? A false may still be wrong.
bool sees_nothing(const Camera& camera, double aspect, std::span<const Ball> balls, double reach);

}  // namespace meniscus
