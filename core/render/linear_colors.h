// SPDX-License-Identifier: BSD-3-Clause
// Colours in linear light, as rays use them.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

namespace meniscus {

struct Coloring;

/// One an atom, linear, alpha: opacity (0: hidden); then, if by kind, three for these: GpuScene::colors.
std::vector<glm::vec4> linear_colors(const Coloring& coloring);

}  // namespace meniscus
