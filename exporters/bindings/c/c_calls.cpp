// SPDX-License-Identifier: BSD-3-Clause
// Maps exceptions to statuses, keeps the last message of each thread, checks arrays, and runs work on a GL thread.
#include "exporters/bindings/c/c_calls.h"

#include <array>
#include <condition_variable>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include <unistd.h>

#include "core/base/error.h"
#include "core/properties/properties.h"

namespace meniscus::c_api {
namespace {

/// The last message of this thread. It has a fixed size, because it is also written if memory does not suffice.
thread_local std::array<char, 4096> last_error{};

/// Stores a message. A message that is too long is cut between two characters.
void keep(std::string_view text) noexcept {
  std::size_t length = std::min(text.size(), last_error.size() - 1);
  if (length < text.size())
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;
  std::memcpy(last_error.data(), text.data(), length);
  last_error[length] = '\0';
}

meniscus_status kept(meniscus_status status, std::string_view text) noexcept {
  keep(text);
  return status;
}

}  // namespace

meniscus_status report(const std::exception_ptr& error) noexcept {
  try {
    std::rethrow_exception(error);
  } catch (const Refusal& refusal) {
    return kept(refusal.status(), refusal.what());
  } catch (const InputError& input) {
    return kept(MENISCUS_INPUT, input.what());
  } catch (const SelectionError& selection) {
    return kept(MENISCUS_USAGE, selection.what());
  } catch (const RequestError& request) {
    return kept(MENISCUS_USAGE, request.what());
  } catch (const GpuError& gpu) {
    return kept(MENISCUS_NO_GPU, gpu.what());
  } catch (const CapacityError& capacity) {
    return kept(MENISCUS_CAPACITY, capacity.what());
  } catch (const OutputError& output) {
    return kept(MENISCUS_OUTPUT, output.what());
  } catch (const OpenSurfaceError& open) {
    return kept(MENISCUS_NOT_CLOSED, open.what());
  } catch (const std::bad_alloc&) {
    return kept(MENISCUS_CAPACITY, "out of memory");
  } catch (const std::length_error&) {
    return kept(MENISCUS_CAPACITY, "out of memory: something would be longer than memory can be");
  } catch (const std::system_error& system) {
    return kept(MENISCUS_CAPACITY, system.what());  // no thread, no lock
  } catch (const std::exception& other) {
    return kept(MENISCUS_INTERNAL, other.what());
  } catch (...) {
    return kept(MENISCUS_INTERNAL, "an exception without a text");
  }
}

std::size_t require_rows(const void* data, const CallerRows& rows, const char* name) {
  const std::size_t row = rows.width * rows.number, stride = rows.stride == 0 ? row : rows.stride;
  if (rows.count == 0) return stride;
  require(data, name);
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  if (address % rows.number != 0)
    refuse(MENISCUS_USAGE, "{} is not aligned: its address is not a multiple of {}", name, rows.number);
  if (stride > kMostBytes)
    refuse(MENISCUS_USAGE, "{}_stride is {} bytes, which is -{} with a sign; rows must ascend", name, stride,
           ~stride + 1);
  if (stride < row || stride % rows.number != 0)
    refuse(MENISCUS_USAGE, "{}_stride is {} bytes; rows of {} numbers of {} bytes need a multiple of {}, at least {}",
           name, stride, rows.width, rows.number, rows.number, row);
  const std::size_t room = std::min<std::size_t>(kMostBytes, std::numeric_limits<std::uintptr_t>::max() - address);
  if (stride > room / rows.count)
    refuse(MENISCUS_USAGE, "{}: {} rows, {} bytes from one to the next, do not fit into memory", name, rows.count,
           stride);
  return stride;
}

void require_apart(const void* written, std::size_t written_bytes, const char* written_name, const void* read,
                   std::size_t read_bytes, const char* read_name) {
  const auto a = reinterpret_cast<std::uintptr_t>(written), b = reinterpret_cast<std::uintptr_t>(read);
  if (a < b + read_bytes && b < a + written_bytes)
    refuse(MENISCUS_USAGE, "{} and {} overlap; what is written needs room of its own", written_name, read_name);
}

void check_number(std::string_view key, const char* name, double value, const char* unit) {
  const Property& property = property_of(key);
  if (!property.is_within(value))
    refuse(MENISCUS_INPUT, "{} is {} {}; it has to be {} to {}", name, value, unit, property.lowest, property.highest);
}

namespace {

/// The process that used GL first; 0: none. In a child it is the parent, whose driver does not work there.
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

const char* meniscus_last_error(void) { return meniscus::c_api::last_error.data(); }

const char* meniscus_version(void) { return MENISCUS_VERSION; }
