// SPDX-License-Identifier: BSD-3-Clause
// A thread for a GL context: contexts belong to threads, and the caller's threads have contexts of their own.
#pragma once

#include <functional>
#include <memory>

#include <sys/types.h>

namespace meniscus::c_api {

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
