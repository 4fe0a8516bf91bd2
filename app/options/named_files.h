// SPDX-License-Identifier: BSD-3-Clause
// The files that a command names: what it reads is never replaced, and no two outputs are the same file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace meniscus {

/// Before a command begins whose options are parsed.
class NamedFiles {
 public:
  /// Those of its options.
  explicit NamedFiles(const CLI::App& command);

  /// A file, or a bundle with all its files, that no output replaces.
  void read(const std::string& path);
  void write(const std::string& option, const std::string& path);

  /// Throws OutputError for an output that is read, and UsageError for two outputs that are the same file, or would be
  /// in some frame of a run.
  void check() const;

 private:
  void protect(const std::filesystem::path& path);

  std::set<std::pair<std::uint64_t, std::uint64_t>> inputs_;  ///< as system_file::State has them
  std::vector<std::pair<std::string, std::string>> outputs_;  ///< option, path
};

}  // namespace meniscus
