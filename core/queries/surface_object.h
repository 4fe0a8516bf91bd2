// SPDX-License-Identifier: BSD-3-Clause
// A surface as an object of a picture or an export: its name, its colours, and the positions of its copies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/color/coloring.h"
#include "core/surface/primitives.h"
#include "core/math/rigid_motion.h"

namespace meniscus {

/// What pictures and exporters draw. A molecule is one object, or several: one a chain, one a component.
struct SurfaceObject {
  std::string name;  ///< may come from a molecule file: never into the source code of another program
  Surface surface;
  Coloring coloring;                ///< one colour per surface.atoms
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: index into Structure::atoms
  /// Where the surface is; the first is usually the identity. Copies share everything else.
  std::vector<RigidMotion> copies{RigidMotion{}};
  bool whole = true;  ///< no part of the surface of its atoms is left out
};

}  // namespace meniscus
