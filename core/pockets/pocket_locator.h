// SPDX-License-Identifier: BSD-3-Clause
// Which pocket a point lies in.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/pockets/pockets.h"
#include "core/queries/distance.h"

namespace meniscus {

/// Answers any number of questions about the same pockets, from any number of threads.
class PocketLocator {
 public:
  /// They must stay and not change.
  explicit PocketLocator(const Pockets& pockets);

  /// The place in Pockets::pockets of the one that the point lies in: that has a probe which covers it.
  std::optional<std::size_t> operator()(const glm::dvec3& point) const;

 private:
  double probe_radius_;
  std::optional<SurfaceDistance> anywhere_;  ///< nothing: there are no pockets
  std::vector<SurfaceDistance> each_;
};

}  // namespace meniscus
