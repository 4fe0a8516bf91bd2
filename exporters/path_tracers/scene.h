// SPDX-License-Identifier: BSD-3-Clause
// What a scene for a path tracer holds, whatever its format, and its text for Mitsuba 3 and for pbrt-v4.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/math/rigid_motion.h"

namespace meniscus::path_tracers {

/// How points look, apart from the material.
struct Paint {
  glm::vec3 color{0.0f};  ///< linear light, each channel in [0, 1]
  float opacity = 1.0f;   ///< in (0, 1]

  bool operator==(const Paint&) const = default;
};

/// Triangles of one opacity. Vertices are doubled where colours meet and along cusps, so that colours change along
/// edges, as they do in the view, and normals are those of the surface.
struct SceneMesh {
  std::vector<glm::vec3> positions;                     ///< Å, from the scene's origin
  std::vector<glm::vec3> normals;                       ///< unit, towards the solvent
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

/// Things that are together, in one place or in several.
struct SceneItem {
  std::vector<SceneMesh> meshes;
  std::vector<SceneSphere> spheres;
  std::vector<SceneCylinder> cylinders;
  std::vector<RigidMotion> copies{RigidMotion{}};  ///< of coordinates that count from the scene's origin
  bool is_surface = true;                          ///< made of the scene's material; else matte

  /// It is not moved, and there is one of it.
  bool stands_once() const {
    return copies.size() == 1 && copies[0].rotation == glm::dmat3(1.0) && copies[0].translation == glm::dvec3(0.0);
  }
  bool empty() const { return meshes.empty() && spheres.empty() && cylinders.empty(); }
};

/// What the surface is made of.
enum class Material {
  matte,
  plastic,  ///< matte below a smooth coat, which mirrors the lights
  glass,    ///< refracts and absorbs as one solid
  wax       ///< light scatters below the surface
};

/// All of a scene.
struct Scene {
  std::vector<SceneItem> items;
  glm::dvec3 origin{0.0};          ///< Å: where its coordinates begin
  Camera camera;                   ///< in the molecule's coordinates
  int width = 1280, height = 960;  ///< pixels
  Material material = Material::matte;
};

/// The scene for Mitsuba 3 (W. Jakob et al., "Mitsuba 3 renderer", 2022; its documentation, "Scene XML file format").
/// Mesh n of the scene, from 1, counted over all items, is the file <name>_<n>.ply with colours.
std::string mitsuba_text(const Scene& scene, const std::string& name);

/// The same for pbrt-v4 (M. Pharr, W. Jakob & G. Humphreys, "Physically based rendering", 4th edition, 2023; its
/// documentation, "pbrt-v4 input file format"); each mesh has one colour.
std::string pbrt_text(const Scene& scene, const std::string& name);

}  // namespace meniscus::path_tracers
