// SPDX-License-Identifier: BSD-3-Clause
// Computes a surface from balls on the device that a user asked for, and times every stage.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/scene/surface_request.h"
#include "core/scene/thread_limit.h"
#include "core/surface/primitives.h"

namespace meniscus {

class EglContext;
class ReducedSurfaceEngine;

/// A surface and how it came to be.
struct ComputedSurface {
  Surface surface;
  std::string device;  ///< "cpu (16 threads)", or GL renderer and version
  std::vector<StageTime> stages;
};

/// Computes any number of surfaces on the device that was asked for.
class SurfaceComputer {
 public:
  /// Automatic takes a hardware GPU if there is one, else the CPU, which is faster than software GL. What runs on GL
  /// runs in `context`, if there is one: it is current and lives longer; else in a context of its own. Throws
  /// RequestError for a van der Waals surface with a probe.
  explicit SurfaceComputer(const SurfaceRequest& request, const EglContext* context = nullptr);
  ~SurfaceComputer();

  /// balls: van der Waals. Sas and vdw surfaces are made of balls without a probe: of these grown, or of these.
  /// With `verify` the surface is computed on the other device as well (software GL if need be) and checked further,
  /// and every difference is an error. Look at its certificate. Throws OpenSurfaceError, CapacityError, GpuError.
  Surface compute(std::span<const Ball> balls);

  /// Whether surfaces are made on the CPU alone, so not verified by GL; then, and only then, on any thread.
  bool is_on_cpu() const { return on_cpu_ && !request_.verify; }
  const std::string& device() const { return device_; }  ///< "cpu (16 threads)", or GL renderer and version
  const std::vector<StageTime>& stages() const { return clock_.times(); }  ///< of all surfaces since the last restart
  void restart_clock() { clock_.restart(); }
  /// look: called before each stage; what it throws ends the computation.
  void before_stages(std::function<void()> look) { clock_.before_stages(std::move(look)); }

 private:
  bool find_hardware();
  std::unique_ptr<ReducedSurfaceEngine> make_engine(bool on_cpu, const DeviceChoice& gl) const;
  void verify(const Surface& surface, std::span<const Ball> balls, double probe_radius);

  SurfaceRequest request_;
  const EglContext* context_;
  ThreadLimit thread_limit_;
  bool on_cpu_;
  std::unique_ptr<ReducedSurfaceEngine> engine_, verifier_;  // verifier_: with --verify, on the other device
  std::string device_;
  StageClock clock_;
};

/// One closed surface. Throws what SurfaceComputer::compute throws, and OpenSurfaceError if it is not closed.
ComputedSurface compute_surface(std::span<const Ball> balls, const SurfaceRequest& request);

/// The sum of all stages.
double total_ms(const std::vector<StageTime>& stages);

}  // namespace meniscus
