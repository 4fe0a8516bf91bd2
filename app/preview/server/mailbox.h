// SPDX-License-Identifier: BSD-3-Clause
// What clients ask for, on its way from the network thread to the thread that draws.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/preview/command_json.h"

namespace meniscus {

using ClientNumber = std::uint64_t;

/// One command of a client; several of its messages may have become one.
struct ClientCommand {
  ClientNumber client = 0;
  nlohmann::json command;
  std::vector<nlohmann::json> ids;  ///< of the messages, for their replies
};

/// Drags that nobody has seen yet become one drag, and of values such as the probe radius the latest counts, so that a
/// slow picture never makes a queue. Every function may be called from any thread.
class Mailbox {
 public:
  /// False, and nothing happens, if too many commands wait already.
  bool put(ClientNumber client, const nlohmann::json& id, nlohmann::json command);
  /// The most that a waiting command will change.
  Change waiting_change();
  /// The client has shown its last picture and is ready for another.
  void want_picture(ClientNumber client);
  /// The client has gone; its commands are still carried out.
  void forget(ClientNumber client);
  /// The network has failed; take() throws Error with this text.
  void fail(const std::string& error);

  struct Content {
    std::vector<ClientCommand> commands;  ///< in order
    std::set<ClientNumber> wanting;       ///< clients that are ready for a picture
    std::set<ClientNumber> gone;          ///< clients that left since the last time
  };
  /// Waits until something new is there or the time has come, and takes all of it.
  Content take(std::optional<std::chrono::steady_clock::time_point> until);

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  Content content_;
  bool news_ = false;
  std::string error_;
};

}  // namespace meniscus
