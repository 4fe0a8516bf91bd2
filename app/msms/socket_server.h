// SPDX-License-Identifier: BSD-3-Clause
// A blocking socket on this machine only, implemented in local_socket_posix.cpp and local_socket_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace meniscus::msms {

/// A socket, closed by the destructor. If a function fails, last_error() has the reason.
class LocalSocket {
 public:
  /// Listens on a port of 127.0.0.1.
  static std::optional<LocalSocket> listening_on(std::uint16_t port);
  ~LocalSocket();
  LocalSocket(LocalSocket&& other) noexcept : number_(other.number_) { other.number_ = kNone; }
  LocalSocket& operator=(LocalSocket&&) = delete;

  /// True if a client has connected within this time.
  bool has_caller(int milliseconds) const;
  /// Accepts the first client. Each later transfer fails if it takes more than `seconds`.
  std::optional<LocalSocket> caller(int seconds) const;
  /// Returns the number of bytes received or sent, possibly fewer than requested; 0 if the other side has closed, -1 on
  /// failure.
  std::ptrdiff_t receive(std::span<std::byte> bytes) const;
  std::ptrdiff_t send(std::span<const std::byte> bytes) const;

  static std::string last_error();

 private:
  static constexpr std::intptr_t kNone = -1;
  explicit LocalSocket(std::intptr_t number) : number_(number) {}
  std::intptr_t number_;
};

}  // namespace meniscus::msms
