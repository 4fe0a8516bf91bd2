// SPDX-License-Identifier: BSD-3-Clause
// Draws views on GL with the paper's pipeline and the renderer.
#include <utility>

#include "core/gpu/context_description.h"
#include "core/render/gl_renderer.h"
#include "core/scene/figure.h"
#include "core/scene/renderers.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {
namespace {

class GlPreviewRenderer final : public PreviewRenderer {
 public:
  void set_atoms(std::vector<Ball> atoms) override {
    by_cpu_->set_atoms(atoms);
    visible_.set_atoms(std::move(atoms));
  }
  void set_coloring(const Coloring& coloring) override {
    translucent_ = coloring.is_translucent();
    by_cpu_->set_coloring(coloring);
    visible_.set_coloring(coloring);
  }
  void set_figure(const FigureRequest& request, std::shared_ptr<const FigureExtras> extras) override {
    layered_ = request.hides_surface || !request.cuts.empty() || (extras && !extras->empty());
    by_cpu_->set_figure(request, std::move(extras));
  }

  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) override {
    if (draws_on_cpu() || settings.look.traces_light()) {
      const bool whole = by_cpu_->draw(probe_radius, camera, settings, stop);
      shows_cpu_ = shows_cpu_ || whole;
      return whole;
    }
    visible_.set_surface(probe_radius, Extent::visible);
    const bool whole = renderer_.draw(visible_, camera, settings, stop);
    require_living_context();
    shows_cpu_ = shows_cpu_ && !whole;
    return whole;
  }

  std::vector<std::uint8_t> rgba() const override { return shows_cpu_ ? by_cpu_->rgba() : renderer_.rgba(); }
  glm::ivec2 size() const override { return shows_cpu_ ? by_cpu_->size() : renderer_.size(); }
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    return shows_cpu_ ? by_cpu_->pick(pixel) : renderer_.pick(pixel);
  }
  std::shared_ptr<const Surface> surface() const override { return shows_cpu_ ? by_cpu_->surface() : nullptr; }
  double grown_by() const override { return shows_cpu_ ? by_cpu_->grown_by() : visible_.stats().grown_by; }
  bool draws_on_cpu() const override { return layered_ || translucent_; }
  const std::vector<StageTime>& times() const override { return shows_cpu_ ? by_cpu_->times() : renderer_.times(); }

 private:
  ViewPipeline visible_;
  GlRenderer renderer_;
  const std::unique_ptr<PreviewRenderer> by_cpu_ = make_cpu_preview_renderer();
  bool layered_ = false, translucent_ = false;  // true if the figure, or the colouring, needs layers
  bool shows_cpu_ = false;                      // true if the last picture is by_cpu_'s
};

}  // namespace

std::unique_ptr<PreviewRenderer> make_gl_preview_renderer() { return std::make_unique<GlPreviewRenderer>(); }

}  // namespace meniscus
