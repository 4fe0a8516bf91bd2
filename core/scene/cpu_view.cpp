// SPDX-License-Identifier: BSD-3-Clause
// Computes what a view lacks, then draws it; stops either when it is no longer wanted.
#include "core/scene/cpu_view.h"

#include <utility>

namespace meniscus {
namespace {

/// Ends the computation of a surface that nobody wants any more.
struct GivenUp {};

}  // namespace

void CpuView::set_atoms(std::vector<Ball> atoms) {
  atoms_ = std::move(atoms);
  forget();
}

bool CpuView::draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
                   const std::function<bool()>& stop) {
  validate_camera(camera, "camera");
  times_.clear();
  if (!is_computed(probe_radius) && !compute_unless(stop, probe_radius)) return false;
  const bool whole = paint(camera, settings, stop);
  times_.insert(times_.end(), renderer_.times().begin(), renderer_.times().end());
  return whole;
}

bool CpuView::compute_unless(const std::function<bool()>& stop, double probe_radius) {
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

}  // namespace meniscus
