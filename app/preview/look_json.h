// SPDX-License-Identifier: BSD-3-Clause
// The look of pictures as JSON, for the state.
#pragma once

#include <nlohmann/json.hpp>

#include "core/render/look.h"

namespace meniscus {

/// Every key with its value.
nlohmann::json look_json(Look look);

/// A look without the effects that take time.
Look without_effects(Look look);

}  // namespace meniscus
