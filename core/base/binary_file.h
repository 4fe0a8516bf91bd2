// SPDX-License-Identifier: BSD-3-Clause
// A file of any size read at any place, as bytes or as lines, which notices when someone writes to it meanwhile.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// What a file is read for; messages say so.
enum class Contents { atoms, frames };

/// A regular file, open for reading. What lies behind the size it had when opened is never looked at, so a simulation
/// may go on appending to it.
class BinaryFile {
 public:
  /// Throws InputError: missing, a folder, a pipe or device, unreadable, empty.
  explicit BinaryFile(const std::string& path, Contents contents = Contents::frames);
  ~BinaryFile();
  BinaryFile(const BinaryFile&) = delete;
  BinaryFile& operator=(const BinaryFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< when it was opened
  /// Time of the last change when it was opened, in nanoseconds; for comparing.
  std::int64_t modified() const { return modified_; }

  /// Reads exactly these bytes. Throws InputError: after the end, a fault of the disk.
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
  std::vector<std::byte> tail_;  ///< what is before the end, to tell appending from writing again
};

/// The number that is at `bytes`, which need not be aligned.
template <typename Number>
Number number_at(const std::byte* bytes, std::endian order) {
  std::array<std::byte, sizeof(Number)> copy;
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

/// Goes through the lines of a file from its beginning, or from where seek() says.
class FileLines {
 public:
  /// The file must outlive this object.
  explicit FileLines(const BinaryFile& file) : file_(file) {}

  /// The next line begins at this offset. What of the block lies behind it stays.
  void seek(std::uint64_t offset);
  /// The next line without its end; false after the last one. A line longer than a block is given in pieces. It holds
  /// until the next call. Throws InputError as BinaryFile::read.
  bool next(std::string_view& line);

  std::uint64_t begin() const { return begin_; }                 ///< offset of the line last given
  std::uint64_t behind() const { return block_begin_ + used_; }  ///< offset behind it and its end
  bool ended_by_newline() const { return used_ > 0 && block_[used_ - 1] == '\n'; }

 private:
  const char* find_end() const;
  void load(std::uint64_t offset);

  const BinaryFile& file_;
  std::string block_;
  std::uint64_t block_begin_ = 0, begin_ = 0;
  std::size_t used_ = 0;
};

/// The line without the CR of CR LF.
std::string_view without_return(std::string_view line);

/// "; 1ubq is a PDB code, not a file; download ..." for a word that looks like a code of the PDB, else empty.
std::string advice_on_pdb_code(std::string_view word);

}  // namespace meniscus
