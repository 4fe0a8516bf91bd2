// SPDX-License-Identifier: BSD-3-Clause
// Tokens and names.
#include "app/preview/server/access.h"

#include <array>
#include <cerrno>

#include <sys/random.h>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus {

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  ssize_t got = -1;
  do {
    got = ::getrandom(bytes.data(), bytes.size(), 0);
  } while (got < 0 && errno == EINTR);
  if (got != static_cast<ssize_t>(bytes.size())) throw Error("the system gives no random numbers");
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned char difference = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
    difference = difference | (static_cast<unsigned char>(a[n]) ^ static_cast<unsigned char>(b[n]));
  return difference == 0;
}

bool is_own_host(std::string_view host, std::uint16_t port) {
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

bool is_own_origin(std::string_view origin, std::uint16_t port) {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && is_own_host(origin.substr(kScheme.size()), port);
}

Admission admit(std::string_view target, std::string_view token) {
  if (target.size() < token.size() + 2 || target[0] != '/' || target[token.size() + 1] != '/') return {};
  if (!equal_in_constant_time(target.substr(1, token.size()), token)) return {};
  return {true, target.substr(token.size() + 2)};
}

}  // namespace meniscus
