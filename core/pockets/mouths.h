// SPDX-License-Identifier: BSD-3-Clause
// The openings of a pocket: where its surface belongs to large probes.
#pragma once

#include <cstdint>
#include <vector>

namespace meniscus {

struct Surface;

/// The areas of a pocket's mouths, Å², the largest first.
/// pocket: its closed surface; is_probe: one per Surface::atoms, whether it is a large probe. A mouth is a set of large
/// probes whose patches share borders, each patch touching none but large probes; its area is what of the surface is
/// nearer to a contact with them than with an atom (AtomAreas::surface). Left out are mouths in which patches that
/// touch large probes alone have no more than `least` (Å²). Throws OpenSurfaceError.
std::vector<double> mouth_areas(const Surface& pocket, const std::vector<bool>& is_probe, double least);

}  // namespace meniscus
