// SPDX-License-Identifier: BSD-3-Clause
// The time that files bear which must have one.
#pragma once

#include <ctime>

namespace meniscus {

/// That of SOURCE_DATE_EPOCH (reproducible-builds.org), or else the first second of 1970: the same command gives the
/// same bytes.
std::time_t source_date();

}  // namespace meniscus
