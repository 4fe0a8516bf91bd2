// SPDX-License-Identifier: BSD-3-Clause
// The lines of a file of any size, of which a block is in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/trajectory/formats/binary_file.h"

namespace meniscus {

/// Goes through the lines of a file from its beginning, or from where seek() says.
class FileLines {
 public:
  /// The file must outlive this object.
  explicit FileLines(const BinaryFile& file) : file_(file) {}

  /// The next line begins at this offset. What of the block lies behind it stays.
  void seek(std::uint64_t offset);
  /// The next line without its end; false behind the last one. A line longer than a block is given in pieces. It holds
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

}  // namespace meniscus
