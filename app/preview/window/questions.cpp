// SPDX-License-Identifier: BSD-3-Clause
// Each question has one command under way at a time.
#include "app/preview/window/questions.h"

#include <algorithm>
#include <cmath>

#include "app/preview/command_json.h"

namespace meniscus {
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
