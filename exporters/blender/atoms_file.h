// SPDX-License-Identifier: BSD-3-Clause
// The atoms that surfaces are computed of, and where they stand in each frame of a run, as one file of arrays.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "exporters/blender/surface_file.h"

namespace meniscus::blender {

/// Where atoms stand at one moment.
struct AtomFrame {
  std::vector<glm::dvec3> positions;  ///< Å, in the order of the atoms of the object
  std::optional<double> time;         ///< ps
};

/// The frames of a run.
struct AtomFrames {
  std::vector<std::uint64_t> numbers;  ///< of the trajectory
  std::function<AtomFrame()> next;     ///< called once for each of them, in order
};

/// Writes them as FORMAT.md describes. The object stands in one place: its copies are atoms of their own. Throws
/// OutputError, and what AtomFrames::next throws.
void write_atoms(const std::string& path, Existing existing, const SurfaceObject& object, const AtomAttributes& atoms,
                 const Provenance& provenance, const AtomFrames& frames);

}  // namespace meniscus::blender
