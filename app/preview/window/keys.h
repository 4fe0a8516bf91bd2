// SPDX-License-Identifier: BSD-3-Clause
// The keys of the preview, as a table that the help shows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/preview/window/input_event.h"

namespace meniscus {

/// What a key does to the window alone.
enum class WindowAction { help, panel, export_name, leave };

/// A row of the help: keys or mouse, and what they do.
struct KeyHelp {
  const char* keys;
  const char* what;
};
std::span<const KeyHelp> key_help();

struct KeyMeaning {
  std::optional<nlohmann::json> command;
  std::optional<WindowAction> action;
};

/// What a typed letter or a pressed key means while the session has this state; nothing for all other keys.
KeyMeaning key_meaning(const InputEvent& event, const nlohmann::json& state);

/// The colour schemes a preview offers, in the order of the keys 1, 2, 3, ...: those that need no file of numbers.
const std::vector<std::string>& offered_schemes();

}  // namespace meniscus
