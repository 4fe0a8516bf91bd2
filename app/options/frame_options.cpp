// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of a run of frames.
#include "app/options/frame_options.h"

#include <cstdlib>
#include <map>

#include "app/options/molecule_options.h"
#include "app/options/value_words.h"

namespace meniscus {
namespace {

void parse_whole(const std::string& word, WholeBy& whole) {
  if (word.empty() || word == "bonds" || word == "true") {
    whole = WholeBy::bonds;
  } else if (word == "guess") {
    whole = WholeBy::guess;
  } else {
    throw CLI::ValidationError("--whole", "is bonds (default) or guess");
  }
}

void add_selection(CLI::App& command, const std::string& name, std::optional<Selection>& selection,
                   const std::string& what) {
  command
      .add_option_function<std::string>(
          name, [name, &selection](const std::string& text) { selection = parse_selection_option(name, text); }, what)
      ->type_name("EXPR");
}

}  // namespace

void add_trajectory_argument(CLI::App& command) {
  command
      .add_option_function<std::vector<std::string>>(
          "TRAJECTORY",
          [&command](const std::vector<std::string>& paths) {
            // Its turn comes before that of --trajectory, whose values these are from here on, for scenes, too.
            for (const std::string& path : paths) command.get_option("--trajectory")->add_result(path);
          },
          "Trajectories: the same as --trajectory")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("");
}

void add_frame_options(CLI::App& command, FrameOptions& options) {
  const Heading heading(command, "Frames");
  options.index_folder = cache_folder();
  command
      .add_option("--trajectory", options.trajectories,
                  "Coordinates of the atoms of FILE, frame by frame (meniscus formats); again for more, in a row; "
                  "without it the models of FILE are the frames")
      ->type_size(1)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("PATH");
  add_selection(command, "--trajectory-atoms", options.trajectory_atoms,
                "The atoms of FILE that the trajectory has, such as 'not water'; the others are left out first");
  command.add_flag("--trust-atom-order", options.trust_atom_order,
                   "Take the atoms of the trajectory for those of FILE, in its order, though bonds come out too long");
  command
      .add_option("--frames", options.frames,
                  "The run: all, or a list such as 0-99:10,250,last (frames count from 0; -10- are the last ten)")
      ->type_name("LIST");
  command.add_option("--stride", options.stride, "Of these every Nth [1]")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("N");
  command.add_option("--begin", options.begin, "Leave out what is before this frame, or time: 300ps, 2.5ns")
      ->type_name("WHEN");
  command.add_option("--end", options.end, "Leave out what is behind this frame or time")->type_name("WHEN");
  command
      .add_option("--repeat", options.repeat,
                  "Each frame of the run N times in a row [1]: slow motion, or a camera about a molecule that stands "
                  "still; files of frame F are then numbered F*N, F*N + 1, ...")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}).description(""))
      ->type_name("N");
  command
      .add_option("--only", options.only,
                  "Make only these frames of the run, as one chunk of many: camera, colours and scene stay those of "
                  "the whole run")
      ->type_name("LIST");
  command.add_flag(
      "--select-once", options.select_once,
      "Selections by distance, coordinates or secondary structure mean in all frames what they mean in the "
      "first of the run; without it they are found anew in each frame");
  command
      .add_option_function<std::string>(
          "--whole", [&options](const std::string& word) { parse_whole(word, options.whole); },
          "Make molecules whole that the periodic box cuts, and gather them: bonds (default: of FILE and of standard "
          "residues) or guess (by distance)")
      ->expected(0, 1)
      ->check(proposes({"bonds", "guess"}))
      ->type_name("WORD");
  add_selection(command, "--superpose", options.superpose,
                "Turn and move each frame so that these atoms fit the reference frame best");
  add_selection(command, "--center", options.center,
                "Move each frame so that the middle of these atoms stays in place");
  command
      .add_option("--reference", options.reference, "Frame of the trajectory for --superpose and --center [0], or last")
      ->type_name("N");
  command
      .add_option("--smooth", options.smooth,
                  "Mean positions over N frames of the trajectory, an odd number, this one in the middle [1]")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{9999}).description(""))
      ->type_name("N");
  command
      .add_option("--jobs", options.jobs,
                  "Frames that are made at once, in their order in every output [as cores and memory allow]")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}).description(""))
      ->type_name("N");
  add_progress_option(command, options.progress);
}

std::string cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::string(cache) + "/meniscus";
  if (const char* home = std::getenv("HOME"); home && *home == '/') return std::string(home) + "/.cache/meniscus";
  return {};
}

void add_progress_option(CLI::App& command, ProgressStyle& style) {
  const std::map<std::string, ProgressStyle> words{{"auto", ProgressStyle::automatic}, {"bar", ProgressStyle::bar},
                                                   {"plain", ProgressStyle::plain},    {"json", ProgressStyle::json},
                                                   {"openjd", ProgressStyle::openjd},  {"none", ProgressStyle::none}};
  command
      .add_option("--progress", style,
                  "Of the frames: auto (default: a bar on a terminal, else plain lines), bar, plain, json (a line a "
                  "frame on stderr), openjd, none")
      ->transform(one_of(words))
      ->type_name("WORD");
}

}  // namespace meniscus
