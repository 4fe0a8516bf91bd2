// SPDX-License-Identifier: BSD-3-Clause
// Shapes in addition to a surface, with their colours, for pictures and exporters.
#pragma once

#include "core/color/coloring.h"
#include "core/shapes/shapes.h"

namespace meniscus {

struct ColoredShapes {
  Shapes shapes;
  Coloring coloring;  ///< one colour and part for each atom that shapes name; empty if there are no shapes

  bool empty() const { return shapes.empty(); }
};

}  // namespace meniscus
