// SPDX-License-Identifier: BSD-3-Clause
// The clients of the preview server, as its network thread knows them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/preview/server/mailbox.h"

namespace meniscus {

/// Bytes on their way to clients, which share them.
struct OutgoingMessage {
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;
  bool is_text = true;
};

/// A connected socket, as others see it. Used by the network thread only.
class Client {
 public:
  virtual ~Client() = default;
  virtual void send(OutgoingMessage message) = 0;
  virtual void close() = 0;
};

/// Who is connected, and what all connections share. Used by the network thread only.
struct Clients {
  Clients(Mailbox& box, std::string word) : mailbox(box), token(std::move(word)) {}

  Mailbox& mailbox;
  std::string token;
  std::uint16_t port = 0;
  std::size_t connections = 0;  ///< sockets of any kind, open
  std::map<ClientNumber, std::shared_ptr<Client>> sockets;
  ClientNumber next_number = 1;

  /// Connections that have not shown the token yet, oldest first, each by a function that ends it.
  std::map<std::uint64_t, std::function<void()>> strangers;
  std::uint64_t next_stranger = 1;
  ClientNumber controller = 0;  ///< 0: nobody

  bool controls(ClientNumber client) const { return client == controller; }
  /// This client controls from now on; both are told.
  void give_control(ClientNumber client);
  bool full() const;
  ClientNumber join(std::shared_ptr<Client> client);
  void leave(ClientNumber client);
};

/// A JSON message as text.
OutgoingMessage text_message(const std::string& text);

}  // namespace meniscus
