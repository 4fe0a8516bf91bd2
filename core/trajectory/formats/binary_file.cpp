// SPDX-License-Identifier: BSD-3-Clause
// Reads blocks of a file as bytes of either order or as lines, and notices changes of the file.
#include "core/trajectory/formats/binary_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/uninterrupted.h"

namespace meniscus {
namespace {

constexpr std::uint64_t kTail = 4096;

std::int64_t nanoseconds(const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; }

}  // namespace

BinaryFile::BinaryFile(const std::string& path) : path_(path) {
  struct stat status {};
  // Asked before opening, because to open a pipe waits for somebody who writes to it.
  if (::stat(path.c_str(), &status) != 0)
    throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw InputError(path, 0, "is a folder; give the name of a trajectory file");
  if (!S_ISREG(status.st_mode)) throw InputError(path, 0, "is a pipe or device; save it as a file first");
  descriptor_ = uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); });
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(error));
  }
  size_ = current_size_ = static_cast<std::uint64_t>(status.st_size);
  modified_ = current_modified_ = nanoseconds(status.st_mtim);
  try {
    if (size_ == 0) throw InputError(path, 0, "is empty: no frames");
    tail_ = last_bytes();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

BinaryFile::~BinaryFile() { ::close(descriptor_); }

void BinaryFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (offset > size_ || bytes.size() > size_ - offset) {
    throw InputError(path_, 0,
                     fmt::format("is cut short or damaged: it ends at byte {}, but {} bytes at byte {} are needed",
                                 with_thousands(size_), with_thousands(bytes.size()), with_thousands(offset)));
  }
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset)); });
    if (count < 0)
      throw InputError(path_, 0, fmt::format("cannot be read at byte {}: {}", offset, std::strerror(errno)));
    if (count == 0) throw InputError(path_, 0, "became shorter while it was read; run again once it is complete");
    offset += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void BinaryFile::check_unchanged() {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0)
    throw InputError(path_, 0, std::string("cannot be read: ") + std::strerror(errno));
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::int64_t modified = nanoseconds(status.st_mtim);
  if (size == current_size_ && modified == current_modified_) return;
  if (size <= current_size_ || last_bytes() != tail_)
    throw InputError(path_, 0, "was changed while it was read; run again once it is complete");
  current_size_ = size;
  current_modified_ = modified;
}

std::vector<std::byte> BinaryFile::last_bytes() const {
  std::vector<std::byte> bytes(std::min(size_, kTail));
  read(size_ - bytes.size(), bytes);
  return bytes;
}

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
