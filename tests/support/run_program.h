// SPDX-License-Identifier: BSD-3-Clause
// Runs the program under test as a user would, and keeps what it said. Where the build and the tests lie is known here
// alone: what is compiled of the other tests serves every checkout.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace meniscus::test {

/// Returns the program under test; empty where it is not built.
std::string meniscus_program();
/// Returns the path of a file in the folder tests.
std::string test_file(const std::string& name);

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal if a signal ended it; 124 if it ran past the time limit
  std::string out;
  std::string err;
};

/// Runs `program` with arguments, without a shell. It is killed after `limit_seconds`.
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          int limit_seconds = 60);

/// Returns the content of a file; fails the test if it cannot be read.
std::string read_bytes(const std::filesystem::path& path);

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
  /// Returns the names of all entries, sorted.
  std::vector<std::string> entries() const;

 private:
  std::filesystem::path path_;
};

/// Returns the bytes as one gzip member.
std::string gzipped(std::string_view bytes);

/// A program that runs while the test goes on. It is killed with this object.
class RunningProgram {
 public:
  RunningProgram(const std::string& program, const std::vector<std::string>& arguments);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Returns its output so far.
  std::string out() const { return read_bytes(folder_.path() / "out"); }
  std::string err() const { return read_bytes(folder_.path() / "err"); }
  /// Sends it SIGSTOP, SIGCONT or another signal.
  void signal(int number) const;
  /// Waits for its end and returns the result; it is killed after `limit_seconds`. Call it once.
  ProgramResult finish(int limit_seconds = 60);

 private:
  TemporaryFolder folder_;
  pid_t child_ = -1;
};

}  // namespace meniscus::test
