// SPDX-License-Identifier: BSD-3-Clause
// Properties of meshes, and of the files that commands write.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr unsigned kForMeshes = for_mesh | for_blender | for_path_tracers;
constexpr std::string_view kMesh = "Mesh", kOutput = "Output", kScene = "Scene";

constexpr auto kTable = std::to_array<Property>({
    number("mesh.tolerance", "--tolerance", "Å", "Largest distance of the mesh from the surface, in Å")
        .from(1e-5, 1)
        .in(kMesh, in_scene | in_bundle)
        .in_short_help()
        .of(kForMeshes),
    number("mesh.tolerance_pixels", "--tolerance-pixels", "PIXELS", "The same in pixels of the picture, such as 0.25")
        .from(1e-3, 100)
        .in(kMesh, in_scene | in_bundle)
        .of(kForMeshes)
        .excludes("mesh.tolerance"),
    number("mesh.density", "--density", "NUMBER",
           "Instead of a tolerance: vertices per Å², from one triangle an atom (0.02) up; triangles are even")
        .from(0.005, 1000)
        .in(kMesh, in_scene)
        .in_short_help()
        .of(for_mesh)
        .excludes("mesh.tolerance|mesh.tolerance_pixels"),
    flag("mesh.even", "--even", "Make nearly equilateral triangles, which cross the borders of patches")
        .in(kMesh, in_scene)
        .of(for_mesh),
    text("mesh.format", "--format", "WORD", "Format, where the file's ending does not tell")
        .in(kMesh, in_scene)
        .in_short_help()
        .of(for_mesh),
    text("mesh.attributes", "--attributes", "NAMES",
         "Numbers of vertices in PLY, VTP and GLB, separated by commas; docs/reference/mesh-attributes.md lists them")
        .initially("usual")
        .in(kMesh, in_scene | in_bundle)
        .of(for_mesh | for_blender),
    word("mesh.unit", "--unit", "UNIT", "Unit of the file: angstrom or nanometer")
        .one_of("angstrom|nanometer")
        .initially("angstrom")
        .in(kMesh, in_scene)
        .of(for_mesh),
    number("mesh.scale", "--scale", "LENGTH",
           "Length of 1 Å in the file; the unit of 3MF is the millimetre, of GLB the metre, others have none")
        .from(1e-12, 1e6)
        .initially("1")
        .in(kMesh, in_scene)
        .of(for_mesh)
        .excludes("mesh.unit"),

    number("pockets.tolerance", "--tolerance", "Å", "Largest distance of the mesh from the pocket, in Å")
        .from(1e-5, 1)
        .initially("0.02")
        .in(kOutput),

    new_file("output.file", "-o,--output", "PATH", "Output to write")
        .in(kOutput, in_scene)
        .in_short_help()
        .of(for_render | kForExports | for_mesh | for_atoms),
    flag("output.force", "--force", "Replace what exists at the output path").in(kOutput).in_short_help().of(kForRuns),
    file("scene.read", "--scene", "FILE",
         "Take these options from a scene file, or from a picture that meniscus made; options given here count "
         "before those of the scene")
        .in(kScene)
        .in_short_help()
        .of(kForRuns),
    flag("scene.trust", "--trust-scene",
         "Let the scene name files anywhere, to read and to write; for scenes of your own")
        .in(kScene)
        .of(kForRuns),
    text("scene.set", "--set", "KEY=VALUE",
         "Set a value by its key in scene files, such as look.outer_lines=2; meniscus help scenes lists the keys. "
         "Repeatable")
        .in(kScene, repeatable)
        .of(kForRuns),
    new_file("scene.save", "--save-scene", "FILE", "Write these options as a scene file")
        .in(kScene)
        .in_short_help()
        .of(for_render | kForExports | for_mesh),
});

}  // namespace

std::span<const Property> mesh_properties() { return kTable; }

}  // namespace meniscus
