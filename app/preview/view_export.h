// SPDX-License-Identifier: BSD-3-Clause
// Exports a view as a picture, scene, Blender file or camera; has the program's callbacks for a session.
#pragma once

#include <nlohmann/json.hpp>

#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/color/color_schemes.h"
#include "core/color/coloring.h"
#include "core/render/annotation.h"
#include "core/scene/figure.h"
#include "core/scene/renderers.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Called during an export with the name of its stage and the finished share of it, from 0 to 1. An exception from it
/// ends the export, which then leaves no file.
using ExportWatch = std::function<void(const char* stage, double share)>;

/// Runs an export on a separate thread from the beginning. The other functions are for one thread.
class ExportJob {
 public:
  /// Makes the export and returns its reply; result() throws the errors of the work.
  using Work = std::function<nlohmann::json(const ExportWatch& watch)>;

  /// path: the output's path, for replies.
  ExportJob(std::string path, Work work);
  /// Cancels the export and waits for its end.
  ~ExportJob();

  /// Ends the export soon, unless it is done before.
  void cancel();
  bool running() const;
  /// Returns true if the export has ended without an error.
  bool done() const;
  /// Waits for the end and returns the reply. Throws the errors of the work; RequestError if it was cancelled, or
  /// instead of a GpuError, which concerns the export alone.
  nlohmann::json result();
  /// Returns {"running", "path", "seconds"}, with "stage" and "share" while it runs; then with the reply or "error".
  nlohmann::json state();

 private:
  struct Shared;

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

/// A view to be exported, which does not depend on the session that showed it.
struct ExportedView {
  Structure structure;
  std::vector<std::uint32_t> atoms;  ///< the shown atoms, as indices into structure.atoms
  std::vector<Ball> balls;           ///< their balls, grown by growth_of() the kind of surface
  Coloring coloring;                 ///< their colours
  ColorKey colors;                   ///< the meaning of the colours
  PreviewFigure figure;
  std::shared_ptr<const FigureExtras> extras;  ///< drawn in addition to the surface; nullptr: nothing
  Annotations annotations;                     ///< written into pictures
  glm::ivec2 size;                             ///< pixels, with the legend
  int samples;                                 ///< rays per pixel
  bool transparent;                            ///< pictures have no background
  std::string scene;                           ///< the scene that pictures carry; empty: none
};

/// The path of the output, and whether it may be replaced.
struct ExportTarget {
  std::filesystem::path path;
  Existing existing = Existing::refuse;
};

/// Makes the device that draws exported pictures, on the thread that calls it; an empty function stands for the CPU.
using MakePictureDevice = std::function<std::unique_ptr<PictureDevice>()>;

/// Ray casts a picture as `meniscus render` does: the complete surface, the objects next to it and the legend, in a
/// format of write_image(). Throws RequestError if there is no room for the legend, OutputError, OpenSurfaceError,
/// CapacityError, GpuError; the other exports throw the same but for GpuError.
void export_picture(const ExportedView& view, const MakePictureDevice& make_device, const ExportTarget& target,
                    const ExportWatch& watch);

/// Writes a scene as `meniscus export povray` does, but refuses objects; returns the command that renders it. archive:
/// a zip file that gets a copy of the scene; empty: none.
std::string export_povray(const ExportedView& view, const ExportTarget& target, const std::filesystem::path& archive,
                          const ExportWatch& watch);

/// Writes a file as `meniscus export blender` does.
void export_blender(const ExportedView& view, const ExportTarget& target, const ExportWatch& watch);

/// Returns the path in `folder` of a file with this name. Throws RequestError if the name is not plain.
std::filesystem::path export_path(const std::filesystem::path& folder, const std::string& name);

/// A figure that a scene file describes, of the molecule that is shown.
struct OpenedScene {
  PreviewFigure figure;
  int frame = 0;  ///< index of the model in a file of several models, from 0
};

/// A film that a command of this program makes.
struct FilmOrder {
  std::vector<std::string> words;  ///< "meniscus", the command, and its options
  std::string storyboard;          ///< the text of the storyboard file that the command reads; empty: none
};

/// Optional callbacks that the program gives to a session.
struct SessionContext {
  ReadShown read_shown;
  bool writes_scenes = false;     ///< true if the molecule has a file that scenes can name
  MakePictureDevice make_device;  ///< draws exported pictures
  /// Makes a film; empty if films cannot be made. Throws RequestError, OutputError.
  std::function<void(const FilmOrder& order, const ExportTarget& target, const ExportWatch& watch)> make_film;
  /// Returns the camera by which `meniscus render` would draw a scene whose colours have the numbers of their file. The
  /// structure has the atoms that the scene draws.
  std::function<Camera(const Scene& scene, const Structure& structure)> aim;
  /// Reads a scene. Throws InputError, UsageError; RequestError if the scene shows another molecule.
  std::function<OpenedScene(const std::filesystem::path& path)> open_scene;
  /// Copies the files of a molecule that came from a page to the paths by which scenes name them, unless they exist.
  /// Returns the paths of the copies; none for other molecules. Throws OutputError.
  std::function<std::vector<std::filesystem::path>()> keep_files;
};

/// The outputs of a session; the latest export may still be running while pictures are drawn.
struct Exporter {
  std::filesystem::path folder;
  SessionContext context;
  std::unique_ptr<ExportJob> job{};            ///< nullptr: none yet
  std::optional<std::uint64_t> job_edition{};  ///< edition of the figure whose scene the job writes; nothing: no scene
  std::uint64_t saved = 0;                     ///< edition of the latest figure that was saved
  bool all_recorded = false;                   ///< true if a log has every command
  /// The molecule with all atoms of its file, once something has needed them; nullptr before.
  std::shared_ptr<const Structure> everything{};
  std::vector<std::filesystem::path> written{};  ///< files and folders that were written, except the job's

  /// Returns the paths of all that the session has written, in order.
  std::vector<std::filesystem::path> written_paths() const {
    std::vector<std::filesystem::path> paths = written;
    if (!job || !job->done()) return paths;
    const nlohmann::json reply = job->result();
    for (const char* key : {"path", "archive"})
      if (reply.contains(key)) add_once(paths, reply[key].get<std::string>());
    return paths;
  }
  /// Keeps the copies that scenes of this molecule name.
  void keep_files() {
    if (!context.keep_files) return;
    for (const std::filesystem::path& path : context.keep_files()) add_once(written, path);
  }
  static void add_once(std::vector<std::filesystem::path>& paths, const std::filesystem::path& path) {
    std::erase(paths, path);
    paths.push_back(path);
  }
  /// Returns true if ending the preview loses nothing of the figure but its camera.
  bool keeps(const PreviewFigure& figure) const {
    return all_recorded || figure.edition == saved || (job_edition == figure.edition && job->done());
  }
  /// Removes the latest job, which has ended, so that another can begin.
  void forget_job() {
    if (job_edition && job->done()) saved = *job_edition;
    written = written_paths();
    job_edition.reset();
    job.reset();
  }
};

}  // namespace meniscus
