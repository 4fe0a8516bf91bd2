// SPDX-License-Identifier: BSD-3-Clause
// A surface, its mesh, its atoms and a camera as one .mns file, which the Blender add-on beside this file reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/render/camera.h"
#include "core/surface/coloring.h"
#include "core/surface/primitives.h"
#include "exporters/mesh/triangle_mesh.h"

namespace meniscus::blender {

/// Numbers per atom, in the order of Surface::atoms; an empty vector leaves the attribute out.
/// The names in the file are those of Molecular Nodes: b_factor, atomic_number, res_id, chain_id.
struct AtomAttributes {
  std::vector<float> b_factor;
  std::vector<std::int32_t> atomic_number;
  std::vector<std::int32_t> residue_number;
  std::vector<std::int32_t> chain;  ///< into chain_names
  std::vector<std::string> chain_names;
};

/// A camera and the picture it is meant for.
struct Shot {
  Camera camera;
  int width = 0, height = 0;  ///< pixels
};

/// Where the surface came from; kept in the file and in Blender as custom properties.
struct Provenance {
  std::string source;     ///< the input file's name, without its folder
  std::string radii_set;  ///< "bondi" or "file"
  std::string device;     ///< what computed the surface
};

/// Writes the file as FORMAT.md describes. Throws OutputError.
void write_surface(const std::string& path, Existing existing, const Surface& surface, const TriangleMesh& mesh,
                   const Coloring& coloring, const AtomAttributes& atoms, const std::optional<Shot>& shot,
                   const Provenance& provenance);

}  // namespace meniscus::blender
