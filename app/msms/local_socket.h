// SPDX-License-Identifier: BSD-3-Clause
// A blocking socket on this machine alone: implemented in local_socket_posix.cpp and local_socket_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace meniscus::msms {

/// Closed with this object. Where a function fails, last_error() says why.
class LocalSocket {
 public:
  /// Listens on a port of 127.0.0.1.
  static std::optional<LocalSocket> listening_on(std::uint16_t port);
  ~LocalSocket();
  LocalSocket(LocalSocket&& other) noexcept : number_(other.number_) { other.number_ = kNone; }
  LocalSocket& operator=(LocalSocket&&) = delete;

  /// Has someone called within this time?
  bool has_caller(int milliseconds) const;
  /// The first that called; what it does not take or send within `seconds` fails.
  std::optional<LocalSocket> caller(int seconds) const;
  /// Bytes received or sent, which may be fewer; none where the other side has closed, -1 if that fails.
  std::ptrdiff_t receive(std::span<std::byte> bytes) const;
  std::ptrdiff_t send(std::span<const std::byte> bytes) const;

  static std::string last_error();

 private:
  static constexpr std::intptr_t kNone = -1;
  explicit LocalSocket(std::intptr_t number) : number_(number) {}
  std::intptr_t number_;
};

}  // namespace meniscus::msms
