// SPDX-License-Identifier: BSD-3-Clause
// What the options of `meniscus preview` say, and scene files as it begins with them, saves and opens them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>

#include "app/options/annotation_options.h"
#include "app/options/frame_options.h"
#include "app/options/molecule_options.h"
#include "app/preview/session.h"
#include "core/camera/view_request.h"
#include "core/render/look_presets.h"
#include "core/scene/figure.h"

namespace meniscus {

struct PreviewCommand {
  MoleculeOptions molecule;
  FrameOptions frames;
  ViewRequest picture;
  FigureRequest figure;
  LegendRequest legend;
  AnnotationRequest annotations;
  LookRequest look{.preset = LookPreset::classic};
  std::optional<int> samples;  ///< of exported pictures
  std::optional<glm::vec3> background = glm::vec3(1.0f);
  bool of_scene = false;  ///< the options come from a scene, so that pictures are those of render
  RenderInput input;
  std::optional<std::uint16_t> port;  ///< of --serve
  std::string record, commands, output_folder = ".";
  bool force = false;
};

/// Declares the options of the empty command, which must not live longer. Once parsed they are to be taken.
void declare_preview(CLI::App& command, PreviewCommand& state);

/// What the parsed words mean together: a scene has the defaults of render, of which it is a picture.
void take_preview(const CLI::App& command, PreviewCommand& state);

/// The molecule again, at a frame, with the atoms that a figure draws beside its surface. Files are read anew when
/// these change.
class ShownReader {
 public:
  /// models: the file's models are the frames.
  ShownReader(const PreviewCommand& command, bool models);

  Structure operator()(const FigureRequest& figure, std::size_t frame) const;

 private:
  MoleculeOptions molecule_;
  FrameOptions frames_;
  bool models_ = false;
};

/// As render aims it: what stands beside the surface counts, and the molecule is framed beside the legend. color: with
/// the numbers of its file. Throws InputError, RequestError.
Camera aimed_camera(const PreviewCommand& command, const std::optional<Camera>& given, const ColorScheme& color,
                    const Structure& structure);

/// What commands change, as the options say it at the beginning; no camera. color: with the numbers of its file.
PreviewFigure figure_of(const PreviewCommand& command, const ColorScheme& color);
ExportWishes wishes_of(const PreviewCommand& command, const CLI::App& parsed);

/// Writes the scene of a command line of render, as its --save-scene does. Throws OutputError, RequestError.
void save_render_scene(const std::vector<std::string>& words, const ExportTarget& target);
/// The same scene as the text that render's pictures carry. Throws RequestError.
std::string render_scene_text(const std::vector<std::string>& words);

/// Opens scenes of one molecule.
class SceneOpener {
 public:
  SceneOpener(const CLI::App& parsed, const PreviewCommand& command);

  /// Throws InputError, UsageError; RequestError where the scene is of another molecule.
  OpenedScene operator()(const std::filesystem::path& path) const;

 private:
  struct Reading {
    std::string option;
    std::vector<std::string> values;
    bool operator==(const Reading&) const = default;
  };
  static std::vector<Reading> reading_of(const CLI::App& parsed, std::initializer_list<std::string_view> sections);

  std::vector<Reading> molecule_, numbers_;
  bool shows_models_;  ///< each is a frame
  std::string file_;
  std::vector<std::string> named_;  ///< words of the command line: files among them may be named by scenes, too
};

}  // namespace meniscus
