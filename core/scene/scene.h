// SPDX-License-Identifier: BSD-3-Clause
// A scene: everything that a user chose for a figure, a film or an export, as one value.
#pragma once

#include <map>
#include <string>

#include "core/camera/view_request.h"
#include "core/render/look.h"
#include "core/scene/annotations.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/outputs.h"
#include "core/scene/run_framing.h"

namespace meniscus {

/// Complete: with the files that it names, nothing else is needed to make the same picture, film or export again. Each
/// member is that of a property (core/properties); scene_values.h sets and reads them by key, scene_json.h as JSON.
/// Scene{} is what every command makes of a molecule if nothing else is asked for.
struct Scene {
  MoleculeRequest molecule;
  RunRequest frames;
  FigureRequest figure;
  ViewRequest picture;
  CameraMotionRequest run_camera;
  LookRequest look;
  LegendRequest legend;
  AnnotationRequest annotations;
  PictureOutput image;
  FilmFormat film;
  MeshOutput mesh;
  RendererOutput renderer;
  std::string output;  ///< path of what is made; empty: not said

  /// Lengths on paper as they were given ("85mm", "0.5pt"), by the key of their property. The members themselves have
  /// pixels.
  std::map<std::string, std::string, std::less<>> lengths;
};

/// Whether both have the same values of all properties that scene files hold.
bool operator==(const Scene& one, const Scene& other);

}  // namespace meniscus
