// SPDX-License-Identifier: BSD-3-Clause
// What happens where a limit on address space (ulimit -v, as batch systems set it) is too small.
#pragma once

namespace meniscus {

/// Libraries do not survive that they get no memory or thread: they crash, some while they are loaded, others wait for
/// ever for a thread that could not be started. Under such a limit, and only then, this is a line on standard error and
/// exit code 5, from before their initialisation on. Call at the beginning of main(): nothing waits any more.
void libraries_are_loaded();

/// Is there such a limit?
bool memory_is_limited();

}  // namespace meniscus
