// SPDX-License-Identifier: BSD-3-Clause
// Properties of meshes, and of the files that commands write.
#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr std::string_view kMesh = "Mesh", kOutput = "Output", kScene = "Scene";

constexpr auto kTable = std::to_array<Property>({
    number("mesh.tolerance", "--tolerance", "Å", "Largest distance between mesh and surface, in Å")
        .from(1e-5, 1)
        .in(kMesh, in_scene | in_bundle | in_short_help),
    number("mesh.tolerance_pixels", "--tolerance-pixels", "PIXELS",
           "Largest distance between mesh and surface, in pixels, such as 0.25")
        .from(1e-3, 100)
        .in(kMesh, in_scene | in_bundle)
        .excludes("mesh.tolerance"),
    number("mesh.density", "--density", "NUMBER",
           "Vertices per Å², instead of a tolerance. 0.02 gives about one triangle per atom; triangles are even")
        .from(0.005, 1000)
        .in(kMesh, in_scene | in_bundle | in_short_help)
        .excludes("mesh.tolerance|mesh.tolerance_pixels"),
    flag("mesh.even", "--even", "Make nearly equilateral triangles. They cross the borders of patches")
        .in(kMesh, in_scene | in_bundle),
    text("mesh.format", "--format", "WORD", "Format of the file, if its ending does not tell")
        .in(kMesh, in_scene | in_short_help),
    text("mesh.attributes", "--attributes", "NAMES",
         "Numbers of vertices to write in PLY, VTP, GLB and USD, separated by commas")
        .initially("usual")
        .in(kMesh, in_scene | in_bundle),
    word("mesh.unit", "--unit", "UNIT", "Unit of the file: angstrom or nanometer")
        .one_of("angstrom|nanometer")
        .initially("angstrom")
        .in(kMesh, in_scene),
    number("mesh.scale", "--scale", "LENGTH",
           "Length of 1 Å in the file. The unit of 3MF is the millimetre, that of GLB and USD the metre; others have "
           "none")
        .from(1e-12, 1e6)
        .initially("1")
        .in(kMesh, in_scene)
        .excludes("mesh.unit"),

    number("distances.voxel", "--voxel", "Å", "Edge of a voxel, in Å").from(0.01, 100).initially("0.5").in(kMesh),
    count("distances.band", "--band", "N", "Voxels on each side of the surface whose distance is written")
        .from(1, 1000)
        .initially("3")
        .in(kMesh),

    number("pockets.tolerance", "--tolerance", "Å", "Largest distance between mesh and pocket, in Å")
        .from(1e-5, 1)
        .initially("0.02")
        .in(kOutput),

    new_file("output.file", "-o,--output", "PATH", "Output file or folder").in(kOutput, in_scene | in_short_help),
    flag("output.force", "--force", "Replace an output that already exists").in(kOutput, in_short_help),
    file("scene.read", "--scene", "FILE",
         "Take options from a scene file or from a picture that meniscus made. Options on the command line override "
         "those of the scene")
        .in(kScene, in_short_help),
    flag("scene.trust", "--trust-scene", "Let the scene read and write files anywhere. Use it only for your own scenes")
        .in(kScene),
    text("scene.set", "--set", "KEY=VALUE",
         "Set a value by its scene key, such as look.outer_lines=2. Repeatable; meniscus help scenes lists the keys")
        .in(kScene, repeatable),
    new_file("scene.save", "--save-scene", "FILE", "Save these options as a scene file").in(kScene, in_short_help),
});

}  // namespace

std::span<const Property> mesh_properties() { return kTable; }

}  // namespace meniscus
