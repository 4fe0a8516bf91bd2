// SPDX-License-Identifier: BSD-3-Clause
// Pictures of whatever can be drawn, for files, films and windows.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/stage_clock.h"
#include "core/camera/camera.h"
#include "core/render/drawable.h"
#include "core/render/picture.h"
#include "core/render/hit_point.h"
#include "core/render/look_pass.h"
#include "core/render/ray_caster.h"
#include "core/surface/primitives.h"

namespace meniscus {

class PictureCollector;
struct Coloring;

/// Makes one picture after another. Needs a current GL context for its whole life.
class Renderer {
 public:
  /// A picture on the host, of any size; the same for any block_edge. Throws what Drawable::prepare() throws, GpuError,
  /// CapacityError, InputError for a bad camera.
  Framebuffer render(Drawable& drawable, const Camera& camera, const RenderSettings& settings);
  /// Of a computed surface.
  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings);

  /// A finished picture over the look's background, which stays on the GPU as texture(). stop: asked now and then; if
  /// true, the picture is given up: false, the texture shows the one before, and there is nothing to pick. The drawable
  /// must stay as long as somebody picks. Throws as render().
  bool draw(Drawable& drawable, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop = {});

  /// Whether draw() asks the GPU what a picture needs before or after it is made; at first as suits the device.
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
