// SPDX-License-Identifier: BSD-3-Clause
// sRGB as an ICC profile, for formats that tell colour spaces by one.
#pragma once

#include <cstdint>
#include <vector>

namespace meniscus {

/// A display profile of version 4.3 (ISO 15076-1:2010): the primaries of IEC 61966-2-1 adapted to D50 (Bradford) and
/// its transfer function as a parametric curve. The same bytes each time.
const std::vector<std::uint8_t>& srgb_profile();

}  // namespace meniscus
