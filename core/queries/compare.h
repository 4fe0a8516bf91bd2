// SPDX-License-Identifier: BSD-3-Clause
// Compares two surfaces of the same atoms, primitive by primitive.
#pragma once

#include <string>
#include <vector>

namespace meniscus {

struct Surface;

/// Every difference in one sentence each: patches that only one of them has, other contacts, cuts, borders, faces or
/// components, positions further apart than 1e-9 Å, areas and volumes by more than 1e-9 of their size. Empty: equal.
std::vector<std::string> differences(const Surface& a, const Surface& b);

}  // namespace meniscus
