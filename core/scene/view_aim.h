// SPDX-License-Identifier: BSD-3-Clause
// Aims the camera of a picture at its atoms.
#pragma once

#include "core/camera/view_request.h"
#include "core/queries/surface_object.h"
#include "core/scene/figure.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The balls in a view, and the balls that must fill the picture.
struct ViewedAtoms {
  std::vector<Ball> shown, framed;
};

/// The atoms of a structure that are shown, the atoms that must fill the picture, and the places of copies.
class ViewAim {
 public:
  /// show: the atoms whose part of the surface is shown; nothing: all. Atoms drawn in addition to the surface are also
  /// shown, and request.zoom_to may select them. Throws RequestError if request.zoom_to selects no atom at all, or if
  /// request.direction is along an axis that the structure does not have; InputError if `show` selects none.
  ViewAim(const ViewRequest& request, const std::optional<Selection>& show, const Structure& structure);

  /// Returns the balls in a picture of these objects of the structure, with their copies.
  ViewedAtoms viewed(std::span<const SurfaceObject> objects) const;
  /// Returns the balls in a picture of the figure. Everything drawn in addition to its surface must fill the picture,
  /// too, unless request.zoom_to selects other atoms.
  ViewedAtoms viewed(const Figure& figure) const;

  /// Returns the camera of such a picture. layout: the request with the size of the molecule's part of the picture.
  Camera camera(const ViewRequest& layout, const std::optional<Camera>& given, const ViewedAtoms& seen) const;
  /// Returns the camera of a picture of the atoms, one ball per atom.
  Camera camera(const ViewRequest& layout, const std::optional<Camera>& given, std::span<const Ball> balls) const;

  /// Return the balls of the atoms that are shown, or that must fill the picture, at the positions of `structure`,
  /// which must have the same atoms; for copies, the balls of all copies (standing_balls). framed() includes atoms
  /// drawn in addition to the surface.
  std::vector<Ball> shown(const Structure& structure) const;
  std::vector<Ball> framed(const Structure& structure) const;
  /// Returns the balls together with everything else that decides a view of them.
  ViewedBalls viewed_balls(std::span<const Ball> shown, std::span<const Ball> framed) const {
    return {shown, framed, symmetry_, forward_};
  }
  /// Returns the direction in which the viewer looks at the broad side so that more of the chains and ligands is seen
  /// than from the opposite one (shows_more_behind), at the positions of `structure`, which must have the same atoms.
  /// Nothing for copies and for fewer than two chains and ligands.
  std::optional<glm::dvec3> clear_side(const Structure& structure) const;

 private:
  std::vector<Ball> framed_extras(const Structure& structure) const;

  std::vector<bool> shown_, framed_;  ///< per atom of the structure; empty: all
  std::vector<bool> frames_extra_;    ///< per atom of Structure::extra_atoms, true if it must fill the picture
  std::vector<Ball> extra_balls_;     ///< the balls of these atoms
  bool frames_all_ = true;            ///< true if no atoms were selected to fill the picture
  std::optional<glm::dvec3> symmetry_, forward_;
};

/// The camera of a picture that ends at its balls, and the height that the picture should have, in pixels.
struct PictureFit {
  Camera camera;
  int height;
};

/// Returns the fit of a picture in which the balls leave a margin, in pixels, at each side. camera: the camera of a
/// picture of this size, with the balls in its middle. height: the height of the new picture, which has the same width.
PictureFit picture_fit(Camera camera, glm::ivec2 size, int height, std::span<const Ball> balls, glm::ivec2 margin);

/// True if it is certain, before any surface is computed, that a picture by this camera shows nothing of the structure.
/// probe: the greatest distance of a surface from its atoms, Å.
bool sees_nothing(const Camera& camera, double aspect, const Structure& structure, double probe);

}  // namespace meniscus
