// SPDX-License-Identifier: BSD-3-Clause
// Combines every file that a command can read with every file that it can write: no input is replaced, and no output
// replaces another. Commands and options are those of the program's own completion and table of properties, so that new
// ones are included.
#include <algorithm>
#include <cstdio>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/properties/properties.h"
#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Words = std::vector<std::string>;

Words words_in(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// A command that takes files.
struct FileCommand {
  Words words;                            ///< "export", "mesh"
  std::map<std::string, bool> arguments;  ///< "FILE"; whether it is required
  Words inputs, outputs;                  ///< options
};

bool is_input(const Property& property) {
  return property.type == ValueType::file || property.type == ValueType::camera || property.value.ends_with("=FILE");
}

std::map<std::string, bool> arguments_of(const Words& command) {
  Words asking = command;
  asking.emplace_back("--help");
  std::string help = run_program(meniscus_program(), asking).out;
  help.erase(0, help.find("\nArguments:\n"));
  help.erase(std::min(help.size(), help.find("\n\n")));
  static const std::regex kArgument(R"(\n  ([A-Z]+)( \(required\))?)");
  std::map<std::string, bool> arguments;
  for (auto found = std::sregex_iterator(help.begin(), help.end(), kArgument); found != std::sregex_iterator(); ++found)
    arguments[(*found)[1]] = (*found)[2].matched;
  return arguments;
}

std::vector<FileCommand> file_commands() {
  const std::string script = run_program(meniscus_program(), {"completion", "bash"}).out;
  static const std::regex kCommand(R"(\n    '?(meniscus/[a-z/]+)'?\) options='([^']*)')");
  std::vector<FileCommand> all;
  for (auto found = std::sregex_iterator(script.begin(), script.end(), kCommand); found != std::sregex_iterator();
       ++found) {
    FileCommand command;
    command.words = words_in(std::regex_replace((*found)[1].str().substr(9), std::regex("/"), " "));
    const Words options = words_in((*found)[2]);
    for (const Property* property : properties()) {
      const std::string option(property->long_option());
      if (std::ranges::find(options, option) == options.end()) continue;
      Words& uses = property->type == ValueType::new_file ? command.outputs : command.inputs;
      if ((&uses == &command.outputs || is_input(*property)) && std::ranges::find(uses, option) == uses.end())
        uses.push_back(option);
    }
    command.arguments = arguments_of(command.words);
    all.push_back(std::move(command));
  }
  return all;
}

class FilePairs : public ::testing::Test {
 protected:
  FilePairs() {
    std::filesystem::create_hard_link(input_, hard_);
    std::filesystem::create_symlink(input_, soft_);
  }

  /// Returns the words of a command in which one of its options or arguments names this file.
  Words words_with(const FileCommand& command, const std::string& input, const std::string& path) const {
    Words words = command.words;
    bool is_named = false;
    for (const auto& [argument, is_required] : command.arguments) {
      if (argument == "COMMAND" || (!is_required && argument != input)) continue;
      words.push_back(argument == input && !is_named ? path : other_);
      is_named = is_named || argument == input;
      if (argument != "FILE" && argument != "DIR") words.push_back(other_);  // the command takes several files
    }
    if (input.starts_with("--")) words.insert(words.end(), {input, input == "--named-view" ? "View=" + path : path});
    return words;
  }

  /// Adds the remaining words, so that nothing else is missing.
  void complete(Words& words, const FileCommand& command, const std::set<std::string>& given) const {
    const bool has_output = std::ranges::find(command.outputs, "--output") != command.outputs.end();
    if (has_output && !given.contains("--output")) words.insert(words.end(), {"--output", free_});
    words.emplace_back("--force");
    if (command.words.front() == "farm") words.insert(words.end(), {"--", "render", other_});
  }

  Words names_of_folder() const { return folder_.entries(); }

  TemporaryFolder folder_;
  std::string other_ = folder_.file("other.pdb", "not read"), free_ = (folder_.path() / "free.png").string();
  std::string input_ = folder_.file("file.png", "not read either"), hard_ = (folder_.path() / "hard.png").string(),
              soft_ = (folder_.path() / "soft.png").string();
};

TEST_F(FilePairs, NoOutputReplacesAnInputByAnyName) {
  const Words before = names_of_folder();
  int pairs = 0;
  std::set<std::string> commands;
  for (const FileCommand& command : file_commands()) {
    if (command.outputs.empty()) continue;
    Words inputs = command.inputs;
    for (const auto& [argument, is_required] : command.arguments)
      if (argument != "COMMAND" && argument != "DIR" && argument != "TOPIC") inputs.push_back(argument);
    for (const std::string& input : inputs)
      for (const std::string& output : command.outputs) {
        const std::string name = std::vector{input_, hard_, soft_}[static_cast<std::size_t>(pairs++) % 3];
        Words words = words_with(command, input, input_);
        words.insert(words.end(), {output, name});
        complete(words, command, {output});
        const ProgramResult result = run_program(meniscus_program(), words);
        const std::string shown = fmt::format("{} {} {}: {}", command.words.back(), input, output, result.err);
        EXPECT_EQ(result.exit_code, 6) << shown;
        EXPECT_NE(result.err.find(name + ": is one of the files that this command reads"), std::string::npos) << shown;
        EXPECT_EQ(read_bytes(input_), "not read either") << shown;
        EXPECT_EQ(names_of_folder(), before) << shown;
        commands.insert(fmt::format("{}", command.words.back()));
      }
  }
  std::printf("%d pairs of %zu commands\n", pairs, commands.size());
  EXPECT_GT(pairs, 150);
  for (const char* name : {"morph", "panels", "film", "render", "surface", "pockets", "preview", "mesh", "page"})
    EXPECT_TRUE(commands.contains(name)) << name;
}

TEST_F(FilePairs, NoOutputReplacesAnotherOrAFrameOfIt) {
  const Words before = names_of_folder();
  const std::string run = (folder_.path() / "f_#.png").string(), frame = (folder_.path() / "f_12.png").string();
  int pairs = 0;
  for (const FileCommand& command : file_commands())
    for (const std::string& one : command.outputs)
      for (const std::string& another : command.outputs) {
        if (one == another) continue;
        ++pairs;
        for (const auto& [first, second] : {std::pair{free_, free_}, {run, frame}, {run, run}}) {
          Words words = words_with(command, "", "");
          words.insert(words.end(), {one, first, another, second});
          complete(words, command, {one, another});
          const ProgramResult result = run_program(meniscus_program(), words);
          const std::string shown = fmt::format("{} {} {}: {}", command.words.back(), one, another, result.err);
          EXPECT_EQ(result.exit_code, 2) << shown;
          EXPECT_NE(result.err.find("name the same file"), std::string::npos) << shown;
          EXPECT_EQ(names_of_folder(), before) << shown;
        }
      }
  std::printf("%d pairs\n", pairs);
  EXPECT_GT(pairs, 50);
}

TEST_F(FilePairs, OutputsBesideARunHaveTheirOwnNames) {
  const std::string molecule = folder_.file("a.xyzr", "0 0 0 1.7\n2 0 0 1.7\n"), in = folder_.path().string() + "/";
  const auto render = [&](const std::string& camera) {
    return run_program(meniscus_program(), {"render", molecule, "--frames", "0", "--size", "32x24", "--device", "cpu",
                                            "-o", in + "f_##.png", "--save-camera", in + camera})
        .exit_code;
  };
  EXPECT_EQ(render("f_0.png"), 0);  // the number has at least two digits
  EXPECT_EQ(render("f_00.png"), 2);
  EXPECT_EQ(render("f_100.png"), 2);
  std::filesystem::remove(in + "f_00.png");
  EXPECT_EQ(render("f_a0.png"), 0);
}

}  // namespace
}  // namespace meniscus::test
