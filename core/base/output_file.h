// SPDX-License-Identifier: BSD-3-Clause
// Output files that appear under their final name complete or not at all: a temporary file is written, synced and
// renamed; and temporary files that vanish with the program, whatever ends it.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// The action if the target exists already.
enum class Existing { refuse, replace };

/// An output file. Its bytes go to a temporary file in the folder of the target, and commit() renames that to the
/// target. A file that is never committed is deleted. A symbolic link at the target is replaced, never followed.
/// Throws OutputError if the target exists (Existing::refuse), is an input (protect_input) or is no regular file, if
/// its folder is missing or not writable, and if the disk is full.
class OutputFile {
 public:
  OutputFile(std::filesystem::path target, Existing existing);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends bytes to the file.
  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);
  /// Overwrites the beginning of the file, for a header that is known at the end only. So many bytes must have been
  /// written.
  void rewrite_beginning(std::span<const std::byte> bytes);

  /// Returns the path of the temporary file, for programs that write a file by name instead of by write(). It has the
  /// extension of the target.
  const std::filesystem::path& temporary_path() const { return temporary_; }
  const std::filesystem::path& target() const { return target_; }

  /// Syncs the file and gives it its final name. It must be called once, after everything else.
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
  bool has_replaced_ = false;
};

/// Protects a file from being replaced by any output of this process, by whatever name, including hard and symbolic
/// links. A missing file is ignored.
void protect_input(const std::filesystem::path& path);

/// Makes the missing folders on the path to a file. Throws OutputError.
void make_folders_of(const std::filesystem::path& file);

/// Throws what an OutputFile of this target would throw, before long work begins, by making a temporary file.
void check_output(const std::filesystem::path& target, Existing existing);

/// Several output files that belong together, in one folder that is made if missing. No file appears before all are
/// complete. If a step fails, new files are deleted, and so is the folder if it was made here.
class OutputFolder {
 public:
  OutputFolder(std::filesystem::path folder, Existing existing);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Begins a file with this plain name, which has no slash. The reference is valid as long as the folder.
  OutputFile& file(const std::string& name);
  const std::filesystem::path& path() const { return folder_; }

  /// Syncs all files, then renames them in the order of their begin. The file that users open should be begun last.
  void commit();

 private:
  void remove_created_folders();

  std::filesystem::path folder_;
  Existing existing_;
  std::vector<std::filesystem::path> created_folders_;
  std::vector<std::unique_ptr<OutputFile>> files_;
  bool is_committed_ = false;
};

/// Deletes the temporary files of all outputs that are not committed yet, and the empty folders made for them. It is
/// meant for programs that are ended from outside. Signal handlers may call it: it allocates no memory, and it waits
/// for other threads for a second at most.
void remove_unfinished_outputs() noexcept;

struct SharedFile {
  std::string name;  ///< name without a folder
  std::string text;
};

/// Writes these files into a folder, all or none of them. A file that exists with the same text is left alone. Throws
/// OutputError, with Existing::refuse also for an existing file with another text.
void write_shared_files(const std::filesystem::path& folder, Existing existing, std::span<const SharedFile> files);

/// A temporary file at a given path. It is deleted with this object, or by remove_unfinished_outputs(). The constructor
/// makes it empty. Throws OutputError if the path exists already, or if the file cannot be made.
class ScratchFile {
 public:
  explicit ScratchFile(std::filesystem::path path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace meniscus
