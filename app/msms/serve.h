// SPDX-License-Identifier: BSD-3-Clause
// Serves one surface over a socket, as VMD asks MSMS for it.
#pragma once

#include <cstdint>

#include "app/msms/arguments.h"

namespace meniscus::msms {

/// Listens on 127.0.0.1 alone, greets the first client, reads probe, density and spheres in the machine's own byte
/// order, and answers with triangles, vertices and the sphere of each vertex, of component 0. Ends after one client, or
/// when none comes. Throws UsageError: the port cannot be had; InputError: no client in time, a client that breaks off,
/// is silent too long, or sends what is not a sphere; what ChosenSurface throws.
void serve(std::uint16_t port);

}  // namespace meniscus::msms
