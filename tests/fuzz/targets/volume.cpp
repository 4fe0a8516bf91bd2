// SPDX-License-Identifier: BSD-3-Clause
// Files of volume maps of every format, and samples of them.
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/volume/volume_grid.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void run_volume(std::string_view bytes) {
  static const ScratchFile scratch("map");
  try {
    const VolumeGrid grid = read_volume(scratch.write(bytes));
    const VolumeFrame& frame = grid.frame();
    require(grid.values().size() == frame.count(), "as many values as points");
    float low = grid.values().front(), high = low;
    for (const float value : grid.values()) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
    const glm::dvec3 last(frame.size[0] - 1.0, frame.size[1] - 1.0, frame.size[2] - 1.0);
    const double sample = grid.sample(frame.origin + frame.step * (0.5 * last));
    const double slack = 1e-6 * std::max(std::abs(static_cast<double>(low)), std::abs(static_cast<double>(high)));
    require(sample >= low - slack && sample <= high + slack, "samples lie between the values");
    require(std::isnan(grid.sample(frame.origin - frame.step * glm::dvec3(1.0))), "there is nothing outside");
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

const Registration registered_volume{"volume", run_volume};

}  // namespace
}  // namespace meniscus::fuzz
