// SPDX-License-Identifier: BSD-3-Clause
// The scenes of a film in order, with the duration of each and the transition to the next.
#pragma once

#include "app/commands/command_run.h"
#include "app/commands/picture_sink.h"
#include "app/options/scene_options.h"
#include "core/scene/renderers.h"
#include "core/scene/scene_picture.h"
#include "core/scene/transition.h"

namespace meniscus {

/// The kind of film: pictures, frames of a scene for another renderer, or scenes and keys for another program.
enum class FilmMedium { pictures, povray, blender };

struct FilmCommand : SceneCommand {
  std::vector<std::string> files;
  std::string hold = "2", transition = "2";
  Pace pace = Pace::smooth;
  bool is_draft = false;
  FilmMedium medium = FilmMedium::pictures;
};
using DeclaredFilm = DeclaredCommand<FilmCommand>;

/// A scene of the film with its figures.
struct FilmScene {
  FigureRun run;
  ColorKey key;
  std::shared_ptr<const PictureLayout> layout;
  FrameAnnotations annotations;

  /// extent: see FigureRun::aim().
  FilmScene(const SceneCommand& command, bool extent);

  /// Returns true if the scene shows more than one frame, each of them once.
  bool plays() { return run.is_run() && run.frames().numbers().size() > 1; }
  std::uint64_t pictures(std::uint64_t held) { return plays() ? run.frames().numbers().size() : held; }
};

/// Makes a film from shots and transitions: pictures, or a scene for another renderer.
class FilmMaker {
 public:
  virtual ~FilmMaker() = default;
  /// Begins the shots of that scene, counted from 0.
  virtual void begin(std::size_t scene) = 0;
  /// Shows a shot for `times` pictures. place: index in the scene's run, from 0.
  virtual void show(const Shot& shot, std::uint64_t place, std::uint64_t times) = 0;
  /// Shows a picture of a transition; `share` is its progress in [0, 1].
  virtual void show(Transition& transition, double share) = 0;
};

class Storyboard {
 public:
  /// Reads the scenes, all in the size of the first, unless the command line sets one. Throws UsageError, and the
  /// errors of reading, computing and aiming. The command must stay valid.
  explicit Storyboard(const DeclaredFilm& declared);

  std::size_t size() const { return scenes_.size(); }
  FilmScene& scene(std::size_t n) { return *scenes_[n]; }
  const FilmCommand& command() const { return command_; }
  /// Returns the format of the film, which is transparent if the command or any scene says so.
  const FilmFormat& format() const { return format_; }
  bool is_exported() const { return command_.medium != FilmMedium::pictures; }
  std::uint64_t pictures() const;
  /// Return the number of pictures of a scene that is not a run, and of the transition after it.
  std::uint64_t held(std::size_t n) const { return timing_.held[n]; }
  std::uint64_t between(std::size_t n) const { return timing_.between[n]; }
  /// Returns the title above the scene's pictures, in exports too.
  const std::string& title(std::size_t n) const { return titles_[n]; }
  /// Returns true if titles, labels, legends and the like were removed from scenes.
  bool leaves_writing_out() const { return leaves_writing_out_; }
  /// Returns true if the predicate is true for some scene.
  bool any(const std::function<bool(const Scene&)>& is_true) const;
  /// Prints a note about each thing that another renderer leaves out.
  void log_left_out(const std::vector<std::string>& sentences) const;

  /// Passes all shots and transitions to the maker in the order of the film, once. context: for computing surfaces;
  /// nullptr: on the CPU. bytes_per_pixel: memory of a frame until it is finished.
  void play(FilmMaker& maker, const EglContext* context, std::uint64_t bytes_per_pixel);

 private:
  /// The number of pictures of each scene and each transition.
  struct Timing {
    explicit Timing(const FilmCommand& film);
    std::vector<std::uint64_t> held, between;
  };
  /// Checks the pictures before anything is computed. Throws UsageError, RequestError, OutputError.
  void check_pictures_of(const std::vector<SceneCommand>& scenes) const;
  void go_over(const Shot& next, std::uint64_t count, FilmMaker& maker, const EglContext* context);

  const FilmCommand& command_;
  Timing timing_;
  FilmFormat format_;
  std::vector<std::unique_ptr<FilmScene>> scenes_;
  std::vector<std::string> titles_;
  std::optional<Shot> last_;  ///< the last shot of the previous scene
  bool leaves_writing_out_ = false;
};

/// Writes the storyboard as a folder with a scene for POV-Ray (--to povray).
void write_povray_film(Storyboard& storyboard);

/// Writes the storyboard as a folder with its surfaces, and the times and cameras of each, for Blender (--to blender).
/// Throws UsageError for a scene of a run.
void write_blender_film(Storyboard& storyboard);

}  // namespace meniscus
