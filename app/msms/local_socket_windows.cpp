// SPDX-License-Identifier: BSD-3-Clause
// Implements LocalSocket (socket_server.h) for Windows.
#include <climits>
#include <system_error>

#include <winsock2.h>

#include "app/msms/socket_server.h"

namespace meniscus::msms {
namespace {

SOCKET number_of(std::intptr_t socket) { return static_cast<SOCKET>(socket); }

int piece(std::size_t count) { return static_cast<int>(std::min<std::size_t>(count, INT_MAX)); }

bool sockets_are_there() {
  WSADATA data{};
  static const int failure = ::WSAStartup(MAKEWORD(2, 2), &data);
  return failure == 0;
}

}  // namespace

std::optional<LocalSocket> LocalSocket::listening_on(std::uint16_t port) {
  if (!sockets_are_there()) return {};
  const SOCKET number = ::socket(AF_INET, SOCK_STREAM, 0);
  if (number == INVALID_SOCKET) return {};
  LocalSocket socket(static_cast<std::intptr_t>(number));
  const BOOL on = TRUE;  // frees the port as soon as its socket is closed, and no other program may take it before
  ::setsockopt(number, SOL_SOCKET, SO_EXCLUSIVEADDRUSE, reinterpret_cast<const char*>(&on), sizeof on);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = ::htons(port);
  here.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  if (::bind(number, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0 || ::listen(number, 1) != 0) return {};
  return socket;
}

LocalSocket::~LocalSocket() {
  const int before = ::WSAGetLastError();
  if (number_ != kNone) ::closesocket(number_of(number_));
  ::WSASetLastError(before);
}

bool LocalSocket::has_caller(int milliseconds) const {
  WSAPOLLFD waiting{number_of(number_), POLLRDNORM, 0};
  return ::WSAPoll(&waiting, 1, milliseconds) > 0;
}

std::optional<LocalSocket> LocalSocket::caller(int seconds) const {
  const SOCKET number = ::accept(number_of(number_), nullptr, nullptr);
  if (number == INVALID_SOCKET) return {};
  const DWORD limit = static_cast<DWORD>(seconds) * 1000;
  for (const int which : {SO_RCVTIMEO, SO_SNDTIMEO})
    ::setsockopt(number, SOL_SOCKET, which, reinterpret_cast<const char*>(&limit), sizeof limit);
  return LocalSocket(static_cast<std::intptr_t>(number));
}

std::ptrdiff_t LocalSocket::receive(std::span<std::byte> bytes) const {
  return ::recv(number_of(number_), reinterpret_cast<char*>(bytes.data()), piece(bytes.size()), 0);
}

std::ptrdiff_t LocalSocket::send(std::span<const std::byte> bytes) const {
  return ::send(number_of(number_), reinterpret_cast<const char*>(bytes.data()), piece(bytes.size()), 0);
}

std::string LocalSocket::last_error() { return std::system_category().message(::WSAGetLastError()); }

}  // namespace meniscus::msms
