// SPDX-License-Identifier: BSD-3-Clause
// The derivatives of a molecule's areas and volumes with respect to its atoms' positions, for tables.
#pragma once

#include <string>
#include <vector>

#include "core/queries/surface_object.h"
#include "core/scene/surface_request.h"
#include "core/structure/structure.h"
#include "core/surface/gradients.h"

namespace meniscus {

/// A derivative by the position of each atom of a structure.
struct GradientColumn {
  std::string name;  ///< "ses_area", "ses_volume", "sas_area", "sas_volume", "vdw_area", "vdw_volume"; a word of ours
  Gradient values;   ///< Å²/Å, or Å³/Å
};

/// Area and volume of the surface that was made, summed over objects; of a solvent-excluded one those of the
/// accessible one, too. Objects must be surfaces of whole groups of atoms. Throws InputError, naming the
/// atoms, where a probe touches more than three.
std::vector<GradientColumn> gradient_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                             SurfaceKind kind);

}  // namespace meniscus
