// SPDX-License-Identifier: BSD-3-Clause
// From atoms and a camera to a finished picture, again for every frame: what the preview shows.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/stage_clock.h"
#include "core/camera/camera.h"
#include "core/render/look.h"
#include "core/color/coloring.h"
#include "core/surface/primitives.h"
#include "core/visible_surface/extent.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {

/// One picture of the surface of the atoms at hand.
struct FrameRequest {
  Camera camera;
  glm::ivec2 size{1024, 768};  ///< pixels
  int samples = 1;             ///< rays per pixel, the first through its centre
  double probe_radius = 1.4;   ///< Å, >= 0
  Extent extent = Extent::visible;
  Look look;
  std::function<bool()> stop;  ///< asked now and then; if true, the picture is given up
};

/// What the ray through the centre of a pixel hits.
struct PickedPoint {
  std::uint32_t atom = kNone;  ///< index into the atoms given
  PatchKind kind = PatchKind::convex;
  glm::dvec3 position{0.0};  ///< Å
};

/// Draws frame after frame, each from its atoms anew: a changed probe or changed coordinates cost the same as a changed
/// camera. Needs a current GL context for its whole life.
class FrameRenderer {
 public:
  FrameRenderer();
  ~FrameRenderer();

  /// Van der Waals balls, Å. There must be one.
  void set_atoms(std::vector<Ball> atoms);
  /// One colour per atom; to be set after atoms of another number and before the next picture.
  void set_coloring(Coloring coloring);

  /// Draws; the picture stays on the GPU. False if it was given up: then the texture shows the one before, and there is
  /// nothing to pick. Throws GpuError, CapacityError, OpenSurfaceError, InputError for a bad camera.
  bool render(const FrameRequest& request);

  /// The last picture, 8 bit sRGB and alpha (255) per pixel, rows from the top.
  std::vector<std::uint8_t> rgba() const;
  /// The last picture as a GL texture (GL_RGBA8, sRGB values, first row on top) that lives until the next render.
  std::uint32_t texture() const;
  glm::ivec2 size() const;

  /// pixel: column, row from the top. Nothing where nothing is hit.
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const;

  /// Wall-clock times of the stages of the last picture, and what it took.
  const std::vector<StageTime>& times() const { return clock_.times(); }
  const ViewStats& stats() const;

  /// What the last picture was finished from: RayCaster::picture() and RayCaster::hits().
  const Buffer& samples() const;
  const Buffer& hits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  StageClock clock_;
};

}  // namespace meniscus
