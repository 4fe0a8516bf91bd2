// SPDX-License-Identifier: BSD-3-Clause
// Files of a run beside its .mns files: a manifest of its frames, and the atoms of each frame as one file of arrays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "exporters/blender/surface_file.h"

namespace meniscus::blender {

/// Every process that makes some frames of a run must have the same.
struct SequenceManifest {
  Provenance provenance;              ///< the device is left out: another share may run on another
  std::string trajectory;             ///< its file's name, without its folder; empty: the models of provenance.source
  std::vector<std::uint64_t> frames;  ///< of the trajectory; scene frame n, from 1, is frames[n - 1]
  std::vector<Shot> shots;            ///< one for all, or one a frame
  glm::dvec3 origin{0.0};             ///< Å, of the scene's coordinates
  double scale = 0.1;                 ///< Blender units per Å
  double fps = 24.0;                  ///< scene frames per second
  double probe_radius = 0.0, tolerance = 0.0;  ///< Å
  std::size_t atom_count = 0;

  const Shot& shot(std::size_t place) const { return shots[shots.size() == 1 ? 0 : place]; }
};

/// "surface_00042.mns"
std::string frame_file(std::uint64_t frame);

/// A text that two runs share only if their frames may be mixed: all but cameras, fps and scale goes into it.
std::string run_name(const SequenceManifest& manifest);

/// Writes surface_sequence.json as FORMAT.md describes and gives its path. A file that is there with just this content
/// stays. Throws OutputError.
std::filesystem::path write_manifest(const std::filesystem::path& folder, Existing existing,
                                     const SequenceManifest& manifest);

/// Where atoms are at one moment.
struct AtomFrame {
  std::vector<glm::dvec3> positions;  ///< Å, in the order of the atoms of the object
  std::optional<double> time;         ///< ps
};

/// The frames of a run.
struct AtomFrames {
  std::vector<std::uint64_t> numbers;  ///< of the trajectory
  std::function<AtomFrame()> next;     ///< called once for each of them, in order
};

/// Writes them as FORMAT.md describes. The object is in one place: its copies are atoms of their own. Throws
/// OutputError, and what AtomFrames::next throws.
void write_atoms(const std::string& path, Existing existing, const SurfaceObject& object, const AtomAttributes& atoms,
                 const Provenance& provenance, const AtomFrames& frames);

}  // namespace meniscus::blender
