// SPDX-License-Identifier: BSD-3-Clause
// Pictures of everything that can be drawn on the GPU: a computed surface, or atoms whose surface is computed for each
// view.
#pragma once

#include "core/base/progress.h"
#include "core/camera/camera.h"
#include "core/gpu/buffer.h"
#include "core/render/gpu_pack.h"
#include "core/render/picture.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_pack.h"
#include "core/render/ray_caster.h"
#include "core/surface/primitives.h"

namespace meniscus {

class EglContext;
struct Coloring;

/// An object that the GPU can draw: a complete surface (SurfaceDrawable), or atoms whose surface the GPU computes for
/// each view (ViewPipeline).
class Drawable {
 public:
  virtual ~Drawable() = default;

  /// Returns the van der Waals balls, Å; at least one. The pivot of the picture is chosen among them.
  virtual std::span<const Ball> atoms() const = 0;

  /// Puts everything that this picture shows on the GPU, including colours. The result is valid until the next call.
  /// Adds the time of each stage to `clock`. Throws GpuError, CapacityError, OpenSurfaceError.
  virtual const GpuPack& prepare(const PictureFrame& frame, StageClock& clock) = 0;

  /// An implementation of prepare() may assume that a frame needs no more memory than the one before. request_counts()
  /// then queues the reading of the counts that the frame needed, and take_counts() returns whether the memory was
  /// sufficient. If it was not, the picture is invalid, and the next prepare() measures again. They throw GpuError,
  /// CapacityError and OpenSurfaceError, as prepare() does.
  virtual void request_counts(Readback&) {}
  virtual bool take_counts() { return true; }

  /// Returns the surface that the scene's primitives belong to, if the host has it; otherwise nullptr.
  virtual const Surface* surface() const { return nullptr; }
};

/// A computed surface, which is packed for each picture. Buffers are reused from surface to surface. Needs a current GL
/// context.
class SurfaceDrawable final : public Drawable {
 public:
  /// Sets the surface and its colours. coloring.atom has one colour for each of surface.atoms. Both must outlive the
  /// last picture of them. Rays continue through points of hidden atoms. A patch that they hit from behind is shaded
  /// like its front, and its normal still points towards the solvent.
  void show(const Surface& surface, const Coloring& coloring);

  std::span<const Ball> atoms() const override { return surface_->atoms; }
  const GpuPack& prepare(const PictureFrame& frame, StageClock& clock) override;
  const Surface* surface() const override { return surface_; }

 private:
  const Surface* surface_ = nullptr;
  const Coloring* coloring_ = nullptr;
  GpuPack scene_;
};

/// Uploads everything of `scene` except the colours.
void upload_scene(const RayCastPack& packed, const Surface& surface, const PictureFrame& frame, GpuPack& scene);

/// Returns the renderer and the version of GL.
std::string gl_words(const EglContext& context);

/// Draws pictures one after another. Needs a current GL context for its whole life.
class GlRenderer {
 public:
  /// Returns a picture of any size in memory; it does not depend on block_edge. Throws the errors of
  /// Drawable::prepare(), GpuError, CapacityError, and InputError for an invalid camera.
  Framebuffer render(Drawable& drawable, const Camera& camera, const RenderSettings& settings);
  /// Returns a picture of a computed surface.
  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings);

  /// Draws a finished picture over the look's background, which stays on the GPU for rgba(). `stop` is called
  /// regularly; if it returns true, drawing stops, draw() returns false, rgba() returns the previous picture, and
  /// pick() finds nothing. The drawable must outlive all calls of pick(). Throws what render() throws.
  bool draw(Drawable& drawable, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop = {});

  /// Sets whether buffer sizes are read back before or after drawing. The default is the faster way for the device.
  void set_counting(Counting counting) { counting_ = counting; }

  /// Returns the last drawn picture, 8 bit sRGB and alpha (255) per pixel, rows from the top.
  std::vector<std::uint8_t> rgba() const { return presenter_.rgba(); }
  glm::ivec2 size() const { return frame_.size; }
  /// Returns the point that a pixel (column, row from the top) of the last drawn picture shows; nothing where no ray
  /// hit anything.
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const;

  /// Returns the times of the stages of the last picture.
  const std::vector<StageTime>& times() const { return clock_.times(); }

  /// Returns RayCaster::picture() and RayCaster::hits(), from which the last picture was finished.
  const Buffer& samples() const { return caster_.picture(); }
  const Buffer& hits() const { return caster_.hits(); }

 private:
  void begin(Drawable& drawable, const Camera& camera, const RenderSettings& settings);
  void prepare(Drawable& drawable);
  bool draw_once(Drawable& drawable, const RenderSettings& settings, const std::function<bool()>& stop, bool& had_room);
  void render_block(const PictureBlock& inner, const RenderSettings& settings, PictureCollector& collector);

  Counting counting_ = suitable_counting();
  RayCaster caster_;
  SurfaceDrawable surface_;  // the surface of pictures of computed surfaces
  Presenter presenter_;
  StageClock clock_;
  PictureFrame frame_;              // frame of the last picture
  const GpuPack* scene_ = nullptr;  // scene of the last picture
};

}  // namespace meniscus
