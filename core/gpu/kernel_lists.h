// SPDX-License-Identifier: BSD-3-Clause
// Lists that kernels append to, the loop that lets them grow, and prefix sums over such lists.
#pragma once

#include <initializer_list>

#include "core/gpu/buffer.h"
#include "core/gpu/program.h"

namespace meniscus {

/// Records in a buffer with room for more. A kernel counts every record to append, by an atomic counter that starts at
/// count(), and writes those with a place below capacity(). A GL context must be current.
class AppendList {
 public:
  /// header_bytes: the kernel's own data before the records.
  AppendList(std::size_t record_bytes, std::uint32_t first_capacity, std::size_t header_bytes = 0)
      : record_bytes_(record_bytes), header_bytes_(header_bytes), capacity_(first_capacity) {}

  std::uint32_t count() const { return count_; }  ///< number of records; while it is open, the previous number
  /// Returns an upper limit of the number of records: their count, or, while that is open, the capacity.
  std::uint32_t most() const { return open_ ? capacity_ : count_; }
  std::uint32_t capacity() const { return capacity_; }  ///< records that the buffer has room for, once make_room() ran
  void clear() { count_ = 0, open_ = false; }
  /// Makes the buffer as large as the capacity, and keeps the records. Throws CapacityError.
  void make_room();
  /// True if all records that a kernel counted have a place. If not, the capacity grows.
  bool fits(std::uint32_t counted);
  /// Sets the count that a kernel reported; it must fit.
  void set_count(std::uint32_t counted) { last_ = count_ = counted, open_ = false; }
  /// Marks the count as open: a kernel appends, and the host reads the count later, which may be somewhat above that of
  /// last time.
  void leave_open() {
    capacity_ = last_ + last_ / 8 + 64;
    open_ = true;
  }
  /// Replaces all records by records of the host; there is no room for more.
  template <typename Record>
  void upload(const std::vector<Record>& records) {
    clear();
    capacity_ = static_cast<std::uint32_t>(records.size());
    make_room();
    append(std::span<const Record>(records));
  }
  /// Appends records of the host.
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
  std::uint32_t last_ = 0;  ///< the count that was last set
  bool open_ = false;
};

/// Runs kernels that append to `lists`, again and again until every record has its place. Before each run the lists
/// make room, and `counters` gets a word for each of `counted`: first the count of each list, then zeros. After the
/// last run `counted` has the values that the kernels left. Throws CapacityError, GpuError.
void append_all(std::initializer_list<AppendList*> lists, Buffer& counters, std::span<std::uint32_t> counted,
                const std::function<void()>& run);

/// Runs the kernels once, on empty lists with the room that they needed last time and some more. The counts are open
/// until take_list_counts(). Throws CapacityError, GpuError.
void append_later(std::initializer_list<AppendList*> lists, Buffer& counters, std::span<std::uint32_t> counted,
                  const std::function<void()>& run);

/// Sets the counts from the words of `counters` that were read back; false if some record had no place.
bool take_list_counts(std::initializer_list<AppendList*> lists, std::span<const std::uint32_t> counted);

/// The way in which invocations share a sum; the result is the same.
enum class ScanKind {
  serial,   ///< kernel "parallel/scan": each invocation adds up a chunk, faster on software GL
  parallel  ///< kernel "parallel/block_scan": groups add up together, faster on a GPU
};

/// Both kernels and their scratch memory. A GL context must be current.
class PrefixSum {
 public:
  /// kind: the faster one for the device, if not set.
  explicit PrefixSum(ProgramCache& programs, std::optional<ScanKind> kind = {}) : programs_(programs), kind_(kind) {}

  /// Replaces each of the first `count` words by the sum of the words before it; words[count] becomes the sum of all.
  /// `words` has count + 1 words. No sum exceeds `limit`, the room of a list.
  void operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit = ~0u);

 private:
  ProgramCache& programs_;
  std::optional<ScanKind> kind_;
  Buffer totals_;
};

}  // namespace meniscus
