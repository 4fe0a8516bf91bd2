// SPDX-License-Identifier: BSD-3-Clause
// Where calls compute: the device, the number of CPU threads, and a thread with a GL context of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <sys/types.h>

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

/// Drivers keep threads and locks that fork() does not copy: in a child of a process that used GL they would wait for
/// ever. So whatever was made before is refused there, and so are new ones, with a GpuError.
class GlThread {
 public:
  /// Throws GpuError in such a child, std::system_error if there is no thread.
  GlThread();
  ~GlThread();
  GlThread(const GlThread&) = delete;
  GlThread& operator=(const GlThread&) = delete;

  /// Runs the work there and waits for it, one after the other. Throws what it throws.
  void run(const std::function<void()>& work);

  /// False in a child that fork() made: the thread is not there.
  bool alive() const;

 private:
  struct Worker;

  const pid_t process_;
  std::unique_ptr<Worker> worker_;
};

/// Something made of GL: it is made, used and destroyed on its thread.
template <typename State>
class OnGlThread {
 public:
  /// make: -> std::unique_ptr<State>
  template <typename Make>
  explicit OnGlThread(const Make& make) {
    thread_.run([&] { state_ = make(); });
  }
  ~OnGlThread() {
    if (thread_.alive())
      thread_.run([&] { state_.reset(); });
    else
      static_cast<void>(state_.release());  // its driver is not there to take anything back
  }
  /// use(State&), there.
  template <typename Use>
  void run(const Use& use) {
    thread_.run([&] { use(*state_); });
  }

 private:
  GlThread thread_;
  std::unique_ptr<State> state_;
};

}  // namespace meniscus::c_api
