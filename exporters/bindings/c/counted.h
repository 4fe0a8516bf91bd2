// SPDX-License-Identifier: BSD-3-Clause
// Reference counts of the objects of the C interface.
#pragma once

#include <atomic>
#include <cstdint>

namespace meniscus::c_api {

class Counted {
 public:
  void retain() noexcept { holders_.fetch_add(1, std::memory_order_relaxed); }
  /// True if nobody is left.
  bool let_go() noexcept { return holders_.fetch_sub(1, std::memory_order_acq_rel) == 1; }
  /// For one who holds it.
  bool held_by_one() const noexcept { return holders_.load(std::memory_order_acquire) == 1; }

 private:
  std::atomic<std::uint32_t> holders_{1};
};

template <typename Object>
Object* retain(Object* object) noexcept {
  if (object) object->retain();
  return object;
}

template <typename Object>
void release(Object* object) noexcept {
  if (object && object->let_go()) delete object;
}

}  // namespace meniscus::c_api
