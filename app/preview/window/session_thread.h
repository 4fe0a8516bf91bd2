// SPDX-License-Identifier: BSD-3-Clause
// The session on a thread of its own, so that a long frame never freezes the window.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/preview/session.h"
#include "app/preview/window/pictures.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

/// What became of a command.
struct SessionReply {
  std::uint64_t number = 0;  ///< as post() gave it
  nlohmann::json command, reply;
};

/// What happened since the last look.
struct SessionUpdate {
  std::vector<SessionReply> replies;
  std::uint64_t shown = 0;             ///< the picture to be had shows all commands up to this number
  bool full = false;                   ///< and it is not a draft
  bool at_rest = false;                ///< every command is done, and the full picture is drawn
  nlohmann::json state, stats;         ///< replies of the session to these words; null when nothing changed
  nlohmann::json choices;              ///< likewise; null before the first state
  std::string fault;                   ///< why there is no picture of this view; empty if there is
  std::optional<double> busy_seconds;  ///< how long it has been working by now
  bool quit = false;
};

/// Commands go in, replies and pictures come out. All functions are for one other thread, the one of the window.
class SessionThread {
 public:
  using Make = std::function<std::unique_ptr<PreviewSession>(const EglContext& context)>;

  /// make: called on the thread with the context that is current there, which is beside `sibling` and stays. wake:
  /// called from the thread when there are news.
  SessionThread(const ForeignContext& sibling, Make make, std::function<void()> wake);
  /// Waits for the frame at hand, and for commands that were posted.
  ~SessionThread();

  /// Queues a command; its number.
  std::uint64_t post(nlohmann::json command);
  /// Throws what ended the thread, if something did.
  SessionUpdate take_update();
  SharedPicture picture() { return pictures_.newest(); }
  /// The window now shows all commands up to this number. A full picture is made some time after its draft was seen.
  void presented(std::uint64_t number);

 private:
  using Clock = LiveView::Clock;

  void run(const ForeignContext& sibling, const Make& make);
  void work(LiveView view);
  std::deque<SessionReply> next_commands(const LiveView& view);
  bool rests(std::unique_lock<std::mutex>& lock, const LiveView& view, Clock::duration pause);
  Change waiting_change();
  void draw(LiveView& view);
  void offer(const PreviewSession& session);
  void tell(const LiveView& view);

  std::function<void()> wake_;
  PictureExchange pictures_;
  std::mutex mutex_;  // guards all below, up to done_
  std::condition_variable posted_;
  std::deque<SessionReply> queue_;
  std::uint64_t last_number_ = 0;
  SessionUpdate news_;
  std::exception_ptr failure_;
  std::optional<Clock::time_point> busy_since_;
  std::uint64_t presented_ = 0;  // number of the last command in the picture that is in the window
  bool stop_ = false;

  std::uint64_t done_ = 0;  // of the thread alone
  Quality wanted_ = Quality::draft;
  std::thread thread_;
};

}  // namespace meniscus
