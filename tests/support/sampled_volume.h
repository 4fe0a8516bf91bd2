// SPDX-License-Identifier: BSD-3-Clause
// The volume inside a surface by random points, tested by the oracle alone.
#pragma once

#include <random>
#include <span>

#include "core/surface/primitives.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {

struct VolumeEstimate {
  double value = 0.0;  ///< Å³
  double error = 0.0;  ///< one standard deviation in Å³, by the difference of the two points of a cell
  double cell = 0.0;   ///< volume of a cell, Å³: what `error` cannot know, where all points agree
};

/// Tests two random points in each of cells³ cells of the box of the balls for whether the probe is kept from them.
VolumeEstimate sampled_volume(std::span<const Ball> balls, double probe_radius, const SphereTracer& oracle, int cells,
                              std::mt19937& random);

}  // namespace meniscus::testing
