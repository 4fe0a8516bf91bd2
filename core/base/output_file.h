// SPDX-License-Identifier: BSD-3-Clause
// Files that appear under their final name complete or not at all: written beside it, synced, then renamed.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// What to do when the target is already there.
enum class Existing { refuse, replace };

/// One output file. Bytes go to a temporary file in the target's folder; commit() makes it the target, and a file that
/// is never committed vanishes. A symbolic link at the target is replaced, never followed.
/// Throws OutputError: target exists (Existing::refuse), is an input (protect_input) or no regular file, folder missing
/// or not writable, disk full.
class OutputFile {
 public:
  OutputFile(std::filesystem::path target, Existing existing);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends bytes.
  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);
  /// Replaces bytes at the beginning, of which so many must have been written: for what is known at the end only.
  void rewrite_beginning(std::span<const std::byte> bytes);

  /// For programs that open files by name: write here instead of calling write(). Ends in the target's extension.
  const std::filesystem::path& temporary_path() const { return temporary_; }
  const std::filesystem::path& target() const { return target_; }

  /// Brings the bytes to the disk and gives the file its final name. Call once, last.
  void commit();

 private:
  friend class OutputFolder;
  void sync();
  void rename_to_target();
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  Existing existing_;
  int descriptor_ = -1;
  bool replaced_ = false;
};

/// From now on no output of this process replaces this file, whatever name leads to it: hard and symbolic links too.
/// Nothing happens if there is no such file.
void protect_input(const std::filesystem::path& path);

/// Makes the folders that a file lies in, if they are missing. Throws OutputError.
void make_folders_of(const std::filesystem::path& file);

/// Before long work: throws what an OutputFile of this target would, which is made and vanishes again.
void check_output(const std::filesystem::path& target, Existing existing);

/// Several files that belong together, in one folder that is made when missing. No file appears before all are
/// complete; if a step fails, the files that appeared newly are taken away again, and the folder if it was made here.
class OutputFolder {
 public:
  OutputFolder(std::filesystem::path folder, Existing existing);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Begins a file of this plain name (no slash). The reference lives as long as the folder.
  OutputFile& file(const std::string& name);
  const std::filesystem::path& path() const { return folder_; }

  /// Syncs all files, then renames them in the order they were begun: begin the one that users open last.
  void commit();

 private:
  void remove_created_folders();

  std::filesystem::path folder_;
  Existing existing_;
  std::vector<std::filesystem::path> created_folders_;
  std::vector<std::unique_ptr<OutputFile>> files_;
  bool committed_ = false;
};

/// Deletes the temporary files of all outputs that are not committed yet, and the empty folders made for them: for a
/// program that ends otherwise than by its own will. Signal handlers may call it: it needs no memory, and waits for
/// others a second at most.
void remove_unfinished_outputs() noexcept;

struct SharedFile {
  std::string name;  ///< plain, in the folder
  std::string text;
};

/// Files that are there with just this text stay; the others are written, all or none. Throws OutputError, with
/// Existing::refuse also for a file of another text.
void write_shared_files(const std::filesystem::path& folder, Existing existing, std::span<const SharedFile> files);

}  // namespace meniscus
