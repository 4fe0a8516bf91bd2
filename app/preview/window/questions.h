// SPDX-License-Identifier: BSD-3-Clause
// Questions to the session that the window repeats until all of the answer is known: what is here, how far an export
// is.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/window/session_link.h"

namespace meniscus {

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
