// SPDX-License-Identifier: BSD-3-Clause
// Repeats system calls that a signal interrupted.
#pragma once

#include <cerrno>

namespace meniscus {

/// Returns the result of `call`, which returns a negative number and sets errno if it fails. It is called again as long
/// as a signal interrupts it before it does anything (EINTR). close() must not be called this way, because it closes
/// the file even if interrupted.
template <typename Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace meniscus
