// SPDX-License-Identifier: BSD-3-Clause
// The options of what is drawn: sticks and tubes beside the surface, objects, opacity, cuts, interfaces.
#pragma once

#include "app/options/molecule_options.h"
#include "core/camera/view_request.h"
#include "core/scene/figure.h"

namespace meniscus {

/// --sticks, --balls, --spheres, --tube, --stick-radius, --tube-radius. They must live as long as the command.
void add_representation_options(CLI::App& command, Representations& representations);

/// The same and --object, --hide-surface, --opacity, --film-opacity, --clip, --cap-color, --cap-hatching. Both must
/// live as long as the command.
void add_figure_options(CLI::App& command, MoleculeOptions& molecule, FigureRequest& figure);

/// --interface. The molecule must live as long as the command.
void add_interface_option(CLI::App& command, MoleculeOptions& molecule);
/// Takes the atoms of both sides, once --select is known; colours and the view are those of an open book unless others
/// were asked for.
void take_interface(const CLI::App& command, MoleculeOptions& molecule, ViewRequest& picture);

}  // namespace meniscus
