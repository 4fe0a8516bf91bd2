// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus preview`, and the scene files that it starts with, saves and opens.
#pragma once

#include "app/options/scene_options.h"
#include "app/preview/preview_state.h"
#include "app/preview/session.h"
#include "core/scene/frame_run.h"

namespace meniscus {

struct PreviewCommand : SceneCommand {
  bool models = false;                ///< true if each model of the file is a frame
  bool aims = false;                  ///< true if the scene sets the first camera
  bool has_size = false;              ///< true if the scene has the size of exported pictures
  std::optional<std::uint16_t> port;  ///< the value of --serve
  std::string address = "127.0.0.1";  ///< the address in the value of --serve
  std::vector<std::string> trusted_hosts;
  bool no_open = false;  ///< true if the user opens the page
  std::string record, commands, token_file, output_folder = ".";

  /// Returns the request for the molecule: all models, if each is a frame.
  MoleculeRequest read_molecule_request() const;
};

using DeclaredPreview = DeclaredCommand<PreviewCommand>;

/// Returns the properties of `meniscus preview`.
TakenProperties preview_properties();

/// Adds the options that only the preview has, and those with other defaults.
void add_preview_options(CLI::App& command, DeclaredPreview& declared);

/// Takes the options. A scene file starts from the defaults of render, whose picture it is; without one the preview has
/// its own defaults, which are fast to draw.
void take_preview(DeclaredPreview& declared, const std::vector<std::string>& named = {});

/// Reads the molecule again, at a frame, with the atoms that a figure draws in addition to its surface. Files are read
/// again when these atoms change; a trajectory stays open while they do not. Calls must not overlap.
class ShownReader {
 public:
  explicit ShownReader(const PreviewCommand& command);

  Structure operator()(const FigureRequest& figure, std::size_t frame) const;

 private:
  MoleculeRequest molecule_;
  RunRequest frames_;
  bool models_ = false;

  /// The run of the last call, and the atoms that it marks.
  struct OpenRun {
    std::string marks;
    std::unique_ptr<FrameRun> run;
  };
  std::shared_ptr<OpenRun> open_ = std::make_shared<OpenRun>();
};

/// Returns the camera that render would use: everything drawn counts, and the molecule is framed next to the legend.
/// The scene's colours have the numbers of their file. Throws InputError, RequestError.
Camera aimed_camera(const Scene& scene, const std::optional<Camera>& given, const Structure& structure);

/// Makes a film in a child process that `watch` can cancel. Throws RequestError, OutputError.
void make_film(const FilmOrder& order, const ExportTarget& target, const ExportWatch& watch);

/// Opens scenes of one molecule.
class SceneOpener {
 public:
  explicit SceneOpener(const DeclaredPreview& begun);

  /// Opens a scene. Throws InputError, UsageError; RequestError if the scene is of another molecule.
  OpenedScene operator()(const std::filesystem::path& path) const;

 private:
  bool is_of_this_molecule(const Scene& scene) const;

  Scene begun_;
  bool models_;
  std::vector<std::string> named_;  ///< words of the command line; scenes may name files among them
};

}  // namespace meniscus
