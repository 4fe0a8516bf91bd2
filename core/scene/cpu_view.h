// SPDX-License-Identifier: BSD-3-Clause
// What views drawn by the CPU have in common: surfaces are computed once for many cameras.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/scene/view_renderer.h"
#include "core/surface/reduced_surface_engine.h"

namespace meniscus {

class CpuView : public ViewRenderer {
 public:
  void set_atoms(std::vector<Ball> atoms) final;
  bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop) final;

  std::vector<std::uint8_t> rgba() const final { return renderer_.rgba(); }
  std::uint32_t texture() const final { return 0; }
  glm::ivec2 size() const final { return renderer_.size(); }
  bool draws_on_cpu() const final { return true; }
  const std::vector<StageTime>& times() const final { return times_; }

 protected:
  const std::vector<Ball>& atoms() const { return atoms_; }
  ReducedSurfaceEngine& engine() { return *engine_; }
  CpuRenderer& renderer() { return renderer_; }
  const CpuRenderer& renderer() const { return renderer_; }

 private:
  /// Lets go of what was computed of atoms that are no longer these.
  virtual void forget() = 0;
  virtual bool is_computed(double probe_radius) const = 0;
  /// Keeps nothing if it throws: the clock does, where the view is given up.
  virtual void compute(double probe_radius, StageClock& clock) = 0;
  /// What was computed; false if it was given up.
  virtual bool paint(const Camera& camera, const RenderSettings& settings, const std::function<bool()>& stop) = 0;

  /// False if it was given up.
  bool compute_unless(const std::function<bool()>& stop, double probe_radius);

  std::vector<Ball> atoms_;
  std::unique_ptr<ReducedSurfaceEngine> engine_ = make_cpu_engine();
  CpuRenderer renderer_;
  std::vector<StageTime> times_;
};

}  // namespace meniscus
