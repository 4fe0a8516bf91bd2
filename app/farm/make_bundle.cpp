// SPDX-License-Identifier: BSD-3-Clause
// Makes a bundle next to its final name: tries one frame, fills the templates of the engines, renames the folder.
#include "app/farm/make_bundle.h"

#include <fstream>
#include <iterator>

#include "app/farm/bundle_folder.h"
#include "app/farm/worker.h"
#include "app/film/film.h"
#include "app/options/property_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/camera/camera_json.h"
#include "core/render/image_output.h"
#include "core/scene/annotations.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/run_framing.h"
#include "core/scene/scene_picture.h"
#include "core/scene/scene_values.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

/// Turns a name into letters, digits and "._-". Its end is kept because it names the format; a leading dot or dash
/// would hide the file or mislead.
std::string plain(std::string name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
  constexpr std::size_t kLongest = 100;
  std::ranges::replace_if(
      name, [&](char c) { return kPlain.find(c) == std::string_view::npos; }, '_');
  if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
  return name.size() > kLongest ? name.substr(name.size() - kLongest) : name;
}

/// Collects the inputs of a bundle.
class BundleInputs {
 public:
  /// If by_reference is true, files that the command reads stay where they are.
  explicit BundleInputs(bool by_reference) : by_reference_(by_reference) {}

  /// Adds a file that the command reads, and returns its path for a command that runs in the bundle. A file that is
  /// added several times has one name. Throws InputError.
  std::string add_file(const fs::path& source) {
    if (!fs::is_regular_file(source))
      throw InputError(source.string(), 0, "is not a regular file and cannot be bundled");
    const fs::path path = fs::canonical(source);
    for (const Item& item : items_)
      if (item.source == path) return item.path;
    items_.push_back({by_reference_ ? path.string() : unique_path(plain(source.filename().string())), path, {}});
    return items_.back().path;
  }

  /// Adds a text under this name, and returns its path in the bundle.
  std::string add_text(const std::string& name, std::string text) {
    items_.push_back({unique_path(name), {}, std::move(text)});
    return items_.back().path;
  }

  /// Adds Blender's driver and the add-on, without files that Python has compiled.
  void add_addon(const fs::path& addon) {
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
    for (const std::string& name : names) items_.push_back({"inputs/blender/" + name, fs::absolute(addon / name), {}});
  }

  /// Reads every file, and returns sizes and checksums in the order in which they were added. Throws InputError.
  std::vector<Input> measured() const {
    std::vector<Input> inputs;
    for (const Item& item : items_)
      inputs.push_back(item.source.empty() ? Input{item.path, item.text.size(), sha256(item.text)}
                                           : Input{item.path, fs::file_size(item.source), sha256_of_file(item.source)});
    return inputs;
  }

  /// Throws OutputError if a file lies in this folder, which is about to be replaced.
  void refuse_within(const fs::path& folder) const {
    const fs::path place = fs::weakly_canonical(folder);
    for (const Item& item : items_) {
      const fs::path inside = item.source.lexically_relative(place);
      if (!inside.empty() && *inside.begin() != "..")
        throw OutputError(folder.string(), "holds {}, which this command reads; choose another folder",
                          inside.string());
    }
  }

  /// Copies the files that do not stay where they are. Throws OutputError, InputError.
  void copy_to(const fs::path& folder) const {
    for (const Item& item : items_) {
      if (item.source.empty()) write_file(folder / item.path, item.text);
      if (item.source.empty() || fs::path(item.path).is_absolute()) continue;
      const StopBarrier barrier;
      make_folders_of(folder / item.path);
      // OutputFile names a full disk, which std::filesystem::copy_file does not.
      OutputFile file(folder / item.path, Existing::refuse);
      std::ifstream stream(item.source, std::ios::binary);
      std::string piece(std::size_t{1} << 20, '\0');
      while (stream.read(piece.data(), std::ssize(piece)) || stream.gcount() > 0)
        file.write(std::string_view(piece.data(), static_cast<std::size_t>(stream.gcount())));
      if (!stream.eof()) throw InputError(item.source.string(), 0, "cannot be read");
      file.commit();
    }
  }

 private:
  struct Item {
    std::string path;  ///< in the bundle; an absolute one stays where it is
    fs::path source;   ///< empty for a text
    std::string text;
  };
  std::string unique_path(const std::string& name) {
    std::string result = name;
    for (int n = 2; !names_.insert(result).second; ++n) result = fmt::format("{}_{}", n, name);
    return "inputs/" + result;
  }

  bool by_reference_;
  std::vector<Item> items_;
  std::set<std::string> names_;
};

/// Returns the camera that shows all of every frame, so that no worker has to read all frames for it. Returns nothing
/// if the command has its own camera, or frames the molecule next to a legend.
std::optional<Camera> default_camera(const Scene& scene, const GivenCameras& given, ShownFrames& frames) {
  if (given.any() || scene.legend.within) return {};
  ViewRequest molecule = scene.picture;
  const Strips strips = scene_strips(scene, molecule.size());
  molecule.height -= strips.top + strips.bottom;
  return run_cameras(molecule, scene.run_camera, given, frames).front();
}

/// Measures colours if that saves work for each worker: buried areas need the surfaces of all frames. Returns their
/// range, unless the command has one.
std::optional<std::array<double, 2>> measured_range(Scene& scene, ShownFrames& frames) {
  ColorScheme& color = scene.molecule.color;
  const bool is_buried = color.by == ColorScheme::By::buried && !color.range;
  if (is_buried || !scene.legend.file.empty()) measure_colors(color, frames);
  if (!is_buried || (*color.frames_range)[1] <= 0.0) return {};
  return color.frames_range;
}

/// Returns the words of the command with paths in the bundle, with the camera and the range of colours.
std::vector<std::string> bundled_words(const BundledCommand& command, const std::optional<Camera>& camera,
                                       const std::optional<std::array<double, 2>>& range, BundleInputs& inputs) {
  Scene scene = command.command.scene;
  if (range) scene.molecule.color.range = range;
  scene.legend.file.clear();
  // Each worker chooses its device, so the scene names none.
  scene.molecule.surface.cpu = false;
  scene.molecule.surface.gl = {};
  scene.molecule.surface.threads = 0;
  // The camera that is added replaces these values of the default one.
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

/// Makes the first frame and removes it again, because the farm's machines should make all frames alike.
void make_trial(const Bundle& bundle, const fs::path& folder, Chunking& measured) {
  Order order;
  order.folder = folder;
  order.steps = bundle.steps();
  order.frames = {bundle.frames.front()};
  try {
    measured.seconds_per_frame = std::max(work(bundle, order, ProgressStyle::none), 1e-3);
  } catch (const RunError& error) {
    throw RunError(error.code(), "the trial frame failed: {}; with --chunk-frames N no trial is made", error.what());
  }
  const StopBarrier barrier;
  for (const char* made : {"images", "scene"}) fs::remove_all(folder / made);
  measured.peak_memory = (memory_of_largest_child() >> 20) + 1;  // in MiB
}

/// Takes the measurements of an equal bundle that exists, and returns true. Returns false if there is none, or another
/// bundle that `force` allows to replace; throws OutputError for anything else.
bool take_measurements(const BundleOptions& options, Bundle& bundle) {
  if (!fs::exists(options.folder / "bundle.json")) {
    if (fs::exists(options.folder) && !fs::is_empty(options.folder))
      throw OutputError(options.folder.string(), "exists and is not a bundle; choose another folder");
    return false;
  }
  try {
    const Bundle there = read_bundle(options.folder);
    Bundle same = bundle;
    same.chunking.seconds_per_frame = there.chunking.seconds_per_frame;
    same.chunking.peak_memory = there.chunking.peak_memory;
    same.chunking.count = there.chunking.count;
    if (bundle_json(same) == bundle_json(there)) {
      bundle = same;
      return true;
    }
  } catch (const InputError&) {
    // A damaged bundle is another bundle.
  }
  if (!options.force)
    throw OutputError(options.folder.string(), "holds another bundle; use --force to replace it and all its frames");
  return false;
}

MadeBundle described(const BundleOptions& options, const BundledCommand& given, BundleInputs& inputs) {
  SceneCommand command = given.command;
  command.scene = prepared_scene(command.scene);
  Scene& scene = command.scene;
  freeze_selections(scene);
  check_picture(scene);
  if (!scene.legend.file.empty()) check_image_path(scene.legend.file);
  const GivenCameras cameras = given_cameras(scene.picture, scene.run_camera);
  FrameRun frames(scene.molecule, scene.frames);
  log_run(command, frames);
  MadeBundle made;
  if (!frames.trajectory().cut_short().empty())
    made.notes.push_back(frames.trajectory().path() + ": " + frames.trajectory().cut_short());
  Bundle& bundle = made.bundle;
  bundle.program_version = build_version();
  bundle.frames = frames.numbers();
  bundle.command = given.words;
  bundle.device = given.device;
  bundle.renderer = given.renderer;
  bundle.width = scene.picture.width;
  bundle.height = scene.picture.height;
  bundle.film = options.film;
  if (bundle.film) {
    const bool is_layered = scene.image.aovs || scene.image.cryptomatte || scene.image.primaries != Primaries::rec709;
    if (is_layered || bundle.steps().back() != Step::render)
      throw UsageError(
          "--film: this bundle makes scenes, or .exr pictures by --aovs, --cryptomatte or --color-space, which films "
          "cannot use; leave one of them out");
    bundle.film->format.transparent = scene.film.transparent;
    check_film_size(film_encoder(bundle.film->file, bundle.film->format), {bundle.width, bundle.height});
  }
  ShownFrames shown(scene.molecule, frames);
  const std::optional<std::array<double, 2>> range = measured_range(scene, shown);
  if (!scene.legend.file.empty())
    made.legend.emplace(key_of(frames, scene), scene.picture.size(),
                        legend_style(scene.legend.style, scene.annotations.letters));
  bundle.command = bundled_words(given, default_camera(scene, cameras, shown), range, inputs);
  for (const std::string& word : bundle.command)
    if (!is_utf8(word)) throw UsageError("after --: {} is not UTF-8, as a bundle is", in_quotes(word));
  if (bundle.maker(bundle.steps().back()) == Maker::blender) inputs.add_addon(options.addon);
  bundle.inputs = inputs.measured();
  bundle.chunking = options.chunking;
  const auto threads = std::ranges::find(given.device, "--threads");
  if (!options.cores_given && threads != given.device.end()) bundle.chunking.cores = std::stoull(threads[1]);
  return made;
}

/// Adds a note if tasks are larger than was wanted.
void note_larger_tasks(MadeBundle& made) {
  const Chunking& chunking = made.bundle.chunking;
  const std::uint64_t frames = made.bundle.frames.size(), wanted = chunking.wanted_count(frames);
  if (wanted <= chunking.count) return;
  made.notes.push_back(fmt::format("{} tasks were wanted; queues accept {}, so a task has up to {} frames",
                                   with_thousands(wanted), with_thousands(chunking.count),
                                   with_thousands((frames + chunking.count - 1) / chunking.count)));
}

}  // namespace

MadeBundle make_bundle(const BundleOptions& given, const BundledCommand& command) {
  BundleOptions options = given;
  options.folder = fs::absolute(options.folder).lexically_normal();
  if (!options.folder.has_filename()) options.folder = options.folder.parent_path();
  require_plain_path(options.farm_path);
  BundleInputs inputs(options.by_reference);
  MadeBundle made = described(options, command, inputs);
  made.was_there = take_measurements(options, made.bundle);
  std::optional<HiddenFolder> staging;
  if (made.was_there) {
    made.legend.reset();
  } else {
    if (made.legend)
      check_output(command.command.scene.legend.file, options.force ? Existing::replace : Existing::refuse);
    inputs.refuse_within(options.folder);
    make_folders_of(options.folder);
    staging.emplace(options.folder.parent_path(), options.folder.filename().string());
    inputs.copy_to(staging->path());
    Chunking& chunking = made.bundle.chunking;
    if (!chunking.wanted_frames) make_trial(made.bundle, staging->path(), chunking);
    chunking.count = std::min(chunking.wanted_count(made.bundle.frames.size()), kMostTasks);
  }
  note_larger_tasks(made);
  for (const Engine& engine : options.engines)
    write_job_files(engine, made.bundle, options.farm_path, staging ? staging->path() : options.folder);
  if (staging) {
    write_file(staging->path() / "bundle.json", bundle_json(made.bundle));
    const StopBarrier barrier;
    if (fs::exists(options.folder / "bundle.json")) fs::remove_all(options.folder);
    fs::rename(staging->path(), options.folder);
  }
  return made;
}

namespace {

/// Returns three times the time that a task was measured to take, and ten minutes for a slow start. The text is empty
/// if nothing was measured, so that the site's default applies.
std::string minutes(const Bundle& bundle) {
  const Chunking& chunking = bundle.chunking;
  if (!chunking.seconds_per_frame) return {};
  const double frames = std::ceil(static_cast<double>(bundle.frames.size()) / static_cast<double>(chunking.count));
  return fmt::format("{:.0f}", std::ceil(10.0 + 3.0 * frames * *chunking.seconds_per_frame / 60.0));
}

std::vector<Filling> fillings(const Bundle& bundle, const std::string& farm_path) {
  const Chunking& chunking = bundle.chunking;
  const bool needs_gpu = std::ranges::find(bundle.device, "--require-gpu") != bundle.device.end();
  return {{"COUNT", std::to_string(chunking.count)},
          {"CORES", std::to_string(chunking.cores)},
          {"MEMORY", chunking.memory() ? std::to_string(*chunking.memory()) : ""},
          {"GPUS", needs_gpu ? "1" : ""},
          {"MINUTES", minutes(bundle)},
          {"PATH", farm_path.empty() ? "PATH_OF_THE_BUNDLE" : farm_path}};
}

std::string filled_lines(std::string_view text, const std::vector<Filling>& fillings) {
  std::string result;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n') + 1);
    const auto is_unknown = [&](const Filling& filling) {
      return filling.text.empty() && line.find("@" + filling.name + "@") != std::string_view::npos;
    };
    if (std::ranges::none_of(fillings, is_unknown)) result += filled(line, fillings);
    text.remove_prefix(line.size());
  }
  return result;
}

}  // namespace

const std::vector<Engine>& engines() {
  static const std::vector<Engine> table{
      {"make", {"Makefile"}, "make -C @DIR@ -j2"},
      {"slurm", {"submit.sh", "slurm/work.sbatch", "slurm/verify.sbatch"}, "@DIR@/submit.sh"},
      {"snakemake", {"Snakefile"}, "snakemake --cores 2 -d @DIR@ -s @DIR@/Snakefile"},
      {"openjd", {"template.json"}, "deadline bundle submit @DIR@, or openjd run @DIR@/template.json"},
      {"kubernetes",
       {"kubernetes.yaml"},
       "set image and volume in @DIR@/kubernetes.yaml; then kubectl apply -f @DIR@/kubernetes.yaml"},
      {"flamenco",
       {"meniscus_film.js", "flamenco_job.json"},
       "once: @DIR@/meniscus_film.js into the manager's scripts folder; then POST @DIR@/flamenco_job.json"},
      {"opencue", {"opencue.xml"}, "launch @DIR@/opencue.xml, by pycue's launchSpec", true},
  };
  return table;
}

void require_plain_path(const std::string& farm_path) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/";
  if (farm_path.find_first_not_of(kPlain) != std::string::npos || farm_path.starts_with('-'))
    throw RequestError(
        "--farm-path {}: has other characters than letters, digits and ._-/, which some "
        "engine would read as more than a path; choose another path",
        in_quotes(farm_path));
}

void write_job_files(const Engine& engine, const Bundle& bundle, const std::string& farm_path, const fs::path& folder) {
  require_plain_path(farm_path);
  for (const char* const file : engine.files) {
    const fs::path path = folder / file;
    write_file(path, filled_lines(template_text(farm_templates(), file), fillings(bundle, farm_path)));
    constexpr auto kExecutable = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
    if (path.extension() == ".sh") fs::permissions(path, kExecutable, fs::perm_options::add);
  }
}

}  // namespace meniscus::farm
