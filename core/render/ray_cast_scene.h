// SPDX-License-Identifier: BSD-3-Clause
// A surface packed for the ray caster: each patch as one primitive with a tight bound, in single precision around a
// pivot.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/camera/camera.h"
#include "core/render/gpu_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct Coloring;
struct RigidMotion;
struct Shapes;

/// The picture's geometry, in double. The pivot lies on the view axis, close to what the middle of the picture shows.
struct PictureFrame {
  Camera camera;
  ViewBasis basis;
  glm::ivec2 size{0};         ///< pixels
  glm::dvec3 pivot{0.0};      ///< Å
  double eye_distance = 0.0;  ///< from the camera's position to the pivot, Å
  double pixel_size = 0.0;    ///< on the plane through the pivot, Å
};

/// Balls that are together, as they are or moved: so that copies need not be in memory all at once.
struct BallGroup {
  std::span<const Ball> balls;
  const RigidMotion* motion = nullptr;  ///< nullptr: as they are
  glm::dvec3 center{0.0};               ///< of a ball around all of them where they are, Å
  double radius = std::numeric_limits<double>::infinity();
};

/// Throws nothing; the camera must be valid. The groups together give what a list of all their balls gives, to the bit.
PictureFrame make_picture_frame(std::span<const Ball> atoms, const Camera& camera, glm::ivec2 size);
PictureFrame make_picture_frame(std::span<const BallGroup> groups, const Camera& camera, glm::ivec2 size);

/// Å by which patches must overlap in this picture: a few roundings of the largest coordinate.
float patch_slack(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame);

ScenePlacement place_atoms(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame);
ScenePlacement place_atoms(std::span<const BallGroup> groups, double probe_radius, const PictureFrame& frame);

/// What the kernel reads. Primitives are by kind and index; those behind the camera are left out.
struct RayCastScene {
  std::vector<ray_cast::Primitive> primitives;
  std::vector<glm::vec4> rows;
  float slack = 0.0f;  ///< patch_slack()
};

/// Patches that touch hidden atoms only are left out. scene: gets all, and keeps its memory from picture to picture.
void pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, RayCastScene& scene);
RayCastScene pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame);

/// A patch that may show, and a ball around it.
struct BoundedPatch {
  PatchKind kind = PatchKind::convex;
  std::uint32_t index = 0;
  glm::dvec3 center{0.0};  ///< Å
  double radius = 0.0;
};

/// Those that pack_scene() takes, by kind and index.
std::vector<BoundedPatch> bounded_patches(const Surface& surface, const Coloring& coloring);

/// A copy of a surface as one of several in a picture.
struct PackedCopy {
  const Surface& surface;
  const Coloring& coloring;
  const RigidMotion& motion;
  float slack;               ///< of all of them
  std::uint32_t first_atom;  ///< its first atom's number among those of all
};

/// Some of its patches, as pack_scene() packs the surface where it is, on one thread. Only tie keys count from
/// first_atom, indices of atoms stay the surface's own.
RayCastScene pack_patches(const PackedCopy& copy, std::span<const BoundedPatch> patches, const PictureFrame& frame);

/// Packs spheres as convex patches without planes, and all other shapes. Indices of atoms are those of the shapes;
/// hidden ones are left out. slack: patch_slack() of the picture.
void pack_shapes(const Shapes& shapes, const Coloring& coloring, const PictureFrame& frame, float slack,
                 RayCastScene& scene);

/// Returns GpuScene::colors: linear light for each atom, alpha: opacity (0: hidden); then, if by kind, for three kinds.
std::vector<glm::vec4> linear_colors(const Coloring& coloring);

/// Rows that a primitive has from its first one on.
std::uint32_t row_count(const ray_cast::Primitive& primitive);

}  // namespace meniscus
