// SPDX-License-Identifier: BSD-3-Clause
// All commands that wait are carried out, then one draft is drawn; better pictures when nothing moves for a while.
#include "app/preview/window/session_thread.h"

#include <algorithm>
#include <utility>

#include "app/preview/command_json.h"

namespace meniscus {
namespace {

using namespace std::chrono_literals;

constexpr auto kUnseen = 1000ms;  // how long a draft may wait to be seen

}  // namespace

SessionThread::SessionThread(const ForeignContext& sibling, Make make, std::function<void()> wake)
    : wake_(std::move(wake)) {
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
  ++last_number_;
  // While a picture is made, movements become one; questions are told apart by their numbers.
  if (!queue_.empty() && !is_question(command) && merge_commands(queue_.back().command, command))
    queue_.back().number = last_number_;
  else
    queue_.push_back({last_number_, std::move(command), {}});
  posted_.notify_one();
  return last_number_;
}

void SessionThread::presented(std::uint64_t number) {
  const std::scoped_lock lock(mutex_);
  presented_ = number;
  posted_.notify_one();
}

SessionUpdate SessionThread::take_update() {
  const std::scoped_lock lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  SessionUpdate news = news_;
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
    const std::unique_ptr<PreviewSession> session = make(context);
    work(LiveView(*session));
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    failure_ = std::current_exception();
  }
  wake_();
}

void SessionThread::work(LiveView view) {
  for (;;) {
    for (SessionReply& command : next_commands(view)) {
      command.reply = view.apply(command.command);
      done_ = command.number;
      const std::scoped_lock lock(mutex_);
      news_.replies.push_back(std::move(command));
      news_.quit |= view.session().wants_to_quit();
    }
    {
      const std::scoped_lock lock(mutex_);
      if (stop_) return;  // what was asked for is done
    }
    draw(view);
  }
}

std::deque<SessionReply> SessionThread::next_commands(const LiveView& view) {
  const std::optional<Quality> next = view.next();
  std::unique_lock lock(mutex_);
  busy_since_.reset();
  wanted_ = Quality::draft;
  if (!next)
    posted_.wait(lock, [&] { return stop_ || !queue_.empty(); });
  else if (next != Quality::draft && rests(lock, view, view.rest(*next)))
    wanted_ = *next;
  busy_since_ = Clock::now();
  return std::exchange(queue_, {});
}

/// True when the picture has been in the window for a while and nothing came; false as soon as something comes.
bool SessionThread::rests(std::unique_lock<std::mutex>& lock, const LiveView& view, Clock::duration pause) {
  const auto called = [&] { return stop_ || !queue_.empty(); };
  const auto seen = [&] { return called() || presented_ >= done_; };
  posted_.wait_until(lock, view.last_change() + kUnseen, seen);  // windows that are minimised never say so
  return !posted_.wait_until(lock, Clock::now() + pause, called);
}

/// The most that a waiting command will change; the end is one too.
Change SessionThread::waiting_change() {
  const std::scoped_lock lock(mutex_);
  Change most = stop_ ? Change::surface : Change::none;
  for (const SessionReply& waiting : queue_) most = std::max(most, change_of(waiting.command));
  return most;
}

void SessionThread::draw(LiveView& view) {
  const std::optional<Quality> drawn = view.drawn();
  const Quality wanted = std::max(wanted_, view.at_once());
  if (view.fault().empty() && (!drawn || *drawn < wanted)) {
    if (view.draw(wanted, [this] { return waiting_change(); }))
      offer(view.session());
    else if (view.fault().empty())
      return;  // given up for what is new
  }
  tell(view);
}

void SessionThread::offer(const PreviewSession& session) {
  if (session.texture())
    pictures_.offer(session.texture(), session.picture_size());
  else
    pictures_.offer(session.rgba(), session.picture_size());
}

void SessionThread::tell(const LiveView& view) {
  PreviewSession& session = view.session();
  nlohmann::json state = session.apply({{"command", "state"}}), stats = session.apply({{"command", "stats"}});
  const bool full = session.is_drawn(Quality::full);
  {
    const std::scoped_lock lock(mutex_);
    if (news_.choices.is_null()) news_.choices = session.apply({{"command", "choices"}});
    news_.state = std::move(state);
    news_.stats = std::move(stats);
    news_.shown = done_;
    news_.full = full;
    news_.at_rest = full || !view.fault().empty();
    news_.fault = view.fault();
  }
  wake_();
}

}  // namespace meniscus
