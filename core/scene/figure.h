// SPDX-License-Identifier: BSD-3-Clause
// A molecule as a figure shows it: its surface, cut or seen through, and what stands beside it.
#pragma once

#include <span>
#include <vector>

#include "core/camera/camera.h"
#include "core/render/framebuffer.h"
#include "core/render/picture_object.h"
#include "core/render/surface_renderer.h"
#include "core/scene/cut.h"
#include "core/scene/figure_object.h"
#include "core/scene/molecule.h"
#include "core/scene/representations.h"

namespace meniscus {

/// What is shown of a molecule, and how.
struct FigureRequest {
  std::vector<Cut> cuts;            ///< of the surface
  CapStyle cap;                     ///< where they cut
  bool thickens = false;            ///< PictureObject::thickens
  bool hides_surface = false;       ///< it is not drawn, only what stands beside it
  Representations representations;  ///< beside the surface; not cut
  std::vector<FigureObjectRequest> objects;

  /// Makes read_structure mark and keep the atoms of all that stands beside the surface.
  void ask_for(ReadOptions& reading) const;

  /// Whether it is a surface and no more.
  bool plain() const {
    return cuts.empty() && !thickens && !hides_surface && representations.empty() && objects.empty();
  }
};

/// Everything of a figure, ready to be drawn.
struct Figure {
  Molecule molecule;
  ColoredShapes shapes;
  std::vector<FigureObject> objects;

  /// For framing: atoms of the surface at all places, and what stands beside it.
  std::vector<Ball> balls() const;
};

/// The shapes beside a molecule, of its structure. Throws as shown_shapes does.
Figure make_figure(Molecule molecule, const FigureRequest& request);

/// What a picture shows of one surface: cut and seen through as asked, and what stands beside it (nullptr: nothing).
/// atoms: of all that the picture shows, for cuts along the view. All must stay.
std::vector<PictureObject> picture_objects(const Surface& surface, const Coloring& coloring,
                                           const FigureRequest& request, const ColoredShapes* beside,
                                           const Camera& camera, std::span<const Ball> atoms);

/// Its picture. atom of the AOVs: into shown_atoms(); without shapes into Structure::atoms. Throws as
/// SurfaceRenderer::render() does.
Framebuffer draw(SurfaceRenderer& renderer, Figure figure, const FigureRequest& request, const Camera& camera,
                 const RenderSettings& settings);

}  // namespace meniscus
