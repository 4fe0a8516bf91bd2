// SPDX-License-Identifier: BSD-3-Clause
// Repeats the measurements of table 1 of the paper (Krone, Dachsbacher & Ertl 2010), by groups of stages.
#pragma once

#include <glm/vec2.hpp>

#include "core/base/constants.h"
#include "core/gpu/device_choice.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// The size and the number of frames.
struct PaperBenchSettings {
  DeviceChoice device;
  glm::ivec2 size{1024, 768};         ///< pixels
  double probe_radius = kUsualProbe;  ///< Å
  int runs = 5;                       ///< timed frames of each kind; medians are shown
};

/// The balls of one file, and their name in the tables.
struct PaperBenchMolecule {
  std::string name;
  std::vector<Ball> balls;
};

/// Prints the tables on stdout. Throws GpuError, OpenSurfaceError, CapacityError.
void print_paper_tables(const std::vector<PaperBenchMolecule>& molecules, const PaperBenchSettings& settings);

}  // namespace meniscus
