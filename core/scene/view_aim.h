// SPDX-License-Identifier: BSD-3-Clause
// Aims the camera of a picture at its atoms.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/view_request.h"
#include "core/queries/surface_object.h"
#include "core/scene/figure.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Balls before a camera, and those of them that should fill the picture.
struct ViewedAtoms {
  std::vector<Ball> shown, framed;
};

/// Of the atoms of a structure those that are shown and those that should fill the picture, and where copies are.
class ViewAim {
 public:
  /// show: the atoms whose part of the surface is shown; nothing: all. Atoms beside the surface are shown, too, and can
  /// be zoomed to. Throws RequestError if request.zoom_to selects none of them all or request.direction is that of an
  /// axis which is not there, InputError if `show` selects none.
  ViewAim(const ViewRequest& request, const std::optional<Selection>& show, const Structure& structure);

  /// What a picture of these objects of the structure shows, with their copies.
  ViewedAtoms viewed(std::span<const SurfaceObject> objects) const;
  /// What a picture of the figure shows: all that is drawn beside its surface fills the picture, too, unless
  /// request.zoom_to says what does.
  ViewedAtoms viewed(const Figure& figure) const;

  /// The camera of such a picture. layout: the request with the size of the part of the picture that the molecule has.
  Camera camera(const ViewRequest& layout, const std::optional<Camera>& given, const ViewedAtoms& seen) const;
  /// Of a picture of the atoms, one ball each.
  Camera camera(const ViewRequest& layout, const std::optional<Camera>& given, std::span<const Ball> balls) const;

  /// Balls of the atoms that are shown, and that fill the picture, wherever `structure` has the same atoms; those of
  /// all copies (standing_balls). Atoms beside the surface are among the latter.
  std::vector<Ball> shown(const Structure& structure) const;
  std::vector<Ball> framed(const Structure& structure) const;
  const std::optional<glm::dvec3>& symmetry() const { return symmetry_; }

 private:
  std::vector<Ball> framed_beside(const Structure& structure) const;

  std::vector<bool> shown_, framed_;  ///< per atom of the structure; empty: all
  std::vector<bool> beside_;          ///< per atom of Structure::beside, whether it fills the picture
  std::vector<Ball> balls_beside_;    ///< those that do
  bool frames_all_ = true;            ///< no atoms were chosen to fill the picture
  std::optional<glm::dvec3> symmetry_;
};

/// Is it certain, before any surface is computed, that a picture by this camera shows nothing of the structure? probe:
/// Å, the farthest that a surface is from its atoms.
bool sees_nothing(const Camera& camera, double aspect, const Structure& structure, double probe);

}  // namespace meniscus
