// SPDX-License-Identifier: BSD-3-Clause
// Sends commands, hands on replies, and asks again what is not known yet.
#include "app/preview/window/session_link.h"

#include <algorithm>
#include <cmath>

#include "app/preview/command_json.h"

namespace meniscus {

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
  told_ = reply.reply;
  return true;
}

std::optional<double> ExportQuestion::advance(SessionLink& link, double time) {
  if (!running_ || number_ != 0) return {};
  if (time < due_) return due_ - time;
  number_ = link.send({{"command", "export_state"}});
  return {};
}

}  // namespace meniscus
