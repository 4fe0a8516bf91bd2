// SPDX-License-Identifier: BSD-3-Clause
// The way from one figure of a film to the next: what is a number changes steadily, all else dissolves.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/gpu/egl_context.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "core/scene/scene_picture.h"

namespace meniscus {

/// A figure as its scene shows it, ready to be drawn.
struct Shot {
  Scene scene;  ///< readied(), with its selections settled
  Figure figure;
  Camera camera;
  std::shared_ptr<const PictureLayout> layout;
  Annotations annotations;
};

/// What is drawn of the molecule of a scene.
struct MoleculeShot {
  Scene scene;  ///< its cuts are planes where there is a transition
  Figure figure;
  Camera camera;
  RenderSettings settings;
};

/// The pace of a transition. smooth: it starts and ends slowly.
enum class Pace { smooth, even };

/// The share of the way that is done after a share of the time, both from 0 to 1.
double eased(double time, Pace pace);

/// How the molecule of a shot is drawn.
RenderSettings settings_of(const Shot& shot);

/// The whole picture of a shot, without its background. molecule: drawn so.
Framebuffer picture_of(const Shot& shot, Framebuffer molecule);

/// The camera, `share` (0 to 1) of the way from one to the other along a CameraPath. It has the projection of the
/// first; where that of the second differs, it ends with what the second shows in the plane of its target.
Camera camera_between(const Camera& from, const Camera& to, double share);

/// Å. `from`, unless both are above 0: no radius grows out of nothing, or out of one that nobody chose.
double radius_between(double from, double to, double share);

/// The planes as cuts.
std::vector<Cut> cuts_at(std::span<const ClipPlane> planes);

/// Planes on the way from some to others. The first goes over into the first, and so on. One that has no partner, or
/// turns by a right angle or more, leaves the balls along its normal, or comes from outside.
std::vector<ClipPlane> planes_between(std::span<const ClipPlane> from, std::span<const ClipPlane> to,
                                      std::span<const Ball> balls, double share);

/// The look whose numbers and colours are on the way from one to the other; the rest is as in the first.
Look look_between(const Look& from, const Look& to, double share);

/// The probe's radius, radii of sticks and tubes, cut planes, the camera, and the numbers of the look change steadily.
/// What else differs dissolves: both scenes are drawn with the same camera and the same numbers, and their pictures
/// are blended in linear light. So an object that only one of them has fades in or out, and what they share stays.
/// A legend takes its part of the picture from the molecule, or gives it back, steadily.
class Transition {
 public:
  /// Both have pictures of one size. context: in which surfaces are computed again; nullptr: on the CPU.
  Transition(Shot from, Shot to, const EglContext* context);

  /// The whole picture, without its background. share: from 0, the picture of the first shot, to 1. Throws as computing
  /// and drawing do.
  Framebuffer picture(double share, StillRenderer& renderer);

  /// What is drawn of the molecule there: of the first scene and, if something dissolves, of the second. Their pictures
  /// have the weights 1 - share and share. Throws as computing does.
  std::vector<MoleculeShot> shots(double share) const;

  /// The colour behind that picture, sRGB; nothing: transparent, or a film's own.
  std::optional<glm::vec3> background(double share) const;

 private:
  struct Side {
    Shot shot;
    std::vector<ClipPlane> planes;
    Look look;
  };
  static Side side_of(Shot shot);
  /// Where the molecule is in the picture: below some rows, at the left.
  struct Place {
    glm::ivec2 size;
    Strips strips;
  };
  Place place(double share) const;
  Camera camera_of(const Side& side, double share) const;
  MoleculeShot shot(const Side& side, const Side& other, double share) const;
  Framebuffer finished(const Framebuffer& drawn, const Side& side, double share) const;

  Side from_, to_;
  std::vector<Ball> balls_;  ///< of both, as far as a surface may reach
  const EglContext* context_;
  bool is_steady_ = false;
};

}  // namespace meniscus
