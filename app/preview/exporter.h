// SPDX-License-Identifier: BSD-3-Clause
// What a session needs of the program around it, and where its exports go.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "app/preview/export_job.h"
#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "app/preview/view_export.h"
#include "core/render/annotation.h"
#include "core/scene/scene.h"

namespace meniscus {

/// A figure that a scene file says, of the molecule that is shown.
struct OpenedScene {
  PreviewFigure figure;
  ExportWishes wishes;
  int frame = 0;  ///< of a file of several models, from 0
};

/// What a session needs of the program around it; all of it may be missing.
struct SessionContext {
  ReadShown read_shown;
  std::optional<Scene> scene;     ///< that the preview began with; nothing: it writes no scenes
  MakePictureDevice make_device;  ///< of exported pictures
  /// What is written into exported pictures of the molecule, as it is at a frame.
  std::function<Annotations(const Structure& structure)> annotations;
  /// Reads a scene. Throws InputError, UsageError; RequestError where it is one of another molecule.
  std::function<OpenedScene(const std::filesystem::path& path)> open_scene;
};

/// What exports go to; the latest of them may still be written, beside the pictures.
struct Exporter {
  std::filesystem::path folder;
  SessionContext context;
  std::unique_ptr<ExportJob> job{};  ///< nullptr: none yet
};

}  // namespace meniscus
