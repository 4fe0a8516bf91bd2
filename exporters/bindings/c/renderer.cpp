// SPDX-License-Identifier: BSD-3-Clause
// Ray casts pictures on the CPU, or on GL in a context of their own.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/render/surface_renderer.h"
#include "exporters/bindings/c/atom_colors.h"
#include "exporters/bindings/c/device.h"
#include "exporters/bindings/c/gl_thread.h"
#include "exporters/bindings/c/caller_memory.h"
#include "exporters/bindings/c/surface.h"
#include "core/camera/camera.h"

namespace meniscus::c_api {
namespace {

constexpr std::int32_t kLargestSide = 65535;  // pixels; what other programs can read
constexpr std::int32_t kMostSamples = 1024;

const meniscus_picture kDefaults{sizeof(meniscus_picture), nullptr, nullptr, 1280, 960, 9, 0, {0.75f, 0.82f, 0.9f},
                                 {1.0f, 1.0f, 1.0f},       0.0f,    0.0f,    0.0f, 0};

meniscus_picture checked(const meniscus_picture* given) {
  const meniscus_picture picture = given ? read_struct(given, kDefaults, "meniscus_picture") : kDefaults;
  require_zero(picture.reserved, "meniscus_picture.reserved");
  check_range("width", picture.width, 1, kLargestSide);
  check_range("height", picture.height, 1, kLargestSide);
  check_range("samples", picture.samples, 1, kMostSamples);
  for (const float channel : picture.color) check_range("color", channel, 0, 1);
  for (const float channel : picture.background) check_range("background", channel, 0, 1);
  check_range("ambient_occlusion", picture.ambient_occlusion, 0, 1);
  check_range("silhouettes", picture.silhouettes, 0, kWidestSilhouette);
  check_range("depth_cue", picture.depth_cue, 0, 1);
  return picture;
}

glm::vec3 vector_of(const float (&from)[3]) { return {from[0], from[1], from[2]}; }
glm::dvec3 vector_of(const double (&from)[3]) { return {from[0], from[1], from[2]}; }

void copy(const glm::dvec3& from, double (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

Projection projection_of(std::int32_t word) {
  if (word != MENISCUS_PERSPECTIVE && word != MENISCUS_ORTHOGRAPHIC)
    refuse(MENISCUS_USAGE, "projection is {}, neither MENISCUS_PERSPECTIVE nor MENISCUS_ORTHOGRAPHIC", word);
  return word == MENISCUS_PERSPECTIVE ? Projection::perspective : Projection::orthographic;
}

Camera camera_of(const meniscus_camera* given) {
  const meniscus_camera from = read_struct(given, meniscus_camera{}, "meniscus_camera");
  require_zero(from.reserved, "meniscus_camera.reserved");
  Camera camera;
  camera.position = vector_of(from.position);
  camera.target = vector_of(from.target);
  camera.up = vector_of(from.up);
  camera.projection = projection_of(from.projection);
  if (camera.projection == Projection::perspective)
    camera.vertical_fov = from.vertical_fov;
  else
    camera.height = from.height;
  validate_camera(camera, "camera");
  return camera;
}

meniscus_camera struct_of(const Camera& camera) {
  meniscus_camera result{};
  copy(camera.position, result.position);
  copy(camera.target, result.target);
  copy(camera.up, result.up);
  result.vertical_fov = camera.vertical_fov;
  result.height = camera.height;
  result.projection = camera.projection == Projection::perspective ? MENISCUS_PERSPECTIVE : MENISCUS_ORTHOGRAPHIC;
  return result;
}

RenderSettings settings_of(const meniscus_picture& picture) {
  RenderSettings settings;
  settings.size = {picture.width, picture.height};
  settings.samples = picture.samples;
  settings.look.background = vector_of(picture.background);
  settings.look.ambient_occlusion = picture.ambient_occlusion;
  settings.look.silhouettes = picture.silhouettes;
  settings.look.depth_cue = picture.depth_cue;
  return settings;
}

void write_pixels(const Framebuffer& drawn, const meniscus_picture& picture, std::uint8_t* rgba) {
  std::optional<glm::vec3> background;
  if (picture.opaque) background = vector_of(picture.background);
  display_bytes(drawn.color, background, 4, rgba);
}

/// A context and what draws in it.
struct Studio {
  explicit Studio(std::int32_t device) : context(gl_of(device)), renderer(make_gl_renderer(context)) {}
  EglContext context;
  std::unique_ptr<SurfaceRenderer> renderer;
};

}  // namespace
}  // namespace meniscus::c_api

struct meniscus_renderer : meniscus::c_api::Counted {
  explicit meniscus_renderer(std::int32_t device) {
    if (device != MENISCUS_CPU) find_gl(device);
    if (!with_gl_) here_ = meniscus::make_cpu_renderer();
  }

  /// use(renderer), where it lives; one caller after the other.
  template <typename Use>
  void run(const Use& use) {
    if (with_gl_) return with_gl_->run([&](meniscus::c_api::Studio& studio) { use(*studio.renderer); });
    const std::lock_guard one_caller(calling_);
    use(*here_);
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
  std::unique_ptr<meniscus::SurfaceRenderer> here_;
  std::optional<meniscus::c_api::OnGlThread<meniscus::c_api::Studio>> with_gl_;
};

meniscus_status meniscus_default_picture(meniscus_picture* picture) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(picture, kDefaults, "meniscus_picture"); });
}

meniscus_status meniscus_surface_camera(const meniscus_surface* surface, double aspect, meniscus_projection projection,
                                        meniscus_camera* camera) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    require(camera, "camera");
    check_range("aspect", aspect, 1.0 / kLargestSide, kLargestSide);
    const meniscus::Camera found =
        meniscus::frame_camera(surface->finished->surface.atoms, aspect, projection_of(projection));
    write_struct(camera, struct_of(found), "meniscus_camera");
  });
}

meniscus_status meniscus_renderer_new(meniscus_device device, meniscus_renderer** renderer) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(renderer, "renderer");
    check_device(device);
    *renderer = new meniscus_renderer(device);
  });
}

meniscus_renderer* meniscus_renderer_retain(meniscus_renderer* renderer) { return meniscus::c_api::retain(renderer); }
void meniscus_renderer_release(meniscus_renderer* renderer) { meniscus::c_api::release(renderer); }

meniscus_status meniscus_render(meniscus_renderer* renderer, const meniscus_surface* surface,
                                const meniscus_picture* picture, std::uint8_t* rgba, std::size_t rgba_size) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(renderer, "renderer");
    require(surface, "surface");
    require(rgba, "rgba");
    require_numbers(rgba, rgba_size, 1, "rgba");
    const meniscus_picture wanted = checked(picture);
    const std::size_t size = std::size_t{4} * wanted.width * wanted.height;
    if (rgba_size < size)
      refuse(MENISCUS_USAGE, "rgba has room for {} bytes; {}x{} pixels need {}", rgba_size, wanted.width, wanted.height,
             size);
    const FinishedSurface& finished = *surface->finished;
    const double aspect = static_cast<double>(wanted.width) / wanted.height;
    const meniscus::Camera camera =
        wanted.camera ? camera_of(wanted.camera) : meniscus::frame_camera(finished.surface.atoms, aspect);
    const meniscus::Coloring coloring = coloring_of(wanted.color, wanted.atom_colors, finished.surface.atoms.size());
    meniscus::Framebuffer drawn;
    renderer->run([&](meniscus::SurfaceRenderer& draws) {
      run_on_threads(finished.threads,
                     [&] { drawn = draws.render(finished.surface, coloring, camera, settings_of(wanted)); });
    });
    write_pixels(drawn, wanted, rgba);
  });
}
