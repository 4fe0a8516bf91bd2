// SPDX-License-Identifier: BSD-3-Clause
// A picture made of what one view needs (`render --extent`), without the complete surface.
#pragma once

#include <string>

#include "core/scene/molecule.h"
#include "core/render/framebuffer.h"
#include "core/render/ray_caster.h"
#include "core/visible_surface/extent.h"
#include "app/options/molecule_options.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {

/// Throws UsageError for options that only a complete surface can serve: --by, --cavities, --instances, --verify,
/// --color component, another --surface.
void check_view_options(const MoleculeOptions& options);

/// The atoms of a structure with their colours, and no surface yet. Throws InputError.
struct ColoredAtoms {
  Molecule molecule;  ///< without objects
  std::vector<Ball> balls;
  Coloring coloring;
};
ColoredAtoms load_atoms(const MoleculeOptions& options);
ColoredAtoms colored_atoms(const MoleculeOptions& options, Structure structure);

/// A finished picture, and how it came to be.
struct ViewPicture {
  Framebuffer picture;
  std::vector<StageTime> times;
  ViewStats stats;
};

/// Draws one picture after another; needs a current GL context as long as it lives.
class ViewPainter {
 public:
  /// Throws OpenSurfaceError, GpuError, CapacityError, InputError for a bad camera.
  ViewPicture paint(const ColoredAtoms& atoms, const Camera& camera, double probe_radius, Extent extent,
                    const RenderSettings& settings);

 private:
  ViewPipeline pipeline_;
  RayCaster caster_;
  GpuScene scene_;
};

/// The four groups of stages and the ray casting line by line, with what each of them found.
std::string stats_text(const ViewPicture& view);

}  // namespace meniscus
