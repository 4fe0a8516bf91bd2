// SPDX-License-Identifier: BSD-3-Clause
// A fuzz target: a name, and a function that accepts any bytes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace meniscus::fuzz {

/// A name and a function that returns for all bytes after its checks; it throws PropertyError where a check fails, and
/// lets through exceptions that the product should not have thrown.
struct Target {
  const char* name;
  void (*run)(std::string_view bytes);
};

/// The targets linked into this program, by name.
std::span<const Target> targets();

/// Makes a target known: `const Registration registered_pdb{"pdb", run_pdb};` in its file.
struct Registration {
  Registration(const char* name, void (*run)(std::string_view bytes));
};

/// Reports a property that does not hold.
class PropertyError : public std::exception {
 public:
  explicit PropertyError(std::string what) : what_(std::move(what)) {}
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

/// Throws PropertyError unless the property holds.
void require(bool holds, const char* property);

/// Checks that an error's message suits one line of a terminal: not empty, no control characters but the line end
/// before a caret.
void require_clear(const std::exception& error);

/// A file in a folder of its own, which vanishes with the process, for functions that want a path.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Gives the file this content and returns its path.
  const std::string& write(std::string_view bytes) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::string path_;
};

}  // namespace meniscus::fuzz
