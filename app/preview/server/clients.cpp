// SPDX-License-Identifier: BSD-3-Clause
// Admits clients by token and origin, passes control on, and keeps commands until the drawing thread takes them.
#include "app/preview/server/clients.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "core/base/error.h"

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
  wake();
  return true;
}

void Mailbox::open(OpenRequest request) {
  const std::lock_guard lock(mutex_);
  content_.opening = std::move(request);
  wake();
}

void Mailbox::wake() {
  news_ = true;
  arrived_.notify_one();
}

Change Mailbox::waiting_change() {
  const std::lock_guard lock(mutex_);
  Change most = content_.opening ? Change::surface : Change::none;
  for (const ClientCommand& waiting : content_.commands) most = std::max(most, change_of(waiting.command));
  return most;
}

void Mailbox::want_picture(ClientNumber client) {
  const std::lock_guard lock(mutex_);
  content_.wanting.insert(client);
  wake();
}

void Mailbox::want_figure(ClientNumber client, std::set<std::string> known) {
  const std::lock_guard lock(mutex_);
  content_.wanting_figure.insert_or_assign(client, std::move(known));
  wake();
}

void Mailbox::forget(ClientNumber client) {
  const std::lock_guard lock(mutex_);
  content_.wanting.erase(client);
  content_.wanting_figure.erase(client);
  content_.gone.insert(client);
  wake();
}

void Mailbox::fail(const std::string& error) {
  const std::lock_guard lock(mutex_);
  error_ = error;
  wake();
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

namespace {

/// Returns true if both texts are equal; takes the same time wherever they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned char difference = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
    difference = difference | (static_cast<unsigned char>(a[n]) ^ static_cast<unsigned char>(b[n]));
  return difference == 0;
}

}  // namespace

std::string random_token() {
  std::random_device system;
  std::array<std::uint32_t, 4> numbers{};
  for (std::uint32_t& number : numbers) number = system();
  return fmt::format("{:08x}", fmt::join(numbers, ""));
}

std::string token_fault(std::string_view token) {
  constexpr std::size_t kShortest = 16, kLongest = 128;
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  if (token.size() >= kShortest && token.size() <= kLongest && token.find_first_not_of(kLetters) == token.npos)
    return {};
  return fmt::format("a token has {} to {} letters, digits, '_' and '-', such as openssl rand -hex 16 writes",
                     kShortest, kLongest);
}

namespace {

/// Makes an empty folder inaccessible to other users.
const std::filesystem::path& made_private(const std::filesystem::path& folder) {
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  return folder;
}

}  // namespace

ReceivedFile::ReceivedFile(std::string_view name)
    : folder_(std::filesystem::temp_directory_path() / ("meniscus-" + random_token()), Existing::refuse),
      file_(made_private(folder_.path()) / name) {}

std::string host_fault(std::string_view host) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789.-:[]_";
  if (!host.empty() && host.find_first_not_of(kLetters) == host.npos) return {};
  return "a host is a name in small letters with its port, such as hub.example.org or localhost:8888";
}

std::optional<std::string_view> admitted_path(std::string_view target, std::string_view token) {
  if (target.size() < token.size() + 2 || target[0] != '/' || target[token.size() + 1] != '/') return {};
  if (!equal_in_constant_time(target.substr(1, token.size()), token)) return {};
  return target.substr(token.size() + 2);
}

bool Clients::is_host(std::string_view host) const {
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port) ||
         std::ranges::find(trusted, host) != trusted.end();
}

bool Clients::is_origin(std::string_view origin) const {
  constexpr std::string_view kPlain = "http://", kSecure = "https://";
  if (origin.starts_with(kPlain)) return is_host(origin.substr(kPlain.size()));
  return origin.starts_with(kSecure) && std::ranges::find(trusted, origin.substr(kSecure.size())) != trusted.end();
}

bool Clients::full() const { return sockets.size() >= kMostClients; }

bool Clients::take_entry(std::string_view target) {
  if (entry.empty() || !target.starts_with('/') || !equal_in_constant_time(target.substr(1), entry)) return false;
  entry.clear();
  return true;
}

ClientNumber Clients::join(std::shared_ptr<Client> client) {
  sockets.emplace(next_number, std::move(client));
  if (controller == 0) controller = next_number;
  return next_number++;
}

void Clients::give_control(ClientNumber client) {
  const auto announce = [this](ClientNumber who, bool controls_now) {
    const auto found = sockets.find(who);
    if (found != sockets.end())
      found->second->send(text_message(json_line({{"event", "role"}, {"controls", controls_now}})));
  };
  if (controls(client)) return;
  announce(std::exchange(controller, client), false);
  announce(client, true);
}

void Clients::leave(ClientNumber client) {
  const bool controlled = controls(client);
  if (sockets.erase(client) == 0) return;
  mailbox.forget(client);
  if (!controlled) return;
  controller = 0;
  if (!sockets.empty()) give_control(sockets.begin()->first);
}

OutgoingMessage text_message(const std::string& text) {
  return {std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end()), true};
}

}  // namespace meniscus
