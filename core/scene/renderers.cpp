// SPDX-License-Identifier: BSD-3-Clause
// Draws still pictures of whole surfaces on GL and all others on the CPU, and chooses between CPU and GL.
#include "core/scene/renderers.h"

#include "core/base/error.h"
#ifdef MENISCUS_WITH_GL
#include "core/render/gl_renderer.h"
#endif

namespace meniscus {

#ifdef MENISCUS_WITH_GL

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

#else

std::unique_ptr<StillRenderer> make_gl_still_renderer(const EglContext&) { return nullptr; }  // there is no context

#endif

PictureDevice::PictureDevice(const SurfaceRequest& request) : thread_limit_(request.threads) {
  if (!request.cpu) find_gl(request.gl);
  renderer_ = context_ ? make_gl_still_renderer(*context_) : std::make_unique<StillRenderer>();
}

// The automatic choice is never software GL. A list of devices does not show it: only a context knows its renderer.
void PictureDevice::find_gl(DeviceChoice choice) {
  if (choice.kind != DeviceChoice::Kind::automatic) {
    context_.emplace(choice);
    return;
  }
  choice.kind = DeviceChoice::Kind::gpu;
  try {
    context_.emplace(choice);
  } catch (const GpuError&) {
    context_.reset();  // EGL or a GPU is missing, or has no GL 4.5
  }
}

}  // namespace meniscus
