// SPDX-License-Identifier: BSD-3-Clause
// The options that say what a figure shows beside the whole surface: cuts, opacity, sticks and the like.
#pragma once

#include "app/options/molecule_options.h"
#include "core/camera/view_request.h"
#include "core/scene/figure.h"

namespace meniscus {

/// --opacity, --film-opacity, --clip, --cap-color, --cap-hatching, --object, --hide-surface, and those of
/// representation_options.h. Both must live as long as the command.
void add_figure_options(CLI::App& command, MoleculeOptions& molecule, FigureRequest& figure);

/// --interface. The molecule must live as long as the command.
void add_interface_option(CLI::App& command, MoleculeOptions& molecule);
/// Takes the atoms of both sides, once --select is known; colours and the view are those of an open book unless others
/// were asked for.
void take_interface(const CLI::App& command, MoleculeOptions& molecule, ViewRequest& picture);

}  // namespace meniscus
