// SPDX-License-Identifier: BSD-3-Clause
// Which touched atom a point of the surface belongs to: the one whose contact direction is nearest.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// A touched atom and the unit direction from the probe to its contact.
struct ContactDirection {
  std::uint32_t atom = kNone;
  glm::dvec3 direction{0.0};
};

/// The contacts of a fixed probe.
std::vector<ContactDirection> contact_directions(const Surface& surface, const ConcavePatch& patch);

/// The tube angle of a torus point: 0 faces the axis, positive towards atom[1]; x = probe + p (-cos e_rho + sin axis).
double tube_angle(const ToroidalPatch& patch, const glm::dvec3& position);
/// The tube angles of the contact circles of atom[0] and atom[1].
std::array<double, 2> contact_angles(const Surface& surface, const ToroidalPatch& patch);

/// The two contacts of a probe that rolls along a torus, at the place of this side of it.
std::vector<ContactDirection> contact_directions(const Surface& surface, const ToroidalPatch& patch,
                                                 const glm::dvec3& probe);

/// The parameters in (0, sweep) of a border of the probe's sphere where the nearest contact changes, ascending.
std::vector<double> color_changes(const std::vector<ContactDirection>& contacts, const glm::dvec3& probe,
                                  const Border& border);

}  // namespace meniscus
