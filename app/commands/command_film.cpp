// SPDX-License-Identifier: BSD-3-Clause
// `meniscus film`: makes a film that goes from one scene to the next.

#include <fmt/ranges.h>

#include "app/commands/command_table.h"
#include "app/commands/picture_sink.h"
#include "app/commands/storyboard.h"
#include "app/film/film.h"
#include "app/options/named_files.h"
#include "app/options/property_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/render/image_output.h"
#include "core/scene/renderers.h"
#include "core/scene/transition.h"

namespace meniscus {
namespace {

/// The destination of the pictures: a film, or numbered files.
class FilmPictures {
 public:
  explicit FilmPictures(Storyboard& storyboard) : command_(storyboard.command()) {
    const Scene& scene = command_.scene;
    const glm::ivec2 size = storyboard.scene(0).run.scene().picture.size();
    numbered_ = numbered_output(scene.output, storyboard.format(), size);
    if (!numbered_) {
      film_.emplace(scene.output, command_.existing(), size, scene.film.frames_per_second, storyboard.format());
      return;
    }
    std::vector<std::uint64_t> numbers(storyboard.pictures());
    std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
    check_pictures(*numbered_, numbers, command_.existing());
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

/// Draws the pictures of a storyboard.
class PictureFilm : public FilmMaker {
 public:
  explicit PictureFilm(Storyboard& storyboard)
      : storyboard_(storyboard),
        command_(storyboard.command()),
        device_(device_request()),
        pictures_(storyboard),
        progress_(progress_on_stderr(command_), "film", storyboard.pictures()) {}

  void make() {
    constexpr std::uint64_t kBytesPerPixel = 100;  // the value of `meniscus render`
    storyboard_.play(*this, device_.context(), kBytesPerPixel);
    pictures_.finish();
    log_line(command_, fmt::format("{} pictures, {:.1f} s: {}", with_thousands(pictures_.count()),
                                   static_cast<double>(pictures_.count()) / command_.scene.film.frames_per_second,
                                   command_.scene.output));
  }

 private:
  SurfaceRequest device_request() const {
    SurfaceRequest request = storyboard_.scene(0).run.scene().molecule.surface;
    for (std::size_t n = 0; n < storyboard_.size(); ++n)
      request.cpu = request.cpu || picture_request(storyboard_.scene(n).run.scene()).cpu;
    return request;
  }

  void begin(std::size_t n) override {
    FigureRun& run = storyboard_.scene(n).run;
    blur_.reset();
    if (const int moments = run.scene().image.motion_blur; moments > 1 && run.is_run())
      blur_.emplace(run.scene(), moments, run.framing().cameras, device_.context());
  }

  void show(const Shot& shot, std::uint64_t place, std::uint64_t times) override {
    Framebuffer molecule =
        blur_ ? blur_->draw(place, device_.renderer(), settings_of(shot))
              : draw(device_.renderer(), shot.figure, shot.scene.figure, shot.camera, settings_of(shot));
    add(picture_of(shot, std::move(molecule)), shot.scene.image.background, times);
  }

  void show(Transition& transition, double share) override {
    add(transition.picture(share, device_.renderer()), transition.background(share), 1);
  }

  void add(const Framebuffer& picture, const std::optional<glm::vec3>& background, std::uint64_t times) {
    pictures_.add(picture, background, times);
    progress_.advance(times);
  }

  Storyboard& storyboard_;
  const FilmCommand& command_;
  PictureDevice device_;
  FilmPictures pictures_;
  Progress progress_;
  std::optional<MotionBlur> blur_;  ///< motion blur of the current scene
};

TakenProperties film_properties() {
  const TakenProperties shared{"Computing", "-surface.verify", "Legend", "-legend.file"};
  return shared.with({"molecule.quiet", "frames.progress", "frames.fps", "frames.codec", "frames.crf", "frames.bits",
                      "frames.chroma", "image.size", "image.samples", "image.background", "picture.any_cost",
                      "annotations.letter_size", "annotations.letter_color", "annotations.font",
                      "annotations.font_file", "output.file", "output.force", "scene.trust"},
                     {film_need(), fixed_size_need()});
}

/// Puts the scenes of a storyboard file in its place, and takes the times that the command line does not set.
void open_storyboard(FilmCommand& film, const CLI::App& command) {
  const std::optional<StoryboardFile> story =
      film.files.size() == 1 ? read_storyboard(film.files.front()) : std::nullopt;
  if (!story) return;
  const std::string file = std::exchange(film.files, {}).front();
  for (std::size_t n = 1; n <= story->scenes.size(); ++n) film.files.push_back(fmt::format("{}#{}", file, n));
  const auto take = [&command](const char* option, std::string& times, const std::vector<double>& seconds) {
    if (command.count(option) == 0 && !seconds.empty()) times = fmt::format("{}", fmt::join(seconds, ","));
  };
  take("--hold", film.hold, story->hold);
  take("--transition", film.transition, story->transition);
}

void run(const DeclaredFilm& declared) {
  const FilmCommand& command = declared.state;
  const bool is_film = is_film_path(command.scene.output);
  if (command.medium != FilmMedium::pictures && is_film)
    throw UsageError("-o {}: --to {} writes a folder; name one, or leave --to out", in_quotes(command.scene.output),
                     command.medium == FilmMedium::povray ? "povray" : "blender");
  Storyboard storyboard(declared);
  if (command.medium == FilmMedium::pictures)
    PictureFilm(storyboard).make();
  else if (command.medium == FilmMedium::povray)
    write_povray_film(storyboard);
  else
    write_blender_film(storyboard);
}

}  // namespace

void add_film(CLI::App& command) {
  describe(
      command,
      "  meniscus film a.png b.png c.png -o story.mp4\n"
      "  meniscus film apo.json holo.json -o story.mp4 --hold 2,4 --transition 1.5 --size 1920x1080\n"
      "  meniscus film a.json b.json -o 'story_####.png' --ease even\n"
      "  meniscus film story.json -o story.mp4                    the storyboard that meniscus preview saved\n"
      "  meniscus film a.json b.json --to povray -o story         a scene for POV-Ray; it prints how to render it\n"
      "  meniscus film a.json b.json --to blender -o story        surfaces and keys for Blender's add-on to import",
      "Scenes are files of --save-scene or pictures that meniscus render made. On the way from one to the next the "
      "camera,\ncut planes, the probe's radius and numbers of the look change steadily; all else dissolves.");
  auto declared = std::make_shared<DeclaredFilm>(command, film_properties());
  FilmCommand& state = declared->state;
  declared->options.describe_output(
      "Film to write: .mp4, .mov, .mkv, .webm, .gif; or pictures: story_####.png; or a folder");
  PropertyOptions options(command);
  options.add("storyboard.scenes", state.files)->required();
  options.add("storyboard.hold", state.hold);
  options.add("storyboard.transition", state.transition);
  options.add("picture.draft", state.is_draft);
  options.add_word("storyboard.ease", state.pace, {Pace::smooth, Pace::even});
  options.add_word("storyboard.to", state.medium, {FilmMedium::pictures, FilmMedium::povray, FilmMedium::blender});
  declared->options.option("image.size")->description("Size of the film in pixels [that of the first scene]");
  command.callback([declared] {
    declared->options.take();
    open_storyboard(declared->state, declared->options.command());
    run(*declared);
  });
}

}  // namespace meniscus
