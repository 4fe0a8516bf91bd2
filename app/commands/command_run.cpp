// SPDX-License-Identifier: BSD-3-Clause
// Reads molecules and runs, passes their structures or figures to a command, and turns options of `meniscus render`
// into settings of pictures, and options that scenes share into words that each scene parses.
#include "app/commands/command_run.h"

#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "app/reports/notes.h"
#include "core/camera/camera_json.h"
#include "core/queries/copies.h"
#include "core/scene/scene_value.h"

namespace meniscus {

NumberRun::NumberRun(const SceneCommand& command) : command_(command) {
  if (!command.scene.frames.is_requested()) {
    molecule_ = read_and_log(command);
    return;
  }
  frames_ = std::make_unique<FrameRun>(command.scene.molecule, command.scene.frames);
  log_run(command, *frames_);
}

void NumberRun::make(std::uint64_t bytes_per_atom,
                     const std::function<Worker(const std::shared_ptr<MoleculeBuilder>&)>& make_worker,
                     const std::function<void()>& commit) {
  if (!frames_) {
    make_molecule(make_worker(std::make_shared<MoleculeBuilder>(command_.scene.molecule)));
    return commit();
  }
  std::vector<FrameWorker> workers;
  for (const auto& builder : frame_builders(*frames_, command_, bytes_per_atom * frames_->structure().atoms.size()))
    workers.push_back([worker = make_worker(builder)](RunFrame frame) {
      return worker(
          {std::move(frame.structure), std::move(frame.together), FrameNote{frame.source, frame.time}, frame.number});
    });
  make_frames(std::move(workers), commit);
}

void NumberRun::make_molecule(const Worker& worker) {
  NumberedStructure numbered{std::move(molecule_), {}, {}, 0};
  const MoleculeRequest& molecule = command_.scene.molecule;
  if (const std::optional<Selection>& context = command_.scene.frames.context)
    numbered.together = read_molecule(with_context(molecule, *context));
  worker(std::move(numbered))();
}

void NumberRun::make_frames(std::vector<FrameWorker> workers, const std::function<void()>& commit) {
  SceneCommand command = command_;
  // On a terminal the rows show the progress; a bar would collide with them.
  ProgressStyle& progress = command.reporting.progress;
  if (progress == ProgressStyle::automatic && system_process::is_terminal(stdout)) progress = ProgressStyle::none;
  try {
    run_frames(*frames_, command, std::move(workers));
  } catch (const RunError&) {
    commit();  // a run with failed frames keeps the others; the exit code reports it
    throw;
  }
  commit();
}

std::uint32_t lasting_number(const Structure& structure, std::uint32_t atom) {
  const Atom& named = structure.atoms[atom];
  return named.copy * static_cast<std::uint32_t>(structure.topology->atoms.size()) + named.index;
}

namespace {

SceneCommand ready(const SceneCommand& command) {
  SceneCommand made = command;
  made.scene = prepared_scene(command.scene);
  freeze_selections(made.scene);
  return made;
}

/// Returns the keys in ascending order of the frames' numbers, because a run may have them in any order.
std::vector<CameraKey> keys_of(std::span<const Camera> cameras, std::span<const std::uint64_t> frames) {
  std::vector<CameraKey> keys;
  for (std::size_t n = 0; n < frames.size(); ++n) keys.push_back({static_cast<double>(frames[n]), cameras[n]});
  std::ranges::sort(keys, {}, &CameraKey::frame);
  return keys;
}

}  // namespace

FigureRun::FigureRun(const SceneCommand& command, Velocities velocities)
    : command_(ready(command)), given_(given_cameras(command_.scene.picture, command_.scene.run_camera)) {
  if (command_.scene.frames.is_requested())
    open_run(velocities);
  else
    make_one_figure();
}

void FigureRun::open_run(Velocities velocities) {
  MoleculeRequest& molecule = command_.scene.molecule;
  // Atoms that move where an open book opens have no velocity from their old positions.
  frames_ =
      std::make_unique<FrameRun>(molecule, command_.scene.frames, molecule.interface ? Velocities::none : velocities);
  shown_ = std::make_unique<ShownFrames>(molecule, *frames_);
  log_run(command_, *frames_);
  measure_colors(molecule.color, *shown_);
}

void FigureRun::make_one_figure() {
  Structure structure = read_and_log(command_);
  aim_.emplace(command_.scene.picture, command_.scene.molecule.show, structure);
  warn_if_unseen(command_, given_.still, structure);
  figure_ = make_figure(build_and_log(command_, std::move(structure)), command_.scene.figure);
  for (std::size_t n = 0; n < scene().figure.objects.size(); ++n)
    if (const FigureObjectRequest& object = scene().figure.objects[n];
        object.is_dashed() && figure_->extras.objects[n].lengths.empty())
      log_line(command_, fmt::format("note: {} {} finds nothing to draw; water counts only if it is drawn or selected",
                                     option_name(object.option()), in_quotes(object.text())));
}

namespace {

/// Returns a note if the atoms that a picture is zoomed to lie at several places. The word `first` of a selection keeps
/// the first of these places; the note names another. Without `first` only ligands are reported. Returns an empty text
/// if there is nothing to say.
std::string several_places(const Selection& zoom_to, std::span<const Atom> atoms) {
  constexpr std::string_view kFirst = "first ";
  std::string text = zoom_to.text();
  const bool shows_first = text.starts_with(kFirst);
  if (shows_first) text = text.substr(kFirst.size());
  if (text.starts_with('(') && text.find(')') + 1 == text.size()) text = text.substr(1, text.size() - 2);
  std::vector<bool> rest = parse_selection(text).evaluate(atoms);
  std::string name;
  std::vector<glm::dvec3> middles;
  for (int turn = 0; turn < 2; ++turn) {
    const std::vector<bool> place = first_place(atoms, rest);
    const auto head = std::ranges::find(place, true);
    if (head == place.end()) return {};
    const Atom& atom = atoms[static_cast<std::size_t>(head - place.begin())];
    name = fmt::format("resid {}", atom.residue_number);
    if (!atom.chain.empty()) name += " and chain " + atom.chain;
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (rest[n] && !shows_first && atoms[n].kind != AtomClass::ligand) return {};
      if (place[n]) sum += atoms[n].position;
      rest[n] = rest[n] && !place[n];
    }
    middles.push_back(sum / static_cast<double>(std::ranges::count(place, true)));
  }
  return fmt::format("{} is at several places, the first two {:.0f} Å apart, and {}; name one, such as {}",
                     in_quotes(text), glm::distance(middles[0], middles[1]),
                     shows_first ? "the first is shown" : "the picture has all of them", in_quotes(name));
}

}  // namespace

void FigureRun::aim(const ViewRequest& picture, bool extent) {
  if (!frames_) {
    framing_.cameras = {picture.fits ? fitted(picture).camera
                                     : aim_->camera(picture, given_.still, aim_->viewed(*figure_))};
  } else if (extent) {
    framing_ = run_framing(picture, scene().run_camera, given_, *shown_);
  } else {
    framing_.cameras = run_cameras(picture, scene().run_camera, given_, *shown_);
  }
  if (const std::optional<Selection>& zoom_to = scene().picture.zoom_to) {
    const std::string sentence = several_places(*zoom_to, shown_atoms(structure()));
    if (!sentence.empty()) log_line(command_, "note: " + sentence);
  }
  log_ineffective_cuts();
}

PictureFit FigureRun::fitted(ViewRequest picture) const {
  const int height = picture.height;
  picture.height = 3 * picture.width / 4;  // the camera is that of an ordinary picture, whose view is then made lower
  const ViewedAtoms seen = aim_->viewed(*figure_);
  return picture_fit(aim_->camera(picture, given_.still, seen), picture.size(), height, seen.framed,
                     fitted_margin(scene(), scene().picture.size()));
}

int FigureRun::fit() {
  Scene& scene = command_.scene;
  constexpr int kTurns = 4;  // the width of the legend depends on the height
  for (int turn = 0; scene.picture.fits && turn < kTurns; ++turn) {
    const PictureLayout layout(scene, key());
    scene.picture.height = std::clamp(scene.picture.height + fitted(layout.size).height - layout.size.height, 1,
                                      scene_values::kLargestSide);
  }
  return scene.picture.height;
}

void FigureRun::log_ineffective_cuts() const {
  const Camera& camera = framing_.cameras.front();
  if (!frames_) {
    for (const std::string& sentence : ineffective_cuts(scene().figure, *figure_, camera))
      log_line(command_, "note: --clip " + sentence);
    return;
  }
  if (scene().figure.cuts.empty() || scene().figure.hides_surface) return;
  const SurfaceRequest& surface = scene().molecule.surface;
  std::vector<Ball> balls = grown(balls_of(structure()), growth_of(surface.kind, surface.probe_radius));
  if (!structure().instances.empty()) balls = reaching_balls(balls, structure().instances);
  const CutAtoms atoms = cut_atoms(scene().figure.cuts, structure());
  for (const std::string& sentence : ineffective_cuts(scene().figure.cuts, atoms, {camera, balls, balls}, balls))
    log_line(command_, fmt::format("note: --clip {}, in the first frame of the run", sentence));
}

void FigureRun::save_cameras() const {
  meniscus::save_cameras(command_, framing_.cameras,
                         frames_ ? std::span(frames_->numbers()) : std::span<const std::uint64_t>());
}

Camera FigureRun::camera_for(const ViewRequest& picture, const std::optional<Camera>& given) {
  if (frames_) return run_cameras(picture, {}, {given, std::nullopt}, *shown_).front();
  const ViewAim aim(picture, scene().molecule.show, figure_->molecule.structure);
  return aim.camera(picture, given, aim.viewed(*figure_));
}

void FigureRun::measure(ColorScheme& color) {
  if (frames_) measure_colors(color, *shown_);
}

ColorKey FigureRun::key() const {
  return frames_ ? key_of(*frames_, scene()) : key_of(figure_->molecule, scene().figure, figure_->extras);
}

void FigureRun::make(const FigureWork& work, const std::function<Sink()>& make_sink) {
  if (!frames_) {
    const Camera& camera = framing_.cameras.front();
    if (make_sink()({0, 0, 0, std::nullopt, std::move(*figure_), camera, {}})().shows_nothing)
      log_line(command_, kShowsNothing);
    return;
  }
  const std::uint64_t bytes = work.bytes_per_atom * structure().atoms.size() + work.bytes_per_frame;
  const auto builders = frame_builders(*frames_, command_, bytes, work.context);
  std::vector<FrameWorker> workers;
  for (const std::shared_ptr<MoleculeBuilder>& builder : builders)
    workers.push_back([this, builder, sink = make_sink()](RunFrame frame) {
      const Camera& seen_by = camera(frame.place);
      return sink({frame.number, frame.source, frame.place, frame.time,
                   make_figure(builder->build(std::move(frame.structure)), scene().figure), seen_by,
                   std::move(frame.velocities)});
    });
  run_frames(*frames_, command_, std::move(workers));
  warn_beyond_map(command_, builders);
}

void merge_copies(std::vector<SurfaceObject>& objects, bool are_cut) {
  if (std::ranges::none_of(objects, [](const SurfaceObject& object) { return object.copies.size() > 1; })) return;
  if (!are_cut && !copies_differ(objects)) return;
  SurfaceObject whole = merged(std::move(objects));
  objects.clear();
  objects.push_back(std::move(whole));
}

void check_caps_of_map(const Scene& scene, std::string_view reason) {
  if (!scene.molecule.color.of_points()) return;
  const char* const option =
      scene.molecule.color.by == ColorScheme::By::volume ? "--color-map-file" : "--color lipophilicity";
  if (!scene.figure.cuts.empty() && !scene.figure.cap.color)
    throw UsageError("{} with --clip needs --cap-color: {}", option, reason);
  for (const FigureObjectRequest& object : scene.figure.objects)
    if (!object.shapes && !object.color && !object.cuts.empty() && !object.cap.color)
      throw UsageError("{} with a \"clip\" in --object needs its \"cap_color\": {}", option, reason);
}

void check_saved_camera(const SceneCommand& command) {
  if (!command.save_camera.empty()) check_output(command.save_camera, command.existing());
}

void save_cameras(const SceneCommand& command, std::span<const Camera> cameras, std::span<const std::uint64_t> frames) {
  if (command.save_camera.empty()) return;
  OutputFile file(command.save_camera, command.existing());
  const bool moves = command.scene.run_camera.moves() && !frames.empty();
  file.write(moves ? camera_path_json(keys_of(cameras, frames)) : camera_json(cameras.front()));
  file.commit();
}

MadeFrame made_frame(std::span<const std::filesystem::path> files) {
  MadeFrame made;
  for (const std::filesystem::path& file : files) made.files.push_back(file.string());
  return made;
}

void run_and_save_scene(const SceneCommand& command, const std::function<void()>& run) {
  SceneOutput scene(command);
  run();
  scene.commit();
}

ImageSettings image_settings(const RenderCommand& command) {
  const Scene& scene = command.scene;
  ImageSettings settings{scene.image.background, command.existing(), scene.look.has_linear_alpha()};
  settings.dots_per_inch = scene.picture.dots_per_inch;
  settings.names_program = command.names_program;
  if (command.provenance) settings.command = command_line();
  if (command.keeps_scene) settings.scene = scene_text(scene, "", *command.added);
  settings.exr.primaries = scene.image.primaries;
  settings.made_of = command.made_of;
  settings.tiff = scene.image.tiff;
  return settings;
}

RenderSettings picture_settings(const RenderCommand& command, const PictureLayout& layout) {
  RenderSettings settings = render_settings(command.scene, layout);
  // Exact times are needed only for pictures with printed times.
  if (command.stats || (!command.scene.frames.is_requested() && !command.reporting.quiet))
    settings.timing = StageTiming::exact;
  return settings;
}

std::vector<std::string> shared_words(const SceneOptions& options, std::span<const std::string_view> but) {
  std::vector<std::string> words;
  for (const Property* property : properties()) {
    if (!options.taken().has(*property) || !options.typed(property->key) ||
        std::ranges::find(but, property->key) != but.end())
      continue;
    const std::string name(property->long_option());
    if (property->type == ValueType::flag) {
      words.push_back(name);
      continue;
    }
    for (const std::string& text : options.typed_texts(*property)) {
      words.push_back(name);
      words.push_back(text);
    }
  }
  return words;
}

SceneCommand read_scene_file(const std::string& path, std::vector<std::string> words, const Reporting& reporting) {
  CLI::App app("", "render");
  DeclaredCommand<RenderCommand> read(app, render_properties());
  read.state.reporting.quiet = true;
  // The scene's own output is not written, so it may exist, and may be read.
  words.insert(words.begin(), {"--scene", path, "-o", "-"});
  std::ranges::reverse(words);
  app.parse(words);
  read.state.reporting.quiet = true;  // an option without effect in one scene may have one in another
  read.options.take();
  SceneCommand command = std::move(static_cast<SceneCommand&>(read.state));
  const PictureOutput& image = command.scene.image;
  if (image.extent || image.aovs || image.cryptomatte || image.primaries != Primaries::rec709)
    throw UsageError(
        "{}: this command shows complete surfaces as sRGB colours; leave image.extent, "
        "image.aovs, image.cryptomatte and image.color_space out",
        escaped(path));
  command.reporting = reporting;
  return command;
}

void make_draft(Scene& scene) {
  ViewRequest& picture = scene.picture;
  // Returns half the size, an even number, as films require.
  const auto half = [](int pixels) { return std::max(2, (pixels / 2 + 1) / 2 * 2); };
  picture.width = half(picture.width);
  picture.height = half(picture.height);
  picture.dots_per_inch /= 2.0;
  constexpr int kLeastLetter = 6;
  LetterStyle& letters = scene.annotations.letters;
  for (std::optional<int>* const height :
       {&letters.all, &letters.labels, &letters.scale_bar, &letters.panel, &scene.legend.style.letters})
    if (*height) *height = std::max(**height / 2, kLeastLetter);
  letters.border /= 2;
  LookRequest& look = scene.look;
  for (std::optional<float>* const width : {&look.silhouettes, &look.outer_lines, &look.inner_lines, &look.part_lines})
    if (*width) *width = **width / 2.0f;
  look.ambient_occlusion_rays.reset();
  scene.image.samples = 1;
}

}  // namespace meniscus
