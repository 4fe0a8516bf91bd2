// SPDX-License-Identifier: BSD-3-Clause
// `meniscus farm`: bundles a command on frames for any engine, verifies the frames, and makes the film.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands/commands.h"
#include "app/commands/parse_bundled_command.h"
#include "app/farm/make_bundle.h"
#include "app/farm/make_frames.h"
#include "app/farm/verify.h"
#include "app/farm/worker.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/child_process.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "app/process/this_program.h"
#include "core/base/text.h"
#include "core/base/utf8.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

constexpr std::size_t kFaultsShown = 10;

struct BundleCommand {
  std::vector<std::string> words;  // after --
  farm::BundleOptions options;
  std::string folder, engines = "make,slurm,snakemake,openjd,kubernetes,flamenco", film, addon = addon_folder();
  double frames_per_second = 25.0;
  FilmFormat film_format;
};

std::vector<farm::Engine> engines_of(const BundleCommand& command) {
  std::vector<farm::Engine> chosen;
  std::string names;
  for (const farm::Engine& engine : farm::engines()) names.append(names.empty() ? "" : ", ").append(engine.name);
  for (const std::string& word : CLI::detail::split(command.engines, ',')) {
    const auto& table = farm::engines();
    const auto found = std::ranges::find_if(table, [&](const farm::Engine& engine) { return word == engine.name; });
    if (word == "all") {
      chosen = table;
    } else if (found == table.end()) {
      throw UsageError(fmt::format("--engine: {} is not one of {}, all", in_quotes(word), names));
    } else {
      chosen.push_back(*found);
    }
  }
  for (const farm::Engine& engine : chosen)
    if (engine.needs_farm_path && command.options.farm_path.empty())
      throw UsageError(fmt::format("--engine {} needs --farm-path: {}", engine.name, engine.needs_farm_path));
  return chosen;
}

void check_film_name(const std::string& name) {
  if (name.find('/') != std::string::npos || name.starts_with('.') || name.starts_with('-') || !is_film_path(name) ||
      !is_utf8(name))
    throw UsageError(
        fmt::format("--film {} is not a plain name that ends in .mp4, .mov, .mkv, .webm or .gif", in_quotes(name)));
}

void bundle(BundleCommand command) {
  farm::BundleOptions& options = command.options;
  options.folder = command.folder;
  options.addon = command.addon;
  options.engines = engines_of(command);
  if (!command.film.empty()) {
    check_film_name(command.film);
    options.film = farm::Film{command.film, command.frames_per_second, command.film_format};
  }
  const farm::BundledCommand bundled = farm::parse_bundled_command(command.words);
  const farm::MadeBundle made = farm::make_bundle(options, bundled);
  for (const std::string& note : made.notes) std::cerr << "meniscus: note: " << escaped(note) << "\n";
  const farm::Chunking& chunking = made.bundle.chunking;
  fmt::print(std::cout, "{}: {} frames in {} {}{}{}\n", escaped(command.folder),
             with_thousands(made.bundle.frames.size()), chunking.count, chunking.count == 1 ? "task" : "tasks",
             chunking.seconds_per_frame ? fmt::format(", {:.3g} s a frame here", *chunking.seconds_per_frame) : "",
             made.was_there ? "; it was there already" : "");
  fmt::print(std::cout, "a task: {} {}{}\n", chunking.cores, chunking.cores == 1 ? "core" : "cores",
             chunking.memory() ? fmt::format(", {} MiB of memory", with_thousands(*chunking.memory())) : "");
  for (const farm::Engine& engine : options.engines)
    fmt::print(std::cout, "  {:<9} {}\n", engine.name,
               escaped(filled(engine.start, {{"DIR", shell_word(command.folder)}})));
}

}  // namespace

void add_farm_bundle(CLI::App& command) {
  describe(command,
           "  meniscus farm bundle film --film film.mp4 -- render adk.psf --trajectory adk.dcd --frames all\n"
           "  meniscus farm bundle film -- export povray adk.psf --trajectory adk.dcd --frames 0-97 -- +A0.1\n"
           "  meniscus farm bundle film --engine slurm --chunk-frames 20 -- export blender adk.pdb --frames all -- "
           "--samples 64",
           "After -- comes the command without -o, FILE first; after another --, options for POV-Ray or "
           "Blender's\ndriver. Files that the command reads are copied into the bundle. One trial frame is made to "
           "measure its\ntime, unless --chunk-frames sets the number of frames of a task.");
  auto state = std::make_shared<BundleCommand>();
  command.add_option("DIR", state->folder, "Folder to make")->required()->type_name("");
  command
      .add_option("COMMAND", state->words, "After --: render, or export povray, blender, mitsuba or pbrt, with options")
      ->required()
      ->type_name("");
  PropertyOptions options(command);
  options.add("bundle.engine", state->engines);
  CLI::Option* const minutes = options.add("bundle.chunk_minutes", state->options.chunking.asked_minutes);
  options.add("bundle.chunk_frames", state->options.chunking.asked_frames)->excludes(minutes);
  options.add("bundle.task_cores", state->options.chunking.cores);
  options.add("bundle.task_memory", state->options.chunking.asked_memory);
  CLI::Option* const film = options.add("bundle.film", state->film);
  options.add("bundle.fps", state->frames_per_second)->needs(film);
  options.add("frames.codec", state->film_format.codec)->check(one_of(film_codec_names()));
  options.add("frames.crf", state->film_format.rate_factor);
  options.add("frames.bits", state->film_format.bits)->check(CLI::IsMember({8, 10}).description(""));
  options.add("frames.chroma", state->film_format.chroma)->check(CLI::IsMember({420, 422, 444}).description(""));
  options.add("bundle.farm_path", state->options.farm_path);
  options.add("bundle.by_reference", state->options.by_reference);
  options.add("bundle.addon", state->addon);
  options.add("bundle.force", state->options.force);
  command.callback([state, &command] {
    state->options.cores_asked = command.count("--task-cores") > 0;
    bundle(*state);
  });
}

namespace {

/// Returns advice on frames that are missing or damaged.
std::string advice(const std::vector<farm::FrameFault>& faults, const std::string& folder) {
  std::vector<std::uint64_t> damaged;
  for (const farm::FrameFault& fault : faults)
    if (fault.is_there) damaged.push_back(fault.frame);
  std::string text;
  if (damaged.size() < faults.size()) text = fmt::format("`meniscus work {}` makes what is missing", folder);
  if (!damaged.empty())
    text += fmt::format("{}`meniscus work {} --frames {} --force` makes what is damaged once more",
                        text.empty() ? "" : ", ", folder, frame_list_text(damaged));
  return text + "; --allow-missing hold goes on without them";
}

void verify(const std::filesystem::path& folder, const std::optional<farm::InPlace>& in_place) {
  const farm::Bundle bundle = farm::read_bundle(folder);
  const StopHandler handler([] { stop_children(); }, std::nullopt);
  farm::check_inputs(bundle, folder, true);
  const std::vector<farm::FrameFault> faults = farm::faults_of(bundle, folder);
  for (std::size_t n = 0; n < std::min(faults.size(), kFaultsShown); ++n)
    std::cerr << fmt::format("meniscus: frame {}: {}\n", faults[n].frame, escaped(faults[n].what));
  const std::size_t all = bundle.frames.size(), good = all - faults.size();
  if (!faults.empty() && (!in_place || good == 0))
    throw RunError(kExitInput,
                   fmt::format("{}: {} of {} frames are not good; {}", folder.string(), with_thousands(faults.size()),
                               with_thousands(all), advice(faults, shell_word(folder.string()))));
  farm::remove_leftovers(folder);
  if (bundle.film) farm::encode_film(bundle, folder, faults, in_place.value_or(farm::InPlace::hold));
  fmt::print(std::cout, "{} frames are good", with_thousands(good));
  if (!faults.empty()) {
    std::vector<std::uint64_t> missing;
    for (const farm::FrameFault& fault : faults) missing.push_back(fault.frame);
    fmt::print(std::cout, ", {} missing: {}; {}", with_thousands(faults.size()), frame_list_text(missing),
               in_place == farm::InPlace::drop ? "the film is shorter" : "the frame before is shown again");
  }
  if (bundle.film) fmt::print(std::cout, "; film: {}", escaped((folder / bundle.film->file).string()));
  std::cout << "\n";
}

}  // namespace

void add_farm_verify(CLI::App& command) {
  describe(command,
           "  meniscus farm verify film\n"
           "  meniscus farm verify film --allow-missing hold    a film in spite of frames that cannot be made");
  struct Verify {
    std::string folder;
    std::optional<farm::InPlace> in_place;
  };
  auto state = std::make_shared<Verify>();
  command.add_option("BUNDLE", state->folder, "Folder of the bundle")->required()->type_name("");
  PropertyOptions(command).add_word("verify.allow_missing", state->in_place,
                                    {farm::InPlace::hold, farm::InPlace::drop});
  command.callback([state] { verify(state->folder, state->in_place); });
}

void add_farm(CLI::App& command) {
  describe(command,
           "  meniscus farm bundle film -- render adk.psf --trajectory adk.dcd --frames all\n"
           "  meniscus work film            on any number of machines (meniscus work --help)\n"
           "  meniscus farm verify film");
}

}  // namespace meniscus
