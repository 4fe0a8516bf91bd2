// SPDX-License-Identifier: BSD-3-Clause
// The paper's pipeline and the renderer behind it.
#include <utility>

#include "core/gpu/context_description.h"
#include "core/render/renderer.h"
#include "core/scene/view_renderer.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {
namespace {

class GlViewRenderer final : public ViewRenderer {
 public:
  void set_atoms(std::vector<Ball> atoms) override { visible_.set_atoms(std::move(atoms)); }
  void set_coloring(const Coloring& coloring) override { visible_.set_coloring(coloring); }

  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) override {
    visible_.set_surface(probe_radius, Extent::visible);
    const bool whole = renderer_.draw(visible_, camera, settings, stop);
    require_living_context();
    return whole;
  }

  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings) override {
    return Renderer().render(surface, coloring, camera, settings);  // the picture that is drawn stays
  }

  std::vector<std::uint8_t> rgba() const override { return renderer_.rgba(); }
  std::uint32_t texture() const override { return renderer_.texture(); }
  glm::ivec2 size() const override { return renderer_.size(); }
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override { return renderer_.pick(pixel); }
  std::shared_ptr<const Surface> surface() const override { return nullptr; }
  const std::vector<StageTime>& times() const override { return renderer_.times(); }

 private:
  ViewPipeline visible_;
  Renderer renderer_;
};

}  // namespace

std::unique_ptr<ViewRenderer> make_gl_view_renderer() { return std::make_unique<GlViewRenderer>(); }

}  // namespace meniscus
