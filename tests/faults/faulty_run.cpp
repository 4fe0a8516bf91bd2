// SPDX-License-Identifier: BSD-3-Clause
// Sets up environments and folders, and compares them.
#include "tests/faults/faulty_run.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <regex>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace meniscus::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFourBalls = "0 0 0 1.7\n2.6 0 0 1.6\n1.2 2.2 0.1 1.8\n1.1 0.8 2.1 1.5\n";

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
  return text;
}

std::size_t count_of(const std::string& word, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) ++count;
  return count;
}

/// Returns three frames of three atoms that move apart.
std::string walk() {
  std::string text;
  for (int frame = 0; frame < 3; ++frame) {
    text += fmt::format("MODEL     {:>4}\n", frame + 1);
    for (int atom = 0; atom < 3; ++atom)
      text += fmt::format("ATOM  {:>5}  C{}  LIG A   1    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C\n", atom + 1,
                          atom + 1, (1.5 + 0.3 * frame) * atom, 0.4 * atom * atom, 0.0);
    text += "ENDMDL\n";
  }
  return text;
}

/// Returns the text without times of stages and without dates in pictures.
std::string timeless(const std::string& text) {
  static const std::regex time(R"("ms": ?[-+.0-9e]+|time +[.0-9]+ ms|\d{4}:\d\d:\d\d \d\d:\d\d:\d\d)");
  return std::regex_replace(text, time, "");
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    files[name] = entry.is_directory() ? "(folder)" : timeless(read_bytes(entry.path()));
  }
  return files;
}

}  // namespace

FaultBench::FaultBench(FaultCase command) : command_(std::move(command)) {
  input_.file("four.xyzr", kFourBalls);
  input_.file("walk.pdb", walk());
}

FaultyRun FaultBench::run(const Fault& fault) const {
  const TemporaryFolder output, notes;
  const std::string in = input_.path().string(), out = output.path().string();
  const std::string tally = (notes.path() / "tally").string();
  // The folders lie next to each other, and their paths begin alike.
  const std::string folder = fs::temp_directory_path() / "meniscus-test-";
  std::vector<std::string> words{"LD_PRELOAD=" MENISCUS_FAILING_CALLS,
                                 "FAULT_PROGRAM=" + fault.program,
                                 "FAULT_CALL=" + fault.call,
                                 "FAULT_KIND=" + fault.kind,
                                 fmt::format("FAULT_AT={}", fault.at),
                                 "FAULT_FOLDER=" + folder,
                                 "FAULT_LIBRARY=" + fault.library,
                                 "FAULT_TALLY=" + tally,
                                 meniscus_program()};
  for (const std::string& word : command_.arguments)
    words.push_back(replaced(replaced(word, "{in}", in), "{out}", out));
  FaultyRun run;
  run.result = run_program("/usr/bin/env", words, 60);
  run.result.out = timeless(replaced(run.result.out, out, "{out}"));
  run.files = files_below(output.path());
  const std::string counted = read_bytes(tally);
  if (counted.size() == sizeof run.tally) std::memcpy(&run.tally, counted.data(), counted.size());
  return run;
}

const FaultyRun& FaultBench::sound(const Fault& fault) {
  sound_ = run({fault.call, fault.kind, 0, fault.program, fault.library});
  EXPECT_EQ(sound_.result.exit_code, 0) << sound_.result.err;
  return sound_;
}

std::string FaultBench::broken_promise(const FaultyRun& run, const std::vector<int>& codes) const {
  const ProgramResult& result = run.result;
  const std::string said = fmt::format("; it ended with {}: {}", result.exit_code, result.err);
  for (const auto& [name, bytes] : run.files) {
    const auto sound = sound_.files.find(name);
    if (sound == sound_.files.end()) return name + " was left" + said;
    if (sound->second != bytes) return name + " is not what it should be" + said;
  }
  if (result.exit_code == 0) {
    if (run.files.size() != sound_.files.size()) return "files are missing" + said;
    return result.out == sound_.result.out ? "" : "standard output differs" + said;
  }
  if (std::ranges::find(codes, result.exit_code) == codes.end()) return "the code is wrong" + said;
  return count_of("meniscus: error: ", result.err) == 1 ? "" : "it says that not once" + said;
}

std::vector<std::uint64_t> sampled(std::vector<std::uint64_t> numbers, std::size_t most) {
  if (numbers.size() <= most || std::getenv("MENISCUS_ALL_FAULTS")) return numbers;
  std::vector<std::uint64_t> few;
  for (std::size_t n = 0; n < most; ++n) few.push_back(numbers[n * numbers.size() / most]);
  return few;
}

}  // namespace meniscus::test
