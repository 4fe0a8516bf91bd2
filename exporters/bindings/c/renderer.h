// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a renderer, and the conversion of its pictures to bytes.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/scene/renderers.h"
#include "core/scene/scene.h"
#include "exporters/bindings/c/caller_memory.h"
#include "exporters/bindings/c/counted.h"
#include "exporters/bindings/c/device.h"
#include "exporters/bindings/c/gl_thread.h"

namespace meniscus::c_api {

/// A context and what draws in it.
struct Studio {
  explicit Studio(std::int32_t device) : context(gl_of(device)), renderer(make_gl_still_renderer(context)) {}
  EglContext context;
  std::unique_ptr<StillRenderer> renderer;
};

/// Refuses memory of the caller's that has no room for a picture of the scene.
inline void require_room(const Scene& scene, const std::uint8_t* rgba, std::size_t rgba_size) {
  require(rgba, "rgba");
  require_numbers(rgba, rgba_size, 1, "rgba");
  const std::size_t size = std::size_t{4} * scene.picture.width * scene.picture.height;
  if (rgba_size < size)
    refuse(MENISCUS_USAGE, "rgba has room for {} bytes; {}x{} pixels need {}", rgba_size, scene.picture.width,
           scene.picture.height, size);
}

/// The bytes that the program's PNG files have, with an alpha always.
inline void write_pixels(const Framebuffer& drawn, const Scene& scene, std::uint8_t* rgba) {
  if (scene.image.background || scene.look.has_linear_alpha())
    display_bytes(drawn.color, scene.image.background, 4, rgba);
  else
    layout_bytes(drawn.color, rgba);
}

/// What a caller asks of a picture of a surface of its own.
struct SurfacePicture {
  Scene scene;
  Camera camera;
  Coloring coloring;
};

/// As meniscus_render() takes it. Refuses what such a picture cannot have.
SurfacePicture surface_picture(const meniscus_surface* surface, const meniscus_scene* scene,
                               const meniscus_camera* camera, const float* atom_colors);

}  // namespace meniscus::c_api

struct meniscus_renderer : meniscus::c_api::Counted {
  explicit meniscus_renderer(std::int32_t device) {
    if (device != MENISCUS_CPU) find_gl(device);
    if (!with_gl_) here_ = std::make_unique<meniscus::StillRenderer>();
  }

  /// use(renderer, context), where they live; one caller after the other. context: nullptr on the CPU.
  template <typename Use>
  void run(const Use& use) {
    if (with_gl_)
      return with_gl_->run([&](meniscus::c_api::Studio& studio) { use(*studio.renderer, &studio.context); });
    const std::lock_guard one_caller(calling_);
    use(*here_, static_cast<const meniscus::EglContext*>(nullptr));
  }

 private:
  /// Automatic takes a hardware GPU or nothing: the CPU is faster than software GL.
  void find_gl(std::int32_t device) {
    const bool automatic = device == MENISCUS_AUTO;
    try {
      with_gl_.emplace([&] { return std::make_unique<meniscus::c_api::Studio>(automatic ? MENISCUS_GPU : device); });
    } catch (const meniscus::GpuError&) {
      if (!automatic) throw;
      with_gl_.reset();
    }
  }

  std::mutex calling_;
  std::unique_ptr<meniscus::StillRenderer> here_;
  std::optional<meniscus::c_api::OnGlThread<meniscus::c_api::Studio>> with_gl_;
};
