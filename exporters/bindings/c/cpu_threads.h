// SPDX-License-Identifier: BSD-3-Clause
// How many CPU threads a call may use, told to TBB for that call alone.
#pragma once

#include <tbb/task_arena.h>

namespace meniscus::c_api {

/// Runs the work in an arena of its own: with so many threads (0: all), and apart from tasks that the caller may have
/// under way in TBB himself.
template <typename Work>
void run_on_threads(int threads, const Work& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(work);
}

}  // namespace meniscus::c_api
