// SPDX-License-Identifier: BSD-3-Clause
// What the window knows of its session: commands sent, the state as it will be once they are done, answers.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/preview/window/session_thread.h"

namespace meniscus {

/// Every command of the window goes through here. Until the session has said how it stands, there
/// is no state.
class SessionLink {
 public:
  using Observer = std::function<void(std::uint64_t number, const nlohmann::json& command)>;

  /// sent: called with every command.
  explicit SessionLink(SessionThread& thread, Observer sent = {}) : thread_(thread), observer_(std::move(sent)) {}

  /// The number of the command.
  std::uint64_t send(const nlohmann::json& command);
  /// The same for a command that may be wrong in any way.
  std::uint64_t replay(const nlohmann::json& command);
  /// Takes the news; true if there is something new to see. Throws what ended the session.
  bool update();

  bool has_state() const { return state_.is_object(); }
  /// As the command "state" answers it, with what was sent since already in it.
  const nlohmann::json& state() const { return state_; }
  /// As the command "choices" answers it.
  const nlohmann::json& choices() const { return news_.choices; }
  /// Of the last picture; null before the first.
  const nlohmann::json& stats() const { return stats_; }
  /// Answers that came with the last update.
  const std::vector<SessionReply>& replies() const { return news_.replies; }
  const SessionUpdate& news() const { return news_; }

  /// True when all that was sent is done and drawn, if only as a draft.
  bool settled() const { return news_.shown >= sent_ && has_state(); }
  SharedPicture picture() { return thread_.picture(); }
  /// The window now shows all commands up to this number.
  void presented(std::uint64_t number) { thread_.presented(number); }

 private:
  SessionThread& thread_;
  Observer observer_;
  SessionUpdate news_;
  nlohmann::json state_, stats_;
  std::uint64_t sent_ = 0;
  std::chrono::steady_clock::time_point last_{};  ///< when something was sent that undo takes back
};

/// The state after a command that is right, as far as a window can tell: switches, sliders and frames.
void predict(const nlohmann::json& command, nlohmann::json& state);

}  // namespace meniscus
