// SPDX-License-Identifier: BSD-3-Clause
// A surface packed for the ray caster: each patch is one primitive with a tight bound, in single precision relative to
// a pivot.
#pragma once

#include "core/camera/camera.h"
#include "core/render/gpu_pack.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct Coloring;
struct RigidMotion;
struct Shapes;

/// The geometry of a picture, in double precision. The pivot lies on the view axis, close to the surface in the middle
/// of the picture.
struct PictureFrame {
  Camera camera;
  ViewBasis basis;
  glm::ivec2 size{0};         ///< pixels
  glm::dvec3 pivot{0.0};      ///< Å
  double eye_distance = 0.0;  ///< distance from the camera's position to the pivot, Å
  double pixel_size = 0.0;    ///< size of a pixel in the plane through the pivot, Å
};

/// A group of balls, possibly moved, so that copies need not be in memory at the same time.
struct BallGroup {
  std::span<const Ball> balls;
  const RigidMotion* motion = nullptr;  ///< nullptr: not moved
  glm::dvec3 center{0.0};               ///< centre of a ball around all of them, after the motion, Å
  double radius = std::numeric_limits<double>::infinity();
};

/// Returns the geometry of a picture. Throws nothing; the camera must be valid. Groups of balls give exactly the result
/// of a list of all their balls.
PictureFrame make_picture_frame(std::span<const Ball> atoms, const Camera& camera, glm::ivec2 size);
PictureFrame make_picture_frame(std::span<const BallGroup> groups, const Camera& camera, glm::ivec2 size);

/// Returns the overlap of patches that this picture needs, Å: a few times the rounding error of the largest coordinate.
float patch_slack(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame);

PackPlacement place_atoms(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame);
PackPlacement place_atoms(std::span<const BallGroup> groups, double probe_radius, const PictureFrame& frame);

/// The data that the kernel reads. Primitives are sorted by kind and index; primitives behind the camera are left out.
struct RayCastPack {
  std::vector<ray_cast::Primitive> primitives;
  std::vector<glm::vec4> rows;
  float slack = 0.0f;  ///< patch_slack()
};

/// Packs a surface. Patches that touch hidden atoms only are left out. scene: the result, whose memory is reused from
/// picture to picture.
void pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, RayCastPack& scene);
RayCastPack pack_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame);

/// A patch that may be visible, and a ball around it.
struct BoundedPatch {
  PatchKind kind = PatchKind::convex;
  std::uint32_t index = 0;
  glm::dvec3 center{0.0};  ///< Å
  double radius = 0.0;
};

/// Returns the patches that pack_scene() packs, by kind and index.
std::vector<BoundedPatch> bounded_patches(const Surface& surface, const Coloring& coloring);

/// A copy of a surface, one of several in a picture.
struct PackedCopy {
  const Surface& surface;
  const Coloring& coloring;
  const RigidMotion& motion;
  float slack;               ///< patch_slack() of all copies together
  std::uint32_t first_atom;  ///< index of its first atom among the atoms of all copies
};

/// Packs some of the copy's patches as pack_scene() packs the surface at its place, on one thread. Only tie keys count
/// from first_atom; indices of atoms are those that the surface has.
RayCastPack pack_patches(const PackedCopy& copy, std::span<const BoundedPatch> patches, const PictureFrame& frame);

/// Packs spheres as convex patches without planes, and all other shapes. Indices of atoms are the shapes' indices;
/// hidden atoms are left out. slack: patch_slack() of the picture.
void pack_shapes(const Shapes& shapes, const Coloring& coloring, const PictureFrame& frame, float slack,
                 RayCastPack& scene);

/// Returns GpuPack::colors: linear light for each atom, alpha: opacity (0: hidden); then, if coloured by kind, for
/// three kinds.
std::vector<glm::vec4> linear_colors(const Coloring& coloring);

/// Returns the number of rows that a primitive has, from its first one on.
std::uint32_t row_count(const ray_cast::Primitive& primitive);

}  // namespace meniscus
