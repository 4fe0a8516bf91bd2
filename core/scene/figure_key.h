// SPDX-License-Identifier: BSD-3-Clause
// The meaning of the colours of a figure: of its surface, and of everything drawn in addition to it.
#pragma once

#include "core/color/color_key.h"
#include "core/scene/figure.h"
#include "core/scene/frame_run.h"
#include "core/scene/scene.h"

namespace meniscus {

/// Returns the key of the colours of the atoms in a picture. structure: read with request.mark_atoms() if anything
/// is drawn in addition to the surface. drawn: one truth value per atom of the surface. `extras`: made by make_extras()
/// from the same structure, request and scheme. Throws InputError if colours are by a number that the atoms do not have
/// (color_atoms).
ColorKey figure_key(const Structure& structure, const ColorScheme& scheme, DrawnAtoms drawn,
                    const FigureRequest& request, const FigureExtras& extras);

/// Returns the key of a molecule that is drawn, and of everything in `extras`. If a cut may open its surface, all atoms
/// count, else only atoms with a part of it.
ColorKey key_of(const Molecule& molecule, const FigureRequest& request = {}, const FigureExtras& extras = {});

/// Returns the key for all frames of a run. If the scene has no legend but may have additional surfaces, everything in
/// addition to the molecule's surface is left out.
ColorKey key_of(const FrameRun& run, const Scene& scene);

}  // namespace meniscus
