// SPDX-License-Identifier: BSD-3-Clause
// Reads blocks and lines of a file, and detects changes of the file.
#include "core/base/binary_file.h"

#include <cctype>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

constexpr std::uint64_t kTail = 4096;

using system_file::State;

[[noreturn]] void unreadable(const std::string& path, int error) {
  throw InputError(
      path, 0,
      std::string("cannot be read: ") + std::strerror(error) + (error == ENOENT ? advice_on_pdb_code(path) : ""));
}

}  // namespace

std::string advice_on_pdb_code(std::string_view word) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  if (word.size() != 4 || word[0] < '1' || word[0] > '9' || !std::ranges::all_of(word, is_letter)) return "";
  return fmt::format("; {0} is a PDB code, not a file; download https://files.rcsb.org/download/{0}.cif.gz first",
                     word);
}

BinaryFile::BinaryFile(const std::string& path, Contents contents) : path_(path) {
  const bool atoms = contents == Contents::atoms;
  const std::filesystem::path file = path_of_text(path);
  // The kind is looked up before opening, because opening a pipe waits for a process that writes to it.
  std::optional<State> state = system_file::state_of(file);
  if (!state) unreadable(path, errno);
  if (state->kind == State::Kind::folder)
    throw InputError(path, 0, "is a folder; give the name of a {} file", atoms ? "molecule" : "trajectory");
  if (state->kind != State::Kind::file)
    throw InputError(path, 0, "is a pipe or device; save it as a file first{}",
                     atoms ? ", or give - to read standard input" : "");
  descriptor_ = system_file::open_to_read(file);
  if (descriptor_ < 0 || !(state = system_file::state_of(descriptor_))) {
    const int error = errno;
    if (descriptor_ >= 0) system_file::close(descriptor_);
    unreadable(path, error);
  }
  size_ = current_size_ = state->size;
  modified_ = current_modified_ = state->modified;
  try {
    if (size_ == 0) throw InputError(path, 0, "is empty: no {}", atoms ? "atoms" : "frames");
    tail_ = last_bytes();
  } catch (...) {
    system_file::close(descriptor_);
    throw;
  }
}

BinaryFile::~BinaryFile() { system_file::close(descriptor_); }

void BinaryFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (offset > size_ || bytes.size() > size_ - offset)
    throw InputError(path_, 0, "is cut short or damaged: it ends at byte {}, but {} bytes at byte {} are needed",
                     with_thousands(size_), with_thousands(bytes.size()), with_thousands(offset));
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system_file::read_at(descriptor_, bytes.data(), bytes.size(), offset);
    if (count < 0) throw InputError(path_, 0, "cannot be read at byte {}: {}", offset, std::strerror(errno));
    if (count == 0) throw InputError(path_, 0, "became shorter while it was read; run again once it is complete");
    offset += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void BinaryFile::check_unchanged() {
  const std::optional<State> state = system_file::state_of(descriptor_);
  if (!state) unreadable(path_, errno);
  const std::uint64_t size = state->size;
  const std::int64_t modified = state->modified;
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
