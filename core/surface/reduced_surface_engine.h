// SPDX-License-Identifier: BSD-3-Clause
// Finds the reduced surface and traces the singularities on one device.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/cusp_tracer.h"

namespace meniscus {

class StageClock;

/// Finds reduced surfaces on one device, frame after frame. All engines find the same ones. One thread uses it at a
/// time.
class ReducedSurfaceEngine {
 public:
  virtual ~ReducedSurfaceEngine() = default;

  /// Finds the reduced surface. atoms: van der Waals balls in Å; probe_radius >= 0 in Å. Adds the time of each stage to
  /// `clock`, with batches added up. Throws GpuError, CapacityError.
  virtual ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius, StageClock& clock) = 0;

  /// Returns the tracer on the same device. It lives as long as the engine.
  virtual CuspTracer& cusp_tracer() = 0;

  /// Returns the statistics of the last reduce().
  virtual const CircleStats& stats() const = 0;

  /// Returns the device's name for people: "cpu (16 threads)", or GL renderer and version.
  virtual std::string device() const = 0;
};

/// Makes an engine on all cores that TBB may use, in double and, where in doubt, quadruple precision. The result does
/// not depend on the number of cores.
std::unique_ptr<ReducedSurfaceEngine> make_cpu_engine();

}  // namespace meniscus
