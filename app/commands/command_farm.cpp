// SPDX-License-Identifier: BSD-3-Clause
// `meniscus farm`: bundles a command on frames for any render farm, shows its progress, verifies it and makes the film.
#include <algorithm>
#include <ctime>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands/commands.h"
#include "app/commands/parse_bundled_command.h"
#include "app/farm/check_bundle.h"
#include "app/farm/child_process.h"
#include "app/farm/claims.h"
#include "app/farm/frame_log.h"
#include "app/farm/frame_record.h"
#include "app/farm/inner_path.h"
#include "app/farm/make_bundle.h"
#include "app/farm/makers.h"
#include "app/farm/merge.h"
#include "app/farm/pause.h"
#include "app/farm/quote.h"
#include "app/farm/status_report.h"
#include "app/farm/verify.h"
#include "app/farm/worker.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "app/process/this_program.h"
#include "core/base/text.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

constexpr std::size_t kFaultsShown = 10;

struct BundleCommand {
  std::vector<std::string> words;  // after --
  farm::BundleOptions options;
  std::string folder, engines = "make,slurm,openjd,flamenco", film, addon = addon_folder();
  double frames_per_second = 25.0;
  FilmFormat film_format;
  bool link = false, reference = false;
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
  if (name.find('/') != std::string::npos || name.starts_with('.') || name.starts_with('-') || !is_film_path(name))
    throw UsageError(
        fmt::format("--film {} is not a plain name that ends in .mp4, .mov, .mkv, .webm or .gif", in_quotes(name)));
  farm::require_printable_path("--film", name);
}

void bundle(BundleCommand command) {
  farm::BundleOptions& options = command.options;
  options.folder = command.folder;
  options.addon = command.addon;
  options.engines = engines_of(command);
  if (command.link) options.transfer = farm::InputTransfer::link;
  if (command.reference) options.transfer = farm::InputTransfer::reference;
  if (!command.film.empty()) {
    check_film_name(command.film);
    options.film = farm::Film{command.film, command.frames_per_second, command.film_format};
  }
  const farm::BundledCommand bundled = farm::parse_bundled_command(command.words);
  const farm::MadeBundle made = farm::make_bundle(options, bundled);
  for (const std::string& note : made.notes) std::cerr << "meniscus: note: " << escaped(note) << "\n";
  const farm::Chunking& chunking = made.bundle.chunking;
  fmt::print(std::cout, "{}: {} frames in {} {} per step{}{}\n", escaped(command.folder),
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
  CLI::Option* const tries = options.add("bundle.tries", state->options.tries.most);
  options.add("bundle.retry_wait", state->options.tries.wait_seconds)->needs(tries);
  options.add("bundle.farm_path", state->options.farm_path);
  CLI::Option* const link = options.add("bundle.link", state->link);
  options.add("bundle.by_reference", state->reference)->excludes(link);
  options.add("bundle.addon", state->addon);
  options.add("bundle.force", state->options.force);
  command.callback([state, &command] {
    state->options.cores_asked = command.count("--task-cores") > 0;
    bundle(*state);
  });
}

void add_farm_status(CLI::App& command) {
  struct Status {
    std::string folder;
    bool json = false, metrics = false;
  };
  describe(command,
           "  meniscus farm status film\n"
           "  meniscus farm status film --prometheus > film.prom.new && mv film.prom.new /var/lib/node/film.prom");
  auto state = std::make_shared<Status>();
  command.add_option("BUNDLE", state->folder, "Folder of the bundle")->required()->type_name("");
  PropertyOptions options(command);
  CLI::Option* const json = options.add("report.json", state->json);
  options.add("status.prometheus", state->metrics)->excludes(json);
  command.callback([state] {
    const farm::Bundle bundle = farm::read_bundle(state->folder);
    const farm::BundleStatus status = farm::status_of(bundle, state->folder);
    std::cout << (state->json      ? farm::status_json(bundle, status)
                  : state->metrics ? farm::status_metrics(bundle, status, state->folder)
                                   : farm::status_table(bundle, status, state->folder));
  });
}

namespace {

/// Of seconds since 1970: "2026-11-23 11:12:13 UTC".
std::string utc_time(double seconds) {
  const auto whole = static_cast<std::time_t>(seconds);
  std::tm parts{};
  char text[64] = {};
  if (!::gmtime_r(&whole, &parts) || std::strftime(text, sizeof text, "%F %T UTC", &parts) == 0)
    return "an invalid time";
  return text;
}

/// What became of the frame in one step.
std::string outcome(const std::optional<farm::FrameRecord>& record) {
  if (!record) return "not made yet";
  const std::string who = record->worker.empty() ? "" : " by " + escaped(record->worker);
  const std::string when = record->ended > 0.0 ? " at " + utc_time(record->ended) : "";
  if (!record->done())
    return fmt::format("failed{}{}{}, exit code {}: {}", who, when,
                       record->tries > 1 ? fmt::format(", {} times", record->tries) : "", record->exit_code,
                       escaped(record->error));
  const std::string again = record->first_try.empty() ? "" : "; second try: " + escaped(record->first_try);
  return fmt::format("made{}{} in {:.2f} s{}", who, when, record->seconds, again);
}

void tell_log(const std::string& folder, std::uint64_t frame, const std::string& only_step) {
  const farm::Bundle bundle = farm::read_bundle(folder);
  bundle.place_of(frame);
  if (!only_step.empty() && !bundle.step(only_step))
    throw UsageError(fmt::format("--step {} is not a step of this bundle", in_quotes(only_step)));
  const farm::FrameRecords records(folder, bundle);
  for (const farm::Step& step : bundle.steps) {
    if (!only_step.empty() && step.name != only_step) continue;
    fmt::print(std::cout, "{} frame {}: {}\n", step.name, frame, outcome(records.read(step.name, frame)));
    std::istringstream log(farm::read_frame_log(folder, step.name, frame));
    for (std::string line; std::getline(log, line);) std::cout << "  " << escaped(line) << "\n";
  }
  const std::optional<farm::FilmNote> note = farm::read_film_note(bundle, folder);
  if (bundle.film && note && std::ranges::count(note->missing, frame) > 0)
    fmt::print(std::cout, "{} was made without frame {}: {}\n", bundle.film->file, frame, note->sentence());
}

}  // namespace

void add_farm_log(CLI::App& command) {
  struct Log {
    std::string folder, step;
    std::uint64_t frame = 0;
  };
  describe(command,
           "  meniscus farm log film 42\n"
           "  meniscus farm log film 42 --step render");
  auto state = std::make_shared<Log>();
  command.add_option("BUNDLE", state->folder, "Folder of the bundle")->required()->type_name("");
  command.add_option("FRAME", state->frame, "Number of the frame in the trajectory")->required()->type_name("");
  PropertyOptions(command).add("work.step", state->step);
  command.callback([state] { tell_log(state->folder, state->frame, state->step); });
}

namespace {

/// What can be done about frames that are not good, which is another thing if they failed when they were made.
std::string advice(const std::vector<farm::FrameFault>& faults, const std::string& folder) {
  const auto failed = std::ranges::find(faults, true, &farm::FrameFault::failed);
  if (failed == faults.end()) return "meniscus work makes them";
  const bool all = std::ranges::all_of(faults, &farm::FrameFault::failed);
  return fmt::format(
      "{}`meniscus farm log {} {}` says why frame {} failed, meniscus work tries it once more, and --allow-missing "
      "hold "
      "goes on without what is missing",
      all ? "" : "meniscus work makes those that did not fail; ", escaped(shell_word(folder)), failed->frame,
      failed->frame);
}

/// Frames whose pictures are not good, if the film may be made without them.
farm::FilmNote film_note(const farm::Bundle& bundle, const std::vector<farm::FrameFault>& faults,
                         const std::optional<farm::InPlace>& in_place) {
  farm::FilmNote note{in_place.value_or(farm::InPlace::hold), {}};
  for (const farm::FrameFault& fault : faults)
    if (fault.step == bundle.steps.back().name) note.missing.push_back(fault.frame);
  return note;
}

void verify(const std::filesystem::path& folder, const std::optional<farm::InPlace>& in_place) {
  const farm::Bundle bundle = farm::read_bundle(folder);
  const StopHandler handler([] { farm::stop_children(); }, std::nullopt);
  farm::check_places(folder);
  // Inputs by reference are not read any more: the frames are made.
  farm::Bundle here = bundle;
  std::erase_if(here.inputs, [&](const farm::Input& input) {
    return !input.source.empty() && farm::input_path(input, folder) == input.source;
  });
  farm::check_inputs(here, folder, true);
  const std::vector<farm::FrameFault> faults = farm::faults_of(bundle, folder);
  for (std::size_t n = 0; n < std::min(faults.size(), kFaultsShown); ++n)
    std::cerr << fmt::format("meniscus: {} frame {}: {}\n", faults[n].step, faults[n].frame, escaped(faults[n].what));
  const farm::FilmNote note = film_note(bundle, faults, in_place);
  const std::size_t good = bundle.frames.size() - note.missing.size();
  if (!faults.empty() && (!in_place || good == 0)) {
    throw RunError(
        static_cast<ExitCode>(faults.front().exit_code),
        fmt::format("{}: {} of {} frames are not good; {}", folder.string(), with_thousands(faults.size()),
                    with_thousands(bundle.frames.size() * bundle.steps.size()), advice(faults, folder.string())));
  }
  farm::remove_leftovers(folder);
  if (bundle.film) {
    farm::encode_film(bundle, folder, note);
    farm::write_film_note(bundle, folder, note);
  }
  fmt::print(std::cout, "{} frames are good{}{}\n", with_thousands(good),
             note.missing.empty()
                 ? ""
                 : fmt::format(", {} missing: {}", with_thousands(note.missing.size()), frame_list_text(note.missing)),
             bundle.film ? fmt::format("; film{}: {}",
                                       note.missing.empty() ? "" : fmt::format(", in which {}", note.sentence()),
                                       escaped((folder / bundle.film->file).string()))
                         : "");
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

namespace {

/// What came of one copy, and what of it was not taken, of each step the first in full and the others by number.
void tell_merged(const std::string& copy, const farm::Merged& merged) {
  std::map<std::string, std::vector<std::uint64_t>> more;
  for (std::size_t n = 0; n < merged.not_taken.size(); ++n) {
    const farm::NotTaken& result = merged.not_taken[n];
    if (n < kFaultsShown) {
      std::cerr << fmt::format(
          "meniscus: {}: {} {} not taken: {}\n", escaped(copy), result.step,
          result.frame == farm::kSharedFiles ? "files of all frames are" : fmt::format("frame {} is", result.frame),
          escaped(result.what));
    } else {
      more[result.step].push_back(result.frame);
    }
  }
  for (const auto& [step, frames] : more)
    std::cerr << fmt::format("meniscus: {}: {} frames {} are not taken\n", escaped(copy), step,
                             frame_list_text(frames));
  const auto also = [](std::uint64_t count, const char* what) {
    return count > 0 ? fmt::format(", {} {}", with_thousands(count), what) : std::string();
  };
  fmt::print(std::cout, "{}: {} taken, {} bytes; {} here already{}{}{}\n", escaped(copy), with_thousands(merged.taken),
             with_thousands(merged.bytes), with_thousands(merged.there), also(merged.failed, "failed there"),
             also(merged.busy, "being made here"), also(merged.not_taken.size(), "not taken"));
}

void merge(const std::filesystem::path& into, const std::vector<std::string>& copies) {
  const farm::Bundle bundle = farm::read_bundle(into);
  farm::check_places(into);
  std::error_code none_there;
  for (const std::string& copy : copies)
    if (std::filesystem::equivalent(copy, into, none_there))
      throw UsageError(fmt::format("{} is the bundle that takes from the others; leave it out", in_quotes(copy)));
  const StopHandler handler([] { farm::give_back_all_claims(); }, kExitStopped);
  farm::MergeTarget target(bundle, into);
  std::size_t not_taken = 0, unread = 0;
  for (const std::string& copy : copies) {
    try {
      const farm::Merged merged = target.take_from(copy);
      not_taken += merged.not_taken.size();
      tell_merged(copy, merged);
    } catch (const InputError& error) {
      ++unread;
      std::cerr << fmt::format("meniscus: nothing is taken from {}: {}\n", escaped(copy), escaped(error.what()));
    }
  }
  const farm::BundleStatus status = farm::status_of(bundle, into);
  for (const farm::StepStatus& step : status.steps)
    fmt::print(std::cout, "{}: {} of {} frames are made\n", step.step, with_thousands(step.done),
               with_thousands(bundle.frames.size()));
  if (not_taken + unread > 0)
    throw RunError(kExitInput, fmt::format("{}: {} frames and {} copies are not taken; all else is", into.string(),
                                           with_thousands(not_taken), with_thousands(unread)));
}

}  // namespace

void add_farm_merge(CLI::App& command) {
  describe(command, "  meniscus farm merge film copy_1 copy_2        what was made in two copies of film",
           "For machines that share no folder. Each file is checked against its record, each picture is read. What is "
           "not\ngood, or differs from what INTO has, is named and not taken, and the exit code is 3. The same command "
           "may be\nrepeated at any time, and goes on after any interruption.");
  struct Merge {
    std::string into;
    std::vector<std::string> copies;
  };
  auto state = std::make_shared<Merge>();
  command.add_option("INTO", state->into, "Folder of the bundle that gets the frames")->required()->type_name("");
  command.add_option("FROM", state->copies, "Folders of copies of it: bundle.json, state, and what is made")
      ->required()
      ->type_name("");
  command.callback([state] { merge(state->into, state->copies); });
}

namespace {

void add_pause(CLI::App& command, bool paused) {
  auto folder = std::make_shared<std::string>();
  command.add_option("BUNDLE", *folder, "Folder of the bundle")->required()->type_name("");
  command.callback([folder, paused] {
    farm::read_bundle(*folder);
    farm::check_places(*folder);
    farm::set_paused(*folder, paused);
  });
}

}  // namespace

void add_farm_pause(CLI::App& command) {
  describe(
      command, "  meniscus farm pause film",
      "Each worker ends the frame that it is at, gives back its others, and waits. It keeps its place in a queue.");
  add_pause(command, true);
}

void add_farm_resume(CLI::App& command) {
  describe(command, "  meniscus farm resume film");
  add_pause(command, false);
}

void add_farm(CLI::App& command) {
  describe(command,
           "  meniscus farm bundle film -- render adk.psf --trajectory adk.dcd --frames all\n"
           "  meniscus work film            on any number of machines (meniscus work --help)\n"
           "  meniscus farm status film\n"
           "  meniscus farm log film 42\n"
           "  meniscus farm merge film copy_1 copy_2    what machines made that share no folder\n"
           "  meniscus farm verify film");
}

}  // namespace meniscus
