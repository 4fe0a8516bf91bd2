// SPDX-License-Identifier: BSD-3-Clause
// Builds a bundle beside its final name, tries one frame, and renames it.
#include "app/farm/make_bundle.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/bundle_inputs.h"
#include "app/farm/worker.h"
#include "app/film/film.h"
#include "app/options/scene_words.h"
#include "app/process/child_process.h"
#include "app/process/program_error.h"
#include "app/process/stop_signals.h"
#include "app/process/this_program.h"
#include "app/reports/notes.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/base/utf8.h"
#include "core/camera/camera_json.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/picture_file.h"
#include "core/scene/annotations.h"
#include "core/scene/figure_key.h"
#include "core/scene/frame_run.h"
#include "core/scene/run_cameras.h"
#include "core/scene/run_framing.h"
#include "core/scene/scene_picture.h"
#include "core/scene/scene_values.h"
#include "core/scene/settled_selections.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

/// The camera that shows all of every frame, so that no worker has to read all frames for it. Nothing if the command
/// has its own, or frames the molecule beside a legend.
std::optional<Camera> default_camera(const Scene& scene, const GivenCameras& given, ShownFrames& frames) {
  if (given.any() || scene.legend.within) return {};
  ViewRequest molecule = scene.picture;
  const Strips strips = scene_strips(scene, molecule.size());
  molecule.height -= strips.top + strips.bottom;
  return run_cameras(molecule, scene.run_camera, given, frames).front();
}

/// Measures colours where that spares each worker to do it: buried areas need the surfaces of all frames. Returns their
/// range, if the command has none.
std::optional<std::array<double, 2>> measured_range(Scene& scene, ShownFrames& frames) {
  ColorScheme& color = scene.molecule.color;
  const bool is_buried = color.by == ColorScheme::By::buried && !color.range;
  if (is_buried || !scene.legend.file.empty()) measure_colors(color, frames);
  if (!is_buried || (*color.frames_range)[1] <= 0.0) return {};
  return color.frames_range;
}

/// That of --legend-file, which is the same for all frames.
std::optional<Legend> legend_of(const Scene& scene, const FrameRun& frames) {
  if (scene.legend.file.empty()) return {};
  return Legend(key_of(frames, scene), scene.picture.size(),
                legend_style(scene.legend.style, scene.annotations.letters));
}

void write_legend(const BundledCommand& command, const Legend& legend, Existing existing) {
  const Scene& scene = command.command.scene;
  ImageSettings settings{scene.image.background, existing, scene.look.has_linear_alpha(), scene.picture.dots_per_inch};
  const auto is_given = [&](const char* option) { return std::ranges::count(command.further, option) > 0; };
  settings.names_program = !is_given("--no-provenance");
  if (is_given("--provenance")) settings.command = command_line();
  write_legend_picture(scene.legend.file, legend, settings);
}

/// Blender's driver and the add-on, but for what Python has compiled.
void add_addon(const fs::path& addon, BundleInputs& inputs) {
  if (!fs::exists(addon / "render_mns.py"))
    throw InputError(
        addon.string(), 0,
        "has no render_mns.py, Blender's driver; name its folder by --addon: in the sources exporters/blender/addon");
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(addon)) {
    const fs::path inside = entry.path().lexically_relative(addon);
    if (inside.extension() == ".py" || inside.filename().string().ends_with("LICENSE.txt"))
      names.insert(inside.string());
  }
  for (const std::string& name : names) inputs.add_own_file("blender/" + name, addon / name);
}

/// The words of the command with paths in the bundle, and with the camera and the range of colours.
std::vector<std::string> bundled_words(const BundledCommand& command, const std::optional<Camera>& camera,
                                       const std::optional<std::array<double, 2>>& range, BundleInputs& inputs) {
  Scene scene = command.command.scene;
  if (range) scene.molecule.color.range = range;
  scene.legend.file.clear();
  // Each worker chooses its device, so the scene names none.
  scene.molecule.surface.cpu = false;
  scene.molecule.surface.gl = {};
  scene.molecule.surface.threads = 0;
  // All that was asked of the default camera is in the one that is added.
  if (camera) {
    scene.picture.projection = Projection::perspective;
    scene.picture.direction.reset();
    scene.picture.turns.clear();
    scene.picture.zoom_to.reset();
  }
  std::vector<std::string> words = command.words;
  const std::vector<std::string> values =
      scene_words(scene, [&](const std::string& path) { return inputs.add_file(path); });
  words.insert(words.end(), values.begin(), values.end());
  words.insert(words.end(), command.further.begin(), command.further.end());
  if (camera) words.insert(words.end(), {"--camera", inputs.add_text("camera.json", camera_json(*camera))});
  return words;
}

/// A folder under a hidden name beside its final one; it vanishes unless renamed, on a signal, too. What is made in it
/// is made while there is a StopBarrier, or by children.
class Staging {
 public:
  explicit Staging(const fs::path& target)
      : target_(target),
        path_(target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid())) {
    const StopBarrier barrier;
    std::error_code error;
    fs::create_directories(path_, error);
    if (error) throw OutputError(target.string(), fmt::format("cannot be made: {}", error.message()));
  }
  ~Staging() { remove(); }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  const fs::path& path() const { return path_; }
  /// An older bundle under that name goes away.
  void become_target() {
    const StopBarrier barrier;
    std::error_code error;
    if (fs::exists(target_ / "bundle.json")) fs::remove_all(target_, error);
    if (!error) fs::rename(path_, target_, error);
    if (error) throw OutputError(target_.string(), fmt::format("cannot get its final name: {}", error.message()));
  }

 private:
  /// Again and again, for another thread may be about to write into it.
  void remove() const {
    std::error_code failed;
    constexpr int kMostTries = 100;
    for (int tries = 0; tries < kMostTries && fs::exists(path_, failed); ++tries) fs::remove_all(path_, failed);
  }

  fs::path target_, path_;
  StopHandler stop_{[this] {
                      stop_children();
                      remove();
                    },
                    std::nullopt};
};

/// In MiB, of the largest child that this process has had.
std::uint64_t peak_memory_of_children() {
  struct rusage usage {};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) / 1024 + 1;
}

/// Makes the first frame and takes it away again: the farm's machines should make all of them alike.
void make_trial(const Bundle& bundle, const Staging& staging, Chunking& measured) {
  const Share share{bundle.steps(), {bundle.frames.front()}};
  try {
    const double seconds = work(bundle, Workplace{staging.path(), {}, 0}, share, ProgressStyle::none);
    measured.seconds_per_frame = std::max(seconds, 1e-3);
  } catch (const RunError& error) {
    throw RunError(error.code(), fmt::format("the trial frame: {}; with --chunk-frames N there is none", error.what()));
  }
  const StopBarrier barrier;
  for (const char* made : {"images", "scene"}) fs::remove_all(staging.path() / made);
  measured.peak_memory = peak_memory_of_children();
}

void write_engine_files(const BundleOptions& options, const Bundle& bundle, const fs::path& folder) {
  const StopBarrier barrier;
  for (const Engine& engine : options.engines) {
    for (const EngineFile& text : emit(engine, bundle, options.farm_path)) {
      const fs::path path = folder / text.path;
      fs::create_directories(path.parent_path());
      OutputFile file(path, Existing::replace);
      file.write(text.text);
      file.commit();
      if (text.is_executable)
        fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                        fs::perm_options::add);
    }
  }
}

/// What lies at the target: nothing, or the same bundle. Throws OutputError for anything else, unless forced.
std::optional<Bundle> same_bundle_at(const BundleOptions& options, const Bundle& bundle) {
  std::error_code error;
  if (!fs::exists(options.folder / "bundle.json")) {
    if (fs::exists(options.folder) && !fs::is_empty(options.folder, error))
      throw OutputError(options.folder.string(), "exists and is not a bundle; choose another folder");
    return {};
  }
  try {
    Bundle there = read_bundle(options.folder);
    if (same_but_for_measurement(there, bundle)) return there;
  } catch (const InputError&) {
    // Damaged: another bundle, then.
  }
  if (!options.force)
    throw OutputError(options.folder.string(), "holds another bundle; use --force to replace it and all its frames");
  return {};
}

/// Cores of a task that uses as many threads as the command says.
std::uint64_t cores_for(const std::vector<std::string>& device, std::uint64_t otherwise) {
  const auto option = std::ranges::find(device, "--threads");
  return option == device.end() ? otherwise : std::stoull(*(option + 1));
}

Bundle described(const BundleOptions& options, const BundledCommand& asked, BundleInputs& inputs,
                 std::optional<Legend>& legend, std::vector<std::string>& notes) {
  SceneCommand command = asked.command;
  command.scene = readied(command.scene);
  Scene& scene = command.scene;
  settle_selections(scene);
  check_picture(scene);
  if (!scene.legend.file.empty()) check_image_path(scene.legend.file);
  const GivenCameras cameras = given_cameras(scene.picture, scene.run_camera);
  FrameRun frames(scene.molecule, scene.frames);
  tell_run(command, frames);
  if (!frames.trajectory().cut_short().empty())
    notes.push_back(frames.trajectory().path() + ": " + frames.trajectory().cut_short());
  Bundle bundle;
  bundle.program_version = build_version();
  bundle.frames = frames.numbers();
  bundle.command = asked.words;
  bundle.device = asked.device;
  bundle.renderer = asked.renderer;
  if (options.film && bundle.steps().back() != Step::render)
    throw UsageError("--film: this bundle makes scenes, not pictures; leave it out");
  if (options.film && (scene.image.aovs || scene.image.cryptomatte || scene.image.primaries != Primaries::rec709))
    throw UsageError(
        "--film: pictures with --aovs, --cryptomatte or --color-space are .exr, which films cannot use; leave one of "
        "them out");
  bundle.width = scene.picture.width;
  bundle.height = scene.picture.height;
  bundle.film = options.film;
  if (bundle.film) {
    bundle.film->format.transparent = scene.film.transparent;
    check_film_size(film_encoder(bundle.film->file, bundle.film->format), {bundle.width, bundle.height});
  }
  ShownFrames shown(scene.molecule, frames);
  const std::optional<std::array<double, 2>> range = measured_range(scene, shown);
  legend = legend_of(scene, frames);
  bundle.command = bundled_words(asked, default_camera(scene, cameras, shown), range, inputs);
  for (const std::string& word : bundle.command)
    if (!is_utf8(word)) throw UsageError(fmt::format("after --: {} is not UTF-8, as a bundle is", in_quotes(word)));
  if (bundle.maker(bundle.steps().back()) == Maker::blender) add_addon(options.addon, inputs);
  bundle.inputs = inputs.measured();
  bundle.chunking = options.chunking;
  if (!options.cores_asked) bundle.chunking.cores = cores_for(asked.device, bundle.chunking.cores);
  return bundle;
}

/// Larger tasks than were asked for are told.
void note_larger_tasks(const Bundle& bundle, std::vector<std::string>& notes) {
  const Chunking& chunking = bundle.chunking;
  const std::uint64_t frames = bundle.frames.size(), wanted = chunking.wanted_count(frames);
  if (wanted <= chunking.count) return;
  const std::string asked = chunking.asked_frames ? fmt::format("--chunk-frames {}", *chunking.asked_frames)
                                                  : fmt::format("--chunk-minutes {}", chunking.asked_minutes);
  notes.push_back(fmt::format("{} would make {} tasks; queues accept {}, so a task has up to {} frames", asked,
                              with_thousands(wanted), with_thousands(chunking.count),
                              with_thousands((frames + chunking.count - 1) / chunking.count)));
}

}  // namespace

MadeBundle make_bundle(const BundleOptions& given, const BundledCommand& command) {
  BundleOptions options = given;
  options.folder = fs::absolute(options.folder).lexically_normal();
  if (!options.folder.has_filename()) options.folder = options.folder.parent_path();
  require_plain_path(options.farm_path);
  MadeBundle made;
  BundleInputs inputs(options.by_reference);
  std::optional<Legend> legend;
  made.bundle = described(options, command, inputs, legend, made.notes);
  if (const std::optional<Bundle> there = same_bundle_at(options, made.bundle)) {
    made.bundle = *there;
    made.was_there = true;
    note_larger_tasks(made.bundle, made.notes);
    write_engine_files(options, made.bundle, options.folder);
    return made;
  }
  const Existing existing = options.force ? Existing::replace : Existing::refuse;
  if (legend) check_output(command.command.scene.legend.file, existing);
  inputs.refuse_within(options.folder);
  Staging staging(options.folder);
  inputs.copy_to(staging.path());
  Chunking& chunking = made.bundle.chunking;
  if (!chunking.asked_frames) make_trial(made.bundle, staging, chunking);
  chunking.decide(made.bundle.frames.size());
  note_larger_tasks(made.bundle, made.notes);
  write_engine_files(options, made.bundle, staging.path());
  {
    const StopBarrier barrier;
    OutputFile file(staging.path() / "bundle.json", Existing::refuse);
    file.write(bundle_json(made.bundle));
    file.commit();
  }
  staging.become_target();
  if (legend) write_legend(command, *legend, existing);
  return made;
}

}  // namespace meniscus::farm
