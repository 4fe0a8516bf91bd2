// SPDX-License-Identifier: BSD-3-Clause
// Runs the program with one of its calls failing, and checks the files that remain.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/tally.h"
#include "tests/support/run_program.h"

namespace meniscus::test {

/// A command of the program. "{in}/" and "{out}/" stand for folders: the first holds the input, the second is empty.
struct FaultCase {
  std::string name;
  std::vector<std::string> arguments;
};

/// A call that fails, and its way to fail, in the words of failing_calls.cpp.
struct Fault {
  std::string call, kind;
  std::uint64_t at = 0;
  std::string program = "meniscus";
  std::string library = {};  ///< empty: all
};

/// Messages of a run and each file that it left, also hidden ones, by its path below the folder.
struct FaultyRun {
  ProgramResult result;
  std::map<std::string, std::string> files;
  Tally tally;
};

/// Small molecules and trajectories as input: water.xyzr, four.xyzr (two of its probes cut each other), walk.pdb of
/// three frames.
class FaultBench {
 public:
  explicit FaultBench(FaultCase command);

  /// Runs without a fault and counts the calls of this kind. Fails the test unless the run ends with 0.
  const FaultyRun& sound(const Fault& fault);
  FaultyRun run(const Fault& fault) const;

  /// Why this run broke the promise; empty if it kept it. Either it ends with 0 and all files and standard output are
  /// those of the sound run; or with one of these codes, a line that says why, and no file that is not whole: none
  /// under its final name that differs from the sound one, none unfinished.
  std::string broken_promise(const FaultyRun& run, const std::vector<int>& codes) const;

 private:
  FaultCase command_;
  TemporaryFolder input_;
  FaultyRun sound_;
};

/// Returns these numbers, or where there are more than `most`, so many of them, evenly spread; returns all if the
/// environment has MENISCUS_ALL_FAULTS.
std::vector<std::uint64_t> sampled(std::vector<std::uint64_t> numbers, std::size_t most);

}  // namespace meniscus::test
