// SPDX-License-Identifier: BSD-3-Clause
// What lies over the picture: the help, and a note beside the mouse.
#pragma once

#include <nlohmann/json.hpp>

namespace meniscus {

/// All keys and gestures, in the middle of the window. em: height of a letter.
void draw_help(float em);

/// What the mouse points at, as the command "pick" answers; nothing for null or a miss.
void draw_answer(const nlohmann::json& pick);

}  // namespace meniscus
