// SPDX-License-Identifier: BSD-3-Clause
// A question that repeats itself as long as something is written.
#include "app/preview/window/export_question.h"

#include "app/preview/command_json.h"

namespace meniscus {
namespace {

constexpr double kAskSoon = 0.3;  // seconds

}  // namespace

bool ExportQuestion::take(const SessionReply& reply, double time) {
  const std::string word = command_word(reply.command);
  if (word != "export_state" && !(word == "export" && reply.reply.value("running", false))) return false;
  number_ = 0;
  due_ = time + kAskSoon;
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
