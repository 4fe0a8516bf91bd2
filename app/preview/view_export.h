// SPDX-License-Identifier: BSD-3-Clause
// "Export this view": what a preview shows as a picture, a scene, a file for Blender, or a camera.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/output_file.h"
#include "core/color/color_schemes.h"
#include "core/structure/structure.h"
#include "core/camera/camera.h"
#include "core/camera/camera_path.h"
#include "app/preview/export_job.h"
#include "app/preview/preview_state.h"
#include "core/color/coloring.h"
#include "core/render/annotation.h"
#include "core/scene/figure.h"
#include "core/scene/picture_device.h"

namespace meniscus {

/// A view to be exported, whatever becomes of the session that showed it.
struct ExportedView {
  Structure structure;
  std::vector<std::uint32_t> atoms;  ///< those shown, into structure.atoms
  std::vector<Ball> balls;           ///< theirs, grown by growth_of() the kind of surface
  Coloring coloring;                 ///< theirs
  ColorScheme color;                 ///< what the colours mean
  PreviewFigure figure;
  std::shared_ptr<const BesideSurface> beside;  ///< the surface; nullptr: nothing
  Annotations annotations;                      ///< written into pictures
  glm::ivec2 size;                              ///< pixels, with the legend
  int samples;                                  ///< rays per pixel
  bool transparent;                             ///< pictures have no background
  std::string scene;                            ///< what pictures say they were made of; empty: nothing
  double dots_per_inch = 0.0;                   ///< of pictures; 0: not said
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
std::string export_povray(const ExportedView& view, const ExportTarget& target, const ExportWatch& watch);

/// As `meniscus export blender`.
void export_blender(const ExportedView& view, const ExportTarget& target, const ExportWatch& watch);

/// As `meniscus render --save-camera`.
void export_camera(const Camera& camera, const ExportTarget& target);

/// Key frames for `meniscus render --camera-path`. Throws RequestError where there are none.
void export_camera_path(const std::vector<CameraKey>& keys, const ExportTarget& target);

/// The path in `folder` of a file with this plain name: letters, digits, '.', '_' and '-', the first no '.' or '-', at
/// most 100 of them. Throws RequestError.
std::filesystem::path export_path(const std::filesystem::path& folder, const std::string& name);

}  // namespace meniscus
