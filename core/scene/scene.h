// SPDX-License-Identifier: BSD-3-Clause
// A scene: everything that a user chose for a figure, a film or an export, as one value.
#pragma once

#include "core/camera/view_request.h"
#include "core/render/look.h"
#include "core/scene/annotations.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/outputs.h"
#include "core/scene/run_framing.h"

namespace meniscus {

/// A complete scene: together with the files that it names, it suffices to make the same picture, film or export again.
/// Each member belongs to a property (core/properties); scene_values.h sets and reads members by key, scene_json.h as
/// JSON. Scene{} has the defaults of every command.
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
  std::string output;  ///< path of the output; empty: not given

  /// Lengths on paper as they were given ("85mm", "0.5pt"), by the key of their property. Members have them in pixels.
  std::map<std::string, std::string, std::less<>> lengths;
};

/// True if both have the same values of all properties that scene files hold.
bool operator==(const Scene& one, const Scene& other);

}  // namespace meniscus
