// SPDX-License-Identifier: BSD-3-Clause
// Compares POV-Ray's buffers with the sphere-tracing oracle, pixel by pixel.
#pragma once

#include <span>
#include <string>

#include "core/camera/camera.h"
#include "core/surface/primitives.h"
#include "tests/export/povray/povray_render.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {

/// Numbers of differing pixels. A pixel agrees when POV-Ray's value agrees with the oracle's at the pixel's centre or
/// at one of four points a hundredth of a pixel away from it: where the truth itself jumps there, either side is right.
struct BufferDifference {
  std::size_t pixels = 0;
  std::size_t surface = 0;              ///< pixels where POV-Ray hit something
  std::size_t position = 0;             ///< hit and miss mixed up, or the point is off by more than 0.01 Å
  std::size_t normal = 0;               ///< off by more than 0.01
  std::size_t kind = 0;                 ///< another kind of patch
  std::size_t color = 0;                ///< not the colour of the touched atom that is nearest as seen from the probe
  std::size_t odd_layers = 0;           ///< rays that cross the closed surface an odd number of times
  double largest_position_error = 0.0;  ///< Å, among pixels that agree
  std::string text() const;
};

/// colors: the palette index of every atom. origin: the scene's origin in the molecule's coordinates.
BufferDifference compare_buffers(const Buffers& buffers, const SphereTracer& tracer, std::span<const Ball> balls,
                                 double probe_radius, std::span<const int> colors, const Camera& camera,
                                 const glm::dvec3& origin);

}  // namespace meniscus::testing
