// SPDX-License-Identifier: BSD-3-Clause
// Draws previews: computed surfaces and their copies on the CPU, copies as atoms by any renderer, and views on GL.
#include <cassert>

#include "core/base/progress.h"
#include "core/queries/copies.h"
#include "core/queries/surface_object.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/scene/figure.h"
#include "core/scene/renderers.h"
#include "core/surface/compute_surface.h"
#ifdef MENISCUS_WITH_GL
#include "core/gpu/context_description.h"
#include "core/render/gl_renderer.h"
#include "core/visible_surface/view_pipeline.h"
#endif

namespace meniscus {
namespace {

/// The common part of previews drawn by the CPU: surfaces are computed once for many cameras, and the computation or
/// the picture stops when the caller gives it up.
class CpuPreviewRenderer : public PreviewRenderer {
 public:
  void set_atoms(std::vector<Ball> atoms) final {
    atoms_ = std::move(atoms);
    forget();
  }
  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) final {
    validate_camera(camera, "camera");
    times_.clear();
    if (!is_computed(probe_radius) && !compute_unless(stop, probe_radius)) return false;
    const bool whole = paint(camera, settings, stop);
    times_.insert(times_.end(), renderer_.times().begin(), renderer_.times().end());
    return whole;
  }

  std::vector<std::uint8_t> rgba() const final { return renderer_.rgba(); }
  glm::ivec2 size() const final { return renderer_.size(); }
  bool draws_on_cpu() const final { return true; }
  const std::vector<StageTime>& times() const final { return times_; }

 protected:
  const std::vector<Ball>& atoms() const { return atoms_; }
  ReducedSurfaceEngine& engine() { return *engine_; }
  CpuRenderer& renderer() { return renderer_; }
  const CpuRenderer& renderer() const { return renderer_; }

 private:
  /// Ends the computation of a surface that the caller gives up.
  struct GivenUp {};

  /// Discards surfaces of other atoms than atoms().
  virtual void forget() = 0;
  virtual bool is_computed(double probe_radius) const = 0;
  /// Computes the surface. Keeps nothing if it throws; the clock throws GivenUp if the picture is given up.
  virtual void compute(double probe_radius, StageClock& clock) = 0;
  /// Draws the computed surface; returns false if the picture was given up.
  virtual bool paint(const Camera& camera, const RenderSettings& settings, const std::function<bool()>& stop) = 0;

  /// Computes the surface; returns false if the computation was given up.
  bool compute_unless(const std::function<bool()>& stop, double probe_radius) {
    forget();
    StageClock clock;
    clock.before_stages([&stop] {
      if (stop && stop()) throw GivenUp();
    });
    try {
      compute(probe_radius, clock);
    } catch (const GivenUp&) {
      return false;
    }
    times_ = clock.times();
    return true;
  }

  std::vector<Ball> atoms_;
  std::unique_ptr<ReducedSurfaceEngine> engine_ = make_cpu_engine();
  CpuRenderer renderer_;
  std::vector<StageTime> times_;
};

/// Draws one complete surface for many cameras.
class CpuSurfaceRenderer final : public CpuPreviewRenderer {
 public:
  void set_coloring(const Coloring& coloring) override { coloring_ = std::make_shared<const Coloring>(coloring); }
  void set_figure(const FigureRequest& request, std::shared_ptr<const FigureExtras> extras) override {
    request_ = request;
    extras_ = std::move(extras);
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
    drawn_ = {surface_, coloring_, extras_,
              picture_objects(*surface_, *coloring_, request_, extras_.get(), camera, surface_->atoms)};
    return renderer().draw(drawn_.objects, camera, settings, stop);
  }

  /// Converts the number of an object of the picture to that of the figure.
  void name_object(PickedPoint& point) const {
    const PictureObject& shown = drawn_.objects[point.object];
    if (shown.surface == drawn_.surface.get()) {
      point.object = 0;
    } else if (shown.shapes == &drawn_.extras->shapes.shapes) {
      point.object = 1;
    } else {
      const std::vector<FigureObject>& objects = drawn_.extras->objects;
      const auto own = std::ranges::find_if(objects, [&](const FigureObject& object) {
        return shown.surface ? object.surface && &object.surface->surface == shown.surface
                             : &object.shapes.shapes == shown.shapes;
      });
      if (own->surface) point.atom = own->surface->atom[point.atom];
      point.object = 2 + static_cast<std::uint32_t>(own - objects.begin());
    }
  }

  /// The contents of the last picture, which pick() needs.
  struct Drawn {
    std::shared_ptr<const Surface> surface;
    std::shared_ptr<const Coloring> coloring;
    std::shared_ptr<const FigureExtras> extras;
    std::vector<PictureObject> objects;
  };

  std::shared_ptr<const Coloring> coloring_;
  FigureRequest request_;
  std::shared_ptr<const FigureExtras> extras_;
  Drawn drawn_;
  std::shared_ptr<const Surface> surface_;  // surface of atoms(); nullptr: not computed yet, or given up
};

/// Draws copies of one computed surface for each group of atoms.
class CpuCopiesRenderer final : public CpuPreviewRenderer {
 public:
  explicit CpuCopiesRenderer(std::vector<Instances> copies) : copies_(std::move(copies)) {}

  void set_coloring(const Coloring& coloring) override {
    coloring_ = coloring;
    color_objects();
  }
  void set_figure([[maybe_unused]] const FigureRequest& request,
                  [[maybe_unused]] std::shared_ptr<const FigureExtras> extras) override {
    assert(request.plain() && !extras);  // copies are shown whole
  }

  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    std::optional<PickedPoint> point = renderer().pick(pixel);
    if (point) point->atom = copies_[point->object].atoms[point->atom];
    return point;
  }
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
  std::vector<SurfaceObject> objects_;  // surfaces of copies_ and atoms(); empty: not computed yet, or given up
};

/// Draws all copies by a renderer of atoms.
class PlacedAtomsRenderer final : public PreviewRenderer {
 public:
  PlacedAtomsRenderer(std::vector<Instances> copies, std::unique_ptr<PreviewRenderer> renderer)
      : copies_(std::move(copies)), placed_(placed_atoms(copies_)), renderer_(std::move(renderer)) {}

  void set_atoms(std::vector<Ball> atoms) override { renderer_->set_atoms(placed_balls(atoms, copies_)); }
  void set_coloring(const Coloring& coloring) override {
    std::vector<std::uint32_t> atoms;
    for (const CopiedAtom& atom : placed_) atoms.push_back(atom.atom);
    Coloring all = coloring_of(coloring, atoms);
    keep_parts_apart(all);
    renderer_->set_coloring(all);
  }
  void set_figure(const FigureRequest& request, std::shared_ptr<const FigureExtras> extras) override {
    renderer_->set_figure(request, std::move(extras));
  }

  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) override {
    return renderer_->draw(probe_radius, camera, settings, stop);
  }

  std::vector<std::uint8_t> rgba() const override { return renderer_->rgba(); }
  glm::ivec2 size() const override { return renderer_->size(); }
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const override {
    std::optional<PickedPoint> point = renderer_->pick(pixel);
    if (!point) return point;
    const CopiedAtom& atom = placed_[point->atom];
    point->atom = atom.atom;
    point->copy = atom.copy;
    return point;
  }
  double grown_by() const override { return renderer_->grown_by(); }
  bool draws_on_cpu() const override { return renderer_->draws_on_cpu(); }
  const std::vector<StageTime>& times() const override { return renderer_->times(); }

 private:
  /// Renumbers parts so that copies and groups have different ones, as in merged().
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
  std::unique_ptr<PreviewRenderer> renderer_;
};

#ifdef MENISCUS_WITH_GL

/// Draws views on GL with the paper's pipeline and the renderer; what GL cannot draw, the CPU draws.
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

#endif

}  // namespace

std::unique_ptr<PreviewRenderer> make_cpu_preview_renderer() { return std::make_unique<CpuSurfaceRenderer>(); }

std::unique_ptr<PreviewRenderer> make_cpu_copies_renderer(std::vector<Instances> copies) {
  return std::make_unique<CpuCopiesRenderer>(std::move(copies));
}

std::unique_ptr<PreviewRenderer> make_placed_atoms_renderer(std::vector<Instances> copies,
                                                            std::unique_ptr<PreviewRenderer> renderer) {
  return std::make_unique<PlacedAtomsRenderer>(std::move(copies), std::move(renderer));
}

#ifdef MENISCUS_WITH_GL
std::unique_ptr<PreviewRenderer> make_gl_preview_renderer() { return std::make_unique<GlPreviewRenderer>(); }
#else
std::unique_ptr<PreviewRenderer> make_gl_preview_renderer() { return nullptr; }  // there is no context
#endif

}  // namespace meniscus
