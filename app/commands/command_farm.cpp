// SPDX-License-Identifier: BSD-3-Clause
// `meniscus farm` and `meniscus work`: bundle a command on frames, make its frames, and verify them.

#include <cstdlib>
#include <iostream>

#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/figure_meshes.h"
#include "app/commands/povray_figures.h"
#include "app/farm/bundle_folder.h"
#include "app/farm/make_bundle.h"
#include "app/farm/worker.h"
#include "app/options/command_tree.h"
#include "app/options/scene_options.h"
#include "app/process/child_process.h"
#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/properties/properties.h"
#include "core/render/picture_file.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kFaultsShown = 10;
constexpr std::initializer_list<const char*> kDeviceOptions{"--device", "--threads", "--require-gpu", "--jobs"};

struct BundleCommand {
  Words words;  // words after --
  farm::BundleOptions options;
  std::string engines = "make,slurm,snakemake,openjd,kubernetes,flamenco";
  farm::Film film;
};

/// Returns the options among `options` that were typed, with their values.
Words typed(const CLI::App& command, std::initializer_list<const char*> options) {
  Words words;
  for (const char* const name : options) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    if (!option || option->count() == 0) continue;
    words.emplace_back(name);
    if (option->get_expected_max() > 0) words.push_back(option->results().back());
  }
  return words;
}

/// Throws UsageError for an option that a bundle does not have. Some of them a bundle decides by itself, and others
/// write files. The legend of --legend-file is written when the bundle is made.
void refuse_options(const SceneOptions& options) {
  for (const Property* const property : properties()) {
    const bool is_possible = property->has(in_bundle) || property->section() == "scene" ||
                             property->key == "legend.file" || property->key == "molecule.file" ||
                             std::ranges::find(kDeviceOptions, property->long_option()) != kDeviceOptions.end();
    if (!is_possible && options.taken().has(*property) && options.typed(property->key))
      throw UsageError("{} after --: a bundle decides that by itself, or does not have it; leave it out",
                       property->long_option());
  }
}

TakenProperties properties_of(const farm::CommandKind& kind) {
  return kind.renderer == farm::Maker::povray    ? povray_properties()
         : kind.renderer == farm::Maker::blender ? blender_properties()
         : kind.name == "render"                 ? render_properties()
                                                 : traced_properties();
}

/// Parses the words after -- by the program's own options, without running their command. Throws UsageError for a
/// command that makes no frames, and for wrong options.
farm::BundledCommand parsed(const Words& words, RenderCommand& command) {
  const std::ptrdiff_t count = words.front() == "export" ? 2 : 1;
  const auto behind = words.begin() + std::min(count, std::ssize(words));
  const auto second = std::find(behind, words.end(), "--");
  farm::BundledCommand bundled;
  bundled.words.assign(words.begin(), behind);
  if (second != words.end()) bundled.renderer.assign(second + 1, words.end());
  const farm::CommandKind& kind = farm::kind_of(bundled.words);
  if (!bundled.renderer.empty() && kind.steps.size() < 2)
    throw UsageError("no renderer is started for {}; leave out what follows the second --", kind.name);
  CLI::App app("", bundled.words.back());
  app.set_help_flag();
  let_the_last_count(app);
  SceneOptions declared(app, properties_of(kind), command);
  PropertyOptions options(app);
  if (kind.name == "render") {
    declared.describe_output("", OutputName::optional);
    options.add("picture.provenance", command.provenance);
    options.add_switch("picture.no_provenance", [&] { command.names_program = false; });
  }
  Words arguments(behind, second);
  std::ranges::reverse(arguments);  // CLI11 takes arguments in reverse order
  try {
    app.parse(arguments);
    refuse_options(declared);
    declared.take();
  } catch (const CLI::ParseError& error) {
    throw UsageError("after --: {}", error.what());
  }
  if (command.scene.molecule.file == "-") throw UsageError("standard input cannot be bundled; name a FILE");
  bundled.command = command;
  bundled.further = typed(app, {"--provenance", "--no-provenance"});
  bundled.device = typed(app, kDeviceOptions);
  return bundled;
}

std::vector<farm::Engine> engines_of(const BundleCommand& command) {
  std::vector<farm::Engine> chosen;
  for (const std::string& word : CLI::detail::split(command.engines, ',')) {
    const std::vector<std::string> known = words_of(property_of("bundle.engine"));
    if (std::ranges::find(known, word) == known.end())
      throw UsageError("--engine: {} is not one of {}", in_quotes(word), fmt::join(known, ", "));
    std::ranges::copy_if(farm::engines(), std::back_inserter(chosen),
                         [&](const farm::Engine& engine) { return word == "all" || word == engine.name; });
  }
  for (const farm::Engine& engine : chosen)
    if (engine.needs_farm_path && command.options.farm_path.empty())
      throw UsageError("--engine {} needs --farm-path: its commands have no working directory", engine.name);
  return chosen;
}

void check_film_name(const std::string& name) {
  if (name.find('/') != std::string::npos || name.starts_with('.') || name.starts_with('-') || !is_film_path(name) ||
      !is_utf8(name))
    throw UsageError("--film {} is not a plain name that ends in .mp4, .mov, .mkv, .webm or .gif", in_quotes(name));
}

void bundle(BundleCommand command) {
  farm::BundleOptions& options = command.options;
  options.engines = engines_of(command);
  if (!command.film.file.empty()) {
    check_film_name(command.film.file);
    options.film = command.film;
  }
  RenderCommand render;
  const farm::MadeBundle made = farm::make_bundle(options, parsed(command.words, render));
  render.force = options.force;
  if (made.legend) write_legend_picture(render.scene.legend.file, *made.legend, image_settings(render));
  for (const std::string& note : made.notes) std::cerr << "meniscus: note: " << escaped(note) << "\n";
  const std::string folder = options.folder.string();
  const farm::Chunking& chunking = made.bundle.chunking;
  fmt::print(std::cout, "{}: {} frames in {} {}{}{}\n", escaped(folder), with_thousands(made.bundle.frames.size()),
             chunking.count, chunking.count == 1 ? "task" : "tasks",
             chunking.seconds_per_frame ? fmt::format(", {:.3g} s a frame here", *chunking.seconds_per_frame) : "",
             made.was_there ? "; it was there already" : "");
  fmt::print(std::cout, "a task: {} {}{}\n", chunking.cores, chunking.cores == 1 ? "core" : "cores",
             chunking.memory() ? fmt::format(", {} MiB of memory", with_thousands(*chunking.memory())) : "");
  for (const farm::Engine& engine : options.engines)
    fmt::print(std::cout, "  {:<9} {}\n", engine.name, escaped(filled(engine.start, {{"DIR", shell_word(folder)}})));
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
  command.add_option("DIR", state->options.folder, "Folder to make")->required()->type_name("");
  command
      .add_option("COMMAND", state->words, "After --: render, or export povray, blender, mitsuba or pbrt, with options")
      ->required()
      ->type_name("");
  PropertyOptions options(command);
  options.add("bundle.engine", state->engines);
  CLI::Option* const minutes = options.add("bundle.chunk_minutes", state->options.chunking.wanted_minutes);
  options.add("bundle.chunk_frames", state->options.chunking.wanted_frames)->excludes(minutes);
  options.add("bundle.task_cores", state->options.chunking.cores);
  options.add("bundle.task_memory", state->options.chunking.wanted_memory);
  CLI::Option* const film = options.add("bundle.film", state->film.file);
  options.add("bundle.fps", state->film.format.frames_per_second)->needs(film);
  options.add("frames.codec", state->film.format.codec)->check(one_of(film_codec_names()));
  options.add("frames.crf", state->film.format.rate_factor);
  options.add("frames.bits", state->film.format.bits)->check(CLI::IsMember({8, 10}).description(""));
  options.add("frames.chroma", state->film.format.chroma)->check(CLI::IsMember({420, 422, 444}).description(""));
  options.add("bundle.farm_path", state->options.farm_path);
  options.add("bundle.by_reference", state->options.by_reference);
  state->options.addon = addon_folder();
  options.add("bundle.addon", state->options.addon);
  options.add("bundle.force", state->options.force);
  command.callback([state, &command] {
    state->options.cores_given = command.count("--task-cores") > 0;
    bundle(*state);
  });
}

namespace {

/// Returns a sentence about how to make the frames that are not good.
std::string advice(const farm::FrameFaults& faults, const std::string& folder) {
  std::vector<std::uint64_t> damaged;
  for (const auto& [frame, fault] : faults)
    if (fault.is_there) damaged.push_back(frame);
  std::string text = fmt::format("`meniscus work {}` makes what is missing", folder);
  if (!damaged.empty()) text += fmt::format(", with --frames {} --force what is damaged", frame_list_text(damaged));
  return text + "; --allow-missing hold goes on without them";
}

void verify(const std::filesystem::path& folder, const std::optional<farm::InPlace>& in_place) {
  const farm::Bundle bundle = farm::read_bundle(folder);
  const StopHandler handler([] { stop_children(); }, std::nullopt);
  farm::check_inputs(bundle, folder, true);
  const farm::FrameFaults faults = farm::faults_of(bundle, folder);
  std::size_t shown = 0;
  for (const auto& [frame, fault] : faults) {
    if (shown++ == kFaultsShown) break;
    std::cerr << fmt::format("meniscus: frame {}: {}\n", frame, escaped(fault.sentence));
  }
  const std::size_t all = bundle.frames.size(), good = all - faults.size();
  if (!faults.empty() && (!in_place || good == 0))
    throw RunError(kExitInput, "{}: {} of {} frames are not good; {}", folder.string(), with_thousands(faults.size()),
                   with_thousands(all), advice(faults, shell_word(folder.string())));
  farm::remove_leftovers(folder);
  if (bundle.film) farm::encode_film(bundle, folder, faults, in_place.value_or(farm::InPlace::hold));
  fmt::print(std::cout, "{} frames are good", with_thousands(good));
  if (!faults.empty()) {
    std::vector<std::uint64_t> missing;
    for (const auto& [frame, fault] : faults) missing.push_back(frame);
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

namespace {

struct WorkCommand {
  std::string folder, frames, chunk, device;
  std::optional<farm::Step> step;
  bool require_gpu = false;
  farm::Order order;
  ProgressStyle progress = ProgressStyle::automatic;
};

/// Returns the frames of K/N, 1 <= K <= N.
std::vector<std::uint64_t> frames_of_chunk(const farm::Bundle& bundle, const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  std::int64_t k = 0, n = 0;
  if (!parse_whole_number(text.substr(0, slash), k) || slash == text.size() ||
      !parse_whole_number(text.substr(slash + 1), n) || k < 1 || k > n)
    throw UsageError("--chunk is {}; it must be K/N with K from 1 to N, such as 3/10", in_quotes(text));
  // Workers of neighbouring chunks on a machine with several GPUs take one each.
  system_process::set_variable(kWorkerVariable, std::to_string(k - 1));
  return farm::chunk_of(bundle, static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(n));
}

/// Returns those frames of the run that are in the list: 0-30 means four frames of a run of every tenth.
std::vector<std::uint64_t> listed_frames(const farm::Bundle& bundle, const std::string& text) {
  const std::uint64_t largest = *std::ranges::max_element(bundle.frames);
  const std::vector<std::uint64_t> list = parse_frame_list("--frames", text, largest + 1);
  const std::set<std::uint64_t> wanted(list.begin(), list.end());
  std::vector<std::uint64_t> frames;
  std::ranges::copy_if(bundle.frames, std::back_inserter(frames), [&](std::uint64_t n) { return wanted.contains(n); });
  if (frames.empty())
    throw UsageError("--frames {}: none of them is in this bundle; it has {}", in_quotes(text),
                     frame_list_text(bundle.frames));
  return frames;
}

void run(WorkCommand command) {
  const farm::Bundle bundle = farm::read_bundle(command.folder);
  farm::Order& order = command.order;
  order.folder = std::filesystem::absolute(command.folder);
  for (const farm::Step step : bundle.steps())
    if (!command.step || command.step == step) order.steps.push_back(step);
  if (order.steps.empty()) throw UsageError("--step: this bundle has no such step; leave it out");
  order.is_whole_run = command.chunk.empty() && command.frames.empty();
  order.frames = !command.chunk.empty()    ? frames_of_chunk(bundle, command.chunk)
                 : !command.frames.empty() ? listed_frames(bundle, command.frames)
                                           : bundle.frames;
  if (!command.device.empty()) order.device = {"--device", command.device};
  if (command.require_gpu) order.device.emplace_back("--require-gpu");
  // Software GL takes as many threads as the machine has cores unless this is set.
  if (order.threads > 0) system_process::set_variable("LP_NUM_THREADS", std::to_string(order.threads));
  const StopHandler handler([] { stop_children(); }, kExitStopped);
  farm::work(bundle, order, command.progress);
}

}  // namespace

void add_work(CLI::App& command) {
  describe(
      command,
      "  meniscus work film                                all that is missing\n"
      "  meniscus work film --step render --chunk 3/10     the third of ten shares of one step\n"
      "  meniscus work film --frames 40-49 --force         these once more",
      "Frames that exist are not made again. So the same command continues after any interruption, even kill -9, and\n"
      "any number of workers can share a bundle. They do not communicate, and may make a few frames twice, with the\n"
      "same bytes. A worker that is stopped (SIGTERM, SIGUSR1, Ctrl-C) leaves only complete files, and ends with exit\n"
      "code 9. If a frame fails, the others are still made; the exit code is that of the failed frame.");
  auto state = std::make_shared<WorkCommand>();
  command.add_option("BUNDLE", state->folder, "Folder of the bundle")->required()->type_name("");
  PropertyOptions options(command);
  options.add_word("work.step", state->step, {farm::Step::surface, farm::Step::render});
  CLI::Option* const frames = options.add("work.frames", state->frames);
  options.add("work.chunk", state->chunk)->excludes(frames);
  options.add("work.force", state->order.force);
  using enum ProgressStyle;
  options.add_word("frames.progress", state->progress, {automatic, bar, plain, json, openjd, none});
  options.add("work.device", state->device);
  options.add("surface.require_gpu", state->require_gpu);
  options.add("surface.threads", state->order.threads);
  command.callback([state] { run(*state); });
}

}  // namespace meniscus

namespace meniscus::farm {
namespace {

constexpr Property kRows[] = {
    text("bundle.engine", "--engine", "WORDS",
         "Engines to write job files for, separated by commas. make, slurm, snakemake, openjd, kubernetes, flamenco, "
         "opencue, or all")
        .proposes("make|slurm|snakemake|openjd|kubernetes|flamenco|opencue|all")
        .initially("all but opencue")
        .in("Tasks"),
    number("bundle.chunk_minutes", "--chunk-minutes", "M", "Wanted minutes per task, estimated from a trial frame")
        .from(0.01, 1e4)
        .initially("5")
        .in("Tasks"),
    count("bundle.chunk_frames", "--chunk-frames", "N", "Frames per task; no trial frame is made")
        .from(1, kUnlimited)
        .in("Tasks"),
    count("bundle.task_cores", "--task-cores", "N", "Cores per task, for engines that run several tasks on a machine")
        .from(1, 4096)
        .initially("@threads@ after --, else 2")
        .in("Tasks"),
    count("bundle.task_memory", "--task-memory", "MIB", "Memory per task in MiB")
        .from(1, 1 << 30)
        .initially("1.5 times that of the trial frame, and 256")
        .in("Tasks"),
    new_file("bundle.film", "--film", "NAME.mp4", "Film that farm verify makes from the pictures, in DIR")
        .in("Options"),
    number("bundle.fps", "--fps", "N", "Frames per second of the film").from(0.1, 1000).initially("25").in("Options"),
    text("bundle.farm_path", "--farm-path", "PATH",
         "Path of DIR on the farm's machines. OpenCue needs it; for Flamenco it is a default")
        .in("Options"),
    flag("bundle.by_reference", "--by-reference",
         "Copy no input files, but name them by path and checksum. All machines need them at these paths")
        .in("Options"),
    file("bundle.addon", "--addon", "DIR", "Folder of render_mns.py of this version, for export blender").in("Options"),
    flag("bundle.force", "--force", "Replace another bundle in DIR and delete all its frames").in("Options"),
    word("verify.allow_missing", "--allow-missing", "WORD",
         "Make the film even if frames are missing or bad. hold: show the previous frame again; drop: leave them out")
        .one_of("hold|drop")
        .in("Options"),
    word("work.step", "--step", "STEP", "Do only this step: surface or render")
        .one_of("surface|render")
        .initially("all, in order")
        .in("Options"),
    text("work.frames", "--frames", "LIST", "Make only these frames of the run, such as 0-99:10,250").in("Options"),
    text("work.chunk", "--chunk", "K/N", "Make only the Kth of N nearly equal parts of the run; K counts from 1")
        .in("Options"),
    flag("work.force", "--force", "Make frames again that already exist").in("Options"),
    text("work.device", "--device", "DEVICE", "Device instead of the bundle's: auto, gpu, gpu:N, software, cpu")
        .proposes("auto|gpu|software|cpu")
        .in("Options"),
};
const PropertyTable kFarmProperties(kRows);

}  // namespace

}  // namespace meniscus::farm
