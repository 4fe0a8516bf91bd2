// SPDX-License-Identifier: BSD-3-Clause
// Formats a colour key as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/color/color_key.h"

namespace meniscus {

/// Returns title, and unit, map, range, missing, missing_color or classes; and others, each in the same form.
nlohmann::ordered_json color_key_json(const ColorKey& key);

}  // namespace meniscus
