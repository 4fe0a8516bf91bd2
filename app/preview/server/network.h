// SPDX-License-Identifier: BSD-3-Clause
// The preview's web server: pages and sockets on 127.0.0.1, in their own thread.
#pragma once

#include "app/preview/server/clients.h"

namespace meniscus {

/// Where the server listens, and which clients it accepts.
struct NetworkOptions {
  std::uint16_t port = 0;                    ///< 0: any free one
  std::string address = "127.0.0.1";         ///< address of this machine; containers need another one
  std::string token{};                       ///< in the address of the page; empty: a random one
  std::vector<std::string> trusted_hosts{};  ///< Clients::trusted
};

/// Serves the page to browsers on this machine that know the token, and passes their commands to the mailbox. The first
/// socket controls, the others watch. Foreign hosts, foreign origins and wrong tokens are answered with 403. All
/// functions may be called from any thread.
class Network {
 public:
  /// Listens when this returns. Throws RequestError if the port is not available, Error if the network fails.
  Network(const NetworkOptions& options, Mailbox& mailbox);
  /// Closes the connections of all clients within a second.
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  std::uint16_t port() const;
  /// Returns http://127.0.0.1:PORT/TOKEN/.
  std::string url() const;
  /// Returns an address for the browser that this program starts. It works once: the first request is sent on to the
  /// page, later requests are refused. It does not contain the token, because other users may see command lines.
  std::string url_once() const;

  /// Sends a message to one client or to all. A client that is gone, or too slow to read, is not an error. bytes: the
  /// picture or the figure that the message refers to, sent after it; nullptr if there is none.
  void send(ClientNumber client, const nlohmann::json& message,
            std::shared_ptr<const std::vector<std::uint8_t>> bytes = nullptr);
  void send_to_all(const nlohmann::json& message);
  /// Sends a message to all clients, and to later ones until another message replaces it; null ends that.
  void announce(const nlohmann::json& message);
  /// Lets browsers download only these files from now on. Their names have letters, digits, '.', '_' and '-'.
  void offer_files(const std::vector<std::filesystem::path>& files);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meniscus
