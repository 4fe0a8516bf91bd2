// SPDX-License-Identifier: BSD-3-Clause
// Loads blocks that begin with the line that did not fit into the block before.
#include "core/trajectory/formats/file_lines.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace meniscus {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

}  // namespace

void FileLines::seek(std::uint64_t offset) {
  if (offset >= block_begin_ && offset <= block_begin_ + block_.size()) {
    used_ = static_cast<std::size_t>(offset - block_begin_);
    return;
  }
  block_.clear();
  block_begin_ = offset;
  used_ = 0;
}

bool FileLines::next(std::string_view& line) {
  begin_ = block_begin_ + used_;
  if (begin_ == file_.size()) return false;
  const char* end = find_end();
  if (!end && block_begin_ + block_.size() < file_.size()) {
    load(begin_);
    end = find_end();
  }
  const std::size_t length = (end ? static_cast<std::size_t>(end - block_.data()) : block_.size()) - used_;
  line = std::string_view(block_).substr(used_, length);
  used_ += length + (end ? 1 : 0);
  return true;
}

const char* FileLines::find_end() const {
  return static_cast<const char*>(std::memchr(block_.data() + used_, '\n', block_.size() - used_));
}

void FileLines::load(std::uint64_t offset) {
  block_.resize(std::min<std::uint64_t>(kBlock, file_.size() - offset));
  file_.read(offset, std::as_writable_bytes(std::span(block_)));
  block_begin_ = offset;
  used_ = 0;
}

std::string_view without_return(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace meniscus
