// SPDX-License-Identifier: BSD-3-Clause
// Who may talk to the preview server: the token of its address, and the names it answers to.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// 128 random bits of the system as 32 hexadecimal digits. Throws Error where the system has none.
std::string random_token();

/// True if they are equal; takes the same time wherever they differ.
bool equal_in_constant_time(std::string_view a, std::string_view b);

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

}  // namespace meniscus
