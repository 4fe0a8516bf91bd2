// SPDX-License-Identifier: BSD-3-Clause
// Repeats system calls that a signal interrupted.
#pragma once

#include <cerrno>

namespace meniscus {

/// The result of `call`, which returns a negative number and sets errno on failure; called again for as long as a
/// signal interrupted it before it did anything (EINTR). Not for close(), which closes all the same.
template <typename Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace meniscus
