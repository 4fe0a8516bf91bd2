// SPDX-License-Identifier: BSD-3-Clause
// What the colours of a figure mean: those of its surface, and of what is drawn beside it.
#pragma once

#include "core/color/color_key.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Of the atoms in a picture. structure: as read with request.ask_for(), if there is something beside the surface.
/// drawn: of the surface, one truth value per atom. beside: made by make_beside() of the same. Throws as color_atoms
/// does.
ColorKey figure_key(const Structure& structure, const ColorScheme& scheme, DrawnAtoms drawn,
                    const FigureRequest& request, const BesideSurface& beside);

/// Of a molecule that is drawn, and of what is beside it. Where a cut may open its surface all atoms count, else those
/// that have a part of it.
ColorKey key_of(const Molecule& molecule, const FigureRequest& request = {}, const BesideSurface& beside = {});

/// Of all frames of a run; where the scene has no legend without what is beside the surface, if surfaces may be.
ColorKey key_of(const FrameRun& run, const Scene& scene);

}  // namespace meniscus
