// SPDX-License-Identifier: BSD-3-Clause
// Runs work on the thread of a GL context.
#include "exporters/bindings/c/c_devices.h"

#include <condition_variable>
#include <mutex>
#include <thread>

#include <unistd.h>

#include "core/base/error.h"

namespace meniscus::c_api {
namespace {

/// The process that used GL first; 0: GL was not used. A child has the number of its parent, whose driver does not work
/// in the child.
std::atomic<pid_t> process_of_driver{0};

/// Returns the number of this process. Throws GpuError if GL was used before fork().
pid_t claim_driver() {
  const pid_t self = ::getpid();
  pid_t owner = 0;
  if (!process_of_driver.compare_exchange_strong(owner, self) && owner != self)
    throw GpuError(
        "GL was used before fork(), and its driver does not survive that; use GL after fork() only, or the CPU");
  return self;
}

}  // namespace

/// The thread and the function that it runs.
struct GlThread::Worker {
  Worker() : thread([this] { loop(); }) {}
  ~Worker() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    changed.notify_all();
    thread.join();
  }

  void run(const std::function<void()>& function) {
    const std::lock_guard one_call(calls);
    std::unique_lock lock(mutex);
    work = &function;
    changed.notify_all();
    changed.wait(lock, [&] { return !work; });
    if (error) std::rethrow_exception(std::exchange(error, nullptr));
  }

  void loop() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return work || ending; });
      if (!work) return;
      lock.unlock();
      std::exception_ptr thrown;
      try {
        (*work)();
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      error = std::move(thrown);
      work = nullptr;
      changed.notify_all();
    }
  }

  std::mutex calls;
  std::mutex mutex;
  std::condition_variable changed;
  const std::function<void()>* work = nullptr;
  std::exception_ptr error;
  bool ending = false;
  std::thread thread;
};

GlThread::GlThread() : process_(claim_driver()), worker_(std::make_unique<Worker>()) {}

GlThread::~GlThread() {
  // In a child process the thread does not exist, so that the destructor of the worker would wait forever.
  if (!alive()) static_cast<void>(worker_.release());
}

bool GlThread::alive() const { return ::getpid() == process_; }

void GlThread::run(const std::function<void()>& work) {
  if (!alive()) throw GpuError("made before fork(), which GL does not survive; make a new one, for the CPU");
  worker_->run(work);
}

}  // namespace meniscus::c_api
