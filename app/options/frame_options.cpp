// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of a run of frames: which frames, how their atoms are moved, progress, films.
#include "app/options/frame_options.h"

#include <cstdlib>

#include "app/options/property_options.h"

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

}  // namespace

void add_trajectory_argument(CLI::App& command) {
  PropertyOptions(command)
      .add_list("frames.trajectories",
                [&command](const std::vector<std::string>& paths) {
                  // Its turn comes before that of --trajectory, whose values these are from here on, for scenes, too.
                  for (const std::string& path : paths) command.get_option("--trajectory")->add_result(path);
                })
      ->allow_extra_args()
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_frame_options(CLI::App& command, FrameOptions& frames) {
  frames.index_folder = cache_folder();
  PropertyOptions options(command);
  options.add("frames.trajectory", frames.trajectories)
      ->type_size(1)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options.add_selection("frames.trajectory_atoms", frames.trajectory_atoms);
  options.add("frames.trust_atom_order", frames.trust_atom_order);
  options.add("frames.frames", frames.frames);
  options.add("frames.stride", frames.stride);
  options.add("frames.begin", frames.begin);
  options.add("frames.end", frames.end);
  options.add("frames.repeat", frames.repeat);
  options.add("frames.only", frames.only);
  options.add("frames.select_once", frames.select_once);
  options.add_parsed("frames.whole", [&frames](const std::string& word) { parse_whole(word, frames.whole); });
  options.add_selection("frames.superpose", frames.superpose);
  options.add_selection("frames.center", frames.center);
  options.add("frames.reference", frames.reference);
  options.add("frames.smooth", frames.smooth);
  options.add("frames.jobs", frames.jobs);
  add_progress_option(command, frames.progress);
}

void add_film_options(CLI::App& command, FilmFormat& format) {
  PropertyOptions options(command);
  options.add("frames.codec", format.codec)->check(CLI::IsMember(film_codec_names()).description(""));
  options.add("frames.crf", format.rate_factor);
  options.add("frames.bits", format.bits)->check(CLI::IsMember({8, 10}).description(""));
  options.add("frames.chroma", format.chroma)->check(CLI::IsMember({420, 422, 444}).description(""));
}

std::string cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::string(cache) + "/meniscus";
  if (const char* home = std::getenv("HOME"); home && *home == '/') return std::string(home) + "/.cache/meniscus";
  return {};
}

void add_progress_option(CLI::App& command, ProgressStyle& style) {
  using enum ProgressStyle;
  PropertyOptions(command).add_word("frames.progress", style, {automatic, bar, plain, json, openjd, none});
}

}  // namespace meniscus
