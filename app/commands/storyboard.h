// SPDX-License-Identifier: BSD-3-Clause
// The scenes of a film in their order: how long each is shown, and the way from each to the next.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/figure_run.h"
#include "app/commands/picture_sink.h"
#include "app/options/scene_options.h"
#include "core/scene/picture_device.h"
#include "core/scene/scene_picture.h"
#include "core/scene/transition.h"

namespace meniscus {

/// What a film is made of: pictures of our own, the frames of a scene for another renderer, or scenes and keys of
/// another program.
enum class FilmMedium { pictures, povray, blender };

struct FilmCommand : SceneCommand {
  std::vector<std::string> files;
  std::string hold = "2", transition = "2";
  Pace pace = Pace::smooth;
  bool is_draft = false;
  FilmMedium medium = FilmMedium::pictures;
};
using DeclaredFilm = DeclaredCommand<FilmCommand>;

/// A scene on its way into the film.
struct FilmScene {
  FigureRun run;
  ColorKey key;
  std::shared_ptr<const PictureLayout> layout;
  FrameAnnotations annotations;

  /// extent: FigureRun::aim()
  FilmScene(const SceneCommand& command, bool extent);

  std::uint64_t pictures(std::uint64_t held) { return run.is_run() ? run.frames().numbers().size() : held; }
};

/// What becomes of a film: pictures, or a scene for another renderer.
class FilmMaker {
 public:
  virtual ~FilmMaker() = default;
  /// Of that scene, from 0, the shots begin.
  virtual void begin(std::size_t scene) = 0;
  /// A shot that is shown so many times. place: in the scene's run, from 0.
  virtual void show(const Shot& shot, std::uint64_t place, std::uint64_t times) = 0;
  /// A picture of a transition, `share` of its way.
  virtual void show(Transition& transition, double share) = 0;
};

class Storyboard {
 public:
  /// Reads the scenes: all in the size of the first, unless the command line names one. Throws UsageError, and what
  /// reading, computing and aiming throw. The command must stay.
  explicit Storyboard(const DeclaredFilm& declared);

  std::size_t size() const { return scenes_.size(); }
  FilmScene& scene(std::size_t n) { return *scenes_[n]; }
  const FilmCommand& command() const { return command_; }
  /// The format of the film, which is transparent if the command or any scene says so.
  const FilmFormat& format() const { return format_; }
  bool is_exported() const { return command_.medium != FilmMedium::pictures; }
  std::uint64_t pictures() const;
  /// For how many pictures a scene is shown that is no run, and the transition to the next one lasts.
  std::uint64_t held(std::size_t n) const { return timing_.held[n]; }
  std::uint64_t between(std::size_t n) const { return timing_.between[n]; }
  /// What the scene has written above its pictures, in exports too.
  const std::string& title(std::size_t n) const { return titles_[n]; }
  /// Whether titles, labels, legends and the like were taken out of scenes.
  bool leaves_writing_out() const { return leaves_writing_out_; }
  /// Is there a scene of which this is true?
  bool any(const std::function<bool(const Scene&)>& is_true) const;
  /// Says what another renderer leaves out, a note each.
  void tell_left_out(const std::vector<std::string>& sentences) const;

  /// Hands all shots and transitions to the maker in the order of the film, once. context: in which surfaces are
  /// computed; nullptr: on the CPU. bytes_per_pixel: what a frame takes until it is finished.
  void play(FilmMaker& maker, const EglContext* context, std::uint64_t bytes_per_pixel);

 private:
  /// How many pictures each scene and each transition has.
  struct Timing {
    explicit Timing(const FilmCommand& film);
    std::vector<std::uint64_t> held, between;
  };
  /// Before anything is computed. Throws UsageError, RequestError, OutputError.
  void check_pictures_of(const std::vector<SceneCommand>& scenes) const;
  void go_over(const Shot& next, std::uint64_t count, FilmMaker& maker, const EglContext* context);

  const FilmCommand& command_;
  Timing timing_;
  FilmFormat format_;
  std::vector<std::unique_ptr<FilmScene>> scenes_;
  std::vector<std::string> titles_;
  std::optional<Shot> last_;  ///< of the scene before
  bool leaves_writing_out_ = false;
};

/// Writes a folder with a scene for POV-Ray of the storyboard (--to povray).
void write_povray_film(Storyboard& storyboard);

/// Writes a folder with the surfaces of the storyboard, and when each is shown by which camera, for Blender
/// (--to blender). Throws UsageError for a scene of a run.
void write_blender_film(Storyboard& storyboard);

}  // namespace meniscus
