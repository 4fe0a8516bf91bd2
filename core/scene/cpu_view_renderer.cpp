// SPDX-License-Identifier: BSD-3-Clause
// Computes one complete surface, and draws it for many cameras.
#include <algorithm>
#include <utility>

#include "core/scene/cpu_view.h"
#include "core/surface/compute_surface.h"

namespace meniscus {
namespace {

class CpuViewRenderer final : public CpuView {
 public:
  void set_coloring(const Coloring& coloring) override { coloring_ = std::make_shared<const Coloring>(coloring); }
  void set_figure(const FigureRequest& request, std::shared_ptr<const BesideSurface> beside) override {
    request_ = request;
    beside_ = std::move(beside);
  }

  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    std::optional<PickedPoint> point = renderer().pick(pixel);
    if (point) name_object(*point);
    return point;
  }
  std::shared_ptr<const Surface> surface() const override { return surface_; }
  double grown_by() const override { return surface_ ? surface_->certificate.grown_by : 0.0; }

 private:
  void forget() override { surface_.reset(); }
  bool is_computed(double probe_radius) const override { return surface_ && surface_->probe_radius == probe_radius; }
  void compute(double probe_radius, StageClock& clock) override {
    auto surface = std::make_shared<Surface>(compute_surface(engine(), atoms(), probe_radius, clock));
    require_closed(*surface);
    surface_ = std::move(surface);
  }
  bool paint(const Camera& camera, const RenderSettings& settings, const std::function<bool()>& stop) override {
    drawn_ = {surface_, coloring_, beside_,
              picture_objects(*surface_, *coloring_, request_, beside_.get(), camera, surface_->atoms)};
    return renderer().draw(drawn_.objects, camera, settings, stop);
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

  std::shared_ptr<const Coloring> coloring_;
  FigureRequest request_;
  std::shared_ptr<const BesideSurface> beside_;
  Drawn drawn_;
  std::shared_ptr<const Surface> surface_;  // of atoms(); none: not yet, or given up
};

}  // namespace

std::unique_ptr<ViewRenderer> make_cpu_view_renderer() { return std::make_unique<CpuViewRenderer>(); }

}  // namespace meniscus
