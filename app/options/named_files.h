// SPDX-License-Identifier: BSD-3-Clause
// The files that a command names: what it reads is never replaced, and no two outputs are the same file.
#pragma once

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

  /// Throws UsageError for two outputs that are the same file.
  void check() const;

 private:
  std::vector<std::pair<std::string, std::string>> outputs_;  ///< option, path
};

}  // namespace meniscus
