// SPDX-License-Identifier: BSD-3-Clause
// A surface and shapes as objects of a picture or an export, with their colours, and the comparison of two surfaces.
#pragma once

#include "core/color/coloring.h"
#include "core/math/rigid_motion.h"
#include "core/shapes/shapes.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// An object that pictures and exporters draw. A molecule is one object, or several: one per chain or per component.
struct SurfaceObject {
  std::string name;  ///< may come from a molecule file: must never get into the source code of another program
  Surface surface;
  Coloring coloring;                ///< one colour per surface.atoms
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: index into Structure::atoms
  /// The places of the surface; the first is usually the identity. Copies share everything else.
  std::vector<RigidMotion> copies{RigidMotion{}};
  bool whole = true;  ///< true if no part of the surface of its atoms is left out
};

struct ColoredShapes {
  Shapes shapes;
  Coloring coloring;  ///< one colour and part for each atom that shapes name; empty if there are no shapes

  bool empty() const { return shapes.empty(); }
};

struct Surface;

/// Returns each difference in one sentence: patches that only one surface has; different contacts, cuts, borders, faces
/// or components; positions more than 1e-9 Å apart; areas and volumes that differ by more than 1e-9 of their size. The
/// result is empty if the surfaces are equal.
std::vector<std::string> differences(const Surface& a, const Surface& b);

}  // namespace meniscus
