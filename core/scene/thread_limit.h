// SPDX-License-Identifier: BSD-3-Clause
// How many CPU threads the program may use.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>

#include <tbb/global_control.h>

namespace meniscus {

/// Holds as long as it lives; 0: all threads.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0)
      limit_.reset(
          new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)));
  }

 private:
  /// Not when an exception passes: oneTBB that got no memory may hold a lock for ever, and would wait for it. The limit
  /// stays in force then, as all of a program have the same.
  struct End {
    void operator()(tbb::global_control* limit) const noexcept {
      if (std::uncaught_exceptions() == 0) delete limit;
    }
  };

  std::unique_ptr<tbb::global_control, End> limit_;
};

}  // namespace meniscus
