// SPDX-License-Identifier: BSD-3-Clause
// Draws copies: on the CPU from one computed surface each, on GL as atoms like all others.
#include <algorithm>
#include <cassert>
#include <utility>

#include "core/queries/surface_object.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/cpu_view.h"
#include "core/surface/compute_surface.h"

namespace meniscus {
namespace {

class CpuCopiesRenderer final : public CpuView {
 public:
  explicit CpuCopiesRenderer(std::vector<Instances> copies) : copies_(std::move(copies)) {}

  void set_coloring(const Coloring& coloring) override {
    coloring_ = coloring;
    color_objects();
  }
  void set_figure([[maybe_unused]] const FigureRequest& request,
                  [[maybe_unused]] std::shared_ptr<const BesideSurface> beside) override {
    assert(request.plain() && !beside);  // copies are shown whole
  }

  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    std::optional<PickedPoint> point = renderer().pick(pixel);
    if (point) point->atom = copies_[point->object].atoms[point->atom];
    return point;
  }
  std::shared_ptr<const Surface> surface() const override { return nullptr; }
  double grown_by() const override {
    double most = 0.0;
    for (const SurfaceObject& object : objects_) most = std::max(most, object.surface.certificate.grown_by);
    return most;
  }

 private:
  void forget() override { objects_.clear(); }
  bool is_computed(double probe_radius) const override {
    return !objects_.empty() && objects_.front().surface.probe_radius == probe_radius;
  }
  void compute(double probe_radius, StageClock& clock) override {
    std::vector<SurfaceObject> objects;
    for (const Instances& group : copies_) {
      std::vector<Ball> balls;
      for (const std::uint32_t atom : group.atoms) balls.push_back(atoms()[atom]);
      SurfaceObject& object = objects.emplace_back();
      object.surface = compute_surface(engine(), balls, probe_radius, clock);
      require_closed(object.surface);
      object.atom = group.atoms;
      object.copies = group.motions;
    }
    objects_ = std::move(objects);
    color_objects();
  }
  bool paint(const Camera& camera, const RenderSettings& settings, const std::function<bool()>& stop) override {
    return renderer().draw_copies(objects_, camera, settings, stop);
  }

  void color_objects() {
    for (SurfaceObject& object : objects_) object.coloring = coloring_of(coloring_, object.atom);
  }

  const std::vector<Instances> copies_;
  Coloring coloring_;
  std::vector<SurfaceObject> objects_;  // of copies_ and atoms(); none: not yet, or given up
};

/// Whatever draws atoms draws all copies, as they keep apart.
class PlacedAtomsRenderer final : public ViewRenderer {
 public:
  PlacedAtomsRenderer(std::vector<Instances> copies, std::unique_ptr<ViewRenderer> renderer)
      : copies_(std::move(copies)), placed_(placed_atoms(copies_)), renderer_(std::move(renderer)) {}

  void set_atoms(std::vector<Ball> atoms) override { renderer_->set_atoms(placed_balls(atoms, copies_)); }
  void set_coloring(const Coloring& coloring) override {
    std::vector<std::uint32_t> atoms;
    for (const CopiedAtom& atom : placed_) atoms.push_back(atom.atom);
    Coloring all = coloring_of(coloring, atoms);
    keep_parts_apart(all);
    renderer_->set_coloring(all);
  }
  void set_figure(const FigureRequest& request, std::shared_ptr<const BesideSurface> beside) override {
    renderer_->set_figure(request, std::move(beside));
  }

  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) override {
    return renderer_->draw(probe_radius, camera, settings, stop);
  }

  std::vector<std::uint8_t> rgba() const override { return renderer_->rgba(); }
  std::uint32_t texture() const override { return renderer_->texture(); }
  glm::ivec2 size() const override { return renderer_->size(); }
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    std::optional<PickedPoint> point = renderer_->pick(pixel);
    if (!point) return point;
    const CopiedAtom& atom = placed_[point->atom];
    point->atom = atom.atom;
    point->copy = atom.copy;
    return point;
  }
  std::shared_ptr<const Surface> surface() const override { return nullptr; }
  double grown_by() const override { return renderer_->grown_by(); }
  bool draws_on_cpu() const override { return renderer_->draws_on_cpu(); }
  const std::vector<StageTime>& times() const override { return renderer_->times(); }

 private:
  /// Those of copies and groups, which merged() keeps apart, too.
  void keep_parts_apart(Coloring& all) const {
    if (all.part.empty()) return;
    std::size_t place = 0;
    std::uint32_t first = 0, next = 0;
    for (const Instances& group : copies_)
      for (std::size_t copy = 0; copy < group.motions.size(); ++copy, first = next)
        for (std::size_t n = 0; n < group.atoms.size(); ++n, ++place) {
          all.part[place] += first;
          next = std::max(next, all.part[place] + 1);
        }
  }

  const std::vector<Instances> copies_;
  const std::vector<CopiedAtom> placed_;
  std::unique_ptr<ViewRenderer> renderer_;
};

}  // namespace

std::unique_ptr<ViewRenderer> make_cpu_copies_renderer(std::vector<Instances> copies) {
  return std::make_unique<CpuCopiesRenderer>(std::move(copies));
}

std::unique_ptr<ViewRenderer> make_placed_atoms_renderer(std::vector<Instances> copies,
                                                         std::unique_ptr<ViewRenderer> renderer) {
  return std::make_unique<PlacedAtomsRenderer>(std::move(copies), std::move(renderer));
}

}  // namespace meniscus
