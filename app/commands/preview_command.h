// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus preview`, and the scene files that it starts with, saves and opens.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/options/scene_options.h"
#include "app/preview/preview_state.h"
#include "app/preview/session.h"

namespace meniscus {

struct PreviewCommand : SceneCommand {
  bool models = false;                ///< each model of the file is a frame
  bool aims = false;                  ///< the scene says how the camera looks at first
  ExportWishes wishes;                ///< of exported pictures
  std::optional<std::uint16_t> port;  ///< of --serve
  std::string record, commands, token_file, output_folder = ".";

  /// The molecule as it is read: all models, if each is a frame.
  MoleculeRequest read_molecule_request() const;
};

using DeclaredPreview = DeclaredCommand<PreviewCommand>;

/// Adds the options of the preview alone, and what the others say differently.
void add_preview_options(CLI::App& command, DeclaredPreview& declared);

/// Takes the options. What a scene file does not say is as in render, of which it is a picture; without one the
/// preview's own defaults count, which are quick to draw.
void take_preview(DeclaredPreview& declared, const std::vector<std::string>& named = {});

/// The molecule again, at a frame, with the atoms that a figure draws beside its surface. Files are read again when
/// these change.
class ShownReader {
 public:
  explicit ShownReader(const PreviewCommand& command);

  Structure operator()(const FigureRequest& figure, std::size_t frame) const;

 private:
  MoleculeRequest molecule_;
  RunRequest frames_;
  bool models_ = false;
};

/// As render aims it: what stands beside the surface counts, and the molecule is framed beside the legend. color: with
/// the numbers of its file. Throws InputError, RequestError.
Camera aimed_camera(const Scene& scene, const std::optional<Camera>& given, const ColorScheme& color,
                    const Structure& structure);

/// As `meniscus render` makes it, by this program as a process of its own, whose end `watch` may want. Throws
/// RequestError, OutputError.
void make_film(Scene scene, const ExportTarget& target, const ExportWatch& watch);

/// Opens scenes of one molecule.
class SceneOpener {
 public:
  explicit SceneOpener(const DeclaredPreview& begun);

  /// Throws InputError, UsageError; RequestError where the scene is of another molecule.
  OpenedScene operator()(const std::filesystem::path& path) const;

 private:
  bool is_of_this_molecule(const Scene& scene) const;

  Scene begun_;
  bool models_;
  std::vector<std::string> named_;  ///< words of the command line: files among them may be named by scenes, too
};

}  // namespace meniscus
