// SPDX-License-Identifier: BSD-3-Clause
// Views in MolViewSpec, which Mol* and other viewers draw: meshes with colours, spheres, cylinders, a camera.
#pragma once

#include <nlohmann/json.hpp>

#include "exporters/path_tracers/path_tracer_scene.h"

namespace meniscus::mvs {

/// One view.
struct State {
  nlohmann::json root;  ///< tree of nodes
  std::string title;    ///< title of the view in a run
};

/// The sequence of the states of a file.
struct Sequence {
  bool is_run = false;    ///< true if states are shown one after the other; false if there is a single state
  int milliseconds = 40;  ///< duration of each state of a run
};

/// Returns the tree of a scene, in the molecule's coordinates rounded to 0.001 Å. The viewer computes normals and
/// lights. Each triangle has one colour, the mean of the colours of its corners.
nlohmann::json tree_of(const path_tracers::PathTracerScene& scene);

/// Returns an archive for viewers (.mvsx). Equal states give equal bytes; the time in it is source_date(). states: at
/// least one. Throws CapacityError for 4 GiB or more.
std::vector<std::byte> mvsx_archive(std::span<const State> states, const std::string& title, const Sequence& sequence);

}  // namespace meniscus::mvs
