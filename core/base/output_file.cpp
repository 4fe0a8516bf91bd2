// SPDX-License-Identifier: BSD-3-Clause
// Writes temporary files, syncs and renames them, and deletes those that were never committed.
#include "core/base/output_file.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <thread>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using system_file::State;

std::string reason(int error) { return std::strerror(error); }

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// The files that protect_input() protects. It may be used by several threads.
class Inputs {
 public:
  void add(const State& state) {
    const std::lock_guard lock(mutex_);
    files_.insert(state.identity);
  }
  bool has(const State& state) {
    const std::lock_guard lock(mutex_);
    return files_.contains(state.identity);
  }

 private:
  std::mutex mutex_;
  std::set<decltype(State::identity)> files_;
};

Inputs& inputs() {
  static Inputs all;
  return all;
}

void refuse_unsuitable_target(const fs::path& target, Existing existing) {
  const std::string text = text_of_path(target);
  if (target.filename().empty()) throw OutputError(text, "is not the name of a file");
  if (const std::optional<State> state = system_file::state_of(target); state && inputs().has(*state))
    throw OutputError(text, "is one of the files that this command reads; choose another name");
  const std::optional<State> state = system_file::state_of_entry(target);
  if (!state) return;
  if (state->kind == State::Kind::folder) throw OutputError(text, "is a folder; give the name of a file");
  if (state->kind == State::Kind::other) throw OutputError(text, "is not a regular file");
  if (existing == Existing::refuse) throw OutputError(text, message("exists already; use @force@ to replace it"));
}

/// The temporary files of this process that have not been renamed yet, and the folders made for them, newest first.
/// Nothing under the lock allocates memory or takes another lock, so that a signal handler may walk the list.
class Unfinished {
 public:
  /// Calls `make`, which makes a file or folder at this path, and notes the path if it returns true. Both happen under
  /// one lock, so that nothing is made after unlink_all().
  template <typename Make>
  void add(const fs::path& path, const Make& make) {
    auto entry = std::make_unique<Entry>(Entry{path, nullptr});
    lock();
    if (make()) {
      entry->older = newest_;
      newest_ = entry.release();
    }
    unlock();
  }
  void remove(const fs::path& path) noexcept {
    lock();
    Entry** place = &newest_;
    while (*place && (*place)->path.native() != path.native()) place = &(*place)->older;
    const std::unique_ptr<Entry> found(*place);
    if (found) *place = found->older;
    unlock();
  }
  /// Deletes all files and folders of the list. A file is newer than its folder and therefore goes first. A folder that
  /// contains files of others stays. The lock is kept, because the program ends.
  void unlink_all() noexcept {
    // The program may be ending because of an error while it held this very lock.
    constexpr int kMostWaits = 1000;
    for (int waits = 0; locked_.test_and_set(std::memory_order_acquire); ++waits) {
      if (waits == kMostWaits) return;
      system_file::wait_a_millisecond();
    }
    for (const Entry* entry = newest_; entry; entry = entry->older) system_file::remove(entry->path);
  }

  void lock() noexcept {
    while (locked_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
  }
  void unlock() noexcept { locked_.clear(std::memory_order_release); }

 private:
  struct Entry {
    fs::path path;
    Entry* older;
  };

  std::atomic_flag locked_;
  Entry* newest_ = nullptr;
};

constinit Unfinished unfinished;

}  // namespace

void remove_unfinished_outputs() noexcept { unfinished.unlink_all(); }

OutputFile::OutputFile(fs::path target, Existing existing) : target_(std::move(target)), existing_(existing) {
  refuse_unsuitable_target(target_, existing_);
  static std::atomic<unsigned> serial{0};
  // The name is made unique here instead of by mkstemp(), whose mode 0600 the renamed file would keep.
  int error = EEXIST;
  for (int attempt = 0; descriptor_ < 0 && error == EEXIST && attempt < 1000; ++attempt) {
    temporary_ = folder_of(target_) /
                 path_of_text(fmt::format(".{}.{}-{}.part{}", text_of_path(target_.stem()), system_file::process_id(),
                                          serial++, text_of_path(target_.extension())));
    unfinished.add(temporary_, [&] {
      descriptor_ = system_file::create(temporary_);
      error = errno;
      return descriptor_ >= 0;
    });
  }
  if (descriptor_ >= 0) return;
  temporary_.clear();
  fail(fmt::format("cannot be written in {}: {}", text_of_path(folder_of(target_)), reason(error)));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) system_file::close(descriptor_);
  if (temporary_.empty()) return;
  system_file::remove(temporary_);
  unfinished.remove(temporary_);
}

void OutputFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t written = system_file::write(descriptor_, bytes.data(), bytes.size());
    if (written <= 0) fail("cannot be written: " + reason(written < 0 ? errno : ENOSPC));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::rewrite_beginning(std::span<const std::byte> bytes) {
  for (std::uint64_t at = 0; !bytes.empty();) {
    const std::ptrdiff_t written = system_file::write_at(descriptor_, bytes.data(), bytes.size(), at);
    if (written <= 0) fail("cannot be written: " + reason(written < 0 ? errno : ENOSPC));
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

void OutputFile::sync() {
  if (descriptor_ >= 0 && !system_file::close(std::exchange(descriptor_, -1)))
    fail("cannot be written: " + reason(errno));
  // The file is synced by its name, not by the descriptor, because a program may have replaced the temporary file.
  if (!system_file::state_of(temporary_)) fail("vanished while it was written: " + reason(errno));
  if (!system_file::sync(temporary_)) fail("cannot be written: " + reason(errno));
}

void OutputFile::rename_to_target() {
  has_replaced_ = system_file::state_of_entry(target_).has_value();
  if (existing_ == Existing::refuse) {
    refuse_unsuitable_target(target_, existing_);
    if (!system_file::rename_to_free(temporary_, target_)) {
      const int error = errno;
      refuse_unsuitable_target(target_, existing_);
      fail("cannot be renamed to its final name: " + reason(error));
    }
  } else if (!system_file::rename_over(temporary_, target_)) {
    fail("cannot be renamed to its final name: " + reason(errno));
  }
}

void OutputFile::commit() {
  // The folder is computed first, because nothing may fail once the file has its final name.
  const fs::path folder = folder_of(target_);
  sync();
  rename_to_target();
  unfinished.remove(temporary_);
  temporary_.clear();
  system_file::sync_folder(folder);
}

void OutputFile::fail(const std::string& what) const { throw OutputError(text_of_path(target_), what); }

void protect_input(const fs::path& path) {
  const std::optional<State> state = system_file::state_of(path);
  if (state && state->kind == State::Kind::file) inputs().add(*state);
}

void make_folders_of(const fs::path& file) {
  std::error_code error;
  fs::create_directories(folder_of(file), error);
  if (error) throw OutputError(text_of_path(folder_of(file)), "the folder cannot be made: " + error.message());
}

void check_output(const fs::path& target, Existing existing) { const OutputFile possible(target, existing); }

ScratchFile::ScratchFile(fs::path path) : path_(std::move(path)) {
  bool made = false;
  unfinished.add(path_, [&] {
    const int file = system_file::create(path_);
    return made = file >= 0 && system_file::close(file);
  });
  if (!made) throw OutputError(text_of_path(path_), "cannot be made: " + reason(errno));
}

ScratchFile::~ScratchFile() {
  system_file::remove(path_);
  unfinished.remove(path_);
}

OutputFolder::OutputFolder(fs::path folder, Existing existing) : folder_(std::move(folder)), existing_(existing) {
  if (folder_.empty()) throw OutputError("output folder", "the name is empty");
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = folder_; !path.empty() && fs::symlink_status(path, error).type() == fs::file_type::not_found;
       path = path.parent_path()) {
    if (path.has_filename()) missing.push_back(path);
  }
  std::reverse(missing.begin(), missing.end());
  try {
    created_folders_.reserve(missing.size());
    for (fs::path& path : missing) {
      bool made = false;
      unfinished.add(path, [&] { return made = fs::create_directory(path, error); });
      if (made) created_folders_.push_back(std::move(path));
      if (error) break;
    }
  } catch (...) {
    remove_created_folders();
    throw;
  }
  if (std::error_code ignored; !fs::is_directory(folder_, ignored)) {
    remove_created_folders();
    throw OutputError(text_of_path(folder_),
                      "is not a folder, and no folder can be made there" + (error ? ": " + error.message() : ""));
  }
}

OutputFolder::~OutputFolder() {
  files_.clear();
  if (is_committed_) {
    for (const fs::path& path : created_folders_) unfinished.remove(path);
  } else {
    remove_created_folders();
  }
}

void OutputFolder::remove_created_folders() {
  for (auto made = created_folders_.rbegin(); made != created_folders_.rend(); ++made) {
    system_file::remove(*made);
    unfinished.remove(*made);
  }
}

OutputFile& OutputFolder::file(const std::string& name) {
  const fs::path plain = path_of_text(name), path = folder_ / plain;
  if (plain.empty() || name == "." || name == ".." || plain != plain.filename())
    throw OutputError(text_of_path(path), "is not a plain file name");
  return *files_.emplace_back(std::make_unique<OutputFile>(path, existing_));
}

void OutputFolder::commit() {
  for (const auto& file : files_) file->sync();
  std::size_t renamed = 0;
  try {
    const std::lock_guard whole(unfinished);  // a program that ends meanwhile leaves all of the files or none
    for (; renamed < files_.size(); ++renamed) files_[renamed]->rename_to_target();
  } catch (...) {
    for (std::size_t n = 0; n < renamed; ++n) {
      if (!files_[n]->has_replaced_) system_file::remove(files_[n]->target_);
    }
    throw;
  }
  system_file::sync_folder(folder_);
  is_committed_ = true;
}

void write_shared_files(const std::filesystem::path& folder, Existing existing, std::span<const SharedFile> files) {
  const auto is_there = [&](const SharedFile& shared) {
    std::ifstream file(folder / path_of_text(shared.name), std::ios::binary);
    return file && std::string(std::istreambuf_iterator<char>(file), {}) == shared.text;
  };
  try {
    OutputFolder output(folder, existing);
    for (const SharedFile& shared : files)
      if (!is_there(shared)) output.file(shared.name).write(shared.text);
    output.commit();
  } catch (const OutputError&) {
    if (!std::ranges::all_of(files, is_there)) throw;  // another process has written them if they are there
  }
}

}  // namespace meniscus
