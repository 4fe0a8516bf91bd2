// SPDX-License-Identifier: BSD-3-Clause
// Draws still pictures of whole surfaces on GL, and leaves all others to the CPU.
#include "core/render/gl_renderer.h"
#include "core/scene/renderers.h"

namespace meniscus {
namespace {

class GlStillRenderer final : public StillRenderer {
 public:
  explicit GlStillRenderer(const EglContext& context) : context_(context) {}

  Framebuffer render(std::span<const PictureObject> objects, const Camera& camera,
                     const RenderSettings& settings) override {
    const PictureObject& first = objects.front();
    on_gl_ = objects.size() == 1 && !needs_layers(first) && !settings.look.traces_light() && !settings.mattes;
    return on_gl_ ? renderer_.render(*first.surface, *first.coloring, camera, settings)
                  : StillRenderer::render(objects, camera, settings);
  }
  Framebuffer render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                            const RenderSettings& settings) override {
    on_gl_ = false;
    return StillRenderer::render_copies(objects, camera, settings);
  }
  const std::vector<StageTime>& times() const override { return on_gl_ ? renderer_.times() : StillRenderer::times(); }
  std::string device() const override { return on_gl_ ? gl_words(context_) : StillRenderer::device(); }

 private:
  const EglContext& context_;
  GlRenderer renderer_;
  bool on_gl_ = true;  // true if the last picture was made on GL
};

}  // namespace

std::unique_ptr<StillRenderer> make_gl_still_renderer(const EglContext& context) {
  return std::make_unique<GlStillRenderer>(context);
}

}  // namespace meniscus
