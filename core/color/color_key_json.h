// SPDX-License-Identifier: BSD-3-Clause
// The meaning of colours as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/color/color_key.h"

namespace meniscus {

/// title, and unit, map, range, missing, missing_color or classes; others, each the same.
nlohmann::ordered_json color_key_json(const ColorKey& key);

}  // namespace meniscus
