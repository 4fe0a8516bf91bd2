// SPDX-License-Identifier: BSD-3-Clause
// Whether memory was refused to this program.
#pragma once

namespace meniscus {

/// Call at the beginning of main(): from then on `new` that gets no memory is remembered, and throws std::bad_alloc as
/// ever.
void remember_failed_allocations();

/// Has `new` got no memory since? What C libraries ask for is not counted.
bool memory_ran_out() noexcept;

}  // namespace meniscus
