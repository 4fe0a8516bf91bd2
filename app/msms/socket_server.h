// SPDX-License-Identifier: BSD-3-Clause
// Serves one surface over a socket on this machine, as VMD requests it from MSMS.
#pragma once

#include "app/msms/arguments.h"

namespace meniscus::msms {

/// Listens only on 127.0.0.1, greets the first client, reads probe, density and spheres in the machine's own byte
/// order, and answers with triangles, vertices and the sphere of each vertex, of component 0. Ends after one client, or
/// when none comes. Throws UsageError if the port is not available; InputError if no client comes in time, or if a
/// client disconnects, is silent too long, or sends invalid spheres; and the errors of ChosenSurface.
void serve(std::uint16_t port);

/// A socket, closed by the destructor. If a function fails, last_error() has the reason.
class LocalSocket {
 public:
  /// Listens on a port of 127.0.0.1.
  static std::optional<LocalSocket> listening_on(std::uint16_t port);
  ~LocalSocket();
  LocalSocket(LocalSocket&& other) noexcept : number_(other.number_) { other.number_ = kNone; }
  LocalSocket& operator=(LocalSocket&&) = delete;

  /// Returns true if a client has connected within this time.
  bool has_caller(int milliseconds) const;
  /// Accepts the first client. Each later transfer fails if it takes more than `seconds`.
  std::optional<LocalSocket> caller(int seconds) const;
  /// Return the number of transferred bytes, possibly fewer than requested; 0 if the other side closed, -1 on failure.
  std::ptrdiff_t receive(std::span<std::byte> bytes) const;
  std::ptrdiff_t send(std::span<const std::byte> bytes) const;

  static std::string last_error();

 private:
  static constexpr std::intptr_t kNone = -1;
  explicit LocalSocket(std::intptr_t number) : number_(number) {}
  std::intptr_t number_;
};

}  // namespace meniscus::msms
