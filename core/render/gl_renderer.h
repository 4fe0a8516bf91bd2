// SPDX-License-Identifier: BSD-3-Clause
// Pictures of whatever can be drawn on the GPU: a computed surface, or atoms whose surface is found for each view.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/progress.h"
#include "core/camera/camera.h"
#include "core/gpu/buffer.h"
#include "core/render/gpu_scene.h"
#include "core/render/picture.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_scene.h"
#include "core/render/ray_caster.h"
#include "core/surface/primitives.h"

namespace meniscus {

class EglContext;
class PictureCollector;
class StageClock;
struct Coloring;

/// A complete surface (SurfaceDrawable), or atoms whose surface the GPU finds for each view (ViewPipeline).
class Drawable {
 public:
  virtual ~Drawable() = default;

  /// Van der Waals balls, Å; at least one. A camera's picture has its pivot among them.
  virtual std::span<const Ball> atoms() const = 0;

  /// Puts on the GPU what this picture shows, colours too; stays until the next call. Adds the time of each stage to
  /// `clock`. Throws GpuError, CapacityError, OpenSurfaceError.
  virtual const GpuScene& prepare(const PictureFrame& frame, StageClock& clock) = 0;

  /// prepare() may assume that a frame needs no more room than the one before. ask() reads back the counts that it
  /// needed; settle() then returns whether the room was enough. If it was not, the picture is invalid, and the next
  /// prepare() measures again. Throws as prepare().
  virtual void ask(Readback&) {}
  virtual bool settle() { return true; }

  /// The surface whose patches the primitives of the scene are, if the host has it; else nullptr.
  virtual const Surface* surface() const { return nullptr; }
};

/// Packs the surface for each picture. Keeps buffers from surface to surface. Needs a current GL context.
class SurfaceDrawable final : public Drawable {
 public:
  /// coloring.atom has one colour per surface.atoms; both must stay until the last picture of them is made. Rays go on
  /// through points of hidden atoms; what they meet from behind is shaded like its front, and its normal still points
  /// towards the solvent.
  void show(const Surface& surface, const Coloring& coloring);

  std::span<const Ball> atoms() const override { return surface_->atoms; }
  const GpuScene& prepare(const PictureFrame& frame, StageClock& clock) override;
  const Surface* surface() const override { return surface_; }

 private:
  const Surface* surface_ = nullptr;
  const Coloring* coloring_ = nullptr;
  GpuScene scene_;
};

/// Everything of `scene` on the GPU but the colours.
void upload_scene(const RayCastScene& packed, const Surface& surface, const PictureFrame& frame, GpuScene& scene);

/// Returns renderer and version of GL.
std::string gl_words(const EglContext& context);

/// Makes one picture after another. Needs a current GL context for its whole life.
class GlRenderer {
 public:
  /// A picture on the host, of any size; the same for any block_edge. Throws what Drawable::prepare() throws, GpuError,
  /// CapacityError, InputError for a bad camera.
  Framebuffer render(Drawable& drawable, const Camera& camera, const RenderSettings& settings);
  /// Of a computed surface.
  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings);

  /// A finished picture over the look's background, which stays on the GPU as texture(). stop: asked now and then; if
  /// true, the picture is given up: false, the texture shows the one before, and there is nothing to pick. The drawable
  /// must stay as long as someone picks. Throws as render().
  bool draw(Drawable& drawable, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop = {});

  /// Whether buffer sizes are read back before or after drawing. The default is the faster way for the device.
  void set_counting(Counting counting) { counting_ = counting; }

  /// The last drawn picture, 8 bit sRGB and alpha (255) per pixel, rows from the top.
  std::vector<std::uint8_t> rgba() const { return presenter_.rgba(); }
  /// The last drawn picture as a GL texture (GL_RGBA8, sRGB values, first row on top) that lives until the next draw.
  std::uint32_t texture() const { return presenter_.texture(); }
  glm::ivec2 size() const { return frame_.size; }
  /// pixel of the last drawn picture: column, row from the top. Nothing where nothing is hit.
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const;

  /// Times of the stages of the last picture.
  const std::vector<StageTime>& times() const { return clock_.times(); }

  /// What the last picture was finished from: RayCaster::picture() and RayCaster::hits().
  const Buffer& samples() const { return caster_.picture(); }
  const Buffer& hits() const { return caster_.hits(); }

 private:
  void begin(Drawable& drawable, const Camera& camera, const RenderSettings& settings);
  void prepare(Drawable& drawable);
  bool draw_once(Drawable& drawable, const RenderSettings& settings, const std::function<bool()>& stop, bool& settled);
  void make_shade_map();
  void add_to_shade_map(const PictureFrame& map, const PictureBlock& block, std::vector<float>& depths);
  void render_block(const PictureBlock& inner, const RenderSettings& settings, PictureCollector& collector);

  Counting counting_ = suitable_counting();
  RayCaster caster_;
  SurfaceDrawable surface_;  // of render() for computed surfaces
  Presenter presenter_;
  StageClock clock_;
  PictureFrame frame_;               // of the last picture
  const GpuScene* scene_ = nullptr;  // likewise
};

}  // namespace meniscus
