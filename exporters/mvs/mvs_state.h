// SPDX-License-Identifier: BSD-3-Clause
// Views as MolViewSpec has them, which Mol* and other viewers draw: meshes with colours, spheres, cylinders, a camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "exporters/path_tracers/scene.h"

namespace meniscus::mvs {

/// One view.
struct State {
  nlohmann::json root;  ///< the tree of nodes
  std::string title;    ///< among those of a run
};

/// How a file has its states.
struct Sequence {
  bool is_run = false;    ///< states one after the other; else there is one
  int milliseconds = 40;  ///< that each of a run is shown
};

/// The tree of a scene, in the molecule's coordinates to a thousandth of an Å. The viewer finds normals and lights.
/// Each triangle has one colour: where a map colours points, the mean of its corners'.
nlohmann::json tree_of(const path_tracers::Scene& scene);

/// An archive as viewers load it (.mvsx). The same states give the same bytes; its time is source_date(). Throws
/// CapacityError for 4 GiB or more.
std::vector<std::byte> mvsx_archive(std::span<const State> states, const std::string& title, const Sequence& sequence);

}  // namespace meniscus::mvs
