// SPDX-License-Identifier: BSD-3-Clause
// Prediction: a switch moves when it is clicked, though the picture may take a while.
#include "app/preview/window/session_link.h"

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

}  // namespace meniscus
