// SPDX-License-Identifier: BSD-3-Clause
// From where and how large a molecule is wanted in a picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/camera/camera.h"
#include "core/camera/view_direction.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// A size and a camera.
struct ViewRequest {
  int width = 1280, height = 960;                   ///< pixels
  double dots_per_inch = 0.0;                       ///< of the printed picture; 0: not said
  std::string camera_file;                          ///< or a camera's JSON; empty: one that shows all of the surface
  Projection projection = Projection::perspective;  ///< of that default camera
  std::optional<ViewDirection> direction;           ///< of it; nothing: the broad side
  std::vector<Turn> turns;                          ///< of what either camera sees, about the middle of it
  std::optional<Selection> zoom_to;                 ///< atoms that shall fill the picture; nothing: all that are shown

  glm::ivec2 size() const { return {width, height}; }
  double aspect() const { return static_cast<double>(width) / height; }
};

/// What is before a camera.
struct ViewedBalls {
  std::span<const Ball> shown;         ///< at least one
  std::span<const Ball> framed;        ///< those that shall fill the picture; at least one
  std::optional<glm::dvec3> symmetry;  ///< axis of an assembly, needed if the direction is along or beside it
};

/// The camera of the file, if one is named. Ask for it before anything is computed. Throws InputError.
std::optional<Camera> given_camera(const ViewRequest& request);

/// Axes of the picture: those of the camera given, else of the side asked for, else of the broad side of what is shown;
/// turned as asked.
ViewBasis aimed_basis(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls);

/// The camera given, turned about the middle of what is shown, or one that shows all that is framed.
Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls);

/// Is it certain that no ray of the picture meets anything within `reach` (Å) of a ball? A false may still be wrong.
bool sees_nothing(const Camera& camera, double aspect, std::span<const Ball> balls, double reach);

}  // namespace meniscus
