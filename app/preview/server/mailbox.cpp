// SPDX-License-Identifier: BSD-3-Clause
// Merging and handing over commands.
#include "app/preview/server/mailbox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "app/preview/command_json.h"
#include "core/base/error.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostWaiting = 256;

bool is_one_of(std::span<const std::string_view> words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

bool are_numbers(const nlohmann::json& a, const nlohmann::json& b, const char* key) {
  return a.contains(key) && b.contains(key) && a[key].is_number() && b[key].is_number();
}

}  // namespace

bool merge_commands(nlohmann::json& first, const nlohmann::json& second) {
  constexpr std::array<std::string_view, 2> kDrags{"orbit", "pan"};
  constexpr std::array<std::string_view, 6> kLatest{"probe", "frame", "resize", "pick", "samples", "look"};
  if (!first.is_object() || !second.is_object() || first.size() != second.size()) return false;
  if (!first.contains("command") || !first["command"].is_string() ||
      first["command"] != second.value("command", nlohmann::json()))
    return false;
  const std::string word = first["command"];
  if (is_one_of(kDrags, word) && first.size() == 3 && are_numbers(first, second, "dx") &&
      are_numbers(first, second, "dy")) {
    const auto sum = [&](const char* key) { return first[key].get<double>() + second[key].get<double>(); };
    const double dx = sum("dx"), dy = sum("dy");
    if (!std::isfinite(dx) || !std::isfinite(dy)) return false;  // no number of JSON
    first["dx"] = dx;
    first["dy"] = dy;
    return true;
  }
  if (word == "zoom" && first.size() == 2 && are_numbers(first, second, "factor")) {
    const double factor = first["factor"].get<double>() * second["factor"].get<double>();
    if (std::isfinite(factor)) first["factor"] = factor;
    return std::isfinite(factor);
  }
  // A pick that is waited for is a click, and each click counts.
  const auto waits = [](const nlohmann::json& pick) { return !pick.contains("wait") || pick["wait"] != false; };
  if (!is_one_of(kLatest, word) || (word == "pick" && (waits(first) || waits(second)))) return false;
  if (std::ranges::any_of(first.items(), [&](const auto& item) { return !second.contains(item.key()); })) return false;
  first = second;
  return true;
}

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

bool Mailbox::has_changes() {
  const std::lock_guard lock(mutex_);
  return !std::ranges::all_of(content_.commands, is_question, &ClientCommand::command);
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
