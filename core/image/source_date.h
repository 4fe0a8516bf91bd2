// SPDX-License-Identifier: BSD-3-Clause
// The time that files bear.
#pragma once

#include <ctime>

namespace meniscus {

/// That of SOURCE_DATE_EPOCH (reproducible-builds.org), or else 0: the same command gives the same bytes.
std::time_t source_date();

}  // namespace meniscus
