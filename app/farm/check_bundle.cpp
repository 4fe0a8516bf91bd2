// SPDX-License-Identifier: BSD-3-Clause
// Compares a bundle with what this program would have made.
#include "app/farm/check_bundle.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/farm/blender_driver.h"
#include "app/farm/command_options.h"
#include "app/farm/inner_path.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kLargestManifest = std::size_t{64} << 20;
constexpr std::uint64_t kMostTasks = 1000, kMostCores = 4096, kMostMemory = std::uint64_t{1} << 30;  // MiB

Words command_words(const Words& command) {
  const std::size_t count = command_word_count(command);
  if (command.size() <= count) throw RequestError("has no command");
  return {command.begin(), command.begin() + static_cast<std::ptrdiff_t>(count)};
}

void check_inputs(const Bundle& bundle) {
  std::set<std::string> paths;
  for (const Input& input : bundle.inputs) {
    if (!input.path.starts_with("inputs/") || !is_inner_path(input.path))
      throw RequestError(fmt::format("input {} is not a plain path below inputs/", in_quotes(input.path)));
    if (!input.source.empty() && !is_plain_absolute_path(input.source))
      throw RequestError(
          fmt::format("input {} is elsewhere: {} is not an absolute path of letters, digits, '.', '_' and '-'",
                      input.path, in_quotes(input.source)));
    if (!paths.insert(input.path).second) throw RequestError(fmt::format("input {} appears twice", input.path));
  }
}

void check_steps(const Bundle& bundle) {
  const std::vector<Step> steps = steps_of(command_words(bundle.command));
  const auto same = [](const Step& a, const Step& b) { return a.name == b.name && a.maker == b.maker; };
  if (!std::ranges::equal(bundle.steps, steps, same)) throw RequestError("its steps are not those of its command");
  for (const Step& step : bundle.steps) {
    if (step.maker == Maker::meniscus) read_device_options(step.arguments);
    if (step.maker == Maker::povray) check_povray_options(step.arguments);
    if (step.maker == Maker::blender) check_blender_options(step.arguments);
  }
}

void check_numbers(const Bundle& bundle) {
  const auto side = [](int pixels) { return pixels >= 1 && pixels <= kLargestSide; };
  if (!side(bundle.width) || !side(bundle.height) || std::int64_t{bundle.width} * bundle.height > kMostPixels)
    throw RequestError(fmt::format("its picture size is {} x {}; a side has 1 to {} pixels, a picture {} at most",
                                   bundle.width, bundle.height, kLargestSide, kMostPixels));
  if (bundle.frames.empty()) throw RequestError("has no frames");
  const std::uint64_t count = bundle.chunking.count;
  if (count < 1 || count > std::min<std::uint64_t>(kMostTasks, bundle.frames.size()))
    throw RequestError("its number of tasks is not valid");
  const std::uint64_t memory =
      std::max(bundle.chunking.asked_memory.value_or(1), bundle.chunking.peak_memory.value_or(1));
  if (bundle.chunking.cores < 1 || bundle.chunking.cores > kMostCores || memory < 1 || memory > kMostMemory)
    throw RequestError("cores or memory of its tasks are not valid");
  if (bundle.tries.most < 1 ||
      !(bundle.tries.wait_seconds >= Tries::kShortestWait && bundle.tries.wait_seconds <= Tries::kLongestWait))
    throw RequestError("its number of tries, or the time between them, is not valid");
  if (!bundle.film) return;
  if (!bundle.makes_pictures()) throw RequestError("has a film, and no pictures to make it of");
  const double rate = bundle.film->frames_per_second;
  if (!(rate >= 0.1 && rate <= 1000.0)) throw RequestError("its film's frames per second are not valid");
  const std::string& name = bundle.film->file;
  if (name.find('/') != std::string::npos || !is_film_path(name) || name.starts_with('.') || name.starts_with('-'))
    throw RequestError(fmt::format("film {} is not a plain name that ends in .mp4 or as films do", in_quotes(name)));
  try {
    film_encoder(name, bundle.film->format);
  } catch (const UsageError& error) {
    throw RequestError(fmt::format("its film cannot be made: {}", error.what()));
  }
}

}  // namespace

Bundle read_bundle(const std::filesystem::path& folder) {
  const std::string path = (folder / "bundle.json").string();
  const std::optional<std::string> text = inner_text(folder, "bundle.json", kLargestManifest);
  if (!text) throw InputError(path, 0, "cannot be opened; meniscus farm bundle makes it");
  try {
    Bundle bundle = parse_bundle(*text);
    check_bundle(bundle);
    return bundle;
  } catch (const RequestError& error) {
    throw InputError(path, 0, error.what());
  }
}

std::vector<Step> steps_of(const std::vector<std::string>& words) {
  const Step surface{"surface", Maker::meniscus, {}};
  const std::string command = fmt::format("{}", fmt::join(words, " "));
  if (command == "render") return {{"render", Maker::meniscus, {}}};
  if (command == "export povray") return {surface, {"render", Maker::povray, {}}};
  if (command == "export blender") return {surface, {"render", Maker::blender, {}}};
  if (command == "export mitsuba" || command == "export pbrt") return {surface};
  throw RequestError(
      fmt::format("{} cannot be bundled; render and export povray, blender, mitsuba and pbrt can", in_quotes(command)));
}

std::size_t command_word_count(const Words& command) { return !command.empty() && command.front() == "export" ? 2 : 1; }

std::filesystem::path input_path(const Input& input, const std::filesystem::path& folder) {
  const bool is_elsewhere = !input.source.empty() && inner_entry(folder, input.path) == Entry::nothing;
  return is_elsewhere ? std::filesystem::path(input.source) : folder / input.path;
}

Words checked_command(const Bundle& bundle, const std::filesystem::path& folder) {
  Words result = command_words(bundle.command);
  const auto file = bundle.command.begin() + static_cast<std::ptrdiff_t>(result.size());
  const auto place_of = [&](const std::string& path) {
    const auto input = std::ranges::find(bundle.inputs, path, &Input::path);
    if (input == bundle.inputs.end())
      throw RequestError(fmt::format("{} is not an input of the bundle", in_quotes(path)));
    return !folder.empty() && input_path(*input, folder) == input->source ? input->source : path;
  };
  result.push_back(place_of(*file));
  std::vector<CommandOption> options = read_command_options({file + 1, bundle.command.end()});
  for (CommandOption& option : options)
    if (option.reads_file) option.value = place_of(*option.value);
  const Words words = as_words(options);
  result.insert(result.end(), words.begin(), words.end());
  return result;
}

void check_bundle(const Bundle& bundle) {
  check_inputs(bundle);
  check_steps(bundle);
  check_driver(bundle);
  check_numbers(bundle);
  checked_command(bundle);
}

}  // namespace meniscus::farm
