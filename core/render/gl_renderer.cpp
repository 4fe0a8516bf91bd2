// SPDX-License-Identifier: BSD-3-Clause
// Renderer as one of the ways to pictures of computed surfaces.
#include <fmt/format.h>

#include "core/gpu/egl_context.h"
#include "core/render/renderer.h"
#include "core/render/surface_renderer.h"

namespace meniscus {
namespace {

class GlRenderer final : public SurfaceRenderer {
 public:
  explicit GlRenderer(const EglContext& context) : context_(context) {}

  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings) override {
    by_cpu_.reset();
    return renderer_.render(surface, coloring, camera, settings);
  }
  Framebuffer render(std::span<const PictureObject> objects, const Camera& camera,
                     const RenderSettings& settings) override {
    by_cpu_.reset();
    if (objects.size() == 1 && !needs_layers(objects.front()))
      return renderer_.render(*objects.front().surface, *objects.front().coloring, camera, settings);
    by_cpu_ = make_cpu_renderer();
    return by_cpu_->render(objects, camera, settings);
  }
  Framebuffer render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                            const RenderSettings& settings) override {
    by_cpu_ = make_cpu_renderer();
    return by_cpu_->render_copies(objects, camera, settings);
  }
  const std::vector<StageTime>& times() const override { return by_cpu_ ? by_cpu_->times() : renderer_.times(); }
  std::string device() const override { return by_cpu_ ? by_cpu_->device() : gl_words(context_); }

 private:
  const EglContext& context_;
  Renderer renderer_;
  std::unique_ptr<SurfaceRenderer> by_cpu_;  // of the last picture, if GL did not make it
};

}  // namespace

std::string gl_words(const EglContext& context) {
  return fmt::format("{}, GL {}{}", context.renderer(), context.version(), context.is_software() ? " (software)" : "");
}

std::unique_ptr<SurfaceRenderer> make_gl_renderer(const EglContext& context) {
  return std::make_unique<GlRenderer>(context);
}

}  // namespace meniscus
