// SPDX-License-Identifier: BSD-3-Clause
// Runs the session on its thread, passes commands and replies on, and repeats questions until they are answered.
#include "app/preview/window/session_link.h"

#include <algorithm>
#include <cmath>
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
  // While a picture is made, movements become one; questions are distinguished by their numbers.
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
    const std::unique_ptr<PreviewSession> session = make(context, [this](const std::string& stage) {
      {
        const std::scoped_lock lock(mutex_);
        news_.stage = stage;
      }
      wake_();
    });
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
  else if (*next > Quality::draft && rests(lock, view, view.rest(*next)))
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
  const Quality first = view.at_once(), wanted = first == Quality::balls ? first : std::max(wanted_, first);
  if (view.fault().empty() && (!drawn || *drawn < wanted)) {
    if (view.draw(wanted, [this] { return waiting_change(); }))
      offer(view.session());
    else if (view.fault().empty())
      return;  // given up for what is new
  }
  publish(view);
}

void SessionThread::offer(const PreviewSession& session) {
  if (session.texture())
    pictures_.offer(session.texture(), session.picture_size());
  else
    pictures_.offer(session.rgba(), session.picture_size());
}

void SessionThread::publish(const LiveView& view) {
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

std::uint64_t SessionLink::send(const nlohmann::json& command) {
  if (has_state()) predict(command, state_);
  const std::string word = command_word(command);
  if (!is_question(command) && word != "undo" && word != "redo") {
    constexpr std::chrono::milliseconds kStep(700);  // what comes later is a step of its own for undo
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ > kStep) replay({{"command", "end_step"}});
    last_ = now;
  }
  return replay(command);
}

std::uint64_t SessionLink::replay(const nlohmann::json& command) {
  sent_ = thread_.post(command);
  if (observer_) observer_(sent_, command);
  return sent_;
}

bool SessionLink::update() {
  const std::uint64_t shown_before = news_.shown;
  news_ = thread_.take_update();
  const bool news = !news_.state.is_null() || !news_.replies.empty() || news_.shown != shown_before;
  if (!news_.stats.is_null()) stats_ = news_.stats;
  // A state from before the last command would move the slider under the user's hand.
  if (!news_.state.is_null() && news_.shown >= sent_) state_ = news_.state;
  return news;
}

void predict(const nlohmann::json& command, nlohmann::json& state) {
  const std::string word = command_word(command);
  if (word == "surface") state["surface"] = command["kind"];
  if (word == "probe") state["probe_radius"] = command["radius"];
  if (word == "projection") state["camera"]["projection"] = command["projection"];
  if (word == "patch_kinds") state["patch_kinds"] = command["on"];
  if (word == "frame") state["frame"] = command["index"];
  if (word == "play" || word == "pause") state["playing"] = word == "play";
  if (word == "play" && command.contains("fps")) state["fps"] = command["fps"];
  if (word == "samples") state["samples"] = command["count"];
  if (word == "color" || word == "look") {
    nlohmann::json& part = state[word];
    if (word == "color") part = nlohmann::json::object();  // a scheme comes with its own map
    for (const auto& [key, value] : command.items())
      if (key != "command") part[key] = value;
  }
}

namespace {

constexpr double kAskAgain = 0.3;  // seconds

}  // namespace

nlohmann::json atom_question(glm::dvec2 place, bool with_area, const nlohmann::json& state) {
  const auto pixel = [&](double x, const char* side) {
    return std::clamp(static_cast<int>(std::floor(x)), 0, state[side].get<int>() - 1);
  };
  return {{"command", "pick"},
          {"x", pixel(place.x, "width")},
          {"y", pixel(place.y, "height")},
          {"wait", false},
          {"area", with_area}};
}

void AtomQuestion::ask_at(glm::dvec2 place, double time) {
  forget();
  place_ = place;
  due_ = time;
}

void AtomQuestion::forget() {
  place_.reset();
  number_ = 0;
  answer_ = nullptr;
}

std::optional<double> AtomQuestion::advance(SessionLink& link, double time) {
  if (!place_ || number_ != 0) return {};
  if (time < due_) return due_ - time;
  number_ = link.send(atom_question(*place_, with_area_, link.state()));
  return {};
}

bool AtomQuestion::take(const SessionReply& reply, double time) {
  if (number_ == 0 || reply.number != number_) return false;
  number_ = 0;
  answer_ = reply.reply;
  if (!with_area_ || !answer_.value("area_follows", false)) place_.reset();
  due_ = time + kAskAgain;
  return true;
}

bool ExportQuestion::take(const SessionReply& reply, double time) {
  const std::string word = command_word(reply.command);
  if (word != "export_state" && !(word == "export" && reply.reply.value("running", false))) return false;
  number_ = 0;
  due_ = time + kAskAgain;
  running_ = reply.reply.value("running", false);
  state_ = reply.reply;
  return true;
}

std::optional<double> ExportQuestion::advance(SessionLink& link, double time) {
  if (!running_ || number_ != 0) return {};
  if (time < due_) return due_ - time;
  number_ = link.send({{"command", "export_state"}});
  return {};
}

}  // namespace meniscus
