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

/// One view, and when it is shown.
struct State {
  nlohmann::json root;  ///< the tree of nodes
  std::string title;
};

/// The tree of a scene, in the molecule's coordinates to a thousandth of an Å. The viewer finds normals and lights.
/// Each triangle has one colour: where a map colours points, the mean of its corners'.
nlohmann::json tree_of(const path_tracers::Scene& scene);

/// An archive as viewers load it (.mvsx): the state, or several of a run, each shown for so many ms. The same states
/// give the same bytes; its time is source_date(). Throws CapacityError for 4 GiB or more.
std::vector<std::byte> mvsx_archive(std::span<const State> states, const std::string& title, int milliseconds);

}  // namespace meniscus::mvs
