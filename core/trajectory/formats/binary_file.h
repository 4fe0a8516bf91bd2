// SPDX-License-Identifier: BSD-3-Clause
// A file read at any place, which notices when somebody writes to it meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// A regular file, open for reading. What lies behind the size it had when opened is never looked at, so a simulation
/// may go on appending to it.
class BinaryFile {
 public:
  /// Throws InputError: missing, a folder, a pipe or device, unreadable, empty.
  explicit BinaryFile(const std::string& path);
  ~BinaryFile();
  BinaryFile(const BinaryFile&) = delete;
  BinaryFile& operator=(const BinaryFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< when it was opened
  /// Time of the last change when it was opened, nanoseconds since 1970.
  std::int64_t modified() const { return modified_; }

  /// Reads exactly these bytes. Throws InputError: behind the end, a fault of the disk.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

  /// Throws InputError if the file was changed since it was opened, other than by appending. To be called behind reads,
  /// before what they gave is believed.
  void check_unchanged();

 private:
  std::vector<std::byte> last_bytes() const;

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0, current_size_ = 0;
  std::int64_t modified_ = 0, current_modified_ = 0;
  std::vector<std::byte> tail_;  ///< what stands before the end, to tell appending from writing anew
};

}  // namespace meniscus
