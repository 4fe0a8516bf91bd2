// SPDX-License-Identifier: BSD-3-Clause
// "Export this view" as a picture, a scene, a file for Blender or a camera, and the callbacks that a session needs from
// the program.
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

/// Called while an export is made, with the name of its stage and the finished share of it, from 0 to 1. Anything it
/// throws ends the export, which leaves nothing.
using ExportWatch = std::function<void(const char* stage, double share)>;

/// Works on a thread of its own from the beginning. The other functions are for one thread.
class ExportJob {
 public:
  /// The reply to the export; what it throws is that of result().
  using Work = std::function<nlohmann::json(const ExportWatch& watch)>;

  /// path: of the output, for replies.
  ExportJob(std::string path, Work work);
  /// Ends it, and waits for that.
  ~ExportJob();

  /// It ends soon, unless it is done before.
  void cancel();
  bool running() const;
  /// Whether it has come to its end, and nothing was thrown.
  bool done() const;
  /// Waits for the end. Throws what the work threw; RequestError where that is a GpuError, which is the export's alone,
  /// and where it was cancelled.
  nlohmann::json result();
  /// {"running", "path", "seconds"}, while it runs "stage" and "share"; then the reply, or "error".
  nlohmann::json state();

 private:
  struct Shared;

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

/// A view to be exported, whatever becomes of the session that showed it.
struct ExportedView {
  Structure structure;
  std::vector<std::uint32_t> atoms;  ///< those shown, into structure.atoms
  std::vector<Ball> balls;           ///< theirs, grown by growth_of() the kind of surface
  Coloring coloring;                 ///< theirs
  ColorKey colors;                   ///< what the colours mean
  PreviewFigure figure;
  std::shared_ptr<const FigureExtras> extras;  ///< drawn in addition to the surface; nullptr: nothing
  Annotations annotations;                     ///< written into pictures
  glm::ivec2 size;                             ///< pixels, with the legend
  int samples;                                 ///< rays per pixel
  bool transparent;                            ///< pictures have no background
  std::string scene;                           ///< what pictures say they were made of; empty: nothing
};

/// Where it goes.
struct ExportTarget {
  std::filesystem::path path;
  Existing existing = Existing::refuse;
};

/// What makes pictures of exports, in the thread that asks for it; nothing: the CPU.
using MakePictureDevice = std::function<std::unique_ptr<PictureDevice>()>;

/// As `meniscus render`: the complete surface and what stands beside it, with its legend, ray cast; what write_image()
/// writes. Throws RequestError where there is no room for the legend, OutputError, OpenSurfaceError, CapacityError,
/// GpuError; so do the others, but for the last.
void export_picture(const ExportedView& view, const MakePictureDevice& make_device, const ExportTarget& target,
                    const ExportWatch& watch);

/// As `meniscus export povray`, whole but for objects, which are refused; returns the command that renders it.
/// archive: a zip file that gets a copy of the scene; empty: none.
std::string export_povray(const ExportedView& view, const ExportTarget& target, const std::filesystem::path& archive,
                          const ExportWatch& watch);

/// As `meniscus export blender`.
void export_blender(const ExportedView& view, const ExportTarget& target, const ExportWatch& watch);

/// Returns the path in `folder` of a file with this name. Throws RequestError if the name is not plain.
std::filesystem::path export_path(const std::filesystem::path& folder, const std::string& name);

/// A figure that a scene file says, of the molecule that is shown.
struct OpenedScene {
  PreviewFigure figure;
  int frame = 0;  ///< of a file of several models, from 0
};

/// A film that a command of this program makes.
struct FilmOrder {
  std::vector<std::string> words;  ///< "meniscus", the command, and its options
  std::string storyboard;          ///< the text of the storyboard file that the command reads; empty: none
};

/// Optional callbacks that the program gives to a session.
struct SessionContext {
  ReadShown read_shown;
  bool writes_scenes = false;     ///< the molecule has a file that scenes can name
  MakePictureDevice make_device;  ///< of exported pictures
  /// Makes a film; empty: there are none. Throws RequestError, OutputError.
  std::function<void(const FilmOrder& order, const ExportTarget& target, const ExportWatch& watch)> make_film;
  /// The camera by which render would draw a scene whose colours have the numbers of their file. The structure has the
  /// atoms that the scene draws.
  std::function<Camera(const Scene& scene, const Structure& structure)> aim;
  /// Reads a scene. Throws InputError, UsageError; RequestError where it is one of another molecule.
  std::function<OpenedScene(const std::filesystem::path& path)> open_scene;
  /// Copies the files of a molecule that came from a page to the paths by which scenes name them, unless they exist.
  /// Returns the paths of the copies; none for other molecules. Throws OutputError.
  std::function<std::vector<std::filesystem::path>()> keep_files;
};

/// What exports go to; the latest of them may still be written, beside the pictures.
struct Exporter {
  std::filesystem::path folder;
  SessionContext context;
  std::unique_ptr<ExportJob> job{};            ///< nullptr: none yet
  std::optional<std::uint64_t> job_edition{};  ///< of the figure whose scene the job writes; nothing: it writes none
  std::uint64_t saved = 0;                     ///< the edition of the figure that a file has
  bool all_recorded = false;                   ///< a log has every command
  /// The molecule with all atoms of its file, once something has needed them; nullptr before.
  std::shared_ptr<const Structure> everything{};
  std::vector<std::filesystem::path> written{};  ///< files and folders that were written, but for the job's

  /// Returns all that the session has written, in its order.
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
  /// Whether the end of the preview loses nothing of the figure but its camera.
  bool keeps(const PreviewFigure& figure) const {
    return all_recorded || figure.edition == saved || (job_edition == figure.edition && job->done());
  }
  /// The latest job, which has ended, makes room for another.
  void forget_job() {
    if (job_edition && job->done()) saved = *job_edition;
    written = written_paths();
    job_edition.reset();
    job.reset();
  }
};

}  // namespace meniscus
