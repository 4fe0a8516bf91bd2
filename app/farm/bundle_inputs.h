// SPDX-License-Identifier: BSD-3-Clause
// The input files of a bundle: where they come from, and their names inside.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// How a file of the user's comes into the bundle.
enum class InputTransfer {
  copy,
  link,      ///< a hard link
  reference  ///< not at all: the bundle says where it is
};

/// Collects the inputs of a bundle. Names inside are plain: letters, digits, "._-" and nothing else, so that no engine
/// has to quote them.
class BundleInputs {
 public:
  /// A file of the user's: its path inside, "inputs/NAME". The same file has one name however often it is added.
  std::string add_file(const std::filesystem::path& source);
  /// The same under a name of ours, relative to inputs/.
  std::string add_file_as(const std::string& name, const std::filesystem::path& source);
  /// A text made here, under a name of ours.
  std::string add_text(const std::string& name, std::string text);

  /// Sizes and checksums, in the order they were added. Reads every file. Throws InputError, and RequestError for a
  /// path that a bundle cannot name.
  std::vector<Input> measured(InputTransfer how) const;
  /// Throws OutputError if a file of the user's lies in this folder, which is about to be replaced.
  void refuse_within(const std::filesystem::path& folder) const;
  /// Puts them into the bundle. Throws OutputError, InputError.
  void transfer(const std::filesystem::path& folder, InputTransfer how) const;

 private:
  struct Item {
    std::string inside;
    std::filesystem::path source;  ///< empty: the text
    std::string text;
    bool is_users = false;  ///< else ours
  };
  std::string unique(const std::string& name);

  std::vector<Item> items_;
  std::set<std::string> names_;
};

}  // namespace meniscus::farm
