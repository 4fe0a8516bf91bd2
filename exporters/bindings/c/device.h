// SPDX-License-Identifier: BSD-3-Clause
// The device of a call, in the library's words, and its number of CPU threads.
#pragma once

#include <cstdint>

#include <tbb/task_arena.h>

#include "core/gpu/device_choice.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {

inline void check_device(std::int32_t device) {
  if (device < MENISCUS_CPU || device > MENISCUS_SOFTWARE)
    refuse(MENISCUS_USAGE, "device is {}, none of MENISCUS_CPU, _AUTO, _GPU, _SOFTWARE", device);
}

/// The GL that a device means.
inline DeviceChoice gl_of(std::int32_t device) {
  DeviceChoice choice;
  choice.kind = device == MENISCUS_GPU    ? DeviceChoice::Kind::gpu
                : device == MENISCUS_AUTO ? DeviceChoice::Kind::automatic
                                          : DeviceChoice::Kind::software;
  return choice;
}

/// Runs the work in an arena of its own: with so many threads (0: all), and apart from tasks that the caller may have
/// under way in TBB himself.
template <typename Work>
void run_on_threads(int threads, const Work& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(work);
}

}  // namespace meniscus::c_api
