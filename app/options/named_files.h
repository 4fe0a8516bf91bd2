// SPDX-License-Identifier: BSD-3-Clause
// Files that a command line names: numbered outputs, and outputs that would replace inputs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace meniscus {

class NumberedPath {
 public:
  /// The last run of # in the file's name stands for the number. Nothing if there is none.
  static std::optional<NumberedPath> parse(const std::string& path);

  /// With zeros before the number, at least as many digits as there are #.
  std::string at(std::uint64_t number) const;
  /// Whether at() gives this path for some number.
  bool names(std::string_view path) const;

 private:
  std::string before_, behind_;
  std::size_t digits_ = 0;
};

/// The path with "_#####" before its ending, to be proposed.
std::string numbered_name(const std::string& path);

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
