// SPDX-License-Identifier: BSD-3-Clause
// From balls to a surface on the device a user asked for, with the time every stage took.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/gpu/device_choice.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Where the surface is computed: on the CPU, or through GL.
struct ComputeOptions {
  double probe_radius = 1.4;  ///< Å
  bool cpu = false;           ///< --device cpu
  DeviceChoice gl;            ///< otherwise; automatic: a hardware GPU if there is one, else the CPU
  bool verify = false;        ///< compute on the other device too and compare
  int threads = 0;            ///< CPU threads; 0: all
};

/// A surface and how it came to be.
struct ComputedSurface {
  Surface surface;
  std::string device;  ///< "cpu (16 threads)", or GL renderer and version
  std::vector<StageTime> stages;
};

/// Automatic takes a hardware GPU if there is one, else the CPU, which is faster than software GL.
/// With `verify` the surface is computed on the other device as well (software GL if need be) and every difference
/// is an error. Throws OpenSurfaceError, CapacityError, GpuError.
ComputedSurface compute_surface(std::span<const Ball> balls, const ComputeOptions& options);

/// The sum of all stages.
double total_ms(const std::vector<StageTime>& stages);

}  // namespace meniscus
