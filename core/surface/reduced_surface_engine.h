// SPDX-License-Identifier: BSD-3-Clause
// What a device does for a surface: it finds the reduced surface and traces the singularities.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/cusp_tracer.h"

namespace meniscus {

class StageClock;

/// Finds reduced surfaces on one device, frame after frame; all engines find the same. Used by one thread at a time.
class ReducedSurfaceEngine {
 public:
  virtual ~ReducedSurfaceEngine() = default;

  /// atoms: van der Waals balls in Å; probe_radius >= 0 in Å. Adds the time of each stage to `clock`, batches added up.
  /// Throws GpuError, CapacityError.
  virtual ReducedSurface reduce(std::span<const Ball> atoms, double probe_radius, StageClock& clock) = 0;

  /// On the same device; lives as long as the engine.
  virtual CuspTracer& cusp_tracer() = 0;

  /// Of the last reduce().
  virtual const CircleStats& stats() const = 0;

  /// For people: "cpu (16 threads)", or GL renderer and version.
  virtual std::string device() const = 0;
};

/// On all cores TBB may use, in double and, in doubt, quadruple precision; the result does not depend on their number.
std::unique_ptr<ReducedSurfaceEngine> make_cpu_engine();

}  // namespace meniscus
