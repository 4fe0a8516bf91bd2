// SPDX-License-Identifier: BSD-3-Clause
// The look of pictures as JSON, for the command "look" and the state.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/preview/command_json.h"
#include "core/render/look.h"

namespace meniscus {

/// The keys of the command "look".
std::vector<std::string_view> look_keys();

/// `look` with what the command says changed; the background is not part of it. Throws RequestError.
LookRequest changed_look(LookRequest look, const CommandReader& command);

/// "background" of the command, if it has one. Throws RequestError.
glm::vec3 changed_background(const glm::vec3& background, const CommandReader& command);

/// Every key with its value.
nlohmann::json look_json(Look look);

/// The sliders that the page shows: key, label, end and help of each, in the order of the table of properties.
nlohmann::json look_sliders();

/// A look without the effects that take time.
Look without_effects(Look look);

}  // namespace meniscus
