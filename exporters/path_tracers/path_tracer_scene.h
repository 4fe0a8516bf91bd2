// SPDX-License-Identifier: BSD-3-Clause
// The content of a scene for a path tracer, made of surfaces and shapes, the parts that all formats share (lights,
// materials, numbers as text), its text for Mitsuba 3 and for pbrt-v4, and its folder with a PLY file for each mesh or
// for each colour.
#pragma once

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/math/rigid_motion.h"
#include "core/mesh/triangle_mesh.h"
#include "core/queries/surface_object.h"
#include "core/structure/structure.h"

namespace meniscus::path_tracers {

/// The colour and opacity of points, without their material.
struct Paint {
  glm::vec3 color{0.0f};  ///< linear light, each channel in [0, 1]
  float opacity = 1.0f;   ///< in (0, 1]

  bool operator==(const Paint&) const = default;
};

/// Triangles of one opacity. Vertices are duplicated at borders of colours and along cusps, so that colours change at
/// edges, as in the view, and normals are those of the surface.
struct SceneMesh {
  std::vector<glm::vec3> positions;                     ///< Å, from the scene's origin
  std::vector<glm::vec3> normals;                       ///< unit vectors towards the solvent
  std::vector<glm::vec3> colors;                        ///< linear light
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the solvent
  float opacity = 1.0f;
};

/// A whole sphere.
struct SceneSphere {
  glm::dvec3 center{0.0};  ///< Å, from the scene's origin
  double radius = 0.0;     ///< Å
  Paint paint;
};

/// The lateral surface of a cylinder.
struct SceneCylinder {
  glm::dvec3 from{0.0}, to{0.0};  ///< Å, from the scene's origin
  double radius = 0.0;            ///< Å
  Paint paint;
};

/// Meshes, spheres and cylinders that are placed together, once or several times.
struct SceneItem {
  std::vector<SceneMesh> meshes;
  std::vector<SceneSphere> spheres;
  std::vector<SceneCylinder> cylinders;
  std::vector<RigidMotion> copies{RigidMotion{}};  ///< motions of coordinates relative to the scene's origin
  bool is_surface = true;                          ///< true if it has the scene's material; false if it is matte

  /// Returns true if there is a single copy, which is not moved.
  bool is_placed_once() const {
    return copies.size() == 1 && copies[0].rotation == glm::dmat3(1.0) && copies[0].translation == glm::dvec3(0.0);
  }
  bool empty() const { return meshes.empty() && spheres.empty() && cylinders.empty(); }
};

/// The material of the surface.
enum class Material {
  matte,
  plastic,  ///< matte below a smooth coat that reflects the lights
  glass,    ///< refracts and absorbs as one solid
  wax       ///< light scatters below the surface
};

/// A whole scene for a path tracer.
struct PathTracerScene {
  std::vector<SceneItem> items;
  glm::dvec3 origin{0.0};          ///< origin of its coordinates in the molecule's coordinates, Å
  Camera camera;                   ///< in the molecule's coordinates
  int width = 1280, height = 960;  ///< pixels
  Material material = Material::matte;
};

/// Returns the scene for Mitsuba 3 (W. Jakob et al., "Mitsuba 3 renderer", 2022; its documentation, "Scene XML file
/// format"). Meshes are counted from 1 over all items; mesh n is the file <name>_<n>.ply with colours of vertices.
std::string mitsuba_text(const PathTracerScene& scene, const std::string& name);

/// Returns the scene for pbrt-v4 (M. Pharr, W. Jakob & G. Humphreys, "Physically based rendering", 4th edition, 2023;
/// its documentation, "pbrt-v4 input file format"). Mesh files are named as for Mitsuba. Each mesh must have a single
/// colour (split_colors()).
std::string pbrt_text(const PathTracerScene& scene, const std::string& name);

/// Parallel light.
struct DistantLight {
  glm::dvec3 direction{0.0};  ///< direction of travel, of unit length
  glm::vec3 strength{0.0f};   ///< radiance of a white matte surface under perpendicular light
};

/// A disc with uniform radiance that faces the scene.
struct Softbox {
  glm::dvec3 center{0.0};     ///< Å, from the scene's origin
  glm::dvec3 direction{0.0};  ///< unit vector towards the scene
  double radius = 0.0;        ///< Å
  glm::vec3 radiance{0.0f};
};

/// All lights of a scene.
struct Lights {
  glm::vec3 environment{0.0f};  ///< radiance of the uniform environment
  std::vector<DistantLight> distant;
  std::vector<Softbox> softboxes;
};

/// A ball around a whole scene.
struct Extent {
  glm::dvec3 center{0.0};  ///< Å, from the scene's origin
  double radius = 1.0;     ///< Å
};
/// Returns a ball around all copies of all items.
Extent extent_of(const PathTracerScene& scene);

/// Returns the lights of a scene, at fixed directions relative to the camera. Glass reflects and refracts its
/// surroundings, so it gets softboxes; all other materials get distant lights.
Lights lights_of(const PathTracerScene& scene);

/// The index of refraction of glass, and its absorption coefficient in 1/Å, as in the POV-Ray scene.
inline constexpr double kGlassIor = 1.45;
inline const glm::vec3 kGlassAbsorption{0.4f / 30.0f, 0.25f / 30.0f, 0.2f / 30.0f};
/// The index of refraction and the roughness of the coat of plastic. The roughness is perceptual, which is the square
/// root of that of microfacets.
inline constexpr double kCoatIor = 1.45, kCoatRoughness = 0.35;
/// The index of refraction and the roughness of the boundary of wax, and its mean free path of light per channel, in Å.
inline constexpr double kWaxIor = 1.4, kWaxRoughness = 0.4;
inline const glm::vec3 kWaxMeanFreePath{1.6f, 1.0f, 0.8f};

/// Returns the colour that is written into a scene. The colour of glass applies twice, where light enters and where it
/// leaves; after both, 0.4 of the light that `color` would absorb remains.
inline glm::vec3 written_color(Material material, bool is_surface, const glm::vec3& color) {
  if (!is_surface || material != Material::glass) return color;
  const auto once = [](float channel) { return std::sqrt(0.4f + 0.6f * channel); };
  return {once(color.x), once(color.y), once(color.z)};
}

/// Returns the shortest text that reads back as the same number. Throws Error for a number that is not finite, so that
/// a scene never contains nan or inf.
std::string number_text(double value);
std::string number_text(float value);
/// Returns the texts of three numbers, separated by `between`. Throws what number_text() throws.
std::string vector_text(const glm::dvec3& v, std::string_view between = " ");
std::string vector_text(const glm::vec3& v, std::string_view between = " ");

/// The caps of a mesh that planes cut, which are its last triangles.
struct CapRows {
  std::size_t count = 0;           ///< number of triangles
  std::optional<glm::vec3> color;  ///< sRGB; empty: the colours of atoms
};

/// Returns the shown part of a surface. Whole spheres, which no other atom touches, become spheres; everything else
/// becomes triangles of `mesh`. mesh: the mesh of the shown part, with one row per triangle in its tables. caps: empty
/// if no plane cuts the surface. Colours of a volume map are those at vertices.
SceneItem surface_item(const SurfaceObject& object, const TriangleMesh& mesh, const glm::dvec3& origin,
                       const std::optional<CapRows>& caps = {});

/// Returns shapes as spheres, cylinders and meshes. Cylinders are split into halves with the colours of their atoms.
/// atoms: the shown atoms (representations.h).
SceneItem shapes_item(std::span<const Atom> atoms, const ColoredShapes& shapes, const glm::dvec3& origin);

/// The program that renders a scene.
enum class Renderer { mitsuba, pbrt };

/// The renderer and the folder of a scene.
struct SceneTarget {
  Renderer renderer = Renderer::mitsuba;
  std::filesystem::path folder;  ///< created if it does not exist
  std::string name = "surface";  ///< begins all file names; letters, digits, '-' and '_' only
  Existing existing = Existing::refuse;
};

/// A report of the written files.
struct SceneReport {
  std::vector<std::filesystem::path> files;               ///< all files, the scene last
  std::size_t triangles = 0, spheres = 0, cylinders = 0;  ///< numbers without copies
};

/// Writes <name>.xml or .pbrt, and <name>_1.ply etc., all or none. Throws RequestError for no items, OutputError.
SceneReport write_scene(const PathTracerScene& scene, const SceneTarget& target);

/// Splits a mesh into meshes of one colour, in the order in which colours occur. Colours are rounded to 8 bits per
/// channel of sRGB, and colours that then agree are one. All corners of a triangle must have one colour.
std::vector<SceneMesh> split_colors(const SceneMesh& mesh);

}  // namespace meniscus::path_tracers
