// SPDX-License-Identifier: BSD-3-Clause
// The input files of a bundle: where they come from, and their names inside.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// Collects the inputs of a bundle. Names inside are plain: letters, digits, "._-" and nothing else.
class BundleInputs {
 public:
  /// by_reference: files of the user's stay where they are.
  explicit BundleInputs(bool by_reference) : by_reference_(by_reference) {}

  /// A file of the user's: its path for a command that runs in the bundle. The same file has one name however often it
  /// is added. Throws InputError.
  std::string add_file(const std::filesystem::path& source);
  /// A file of the program's, under a name relative to inputs/.
  void add_own_file(const std::string& name, const std::filesystem::path& source);
  /// A text made here, under a name of ours: its path inside.
  std::string add_text(const std::string& name, std::string text);

  /// Sizes and checksums, in the order they were added. Reads every file. Throws InputError.
  std::vector<Input> measured() const;
  /// Throws OutputError if a file of the user's lies in this folder, which is about to be replaced.
  void refuse_within(const std::filesystem::path& folder) const;
  /// Copies what does not stay where it is. Throws OutputError, InputError.
  void copy_to(const std::filesystem::path& folder) const;

 private:
  struct Item {
    std::string path;              ///< in the bundle; absolute: it stays there
    std::filesystem::path source;  ///< empty: the text
    std::string text;
    bool is_users = false;  ///< else ours
  };
  std::string unique(const std::string& name);

  bool by_reference_;
  std::vector<Item> items_;
  std::set<std::string> names_;
};

}  // namespace meniscus::farm
