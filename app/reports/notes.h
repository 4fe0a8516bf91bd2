// SPDX-License-Identifier: BSD-3-Clause
// What a command says on stderr while it works.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/molecule_options.h"
#include "core/base/progress.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/frame_run.h"
#include "core/scene/view_aim.h"

namespace meniscus {

/// A line on stderr, unless quiet. Control characters are escaped.
void say(const MoleculeOptions& options, const std::string& line);

/// The warnings about a file on stderr, as detailed as wanted, unless quiet.
void say_warnings(const MoleculeOptions& options, const Structure& structure);

/// Warns that this share of a surface lies outside of the volume map that colours it, unless none does. whose: "the
/// surface".
void tell_beyond_map(const MoleculeOptions& options, double share, std::string_view whose);

/// Progress on stderr: a bar on a terminal, plain lines elsewhere, nothing when quiet.
ProgressSink progress_on_stderr(const MoleculeOptions& options);

/// Reads the file and says what was read and left out, and each warning. With --assembly list it prints the assemblies
/// and ends the program by CLI::Success.
Structure read_and_tell(const MoleculeOptions& options);

/// What was read and left out, each warning, and how many frames a run has.
void tell_run(const MoleculeOptions& options, const FrameRun& frames);

/// Meshes what is shown of each object, and says how many triangles came out.
std::vector<TriangleMesh> mesh_and_tell(const MoleculeOptions& options, std::span<const SurfaceObject> objects,
                                        double tolerance, bool may_be_empty = false);

/// Reads, computes and colours, in that order; says what was read and on which device it ran.
Molecule load_molecule(const MoleculeOptions& options);

/// A molecule, and how a picture of it is aimed.
struct AimedMolecule {
  Molecule molecule;
  ViewAim aim;
};

/// The same. Between reading and computing it refuses what the picture asks for and the molecule has not, and warns if
/// the camera given is certain to see nothing.
AimedMolecule load_aimed_molecule(const MoleculeOptions& options, const ViewRequest& picture,
                                  const std::optional<Camera>& given);

}  // namespace meniscus
