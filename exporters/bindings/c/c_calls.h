// SPDX-License-Identifier: BSD-3-Clause
// The common part of the functions of the C interface: errors as status codes, checks of the caller's memory, reference
// counts of the objects behind handles, and the device, the CPU threads and the thread with a GL context that compute.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>
#include <sys/types.h>
#include <tbb/task_arena.h>

#include "core/base/version.h"
#include "core/gpu/device_choice.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

// ---- Errors

/// A call with invalid arguments. It becomes the status and the message of the call.
class Refusal : public std::runtime_error {
 public:
  Refusal(meniscus_status status, const std::string& text) : std::runtime_error(text), status_(status) {}
  meniscus_status status() const { return status_; }

 private:
  meniscus_status status_;
};

/// Throws a Refusal with a formatted message.
template <typename... Values>
[[noreturn]] void refuse(meniscus_status status, fmt::format_string<Values...> text, const Values&... values) {
  throw Refusal(status, fmt::vformat(fmt::string_view(text), fmt::make_format_args(values...)));
}

/// Stores the message of an exception for meniscus_last_error() in this thread, and returns its status.
meniscus_status report(const std::exception_ptr& error) noexcept;

/// Calls a function, and returns the status of its exception. Each function that can fail is such a call.
template <typename Call>
meniscus_status guarded(const Call& call) noexcept {
  try {
    call();
    return MENISCUS_OK;
  } catch (...) {
    return report(std::current_exception());
  }
}

// ---- Memory of the caller

/// The largest size of an array in bytes, half the address space; negative or overflowing numbers exceed it.
inline constexpr std::size_t kMostBytes = std::numeric_limits<std::size_t>::max() / 2;

/// Refuses NULL, and an address that is not aligned for such an object, with MENISCUS_USAGE.
template <typename Object>
void require(const Object* pointer, const char* name) {
  if (!pointer) refuse(MENISCUS_USAGE, "{} is NULL", name);
  if constexpr (!std::is_void_v<Object>)
    if (reinterpret_cast<std::uintptr_t>(pointer) % alignof(Object) != 0)
      refuse(MENISCUS_USAGE, "{} is not aligned: its address is not a multiple of {}", name, alignof(Object));
}

/// The layout of a caller's array: `count` rows of `width` numbers of `number` bytes each. Rows begin `stride` bytes
/// after each other; 0 means that they are contiguous.
struct CallerRows {
  std::size_t count, width, number, stride = 0;
};

/// Returns the stride of the rows in bytes. Refuses an impossible array with MENISCUS_USAGE: NULL, an address or a
/// stride that is not aligned for its numbers, a stride shorter than a row, and rows that do not fit into memory. An
/// array without rows may be NULL.
std::size_t require_rows(const void* data, const CallerRows& rows, const char* name);

/// Refuses an impossible array of contiguous rows with MENISCUS_USAGE.
template <typename Number>
void require_numbers(const Number* data, std::size_t count, std::size_t width, const char* name) {
  require_rows(data, {count, width, sizeof(Number)}, name);
}

/// Refuses arrays that overlap, of which one is written while the other is read, with MENISCUS_USAGE.
void require_apart(const void* written, std::size_t written_bytes, const char* written_name, const void* read,
                   std::size_t read_bytes, const char* read_name);

/// Refuses a reserved field that is not 0 with MENISCUS_USAGE.
inline void require_zero(std::int32_t reserved, const char* name) {
  if (reserved != 0) refuse(MENISCUS_USAGE, "{} is {}; it has to be 0", name, reserved);
}

/// Refuses a number outside of the range of a property with MENISCUS_INPUT. key: the property's key. name, unit: the
/// words of the message, as in "tolerance is 2 Å".
void check_number(std::string_view key, const char* name, double value, const char* unit);

/// Refuses a number that is outside of a range, or NaN, with MENISCUS_INPUT.
inline void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    refuse(MENISCUS_INPUT, "{} is {}; it has to be {} to {}", name, value, low, high);
}

/// The largest size of a caller's struct in bytes, in any version. A struct is also larger than its field `size`.
inline constexpr std::size_t kLargestStruct = 4096;

inline void check_size(std::size_t size, const char* name) {
  if (size <= sizeof(std::size_t) || size > kLargestStruct)
    refuse(MENISCUS_USAGE, "{}.size is {}; set it to sizeof({})", name, size, name);
}

/// Returns a copy of the caller's struct. Fields that the caller's version does not have are those of `defaults`.
/// Refuses fields that this library does not know, unless they are zero, with MENISCUS_USAGE.
template <typename Struct>
Struct read_struct(const Struct* given, const Struct& defaults, const char* name) {
  require(given, name);
  check_size(given->size, name);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
  if (given->size > sizeof(Struct) &&
      std::any_of(bytes + sizeof(Struct), bytes + given->size, [](unsigned char byte) { return byte != 0; }))
    refuse(MENISCUS_USAGE, "{} asks for more than version {} of this library knows", name, MENISCUS_VERSION);
  Struct result = defaults;
  std::memcpy(&result, given, std::min(given->size, sizeof(Struct)));
  result.size = sizeof(Struct);
  return result;
}

/// Returns the caller's options, or the defaults if the pointer is NULL.
template <typename Struct>
Struct read_options(const Struct* given, const Struct& defaults, const char* name) {
  return given ? read_struct(given, defaults, name) : defaults;
}

/// Copies a value to the caller's struct, but for fields that the caller's version does not have.
template <typename Struct>
void write_struct(Struct* given, const Struct& value, const char* name) {
  require(given, name);
  check_size(given->size, name);
  const std::size_t size = given->size;
  std::memcpy(given, &value, std::min(size, sizeof(Struct)));
  given->size = size;
}

/// Returns a view of rows.
template <typename Row>
meniscus_array table_of(const std::vector<Row>& rows) {
  return {rows.data(), rows.size(), sizeof(Row)};
}

// ---- Handles

/// A reference count, with which an object begins at 1.
class Counted {
 public:
  void retain() noexcept { references_.fetch_add(1, std::memory_order_relaxed); }
  /// Returns true if that was the last reference.
  bool remove_reference() noexcept { return references_.fetch_sub(1, std::memory_order_acq_rel) == 1; }
  /// Returns true if the caller has the only reference.
  bool has_one_reference() const noexcept { return references_.load(std::memory_order_acquire) == 1; }

 private:
  std::atomic<std::uint32_t> references_{1};
};

/// Adds a reference, and returns the object. NULL is allowed.
template <typename Object>
Object* retain(Object* object) noexcept {
  if (object) object->retain();
  return object;
}

/// Removes a reference, and deletes the object with the last one. NULL is allowed.
template <typename Object>
void release(Object* object) noexcept {
  if (object && object->remove_reference()) delete object;
}

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

/// Runs work on a number of threads; 0: all. A separate arena keeps TBB tasks of the calling program away.
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
