// SPDX-License-Identifier: BSD-3-Clause
// Names the kinds of surfaces, and checks the radius of a probe.
#include "core/scene/surface_request.h"

#include <cstddef>

#include <fmt/format.h>

namespace meniscus {
namespace {

// Below 0.001 Å the patches between atoms are thinner than any file's coordinates are precise; above 100 Å the probe is
// larger than most molecules and every atom neighbours every other.
constexpr double kSmallestProbe = 1e-3;
constexpr double kLargestProbe = 100.0;

}  // namespace

const char* kind_word(SurfaceKind kind) {
  constexpr const char* kWords[] = {"ses", "sas", "vdw"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::string probe_fault(double radius) {
  if (radius != 0.0 && radius < kSmallestProbe)
    return fmt::format("{} Å is {}; use at least {} Å, or the van der Waals surface", radius,
                       radius < 0.0 ? "negative" : "too small", kSmallestProbe);
  if (radius > kLargestProbe) return fmt::format("{} Å is too large; use at most {} Å", radius, kLargestProbe);
  return {};
}

}  // namespace meniscus
