// SPDX-License-Identifier: BSD-3-Clause
// The objects behind the handles of a renderer and of a page, and the conversion of pictures to bytes.
#pragma once

#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/scene/renderers.h"
#include "core/scene/scene.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {

/// A GL context and its renderer. It must be made, used and destroyed on one thread (OnGlThread).
struct GlRenderer {
  /// Makes the context on a device other than MENISCUS_CPU. Throws GpuError if there is no such GL.
  explicit GlRenderer(std::int32_t device) : context(gl_of(device)), renderer(make_gl_still_renderer(context)) {}
  EglContext context;
  std::unique_ptr<StillRenderer> renderer;
};

/// Refuses, with MENISCUS_USAGE, memory that is NULL or too small for the four bytes of each pixel.
inline void require_room(const Scene& scene, const std::uint8_t* rgba, std::size_t rgba_size) {
  require(rgba, "rgba");
  require_numbers(rgba, rgba_size, 1, "rgba");
  const std::size_t size = std::size_t{4} * scene.picture.width * scene.picture.height;
  if (rgba_size < size)
    refuse(MENISCUS_USAGE, "rgba has room for {} bytes; {}x{} pixels need {}", rgba_size, scene.picture.width,
           scene.picture.height, size);
}

/// Writes the bytes of the program's PNG files to the caller's memory, always with alpha. The memory must have passed
/// require_room(). Transparent pixels are encoded for programs that blend in sRGB (layout_bytes), except with a
/// background or linear alpha (display_bytes).
inline void write_pixels(const Framebuffer& drawn, const Scene& scene, std::uint8_t* rgba) {
  if (scene.image.background || scene.look.has_linear_alpha())
    display_bytes(drawn.color, scene.image.background, 4, rgba);
  else
    layout_bytes(drawn.color, rgba);
}

/// The settings of a picture of a surface that the caller computed, without a molecule from a file.
struct SurfacePicture {
  Scene scene;
  Camera camera;
  Coloring coloring;
};

/// Returns the settings from the arguments of meniscus_render(). `scene`, `camera` and `atom_colors` may be NULL: then
/// the scene is the default one, the camera frames all atoms, and the atoms have one colour. `atom_colors` has three
/// numbers, sRGB in [0, 1], per atom of the surface. Refuses impossible arguments, and scenes with values that only
/// pictures of molecules from files have.
SurfacePicture surface_picture(const meniscus_surface* surface, const meniscus_scene* scene,
                               const meniscus_camera* camera, const float* atom_colors);

}  // namespace meniscus::c_api

/// The object behind the handle of a renderer. It draws on the CPU or on a GL thread. It is made by new, and release()
/// deletes it with its last reference (Counted).
struct meniscus_renderer : meniscus::c_api::Counted {
  /// `device` must have passed check_device(). MENISCUS_AUTO uses the CPU if there is no hardware GPU; any other device
  /// without its GL is a GpuError.
  explicit meniscus_renderer(std::int32_t device) {
    if (device != MENISCUS_CPU) use_gl(device);
    if (!gl_renderer_) cpu_renderer_ = std::make_unique<meniscus::StillRenderer>();
  }

  /// Calls use(renderer, context), on the GL thread if there is one; `context` is nullptr on the CPU. Several threads
  /// may call this; their calls wait for each other.
  template <typename Use>
  void run(const Use& use) {
    if (gl_renderer_)
      return gl_renderer_->run([&](meniscus::c_api::GlRenderer& gl) { use(*gl.renderer, &gl.context); });
    const std::lock_guard lock(mutex_);
    use(*cpu_renderer_, static_cast<const meniscus::EglContext*>(nullptr));
  }

 private:
  /// Creates the GL renderer. MENISCUS_AUTO takes a hardware GPU only, because the CPU is faster than software GL, and
  /// leaves gl_renderer_ empty if there is none. For other devices throws GpuError if there is no such GL.
  void use_gl(std::int32_t device) {
    const bool automatic = device == MENISCUS_AUTO;
    try {
      gl_renderer_.emplace(
          [&] { return std::make_unique<meniscus::c_api::GlRenderer>(automatic ? MENISCUS_GPU : device); });
    } catch (const meniscus::GpuError&) {
      if (!automatic) throw;
      gl_renderer_.reset();
    }
  }

  std::mutex mutex_;
  std::unique_ptr<meniscus::StillRenderer> cpu_renderer_;
  std::optional<meniscus::c_api::OnGlThread<meniscus::c_api::GlRenderer>> gl_renderer_;
};

/// The object behind the handle of a page. release() deletes it with its last reference (Counted).
struct meniscus_page : meniscus::c_api::Counted {
  explicit meniscus_page(std::string text) : html(std::move(text)) {}
  const std::string html;
};
