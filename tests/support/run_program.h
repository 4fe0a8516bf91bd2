// SPDX-License-Identifier: BSD-3-Clause
// Runs the program under test as a user would, and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus::test {

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal if a signal ended it; 124 if it ran past the time limit
  std::string out;
  std::string err;
};

/// Runs `program` with arguments, no shell between. It is killed after `limit_seconds`.
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          int limit_seconds = 60);

/// A fresh folder that vanishes with this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file of this name and returns its path.
  std::string file(const std::string& name, std::string_view content) const;
  /// Names of all entries, sorted.
  std::vector<std::string> entries() const;

 private:
  std::filesystem::path path_;
};

/// The bytes as one gzip member.
std::string gzipped(std::string_view bytes);

/// The content of a file; fails the test if it cannot be read.
std::string read_bytes(const std::filesystem::path& path);

}  // namespace meniscus::test
