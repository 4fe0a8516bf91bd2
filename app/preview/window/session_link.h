// SPDX-License-Identifier: BSD-3-Clause
// The window's side of the session: commands that wait for their replies, and questions repeated until they are
// answered.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
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

/// The command that asks what is at a place of a picture in this state, without waiting for the area.
nlohmann::json atom_question(glm::dvec2 place, bool with_area, const nlohmann::json& state);

/// Exposed areas take a while; the rest of the answer comes at once. Times: seconds on any one clock.
class AtomQuestion {
 public:
  /// with_area: until the atom's exposed area is known; else only once, and with the area if it is known anyway.
  explicit AtomQuestion(bool with_area) : with_area_(with_area) {}

  /// To be asked at `time`, in place of any question before. place: pixels of the picture.
  void ask_at(glm::dvec2 place, double time);
  /// Asks no more; what is known stays.
  void stop() { place_.reset(); }
  void forget();

  /// Asks if it is time to. Seconds until it will be; nothing: not until something else happens.
  std::optional<double> advance(SessionLink& link, double time);
  /// True if this was the answer.
  bool take(const SessionReply& reply, double time);

  /// As the command "pick" answers; null while unknown.
  const nlohmann::json& answer() const { return answer_; }

 private:
  const bool with_area_;
  std::optional<glm::dvec2> place_;
  double due_ = 0.0;
  std::uint64_t number_ = 0;  // of the question on its way; 0: none
  nlohmann::json answer_;
};

/// Of the export that is written now; times are those of the window, in seconds.
class ExportQuestion {
 public:
  /// True if the reply is one of an export: that it has begun, or how far it is.
  bool take(const SessionReply& reply, double time);
  /// Asks if that is due; seconds until it will be, or nothing if nothing is written.
  std::optional<double> advance(SessionLink& link, double time);

  bool running() const { return running_; }
  /// The latest answer of "export_state"; null before the first.
  const nlohmann::json& told() const { return told_; }

 private:
  bool running_ = false;
  std::uint64_t number_ = 0;  // of the question that is under way; 0: none
  double due_ = 0.0;
  nlohmann::json told_;
};

}  // namespace meniscus
