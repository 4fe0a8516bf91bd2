// SPDX-License-Identifier: BSD-3-Clause
// Requests of any client to the preview server: HTTP, the handshake of a WebSocket, and its frames.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>

#include <boost/asio/io_context.hpp>

#include "app/preview/server/clients.h"
#include "app/preview/server/connection.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

constexpr std::string_view kToken = "0123456789abcdef0123456789abcdef";  // the seeds' token
constexpr std::uint16_t kPort = 4711;

/// Both ends of a connection.
struct Ends {
  int server = -1, client = -1;

  Ends() {
    int ends[2];
    require(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "the system has sockets");
    server = ends[0];
    client = ends[1];
  }
  ~Ends() { ::close(client); }  // The server closes its own end.
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;

  void send(std::string_view bytes) const {
    const ssize_t written = ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    require(written == static_cast<ssize_t>(bytes.size()) || errno == EPIPE || errno == ECONNRESET,
            "a socket takes the bytes, or is closed");
  }
};

/// Returns the request, and the bytes that follow its answer: a client of a WebSocket waits so (RFC 6455, 4.1).
std::array<std::string_view, 2> parts_of(std::string_view bytes) {
  constexpr std::string_view kEnd = "\r\n\r\n";
  const std::size_t end = bytes.find(kEnd);
  const std::size_t cut = end == std::string_view::npos ? bytes.size() : end + kEnd.size();
  return {bytes.substr(0, cut), bytes.substr(cut)};
}

void run_preview_server(std::string_view bytes) {
  constexpr std::size_t kMost = 100'000;  // the size of a socket's buffer
  const auto [request, rest] = parts_of(bytes.substr(0, kMost));
  const Ends ends;
  Mailbox mailbox;
  const auto clients = std::make_shared<Clients>(mailbox, std::string(kToken));
  clients->port = kPort;
  {
    boost::asio::io_context context{1};
    serve_connection(boost::asio::ip::tcp::socket(context, boost::asio::ip::tcp::v4(), ends.server), clients);
    ends.send(request);
    while (context.poll() > 0) {
    }
    ends.send(rest);
    ::shutdown(ends.client, SHUT_WR);
    context.run_for(std::chrono::seconds(30));  // for a busy machine; a fuzzer gives up sooner
    require(context.stopped(), "a connection that says no more is given up");
  }
  require(clients->connections == 0 && clients->sockets.empty(), "a connection that ended leaves nothing behind");
}

const Registration registered_preview_server{"preview_server", run_preview_server};

}  // namespace
}  // namespace meniscus::fuzz
