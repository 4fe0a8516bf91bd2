// SPDX-License-Identifier: BSD-3-Clause
// Serves one surface over a socket, in the protocol between VMD and MSMS.
#pragma once

#include <cstdint>

#include "app/msms/arguments.h"

namespace meniscus::msms {

/// Listens only on 127.0.0.1, greets the first client, reads probe, density and spheres in the machine's own byte
/// order, and answers with triangles, vertices and the sphere of each vertex, of component 0. Ends after one client, or
/// when none comes. Throws UsageError if the port is not available; InputError if no client comes in time, or if a
/// client disconnects, is silent too long, or sends invalid spheres; and the errors of ChosenSurface.
void serve(std::uint16_t port);

}  // namespace meniscus::msms
