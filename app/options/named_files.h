// SPDX-License-Identifier: BSD-3-Clause
// Files on a command line: numbered outputs, outputs that would replace inputs, and storyboards, which are JSON files
// with the scenes and times of a film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace meniscus {

/// The path of numbered files, with # instead of digits.
class NumberedPath {
 public:
  /// Parses a path in whose file name the last run of # represents the number. Returns nothing if there is no #.
  static std::optional<NumberedPath> parse(const std::string& path);

  /// Returns the path of a number. Leading zeros give it at least as many digits as there are #.
  std::string at(std::uint64_t number) const;
  /// Returns true if at() returns this path for some number.
  bool names(std::string_view path) const;

 private:
  std::string before_, behind_;
  std::size_t digits_ = 0;
};

/// Returns the path with "_#####" before its suffix, as a proposal for users.
std::string numbered_name(const std::string& path);

/// The files that a command reads and writes, checked before it begins.
class NamedFiles {
 public:
  /// Adds the files of the command's options, which must be parsed.
  explicit NamedFiles(const CLI::App& command);

  /// Adds a file, or a bundle with all its files, that no output may replace.
  void read(const std::string& path);
  void write(const std::string& option, const std::string& path);

  /// Throws OutputError for an output that is also read, and UsageError for two outputs that are the same file or would
  /// be the same in some frame of a run.
  void check() const;

 private:
  void protect(const std::filesystem::path& path);

  std::set<std::pair<std::uint64_t, std::uint64_t>> inputs_;  ///< identities of files: system_file::State
  std::vector<std::pair<std::string, std::string>> outputs_;  ///< option and path
};

/// The content of a storyboard file.
struct StoryboardFile {
  std::vector<std::string> scenes;       ///< the JSON of each scene, as scene_text() returns it
  std::vector<double> hold, transition;  ///< seconds of each, or one number for all; empty: the defaults of the film
};

/// Returns the text of a storyboard file, ending with a newline.
std::string storyboard_text(const StoryboardFile& story);

/// Reads a storyboard file. Returns nothing for a file that is something else. Throws InputError if a storyboard is
/// damaged, and the errors of read_text_file().
std::optional<StoryboardFile> read_storyboard(const std::string& file);

/// Returns the JSON of a scene by a name such as "story.json#2", which is the second scene of the storyboard
/// story.json. Returns nothing for other names. Throws InputError if the storyboard has no such scene.
std::optional<std::string> scene_of_storyboard(const std::string& name);

}  // namespace meniscus
