// SPDX-License-Identifier: BSD-3-Clause
// How a picture looks, apart from what it shows.
#pragma once

#include <glm/vec3.hpp>

namespace meniscus {

/// Light, air and ink of a finished picture.
struct Look {
  glm::vec3 background{1.0f};  ///< sRGB in [0, 1]
};

}  // namespace meniscus
