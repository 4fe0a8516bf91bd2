// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the GNU C library's malloc, which adapt themselves to less than a frame unless they are set.
#include "app/process/freed_memory.h"

#include <climits>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace meniscus {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kOwnMapping = 32 << 20;  // bytes, the most that malloc takes
  ::mallopt(M_MMAP_THRESHOLD, kOwnMapping);
  ::mallopt(M_TRIM_THRESHOLD, INT_MAX);
#endif
}

}  // namespace meniscus
