// SPDX-License-Identifier: BSD-3-Clause
// Draws views on GL with the paper's pipeline and the renderer.
#include <utility>

#include "core/gpu/context_description.h"
#include "core/render/renderer.h"
#include "core/scene/view_renderer.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {
namespace {

class GlViewRenderer final : public ViewRenderer {
 public:
  void set_atoms(std::vector<Ball> atoms) override {
    if (layered_) layered_->set_atoms(atoms);
    atoms_ = atoms;
    visible_.set_atoms(std::move(atoms));
  }
  void set_coloring(const Coloring& coloring) override {
    coloring_ = coloring;
    if (layered_) layered_->set_coloring(coloring);
    visible_.set_coloring(coloring);
  }
  void set_figure(const FigureRequest& request, std::shared_ptr<const BesideSurface> beside) override {
    request_ = request;
    beside_ = std::move(beside);
    if (layered_) layered_->set_figure(request_, beside_);
  }

  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) override {
    if (draws_on_cpu() || settings.look.traces_light()) {
      if (!layered_) begin_layered();
      const bool whole = layered_->draw(probe_radius, camera, settings, stop);
      shows_layered_ = shows_layered_ || whole;
      return whole;
    }
    visible_.set_surface(probe_radius, Extent::visible);
    const bool whole = renderer_.draw(visible_, camera, settings, stop);
    require_living_context();
    shows_layered_ = shows_layered_ && !whole;
    return whole;
  }

  std::vector<std::uint8_t> rgba() const override { return shows_layered_ ? layered_->rgba() : renderer_.rgba(); }
  std::uint32_t texture() const override { return shows_layered_ ? 0 : renderer_.texture(); }
  glm::ivec2 size() const override { return shows_layered_ ? layered_->size() : renderer_.size(); }
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    return shows_layered_ ? layered_->pick(pixel) : renderer_.pick(pixel);
  }
  std::shared_ptr<const Surface> surface() const override { return shows_layered_ ? layered_->surface() : nullptr; }
  double grown_by() const override { return shows_layered_ ? layered_->grown_by() : visible_.stats().grown_by; }
  bool draws_on_cpu() const override {
    return request_.hides_surface || !request_.cuts.empty() || (beside_ && !beside_->empty()) ||
           coloring_.is_translucent();
  }
  const std::vector<StageTime>& times() const override {
    return shows_layered_ ? layered_->times() : renderer_.times();
  }

 private:
  void begin_layered() {
    layered_ = make_cpu_view_renderer();
    layered_->set_atoms(atoms_);
    layered_->set_coloring(coloring_);
    layered_->set_figure(request_, beside_);
  }

  std::vector<Ball> atoms_;
  Coloring coloring_;
  FigureRequest request_;
  std::shared_ptr<const BesideSurface> beside_;
  ViewPipeline visible_;
  Renderer renderer_;
  std::unique_ptr<ViewRenderer> layered_;  // once a view was one that GL does not draw
  bool shows_layered_ = false;             // the last picture is its
};

}  // namespace

std::unique_ptr<ViewRenderer> make_gl_view_renderer() { return std::make_unique<GlViewRenderer>(); }

}  // namespace meniscus
