// SPDX-License-Identifier: BSD-3-Clause
// `meniscus film`: makes a film that goes from one scene to the next.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/figure_run.h"
#include "app/commands/picture_sink.h"
#include "app/commands/scene_files.h"
#include "app/film/film.h"
#include "app/film/film_format.h"
#include "app/options/numbered_path.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/base/parse_number.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/render/image_output.h"
#include "core/scene/motion_blur.h"
#include "core/scene/picture_device.h"
#include "core/scene/transition.h"

namespace meniscus {
namespace {

enum class Pace { smooth, even };

struct FilmCommand : SceneCommand {
  std::vector<std::string> files;
  std::string hold = "2", transition = "2";
  Pace pace = Pace::smooth;
  bool is_draft = false;
};
using DeclaredFilm = DeclaredCommand<FilmCommand>;

/// One number for all, or as many as there are, with commas between. Throws UsageError.
std::vector<double> seconds_in(const std::string& text, std::size_t count, const char* option, const char* of_what) {
  constexpr double kLongest = 3600.0;
  std::vector<double> seconds;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    double number = 0.0;
    if (!parse_number(std::string_view(text).substr(at, comma - at), number) || number < 0.0 || number > kLongest)
      throw UsageError(
          fmt::format("{} {}: give seconds from 0 to {:g}, such as 2 or 1,2.5,1", option, in_quotes(text), kLongest));
    seconds.push_back(number);
    at = comma + 1;
  }
  if (seconds.size() == 1) seconds.resize(count, seconds.front());
  if (seconds.size() != count)
    throw UsageError(fmt::format("{} {}: there are {} {}; give one number, or one for each", option, in_quotes(text),
                                 count, of_what));
  return seconds;
}

/// How many pictures each scene and each transition has.
struct Timing {
  std::vector<std::uint64_t> held, between;

  Timing(const FilmCommand& film) {
    const double rate = film.scene.film.frames_per_second;
    const auto pictures = [rate](double seconds) { return static_cast<std::uint64_t>(std::llround(seconds * rate)); };
    for (const double seconds : seconds_in(film.hold, film.files.size(), "--hold", "scenes"))
      held.push_back(std::max<std::uint64_t>(pictures(seconds), 1));
    for (const double seconds : seconds_in(film.transition, film.files.size() - 1, "--transition", "transitions"))
      between.push_back(pictures(seconds));
  }
};

/// The share of the way after that share of the time.
double eased(double time, Pace pace) { return pace == Pace::even ? time : time * time * (3.0 - 2.0 * time); }

/// Where the pictures go: into a film, or into numbered files.
class FilmPictures {
 public:
  FilmPictures(const FilmCommand& command, glm::ivec2 size) : command_(command) {
    const Scene& scene = command.scene;
    if (is_film_path(scene.output)) {
      film_.emplace(scene.output, command.existing(), size, scene.film.frames_per_second, scene.film);
      return;
    }
    numbered_ = NumberedPath::parse(scene.output);
    if (!numbered_)
      throw UsageError(
          fmt::format("-o {}: name a film (.mp4, .mov, .mkv, .webm, .gif), or put # where the number of a "
                      "picture goes, as in {}",
                      in_quotes(scene.output), in_quotes(numbered_name(scene.output))));
    check_image_path(scene.output);
  }

  std::uint64_t count() const { return count_; }

  void add(const Framebuffer& picture, const std::optional<glm::vec3>& background, std::uint64_t times) {
    if (film_) {
      const std::vector<std::uint8_t> pixels =
          srgb_pixels(picture, ground_of_film(background, film_->pixels()), film_->pixels().bytes);
      for (std::uint64_t n = 0; n < times; ++n) film_->add(pixels);
    } else {
      for (std::uint64_t n = 0; n < times; ++n)
        write_image(numbered_->at(count_ + n), picture, {background, command_.existing()});
    }
    count_ += times;
  }

  void finish() {
    if (film_) film_->finish();
  }

 private:
  const FilmCommand& command_;
  std::optional<FilmWriter> film_;
  std::optional<NumberedPath> numbered_;
  std::uint64_t count_ = 0;
};

/// A scene on its way into the film.
struct FilmScene {
  FigureRun run;
  std::shared_ptr<const PictureLayout> layout;
  FrameAnnotations annotations;

  explicit FilmScene(const SceneCommand& command)
      : run(command),
        layout(std::make_shared<const PictureLayout>(run.scene(), run.key())),
        annotations(run.scene(), run.is_run() ? &run.frames() : nullptr) {
    run.aim(layout->size, false);
  }

  std::uint64_t pictures(std::uint64_t held) { return run.is_run() ? run.frames().numbers().size() : held; }
};

class Film {
 public:
  Film(const FilmCommand& command, std::vector<std::unique_ptr<FilmScene>> scenes)
      : command_(command),
        scenes_(std::move(scenes)),
        timing_(command),
        device_(device_request()),
        pictures_(command, scenes_.front()->run.scene().picture.size()),
        progress_(progress_on_stderr(command), "film", total()) {}

  void make() {
    for (std::size_t n = 0; n < scenes_.size(); ++n) show(n);
    pictures_.finish();
    say(command_, fmt::format("{} pictures, {:.1f} s: {}", with_thousands(pictures_.count()),
                              static_cast<double>(pictures_.count()) / command_.scene.film.frames_per_second,
                              command_.scene.output));
  }

 private:
  SurfaceRequest device_request() const {
    SurfaceRequest request = scenes_.front()->run.scene().molecule.surface;
    for (const auto& scene : scenes_) request.cpu = request.cpu || picture_request(scene->run.scene()).cpu;
    return request;
  }

  std::uint64_t total() const {
    std::uint64_t pictures = 0;
    for (std::size_t n = 0; n < scenes_.size(); ++n) pictures += scenes_[n]->pictures(timing_.held[n]);
    for (const std::uint64_t between : timing_.between) pictures += between;
    return pictures;
  }

  void show(std::size_t n) {
    FilmScene& scene = *scenes_[n];
    const glm::u64vec2 size(scene.run.scene().picture.size());
    constexpr std::uint64_t kBytesPerPixel = 100;  // as in `meniscus render`
    const std::uint64_t count = scene.pictures(1);
    std::optional<MotionBlur> blur;
    if (const int moments = scene.run.scene().image.motion_blur; moments > 1 && scene.run.is_run())
      blur.emplace(scene.run.scene(), moments, scene.run.framing().cameras, device_.context());
    const FigureWork work{kSurfaceBytesPerAtom, kBytesPerPixel * size.x * size.y, device_.context()};
    scene.run.make(work, [&]() -> FigureRun::Sink {
      return [&](FigureFrame frame) -> FinishFrame {
        const SinkPicture picture{frame.number, frame.place, frame.source, frame.time, frame.camera};
        Annotations annotations = scene.annotations.of(picture, frame.figure.molecule.structure);
        auto shot = std::make_shared<Shot>(
            Shot{scene.run.scene(), std::move(frame.figure), frame.camera, scene.layout, std::move(annotations)});
        return [this, &blur, n, shot, count, place = frame.place] {
          if (place == 0 && n > 0) go_over(*shot, timing_.between[n - 1]);
          const bool is_run = scenes_[n]->run.is_run();
          Framebuffer molecule =
              blur ? blur->draw(place, device_.renderer(), settings_of(*shot))
                   : draw(device_.renderer(), shot->figure, shot->scene.figure, shot->camera, settings_of(*shot));
          add(picture_of(*shot, std::move(molecule)), shot->scene.image.background, is_run ? 1 : timing_.held[n]);
          if (place + 1 == count) last_ = std::move(*shot);
          return MadeFrame{};
        };
      };
    });
  }

  void go_over(const Shot& next, std::uint64_t count) {
    Transition transition(std::move(*last_), next, device_.context());
    last_.reset();
    for (std::uint64_t n = 0; n < count; ++n) {
      const double share = eased(static_cast<double>(n + 1) / static_cast<double>(count + 1), command_.pace);
      add(transition.picture(share, device_.renderer()), transition.background(share), 1);
    }
  }

  void add(const Framebuffer& picture, const std::optional<glm::vec3>& background, std::uint64_t times) {
    pictures_.add(picture, background, times);
    progress_.advance(times);
  }

  const FilmCommand& command_;
  std::vector<std::unique_ptr<FilmScene>> scenes_;
  Timing timing_;
  PictureDevice device_;
  FilmPictures pictures_;
  Progress progress_;
  std::optional<Shot> last_;  ///< of the scene before
};

/// All in the size of the first, unless the command line names one.
std::vector<std::unique_ptr<FilmScene>> read_scenes(const DeclaredFilm& declared) {
  constexpr std::array<std::string_view, 8> kOfFilm{"output.file", "picture.draft", "frames.fps",    "frames.codec",
                                                    "frames.crf",  "frames.bits",   "frames.chroma", "frames.progress"};
  const FilmCommand& film = declared.state;
  std::vector<std::string> words = shared_words(declared.options, for_film, "storyboard", kOfFilm);
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
  std::vector<std::unique_ptr<FilmScene>> scenes;
  for (SceneCommand& command : read) {
    if (film.is_draft) make_draft(command.scene);
    scenes.push_back(std::make_unique<FilmScene>(command));
  }
  return scenes;
}

void run(const DeclaredFilm& declared) {
  const FilmCommand& command = declared.state;
  if (command.files.size() < 2) throw UsageError("a film goes from one scene to the next: name two scenes or more");
  const Timing checked(command);
  if (is_film_path(command.scene.output)) check_output(command.scene.output, command.existing());
  Film(command, read_scenes(declared)).make();
}

}  // namespace

void add_film(CLI::App& command) {
  describe(
      command,
      "  meniscus film a.png b.png c.png -o story.mp4\n"
      "  meniscus film apo.json holo.json -o story.mp4 --hold 2,4 --transition 1.5 --size 1920x1080\n"
      "  meniscus film a.json b.json -o 'story_####.png' --ease even",
      "Scenes are files of --save-scene or pictures that meniscus render made. On the way from one to the next the "
      "camera,\ncut planes, the probe's radius and numbers of the look change steadily; all else dissolves.");
  auto declared = std::make_shared<DeclaredFilm>(command, for_film);
  FilmCommand& state = declared->state;
  declared->options.describe_output("Film to write: .mp4, .mov, .mkv, .webm, .gif; or pictures: story_####.png");
  PropertyOptions options(command);
  options.add("storyboard.scenes", state.files)->required();
  options.add("storyboard.hold", state.hold);
  options.add("storyboard.transition", state.transition);
  options.add("picture.draft", state.is_draft);
  options.add_word("storyboard.ease", state.pace, {Pace::smooth, Pace::even});
  declared->options.option("image.size")->description("Size of the film in pixels [that of the first scene]");
  command.callback([declared] {
    declared->options.take();
    run(*declared);
  });
}

}  // namespace meniscus
