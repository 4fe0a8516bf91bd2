// SPDX-License-Identifier: BSD-3-Clause
// Reads the scenes of a storyboard, counts its pictures, and goes through them.
#include "app/commands/storyboard.h"

#include "app/reports/notes.h"

namespace meniscus {
namespace {

/// Parses one number for all, or `count` numbers separated by commas. Throws UsageError.
std::vector<double> seconds_in(const std::string& text, std::size_t count, const char* option, const char* of_what) {
  constexpr double kLongest = 3600.0;
  std::vector<double> seconds;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    double number = 0.0;
    if (!parse_number(std::string_view(text).substr(at, comma - at), number) || number < 0.0 || number > kLongest)
      throw UsageError("{} {}: give seconds from 0 to {:g}, such as 2 or 1,2.5,1", option, in_quotes(text), kLongest);
    seconds.push_back(number);
    at = comma + 1;
  }
  if (seconds.size() == 1) seconds.resize(count, seconds.front());
  if (seconds.size() != count)
    throw UsageError("{} {}: there are {} {}; give one number, or one for each", option, in_quotes(text), count,
                     of_what);
  return seconds;
}

/// Returns the film after a check of its scenes, before anything is read.
const FilmCommand& with_scenes(const FilmCommand& film) {
  if (film.files.size() < 2) throw UsageError("a film needs two scenes or more");
  return film;
}

bool is_written_into(const Scene& scene) {
  const AnnotationRequest& written = scene.annotations;
  return scene.legend.is_requested() || !written.panel.empty() || !written.title.empty() || written.scale_bar ||
         written.time_stamp || !written.labels.empty() || !written.curve.empty();
}

std::vector<SceneCommand> read_scenes(const DeclaredFilm& declared) {
  constexpr std::array<std::string_view, 7> kOfFilm{"output.file", "frames.fps",    "frames.codec",   "frames.crf",
                                                    "frames.bits", "frames.chroma", "frames.progress"};
  const FilmCommand& film = declared.state;
  std::vector<std::string> words = shared_words(declared.options, kOfFilm);
  Reporting reporting = film.reporting;
  reporting.progress = ProgressStyle::none;
  std::vector<SceneCommand> read;
  for (const std::string& file : film.files) {
    read.push_back(read_scene_file(file, words, reporting));
    read.back().jobs = film.jobs;
    if (read.size() > 1 || declared.options.typed("image.size")) continue;
    const glm::ivec2 size = read.front().scene.picture.size();
    words.insert(words.end(), {"--size", fmt::format("{}x{}", size.x, size.y)});
  }
  return read;
}

/// Adds the name of the scene to errors.
void of_scene(const std::string& file, const std::function<void()>& work) {
  try {
    work();
  } catch (const RequestError& error) {
    throw RequestError("{}: {}", escaped(file), error.what());
  }
}

}  // namespace

FilmScene::FilmScene(const SceneCommand& command, bool extent)
    : run(command),
      key(run.key()),
      layout(std::make_shared<const PictureLayout>(run.scene(), key)),
      annotations(run.scene(), run.is_run() ? &run.frames() : nullptr) {
  run.aim(layout->size, extent);
  if (!extent) annotations.check(*layout, run.framing().cameras, run.structure());
}

Storyboard::Timing::Timing(const FilmCommand& film) {
  const double rate = film.scene.film.frames_per_second;
  const auto pictures = [rate](double seconds) { return static_cast<std::uint64_t>(std::llround(seconds * rate)); };
  for (const double seconds : seconds_in(film.hold, film.files.size(), "--hold", "scenes"))
    held.push_back(std::max<std::uint64_t>(pictures(seconds), 1));
  for (const double seconds : seconds_in(film.transition, film.files.size() - 1, "--transition", "transitions"))
    between.push_back(pictures(seconds));
}

Storyboard::Storyboard(const DeclaredFilm& declared)
    : command_(with_scenes(declared.state)), timing_(command_), format_(command_.scene.film) {
  std::vector<SceneCommand> read = read_scenes(declared);
  for (SceneCommand& command : read) {
    if (command_.is_draft) make_draft(command.scene);
    titles_.push_back(command.scene.annotations.title);
    // Scenes for other renderers contain no text, and reserve no room for it.
    if (is_exported()) {
      leaves_writing_out_ = leaves_writing_out_ || is_written_into(command.scene);
      command.scene.legend = {};
      command.scene.annotations = {};
    }
    format_.transparent = format_.transparent || command.scene.film.transparent;
  }
  if (!is_exported()) check_pictures_of(read);
  std::vector<ColorKey> keys;
  for (std::size_t n = 0; n < read.size(); ++n)
    of_scene(command_.files[n], [&] {
      scenes_.push_back(std::make_unique<FilmScene>(read[n], is_exported()));
      keys.push_back(scenes_.back()->key);
    });
  const std::string conflicts = color_conflicts(keys, "scene");
  if (!conflicts.empty()) log_line(command_, "warning: " + conflicts);
}

void Storyboard::check_pictures_of(const std::vector<SceneCommand>& scenes) const {
  for (std::size_t n = 0; n < scenes.size(); ++n)
    of_scene(command_.files[n], [&] {
      check_picture(scenes[n].scene);
      check_cost(command_, scenes[n].scene, scenes[n].scene.picture.size());
    });
  if (!numbered_output(command_.scene.output, format_, scenes.front().scene.picture.size()))
    check_output(command_.scene.output, command_.existing());
}

std::uint64_t Storyboard::pictures() const {
  std::uint64_t pictures = 0;
  for (std::size_t n = 0; n < scenes_.size(); ++n) pictures += scenes_[n]->pictures(timing_.held[n]);
  for (const std::uint64_t between : timing_.between) pictures += between;
  return pictures;
}

bool Storyboard::any(const std::function<bool(const Scene&)>& is_true) const {
  return std::ranges::any_of(scenes_, [&](const auto& scene) { return is_true(scene->run.scene()); });
}

void Storyboard::log_left_out(const std::vector<std::string>& sentences) const {
  for (const std::string& sentence : sentences) log_line(command_, "note: " + sentence);
}

void Storyboard::play(FilmMaker& maker, const EglContext* context, std::uint64_t bytes_per_pixel) {
  for (std::size_t n = 0; n < scenes_.size(); ++n) {
    FilmScene& scene = *scenes_[n];
    const glm::u64vec2 size(scene.run.scene().picture.size());
    const std::uint64_t count = scene.pictures(1);
    maker.begin(n);
    scene.run.make({kSurfaceBytesPerAtom, bytes_per_pixel * size.x * size.y, context}, [&]() -> FigureRun::Sink {
      return [&](FigureFrame frame) -> FinishFrame {
        const SinkPicture picture{frame.number, frame.place, frame.source, frame.time, frame.camera};
        Annotations annotations =
            scene.annotations.of(picture, frame.figure.molecule.structure, frame.figure.extras.lengths());
        auto shot = std::make_shared<Shot>(
            Shot{scene.run.scene(), std::move(frame.figure), frame.camera, scene.layout, std::move(annotations)});
        return [this, &maker, &scene, context, n, shot, count, place = frame.place] {
          if (place == 0 && n > 0) go_over(*shot, timing_.between[n - 1], maker, context);
          maker.show(*shot, place, scene.plays() ? 1 : timing_.held[n]);
          if (place + 1 == count) last_ = std::move(*shot);
          return MadeFrame{};
        };
      };
    });
  }
}

void Storyboard::go_over(const Shot& next, std::uint64_t count, FilmMaker& maker, const EglContext* context) {
  Transition transition(std::move(*last_), next, context);
  last_.reset();
  for (std::uint64_t n = 0; n < count; ++n)
    maker.show(transition, eased(static_cast<double>(n + 1) / static_cast<double>(count + 1), command_.pace));
}

}  // namespace meniscus
