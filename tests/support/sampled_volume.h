// SPDX-License-Identifier: BSD-3-Clause
// The volume inside a surface by random points, which are tested by the oracle alone.
#pragma once

#include <random>
#include <span>

#include "core/surface/primitives.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {

struct VolumeEstimate {
  double value = 0.0;  ///< Å³
  double error = 0.0;  ///< one standard deviation, by how the two points of a cell differ; Å³
  double cell = 0.0;   ///< volume of a cell, Å³: what `error` cannot know, where all points agree
};

/// Two random points in each of cells³ cells of the box of the balls: is the probe kept from them?
VolumeEstimate sampled_volume(std::span<const Ball> balls, double probe_radius, const SphereTracer& oracle, int cells,
                              std::mt19937& random);

}  // namespace meniscus::testing
