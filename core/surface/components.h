// SPDX-License-Identifier: BSD-3-Clause
// The connected components of a surface and their Euler characteristics, from its faces and borders.
#pragma once

namespace meniscus {

struct Surface;

/// Fills in Face::component, Component::euler and as many components as there are, in the order of their first faces.
/// Two faces are connected where they share a border; a border with one face or none connects nothing. Returns whether
/// each border has two.
bool connect_components(Surface& surface);

}  // namespace meniscus
