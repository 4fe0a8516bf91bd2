// SPDX-License-Identifier: BSD-3-Clause
// Pictures between two figures of a film, and the mean of pictures while the shutter is open.
#pragma once

#include "core/camera/camera.h"
#include "core/gpu/egl_context.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/scene.h"
#include "core/scene/scene_picture.h"

namespace meniscus {

/// A figure of a scene, ready to be drawn.
struct Shot {
  Scene scene;  ///< made by prepared_scene(), after freeze_selections()
  Figure figure;
  Camera camera;
  std::shared_ptr<const PictureLayout> layout;
  Annotations annotations;
};

/// The molecule of a scene, ready to be drawn.
struct MoleculeShot {
  Scene scene;  ///< in a transition, its cuts are planes
  Figure figure;
  Camera camera;
  RenderSettings settings;
};

/// The pace of a transition. smooth: it starts and ends slowly; even: its speed is constant.
enum class Pace { smooth, even };

/// Returns the share of the way that is done after a share of the time, both from 0 to 1.
double eased(double time, Pace pace);

/// Returns the settings for drawing the molecule of a shot.
RenderSettings settings_of(const Shot& shot);

/// Returns the whole picture of a shot, without its background. molecule: drawn with settings_of().
Framebuffer picture_of(const Shot& shot, Framebuffer molecule);

/// Returns the camera after a `share` (0 to 1) of the way from one to the other along a CameraPath. It has the
/// projection of the first; if the second has another one, the way ends with its view of the plane of its target.
Camera camera_between(const Camera& from, const Camera& to, double share);

/// Returns a radius in Å between two; `from` unless both are above 0, because a radius must not grow from nothing, or
/// from a default.
double radius_between(double from, double to, double share);

std::vector<Cut> cuts_at(std::span<const ClipPlane> planes);

/// Returns planes on the way from some to others. The first plane becomes the first of the others, and so on. A plane
/// without a partner leaves the balls along its normal, or comes from outside; so do partners whose normals differ by a
/// right angle or more.
std::vector<ClipPlane> planes_between(std::span<const ClipPlane> from, std::span<const ClipPlane> to,
                                      std::span<const Ball> balls, double share);

/// Returns the look with numbers and colours on the way from one to the other; the rest is from the first.
Look look_between(const Look& from, const Look& to, double share);

/// A transition between two shots. The probe's radius, radii of sticks and tubes, cut planes, the camera, and the
/// numbers of the look change steadily. All other differences dissolve: both scenes are drawn with the same camera and
/// the same numbers, and their pictures are blended in linear light. So an object that only one of them has fades in or
/// out, and common objects stay. The legend's part of the picture grows or shrinks steadily. Texts of the first scene
/// fade out in the first half of the way, and texts of the second scene fade in in the second half; legends do so in
/// the first and in the last quarter, and are never over the molecule's part. Common texts and legends stay.
class Transition {
 public:
  /// Both shots must have pictures of one size. context: computes surfaces on GL again; nullptr: on the CPU.
  Transition(Shot from, Shot to, const EglContext* context);

  /// Returns the whole picture, without its background. share: from 0, the picture of the first shot, to 1. Throws like
  /// computing and drawing.
  Framebuffer picture(double share, StillRenderer& renderer);

  /// Returns the molecule's part of that picture: the shot of the first scene and, if something dissolves, of the
  /// second. Their pictures have the weights 1 - share and share. Throws like computing.
  std::vector<MoleculeShot> shots(double share) const;

  /// Returns the background of that picture, sRGB; nothing: transparent, or a film's own.
  std::optional<glm::vec3> background(double share) const;

 private:
  struct Side {
    Shot shot;
    std::vector<ClipPlane> planes;
    Look look;
  };
  static Side side_of(Shot shot);
  /// The molecule's place in the picture: below some rows, at the left.
  struct Place {
    glm::ivec2 size;
    Strips strips;
  };
  Place place(double share) const;
  Camera camera_of(const Side& side, double share) const;
  MoleculeShot shot(const Side& side, const Side& other, double share) const;
  void write(Framebuffer& picture, const Annotations& annotations, const Side& side, double share, double weight) const;
  void add_legend(Framebuffer& picture, const Side& side, double share, double weight) const;

  Side from_, to_;
  std::vector<Ball> balls_;  ///< balls of both sides, grown to the farthest extent of a surface
  const EglContext* context_;
  bool is_steady_ = false;
};

/// Draws frames of a run blurred. The shutter is open for half the time from a frame to the next (a shutter of 180
/// degrees), a quarter before the frame and a quarter after it; before the first frame and after the last one nothing
/// moves. Between frames, atoms are at the positions of --interpolate, and the camera is between the cameras of both
/// frames.
class MotionBlur {
 public:
  /// scene: a run, made by prepared_scene(), after freeze_selections(); it must outlive this object.
  /// moments: number of moments in a picture, at least 2. cameras: one for all frames, or one per frame. context:
  /// computes surfaces on GL; nullptr: on the CPU. Throws RequestError for an interface, and for frames without moments
  /// between them: see RunRequest::interpolate.
  MotionBlur(const Scene& scene, int moments, std::vector<Camera> cameras, const EglContext* context);

  /// Returns the picture of the molecule at this place of the run: the mean of the pictures of its moments, in linear
  /// light. May be called on any thread, by one at a time. Throws like reading, computing and drawing.
  Framebuffer draw(std::uint64_t place, StillRenderer& renderer, RenderSettings settings);

 private:
  Camera camera(std::uint64_t place, double later) const;

  const Scene& scene_;
  int moments_;
  std::vector<Camera> cameras_;
  FrameRun run_;  ///< the run, with all moments among its frames
  MoleculeBuilder builder_;
  std::mutex mutex_;
};

}  // namespace meniscus
