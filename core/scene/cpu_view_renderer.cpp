// SPDX-License-Identifier: BSD-3-Clause
// One complete surface for many cameras.
#include <algorithm>
#include <utility>

#include "core/render/cpu/cpu_renderer.h"
#include "core/scene/view_renderer.h"
#include "core/surface/reduced_surface_engine.h"
#include "core/surface/surface.h"

namespace meniscus {
namespace {

/// Ends the computation of a surface that nobody wants any more.
struct GivenUp {};

class CpuViewRenderer final : public ViewRenderer {
 public:
  void set_atoms(std::vector<Ball> atoms) override {
    atoms_ = std::move(atoms);
    surface_.reset();
  }
  void set_coloring(const Coloring& coloring) override { coloring_ = std::make_shared<const Coloring>(coloring); }
  void set_figure(const FigureRequest& request, std::shared_ptr<const BesideSurface> beside) override {
    request_ = request;
    beside_ = std::move(beside);
  }

  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) override {
    validate_camera(camera, "camera");
    times_.clear();
    if (!surface_ || surface_->probe_radius != probe_radius)
      if (!compute(probe_radius, stop)) return false;
    drawn_ = {surface_, coloring_, beside_,
              picture_objects(*surface_, *coloring_, request_, beside_.get(), camera, surface_->atoms)};
    const bool whole = renderer_.draw(drawn_.objects, camera, settings, stop);
    times_.insert(times_.end(), renderer_.times().begin(), renderer_.times().end());
    return whole;
  }

  std::vector<std::uint8_t> rgba() const override { return renderer_.rgba(); }
  std::uint32_t texture() const override { return 0; }
  glm::ivec2 size() const override { return renderer_.size(); }
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    std::optional<PickedPoint> point = renderer_.pick(pixel);
    if (point) name_object(*point);
    return point;
  }
  std::shared_ptr<const Surface> surface() const override { return surface_; }
  bool draws_on_cpu() const override { return true; }
  const std::vector<StageTime>& times() const override { return times_; }

 private:
  /// False if it was given up.
  bool compute(double probe_radius, const std::function<bool()>& stop) {
    surface_.reset();
    StageClock clock;
    clock.before_stages([&stop] {
      if (stop && stop()) throw GivenUp();
    });
    try {
      auto surface = std::make_shared<Surface>(compute_surface(*engine_, atoms_, probe_radius, clock));
      require_closed(*surface);
      surface_ = std::move(surface);
    } catch (const GivenUp&) {
      return false;
    }
    times_ = clock.times();
    return true;
  }

  /// From the objects of the picture to those of the figure.
  void name_object(PickedPoint& point) const {
    const PictureObject& shown = drawn_.objects[point.object];
    if (shown.surface == drawn_.surface.get()) {
      point.object = 0;
    } else if (shown.shapes == &drawn_.beside->shapes.shapes) {
      point.object = 1;
    } else {
      const std::vector<FigureObject>& objects = drawn_.beside->objects;
      const auto own = std::ranges::find_if(objects, [&](const FigureObject& object) {
        return shown.surface ? object.surface && &object.surface->surface == shown.surface
                             : &object.shapes.shapes == shown.shapes;
      });
      if (own->surface) point.atom = own->surface->atom[point.atom];
      point.object = 2 + static_cast<std::uint32_t>(own - objects.begin());
    }
  }

  /// What the last picture was made of, for what it shows is asked later.
  struct Drawn {
    std::shared_ptr<const Surface> surface;
    std::shared_ptr<const Coloring> coloring;
    std::shared_ptr<const BesideSurface> beside;
    std::vector<PictureObject> objects;
  };

  std::vector<Ball> atoms_;
  std::shared_ptr<const Coloring> coloring_;
  FigureRequest request_;
  std::shared_ptr<const BesideSurface> beside_;
  Drawn drawn_;
  std::unique_ptr<ReducedSurfaceEngine> engine_ = make_cpu_engine();
  std::shared_ptr<const Surface> surface_;  // of atoms_; none: not yet, or given up
  CpuRenderer renderer_;
  std::vector<StageTime> times_;
};

}  // namespace

std::unique_ptr<ViewRenderer> make_cpu_view_renderer() { return std::make_unique<CpuViewRenderer>(); }

}  // namespace meniscus
