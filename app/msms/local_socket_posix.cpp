// SPDX-License-Identifier: BSD-3-Clause
// Implements LocalSocket (socket_server.h) for Linux and macOS.
#include <cstring>

#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "app/msms/socket_server.h"
#include "core/base/system_file.h"

namespace meniscus::msms {
namespace {

// A client that has disconnected is an error here, not a signal that ends the program.
#if defined(__APPLE__)
constexpr int kNoSignal = 0;
void send_no_signal(int socket) {
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on);
}
#else
constexpr int kNoSignal = MSG_NOSIGNAL;
void send_no_signal(int) {}
#endif

int number_of(std::intptr_t socket) { return static_cast<int>(socket); }

}  // namespace

std::optional<LocalSocket> LocalSocket::listening_on(std::uint16_t port) {
  const int number = ::socket(AF_INET, SOCK_STREAM, 0);
  if (number < 0) return {};
  LocalSocket socket(number);
  ::fcntl(number, F_SETFD, FD_CLOEXEC);
  const int on = 1;
  ::setsockopt(number, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(port);
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::bind(number, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0 || ::listen(number, 1) != 0) return {};
  return socket;
}

LocalSocket::~LocalSocket() {
  const int before = errno;
  if (number_ != kNone) ::close(number_of(number_));
  errno = before;
}

bool LocalSocket::has_caller(int milliseconds) const {
  pollfd waiting{number_of(number_), POLLIN, 0};
  return uninterrupted([&] { return ::poll(&waiting, 1, milliseconds); }) > 0;
}

std::optional<LocalSocket> LocalSocket::caller(int seconds) const {
  const int number = uninterrupted([&] { return ::accept(number_of(number_), nullptr, nullptr); });
  if (number < 0) return {};
  ::fcntl(number, F_SETFD, FD_CLOEXEC);
  send_no_signal(number);
  const timeval limit{seconds, 0};
  ::setsockopt(number, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  ::setsockopt(number, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  return LocalSocket(number);
}

std::ptrdiff_t LocalSocket::receive(std::span<std::byte> bytes) const {
  return uninterrupted([&] { return ::recv(number_of(number_), bytes.data(), bytes.size(), 0); });
}

std::ptrdiff_t LocalSocket::send(std::span<const std::byte> bytes) const {
  return uninterrupted([&] { return ::send(number_of(number_), bytes.data(), bytes.size(), kNoSignal); });
}

std::string LocalSocket::last_error() { return std::strerror(errno); }

}  // namespace meniscus::msms
