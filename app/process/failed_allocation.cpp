// SPDX-License-Identifier: BSD-3-Clause
// A handler that `new` calls before it gives up.
#include "app/process/failed_allocation.h"

#include <atomic>
#include <new>

namespace meniscus {
namespace {

std::atomic<bool> failed{false};

[[noreturn]] void remember() {
  failed = true;
  throw std::bad_alloc();
}

}  // namespace

void remember_failed_allocations() { std::set_new_handler(remember); }

bool memory_ran_out() noexcept { return failed; }

}  // namespace meniscus
