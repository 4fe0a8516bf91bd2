// SPDX-License-Identifier: BSD-3-Clause
// Lists that kernels append to and the loop that lets them grow, and prefix sums over such lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"

namespace meniscus {

/// Records in a buffer with room for some more. A kernel counts every record that it would append, by an atomic counter
/// that starts at count(), and writes those whose place is below capacity(). Needs a current GL context.
class AppendList {
 public:
  /// header_bytes: in front of the records, the kernel's own.
  AppendList(std::size_t record_bytes, std::uint32_t first_capacity, std::size_t header_bytes = 0)
      : record_bytes_(record_bytes), header_bytes_(header_bytes), capacity_(first_capacity) {}

  std::uint32_t count() const { return count_; }  ///< records; while their number is open, as it was before
  /// No more records than that are here: their count, or, while that is open, the capacity.
  std::uint32_t most() const { return open_ ? capacity_ : count_; }
  std::uint32_t capacity() const { return capacity_; }  ///< records that the buffer has room for, once make_room() ran
  /// Forgets all records.
  void clear() { count_ = 0, open_ = false; }
  /// Makes the buffer as large as the capacity, and keeps the records. Throws CapacityError.
  void make_room();
  /// Whether so many records, which a kernel counted, all have a place. If not the capacity grows.
  bool fits(std::uint32_t counted);
  /// Takes the kernel's count, which fits.
  void settle(std::uint32_t counted) { last_ = count_ = counted, open_ = false; }
  /// A kernel appends whose count the host learns later, no more records than it last had and some room.
  void leave_open() {
    capacity_ = last_ + last_ / 8 + 64;
    open_ = true;
  }
  /// Replaces all records by those that the host has; there is room for no others.
  template <typename Record>
  void upload(const std::vector<Record>& records) {
    clear();
    capacity_ = static_cast<std::uint32_t>(records.size());
    make_room();
    append(std::span<const Record>(records));
  }
  /// Appends records that the host has.
  template <typename Record>
  void append(std::span<const Record> records) {
    append_bytes(std::as_bytes(records), static_cast<std::uint32_t>(records.size()));
  }

  Buffer buffer;  ///< header and records

 private:
  void append_bytes(std::span<const std::byte> bytes, std::uint32_t count);

  std::size_t record_bytes_, header_bytes_;
  std::uint32_t count_ = 0;
  std::uint32_t capacity_;
  std::uint32_t last_ = 0;  ///< count when it was settled last
  bool open_ = false;
};

/// Runs kernels that append to `lists`, again and again until every record has its place. Before each run the lists
/// make room, and `counters` gets a word for each of `counted`: first what each list holds, then zeros. After the last
/// one `counted` holds what the kernels made of them. Throws CapacityError, GpuError.
void append_all(std::initializer_list<AppendList*> lists, Buffer& counters, std::span<std::uint32_t> counted,
                const std::function<void()>& run);

/// Runs them once, on empty lists that have the room that they needed last time and some more. The counts are open
/// until settle_all(). Throws CapacityError, GpuError.
void append_later(std::initializer_list<AppendList*> lists, Buffer& counters, std::span<std::uint32_t> counted,
                  const std::function<void()>& run);

/// Takes the words of `counters` once they have been read back; false if some record had no place.
bool settle_all(std::initializer_list<AppendList*> lists, std::span<const std::uint32_t> counted);

/// How invocations share a sum; the result is the same.
enum class ScanKind {
  serial,   ///< kernel "parallel/scan": each adds up a chunk by itself, as suits software GL
  parallel  ///< kernel "parallel/block_scan": groups add up together, as suits a GPU
};

/// Both kernels and their scratch memory. Needs a current GL context.
class PrefixSum {
 public:
  /// kind: that which suits the device, if not set.
  explicit PrefixSum(ProgramCache& programs, std::optional<ScanKind> kind = {}) : programs_(programs), kind_(kind) {}

  /// Replaces each of the first `count` words by the sum of those before it; words[count] becomes the sum of all.
  /// `words` holds count + 1 words. No sum gets larger than `limit`: places in a list that has no more room.
  void operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit = ~0u);

 private:
  ProgramCache& programs_;
  std::optional<ScanKind> kind_;
  Buffer totals_;
};

}  // namespace meniscus
