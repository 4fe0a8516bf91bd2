// SPDX-License-Identifier: BSD-3-Clause
// What a table of pockets does not show by itself: ligands that lie in none, and chains that fill some.
#pragma once

#include <string>
#include <vector>

#include "app/reports/pocket_report.h"

namespace meniscus {

/// Sentences that say what to try next; none where there is nothing to say.
std::vector<std::string> pocket_hints(const PocketReport& report);

}  // namespace meniscus
