// SPDX-License-Identifier: BSD-3-Clause
// All commands that wait are carried out, then one draft is drawn; better pictures when nothing moves for a while.
#include "app/preview/window/session_thread.h"

#include <algorithm>
#include <utility>

#include "app/preview/window/command_word.h"
#include "core/base/error.h"
#include "core/gpu/context_description.h"

namespace meniscus {
namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 60ms;  // of the mouse, until the draft gets its full size
// Until the full picture is begun; as long as it may take, for it cannot be stopped.
constexpr std::chrono::steady_clock::duration kRest = 150ms, kLongestRest = 1500ms;
constexpr auto kUnseen = 1000ms;  // how long a draft may wait to be seen

std::optional<Quality> quality_drawn(const PreviewSession& session) {
  for (const Quality quality : {Quality::full, Quality::plain, Quality::draft})
    if (session.is_drawn(quality)) return quality;
  return {};
}

}  // namespace

SessionThread::SessionThread(const ForeignContext& sibling, Make make, std::function<void()> wake)
    : wake_(std::move(wake)), last_change_(Clock::now()), rest_(kRest) {
  thread_ = std::thread([this, sibling, make = std::move(make)] { run(sibling, make); });
}

SessionThread::~SessionThread() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  posted_.notify_one();
  thread_.join();
}

std::uint64_t SessionThread::post(nlohmann::json command) {
  const std::scoped_lock lock(mutex_);
  queue_.push_back({++last_number_, std::move(command), {}});
  posted_.notify_one();
  return last_number_;
}

void SessionThread::presented(std::uint64_t number) {
  const std::scoped_lock lock(mutex_);
  presented_ = number;
  posted_.notify_one();
}

SessionNews SessionThread::take_news() {
  const std::scoped_lock lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  SessionNews news = news_;
  news_.replies.clear();
  news_.state = news_.stats = nullptr;
  if (busy_since_) news.busy_seconds = std::chrono::duration<double>(Clock::now() - *busy_since_).count();
  news.at_rest &= queue_.empty() && !busy_since_;
  return news;
}

void SessionThread::run(const ForeignContext& sibling, const Make& make) {
  {
    const std::scoped_lock lock(mutex_);
    busy_since_ = Clock::now();
  }
  try {
    const EglContext context(sibling);
    const std::unique_ptr<PreviewSession> session = make();
    work(*session);
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    failure_ = std::current_exception();
  }
  wake_();
}

void SessionThread::work(PreviewSession& session) {
  for (;;) {
    for (SessionReply& command : next_commands(session)) {
      carry_out(session, command);
      const std::scoped_lock lock(mutex_);
      news_.replies.push_back(std::move(command));
      news_.quit |= session.wants_to_quit();
    }
    {
      const std::scoped_lock lock(mutex_);
      if (stop_) return;  // what was asked for is done
    }
    draw(session);
  }
}

std::deque<SessionReply> SessionThread::next_commands(const PreviewSession& session) {
  const std::optional<Quality> drawn = quality_drawn(session);
  const bool done = drawn == Quality::full || !trouble_.empty() || (drawn && session.playing());
  std::unique_lock lock(mutex_);
  busy_since_.reset();
  wanted_ = Quality::draft;
  if (done)
    posted_.wait(lock, [&] { return stop_ || !queue_.empty(); });
  else if (drawn && rests(lock, drawn == Quality::draft ? kPause : rest_))
    wanted_ = drawn == Quality::draft ? Quality::plain : Quality::full;
  busy_since_ = Clock::now();
  return std::exchange(queue_, {});
}

/// True when the picture has been in the window for a while and nothing came; false as soon as something comes.
bool SessionThread::rests(std::unique_lock<std::mutex>& lock, Clock::duration pause) {
  const auto called = [&] { return stop_ || !queue_.empty(); };
  const auto seen = [&] { return called() || presented_ >= done_; };
  posted_.wait_until(lock, last_change_ + kUnseen, seen);  // windows that are minimised never say so
  return !posted_.wait_until(lock, Clock::now() + pause, called);
}

void SessionThread::carry_out(PreviewSession& session, SessionReply& command) {
  const std::uint64_t before = session.revision();
  command.reply = session.apply(command.command);
  done_ = command.number;
  if (session.revision() == before) return;
  trouble_.clear();
  last_change_ = Clock::now();
}

/// Does a command wait that will change the view, or is it all over?
bool SessionThread::something_new_waits() {
  const std::scoped_lock lock(mutex_);
  return stop_ || std::ranges::any_of(queue_, [](const SessionReply& waiting) {
           return !is_question(waiting.command) && command_word(waiting.command) != "export";
         });
}

void SessionThread::draw(PreviewSession& session) {
  const std::optional<Quality> drawn = quality_drawn(session);
  if (trouble_.empty() && (!drawn || *drawn < wanted_)) {
    try {
      const Clock::time_point begin = Clock::now();
      const bool whole = session.render(wanted_, [this] { return something_new_waits(); });
      require_living_context();
      if (!whole) return;
      pictures_.offer(session.texture(), session.picture_size());
      if (wanted_ == Quality::full) rest_ = std::clamp(Clock::now() - begin, kRest, kLongestRest);
    } catch (const CapacityError& error) {
      trouble_ = error.what();
    } catch (const OpenSurfaceError& error) {
      trouble_ = error.what();
    }
  }
  tell(session, session.is_drawn(Quality::full));
}

void SessionThread::tell(PreviewSession& session, bool full) {
  nlohmann::json state = session.apply({{"command", "state"}}), stats = session.apply({{"command", "stats"}});
  {
    const std::scoped_lock lock(mutex_);
    news_.state = std::move(state);
    news_.stats = std::move(stats);
    news_.shown = done_;
    news_.full = full;
    news_.at_rest = full || !trouble_.empty();
    news_.trouble = trouble_;
  }
  wake_();
}

}  // namespace meniscus
