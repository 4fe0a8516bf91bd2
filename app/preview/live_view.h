// SPDX-License-Identifier: BSD-3-Clause
// A session that is looked at while it changes: a draft at once, better pictures when nothing moves.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "app/preview/command_json.h"
#include "app/preview/session.h"

namespace meniscus {

/// When which picture of a session is due, for the window and the page alike. One thread, that of the session.
class LiveView {
 public:
  using Clock = std::chrono::steady_clock;

  /// The session lives longer.
  explicit LiveView(PreviewSession& session);

  PreviewSession& session() const { return session_; }

  /// Carries a command out; its reply.
  nlohmann::json apply(const nlohmann::json& command);

  /// Draws the view in this quality. waiting: the most that a command which waits will change. A draft goes on whatever
  /// moves, or nothing would be seen of a long drag, and is given up late, for another surface only; better pictures
  /// for any change. False: it was given up, or it cannot be drawn (fault). Throws GpuError.
  bool draw(Quality quality, const std::function<Change()>& waiting);

  /// The best picture that there is of the view; nothing: none yet.
  std::optional<Quality> drawn() const;
  /// The next better one that is worth drawing. Nothing: this is the best, none can be drawn, or the next frame of a
  /// trajectory that plays will replace it.
  std::optional<Quality> next() const;
  /// Without a change for so long a picture of this quality is begun. A full one is rested for as long as it may take,
  /// for it stops between samples only.
  Clock::duration rest(Quality quality) const;
  /// The quality of the first picture after a change: a draft, but of a trajectory that plays the full size once a
  /// picture of it has turned out to be made before the next frame is due.
  Quality at_once() const;
  /// The quality that is due at this time, as the view has rested since its last change.
  Quality due(Clock::time_point now) const;
  Clock::time_point last_change() const { return last_change_; }

  /// Why there is no picture of this view; empty if there is, or may be.
  const std::string& fault() const { return fault_; }

 private:
  void note_change();

  PreviewSession& session_;
  std::uint64_t seen_revision_;
  Clock::time_point last_change_;
  Clock::duration rest_;
  std::optional<Clock::duration> draft_cost_, plain_cost_;  ///< of the last picture since the trajectory plays
  std::string fault_;
};

}  // namespace meniscus
