// SPDX-License-Identifier: BSD-3-Clause
// Who may talk to the preview server, who is connected, and who controls; as its network thread knows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/preview/server/mailbox.h"

namespace meniscus {

// How much the server takes from others.
inline constexpr std::size_t kMostClients = 4;  ///< sockets that look or control
inline constexpr std::size_t kMostConnections = 32;
inline constexpr std::size_t kLargestMessage = 4096;  ///< bytes
inline constexpr std::size_t kLargestHeader = 8192;   ///< bytes of a request's header
inline constexpr int kPatience = 10;                  ///< seconds for a request

/// 128 random bits of the system as 32 hexadecimal digits. Throws Error where the system has none.
std::string random_token();

/// Is this the Host header of a request to us? 127.0.0.1:PORT and localhost:PORT are; a name that somebody else's DNS
/// points here is not.
bool is_own_host(std::string_view host, std::uint16_t port);

/// Is this the Origin header of our own page?
bool is_own_origin(std::string_view origin, std::uint16_t port);

/// "/TOKEN/rest" -> "rest" if the token is right, else nothing with `admitted` false.
struct Admission {
  bool admitted = false;
  std::string_view path;
};
Admission admit(std::string_view target, std::string_view token);

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
