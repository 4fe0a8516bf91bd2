// SPDX-License-Identifier: BSD-3-Clause
// Events of the window as keys of the table that window and page share.
#pragma once

#include <nlohmann/json.hpp>

#include "app/preview/key_table.h"
#include "app/preview/window/input_event.h"

namespace meniscus {

/// What a typed letter or a pressed key means while the session has this state; nothing for all other keys.
KeyMeaning event_meaning(const InputEvent& event, const nlohmann::json& state);

}  // namespace meniscus
