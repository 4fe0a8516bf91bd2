// SPDX-License-Identifier: BSD-3-Clause
// Files of any size, read at any offset as bytes or as lines. Changes of a file while it is read are noticed.
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

/// The contents that a file should have, which error messages name.
enum class Contents { atoms, frames };

/// A regular file, open for reading. Bytes beyond the size that it had when opened are never read, so that a simulation
/// may go on appending to it.
class BinaryFile {
 public:
  /// Opens the file. Throws InputError if it is missing, a folder, a pipe or device, unreadable or empty.
  explicit BinaryFile(const std::string& path, Contents contents = Contents::frames);
  ~BinaryFile();
  BinaryFile(const BinaryFile&) = delete;
  BinaryFile& operator=(const BinaryFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< bytes, when it was opened
  /// Returns the time of the last change when the file was opened, in nanoseconds, for comparing only.
  std::int64_t modified() const { return modified_; }

  /// Reads exactly these bytes. Throws InputError if they reach beyond the end, or for an error of the disk.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

  /// Throws InputError if the file was changed since it was opened, other than by appending. It has to be called after
  /// reading and before the data is used.
  void check_unchanged();

 private:
  std::vector<std::byte> last_bytes() const;

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0, current_size_ = 0;
  std::int64_t modified_ = 0, current_modified_ = 0;
  std::vector<std::byte> tail_;  ///< bytes before the end, which distinguish appending from writing again
};

/// Returns the number at `bytes`, which need not be aligned, in the byte order `order`.
template <typename Number>
Number number_at(const std::byte* bytes, std::endian order) {
  std::array<std::byte, sizeof(Number)> copy;
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

/// Reads the lines of a file one after another from its beginning, or from the offset of seek().
class FileLines {
 public:
  /// Begins at the first line. The file must outlive this object.
  explicit FileLines(const BinaryFile& file) : file_(file) {}

  /// Sets the offset at which the next line begins. A block in memory that contains this offset is kept.
  void seek(std::uint64_t offset);
  /// Reads the next line without its line end; false after the last one. A line that is longer than a block comes in
  /// pieces. The line is valid until the next call. Throws InputError as BinaryFile::read.
  bool next(std::string_view& line);

  std::uint64_t begin() const { return begin_; }  ///< offset of the last line read
  std::uint64_t next_offset() const {
    return block_begin_ + used_;
  }  ///< offset after the last line read and its line end
  bool ended_by_newline() const { return used_ > 0 && block_[used_ - 1] == '\n'; }

 private:
  const char* find_end() const;
  void load(std::uint64_t offset);

  const BinaryFile& file_;
  std::string block_;
  std::uint64_t block_begin_ = 0, begin_ = 0;
  std::size_t used_ = 0;
};

/// Returns the line without the CR of CR LF.
std::string_view without_return(std::string_view line);

/// Returns "; 1ubq is a PDB code, not a file; download ..." for a word that looks like a PDB code, else an empty text.
std::string advice_on_pdb_code(std::string_view word);

}  // namespace meniscus
