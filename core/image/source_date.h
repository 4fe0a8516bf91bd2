// SPDX-License-Identifier: BSD-3-Clause
// The time that is written into files.
#pragma once

#include <ctime>

namespace meniscus {

/// Returns the time in SOURCE_DATE_EPOCH (reproducible-builds.org), or 0, so that a command always writes the same
/// bytes.
std::time_t source_date();

}  // namespace meniscus
