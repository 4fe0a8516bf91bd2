// SPDX-License-Identifier: BSD-3-Clause
// Positions, radii and colours of atoms that callers pass.
#pragma once

#include "core/color/coloring.h"
#include "core/surface/primitives.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Returns the atoms of a caller. Refuses numbers that meniscus.h does not allow; the message has the atom and the
/// value.
std::vector<Ball> read_atoms(const meniscus_atoms* atoms);

/// The sRGB colour of surfaces and meshes for which the caller gives no colour.
inline constexpr glm::vec3 kPlainColor(0.75f, 0.82f, 0.9f);

/// Returns the colours of atoms: of_atoms has three channels per atom; if it is NULL, all atoms have `color`. Refuses
/// channels outside of [0, 1] with MENISCUS_INPUT.
Coloring coloring_of(const glm::vec3& color, const float* of_atoms, std::size_t atoms);

}  // namespace meniscus::c_api
