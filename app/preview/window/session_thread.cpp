// SPDX-License-Identifier: BSD-3-Clause
// All commands that wait are carried out, then one draft is drawn; the full picture when nothing has moved for a while.
#include "app/preview/window/session_thread.h"

#include <utility>

#include "core/base/error.h"
#include "core/gpu/context_description.h"

namespace meniscus {
namespace {

using namespace std::chrono_literals;

constexpr auto kRest = 150ms;     // people pause for less between two parts of one movement
constexpr auto kUnseen = 1000ms;  // how long a draft may wait to be seen

/// Words that look, and leave the picture as it is.
bool only_asks(const nlohmann::json& command) {
  const std::string word = command.value("command", "");
  return word == "pick" || word == "state" || word == "stats" || word == "export";
}

}  // namespace

SessionThread::SessionThread(const ForeignContext& sibling, Make make, std::function<void()> wake)
    : wake_(std::move(wake)), last_change_(Clock::now()) {
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
    std::deque<SessionReply> commands = next_commands(session);
    {
      const std::scoped_lock lock(mutex_);
      if (stop_) return;
    }
    for (SessionReply& command : commands) {
      carry_out(session, command);
      const std::scoped_lock lock(mutex_);
      news_.replies.push_back(std::move(command));
      news_.quit |= session.wants_to_quit();
    }
    draw(session);
  }
}

std::deque<SessionReply> SessionThread::next_commands(const PreviewSession& session) {
  const bool draft = session.is_drawn(Quality::draft), full = session.is_drawn(Quality::full);
  const bool done = full || !trouble_.empty() || (draft && session.playing());
  std::unique_lock lock(mutex_);
  busy_since_.reset();
  if (done)
    posted_.wait(lock, [&] { return stop_ || !queue_.empty(); });
  else if (draft)
    at_rest_ = wait_for_rest(lock);
  busy_since_ = Clock::now();
  return std::exchange(queue_, {});
}

/// True when the draft has been in the window for a while and nothing came; false as soon as something comes.
bool SessionThread::wait_for_rest(std::unique_lock<std::mutex>& lock) {
  const auto called = [&] { return stop_ || !queue_.empty(); };
  const auto seen = [&] { return called() || presented_ >= done_; };
  posted_.wait_until(lock, last_change_ + kUnseen, seen);  // windows that are minimised never say so
  return !posted_.wait_until(lock, Clock::now() + kRest, called);
}

void SessionThread::carry_out(PreviewSession& session, SessionReply& command) {
  command.reply = session.apply(command.command);
  done_ = command.number;
  if (only_asks(command.command)) return;
  trouble_.clear();
  last_change_ = Clock::now();
  at_rest_ = false;
}

void SessionThread::draw(PreviewSession& session) {
  bool full = session.is_drawn(Quality::full);
  if (trouble_.empty() && !full) {
    full = std::exchange(at_rest_, false);
    const Quality quality = full ? Quality::full : Quality::draft;
    try {
      if (!session.is_drawn(quality)) {
        session.render(quality);
        require_living_context();
        pictures_.offer(session.texture(), session.picture_size());
      }
    } catch (const CapacityError& error) {
      trouble_ = error.what();
    } catch (const OpenSurfaceError& error) {
      trouble_ = error.what();
    }
  }
  tell(session, full);
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
