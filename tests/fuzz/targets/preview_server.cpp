// SPDX-License-Identifier: BSD-3-Clause
// What a browser, or something else, sends to the preview server: HTTP, the handshake of a WebSocket, and its frames.
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>

#include <boost/asio/io_context.hpp>

#include "app/preview/server/clients.h"
#include "app/preview/server/connection.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

constexpr std::string_view kToken = "0123456789abcdef0123456789abcdef";  // as seeds have it
constexpr std::uint16_t kPort = 4711;

/// The bytes written into one end of a connection, which then says no more.
int connection_with(std::string_view bytes, int& other_end) {
  int ends[2];
  require(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "the system has sockets");
  const ssize_t written = ::send(ends[1], bytes.data(), bytes.size(), MSG_NOSIGNAL);
  require(written == static_cast<ssize_t>(bytes.size()), "a socket takes the bytes");
  ::shutdown(ends[1], SHUT_WR);
  other_end = ends[1];
  return ends[0];
}

void run(std::string_view bytes) {
  constexpr std::size_t kMost = 100'000;  // what a socket's buffer holds
  int other_end = -1;
  const int end = connection_with(bytes.substr(0, kMost), other_end);
  Mailbox mailbox;
  const auto clients = std::make_shared<Clients>(mailbox, std::string(kToken));
  clients->port = kPort;
  {
    boost::asio::io_context context{1};
    serve_connection(boost::asio::ip::tcp::socket(context, boost::asio::ip::tcp::v4(), end), clients);
    context.run_for(std::chrono::seconds(30));  // on a busy machine; a fuzzer gives up sooner
    require(context.stopped(), "a connection that says no more is given up");
  }
  ::close(other_end);
  require(clients->connections == 0 && clients->sockets.empty(), "a connection that ended leaves nothing behind");
}

const Registration registration{"preview_server", run};

}  // namespace
}  // namespace meniscus::fuzz
