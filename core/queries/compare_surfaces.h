// SPDX-License-Identifier: BSD-3-Clause
// Compares two surfaces of the same atoms, primitive by primitive.
#pragma once

#include <string>
#include <vector>

namespace meniscus {

struct Surface;

/// Returns each difference in one sentence: patches that only one surface has; different contacts, cuts, borders, faces
/// or components; positions more than 1e-9 Å apart; areas and volumes that differ by more than 1e-9 of their size. The
/// result is empty if the surfaces are equal.
std::vector<std::string> differences(const Surface& a, const Surface& b);

}  // namespace meniscus
