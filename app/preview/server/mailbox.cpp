// SPDX-License-Identifier: BSD-3-Clause
// Handing over commands.
#include "app/preview/server/mailbox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "app/preview/command_json.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostWaiting = 256;

}  // namespace

bool Mailbox::put(ClientNumber client, const nlohmann::json& id, nlohmann::json command) {
  const std::lock_guard lock(mutex_);
  auto& waiting = content_.commands;
  if (!waiting.empty() && waiting.back().client == client && waiting.back().ids.size() < kMostWaiting &&
      merge_commands(waiting.back().command, command)) {
    waiting.back().ids.push_back(id);
  } else {
    if (waiting.size() >= kMostWaiting) return false;
    waiting.push_back({client, std::move(command), {id}});
  }
  news_ = true;
  arrived_.notify_one();
  return true;
}

Change Mailbox::waiting_change() {
  const std::lock_guard lock(mutex_);
  Change most = Change::none;
  for (const ClientCommand& waiting : content_.commands) most = std::max(most, change_of(waiting.command));
  return most;
}

void Mailbox::want_picture(ClientNumber client) {
  const std::lock_guard lock(mutex_);
  content_.wanting.insert(client);
  news_ = true;
  arrived_.notify_one();
}

void Mailbox::forget(ClientNumber client) {
  const std::lock_guard lock(mutex_);
  content_.wanting.erase(client);
  content_.gone.insert(client);
  news_ = true;
  arrived_.notify_one();
}

void Mailbox::fail(const std::string& error) {
  const std::lock_guard lock(mutex_);
  error_ = error;
  news_ = true;
  arrived_.notify_one();
}

Mailbox::Content Mailbox::take(std::optional<std::chrono::steady_clock::time_point> until) {
  std::unique_lock lock(mutex_);
  const auto news = [this] { return news_; };
  if (until) {
    arrived_.wait_until(lock, *until, news);
  } else {
    arrived_.wait(lock, news);
  }
  if (!error_.empty()) throw Error(error_);
  news_ = false;
  return std::exchange(content_, {});
}

}  // namespace meniscus
