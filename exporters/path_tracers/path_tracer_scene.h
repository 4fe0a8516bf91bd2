// SPDX-License-Identifier: BSD-3-Clause
// The content of a scene for a path tracer, independent of its format, and its text for Mitsuba 3 and for pbrt-v4.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/math/rigid_motion.h"

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
  std::vector<glm::vec3> normals;                       ///< of unit length, towards the solvent
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

  /// True if there is a single copy, which is not moved.
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

}  // namespace meniscus::path_tracers
