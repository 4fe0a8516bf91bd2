// SPDX-License-Identifier: BSD-3-Clause
// What `render --extent` needs around the view pipeline: atoms, checks, figures.
#pragma once

#include <string>

#include "core/scene/molecule.h"
#include "core/visible_surface/extent.h"
#include "core/visible_surface/view_pipeline.h"

namespace meniscus {

/// Throws UsageError for options that only a complete surface can serve: --by, --cavities, --instances, --verify,
/// --color component, another --surface, and for --device cpu.
void check_view_options(const MoleculeRequest& request);

/// The atoms of a structure with their colours, and no surface yet. Throws InputError.
struct ColoredAtoms {
  Molecule molecule;  ///< without objects
  std::vector<Ball> balls;
  Coloring coloring;
};
ColoredAtoms colored_atoms(const MoleculeRequest& request, Structure structure);

/// What the next pictures of `view` show.
void show(const ColoredAtoms& atoms, double probe_radius, Extent extent, ViewPipeline& view);

/// The four groups of stages and the ray casting line by line, with what each of them found.
std::string stats_text(const ViewStats& stats, const std::vector<StageTime>& times, glm::ivec2 picture_size);

}  // namespace meniscus
