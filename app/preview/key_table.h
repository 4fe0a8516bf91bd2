// SPDX-License-Identifier: BSD-3-Clause
// The keys of a preview and what they mean.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace meniscus {

/// The actions of keys that change the page and not the figure.
enum class FaceAction { help, panel, export_name };

/// Returns "help", "panel" or "export".
std::string_view face_action_word(FaceAction action);

/// A row of the help: keys or mouse, and what they do.
struct KeyHelp {
  const char* keys;
  const char* what;
};
std::span<const KeyHelp> key_help();

/// A key as key_meaning() takes it, in small letters, and what it does to the page whatever the state.
struct FaceKey {
  std::string_view key;
  FaceAction action;
};
std::span<const FaceKey> face_keys();

struct KeyMeaning {
  std::optional<nlohmann::json> command;
  std::optional<FaceAction> action;
};

/// What a key means while the session has this state (the reply to "state"); nothing for all other keys. typed: the
/// letter, great or small, or "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", as browsers call them.
KeyMeaning key_meaning(std::string_view typed, const nlohmann::json& state);

/// The colour schemes of the keys 1, 2, 3, ...: those that every molecule has.
const std::vector<std::string>& numbered_schemes();

}  // namespace meniscus
