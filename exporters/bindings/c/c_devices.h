// SPDX-License-Identifier: BSD-3-Clause
// Where calls compute: the device, the number of CPU threads, and a thread with a GL context of its own.
#pragma once

#include <functional>
#include <memory>

#include <sys/types.h>

#include <tbb/task_arena.h>

#include "core/gpu/device_choice.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {

/// Refuses a number that is not a device with MENISCUS_USAGE.
inline void check_device(std::int32_t device) {
  if (device < MENISCUS_CPU || device > MENISCUS_SOFTWARE)
    refuse(MENISCUS_USAGE, "device is {}, none of MENISCUS_CPU, _AUTO, _GPU, _SOFTWARE", device);
}

/// Returns the GL of a device other than MENISCUS_CPU.
inline DeviceChoice gl_of(std::int32_t device) {
  DeviceChoice choice;
  choice.kind = device == MENISCUS_GPU    ? DeviceChoice::Kind::gpu
                : device == MENISCUS_AUTO ? DeviceChoice::Kind::automatic
                                          : DeviceChoice::Kind::software;
  return choice;
}

/// Runs work on a number of threads; 0 means all. The work has a separate arena, so that it does not execute TBB tasks
/// of the calling program.
template <typename Work>
void run_on_threads(int threads, const Work& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(work);
}

/// A thread for a GL context. Contexts belong to threads, and the threads of the calling program may have contexts of
/// their own. fork() does not copy the threads of a GL driver, so that a child of a process that used GL would wait
/// forever. Therefore GL is refused in such a child.
class GlThread {
 public:
  /// Throws GpuError in a child of a process that used GL, and std::system_error if no thread can be created.
  GlThread();
  ~GlThread();
  GlThread(const GlThread&) = delete;
  GlThread& operator=(const GlThread&) = delete;

  /// Runs work on the thread, and returns when it is finished. Calls wait for each other. Throws the exceptions of the
  /// work, and GpuError in a child of the process.
  void run(const std::function<void()>& work);

  /// Returns false in a child of the process that created this object, where the thread does not exist.
  bool alive() const;

 private:
  struct Worker;

  const pid_t process_;
  std::unique_ptr<Worker> worker_;
};

/// An object that uses GL. It is created, used and destroyed on a GL thread.
template <typename State>
class OnGlThread {
 public:
  /// make: a function that returns std::unique_ptr<State>.
  template <typename Make>
  explicit OnGlThread(const Make& make) {
    thread_.run([&] { state_ = make(); });
  }
  ~OnGlThread() {
    if (thread_.alive())
      thread_.run([&] { state_.reset(); });
    else
      static_cast<void>(state_.release());  // its driver does not work in this process
  }
  /// Calls use(State&) on the thread.
  template <typename Use>
  void run(const Use& use) {
    thread_.run([&] { use(*state_); });
  }

 private:
  GlThread thread_;
  std::unique_ptr<State> state_;
};

}  // namespace meniscus::c_api
