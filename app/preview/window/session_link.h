// SPDX-License-Identifier: BSD-3-Clause
// The session of a window: on a thread of its own, with commands that wait for replies and questions that are repeated
// until answered.
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
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
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
  std::string stage;                   ///< what is done before there is a state
  std::string fault;                   ///< why this view could not be drawn; empty if it was
  std::optional<double> busy_seconds;  ///< how long it has been working by now
  bool quit = false;
};

/// Commands go in, replies and pictures come out. All functions are for one other thread, the one of the window.
class SessionThread {
 public:
  using Make = std::function<std::unique_ptr<PreviewSession>(const EglContext& context,
                                                             const std::function<void(const std::string&)>& tell)>;

  /// make: called on the thread with the context that is current there, which is beside `sibling` and stays; it tells
  /// what it is doing, such as "Reading 1tii.pdb". wake:
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
  void publish(const LiveView& view);

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

/// Every command of the window goes through here. Until the session has said what its state is, there
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
  const nlohmann::json& state() const { return state_; }

 private:
  bool running_ = false;
  std::uint64_t number_ = 0;  // of the question that is under way; 0: none
  double due_ = 0.0;
  nlohmann::json state_;
};

}  // namespace meniscus
