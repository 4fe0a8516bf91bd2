// SPDX-License-Identifier: BSD-3-Clause
// The look of pictures as JSON, for the command "look" and the state.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "app/preview/command_reader.h"
#include "core/render/look_presets.h"

namespace meniscus {

/// The keys of the command "look".
std::span<const std::string_view> look_keys();

/// `look` with what the command says changed; the background is not part of it. Throws RequestError.
LookRequest changed_look(LookRequest look, const CommandReader& command);

/// "background" of the command, if it has one. Throws RequestError.
glm::vec3 changed_background(const glm::vec3& background, const CommandReader& command);

/// Every key with its value.
nlohmann::json look_json(const Look& look);

/// The same without what takes time.
Look without_effects(Look look);

}  // namespace meniscus
