// SPDX-License-Identifier: BSD-3-Clause
// Packs a bound and rows for each shape; every number is computed in double and rounded once.
#include "core/render/ray_cast_pack.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/color/coloring.h"
#include "core/render/ray_geometry.h"
#include "core/shapes/shapes.h"

namespace meniscus {
namespace {

using ray_cast::Primitive;

class ShapePacker {
 public:
  ShapePacker(const Coloring& coloring, const PictureFrame& frame, RayCastPack& scene)
      : coloring_(coloring), frame_(frame), scene_(scene) {}

  void pack(const SphereShape& sphere) {
    Primitive* const primitive = begin({sphere.center, sphere.radius}, ray_cast::kConvex);
    if (!primitive || !coloring_.shows(sphere.atom)) return drop(primitive);
    primitive->atom = sphere.atom;
    add_row(sphere.center - frame_.pivot, sphere.radius);
  }

  void pack(const CylinderShape& cylinder) {
    const glm::dvec3 middle = 0.5 * (cylinder.from + cylinder.to);
    const double half = 0.5 * glm::length(cylinder.to - cylinder.from);
    Primitive* const primitive = begin({middle, std::hypot(half, cylinder.radius)}, ray_cast::kCylinder);
    if (!primitive || (!coloring_.shows(cylinder.from_atom) && !coloring_.shows(cylinder.to_atom)))
      return drop(primitive);
    primitive->atom = cylinder.from_atom;
    primitive->second_atom = cylinder.to_atom;
    add_row(middle - frame_.pivot, cylinder.radius);
    add_row(glm::normalize(cylinder.to - cylinder.from), half);
  }

  void pack(const MeshShape& mesh, const std::array<std::uint32_t, 3>& corners) {
    const glm::dvec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]], c = mesh.positions[corners[2]];
    const glm::dvec3 middle = (a + b + c) / 3.0;
    const double reach = std::max({glm::length(a - middle), glm::length(b - middle), glm::length(c - middle)});
    Primitive* const primitive = begin({middle, reach}, ray_cast::kTriangle);
    if (!primitive || std::ranges::none_of(corners, [&](std::uint32_t v) { return coloring_.shows(mesh.atoms[v]); }))
      return drop(primitive);
    primitive->atom = mesh.atoms[corners[0]];
    add_row(a - frame_.pivot, 0.0);
    add_row(b - a, 0.0);
    add_row(c - a, 0.0);
    for (const std::uint32_t v : corners)
      scene_.rows.emplace_back(mesh.normals[v], std::bit_cast<float>(mesh.atoms[v]));
  }

 private:
  void add_row(const glm::dvec3& v, double w) { scene_.rows.emplace_back(glm::vec3(v), static_cast<float>(w)); }

  /// Begins a primitive. Returns nullptr if the whole bound is behind the camera.
  Primitive* begin(const geometry::PatchBound& bound, std::uint32_t kind) {
    const geometry::SeenBound seen =
        geometry::see_bound(bound, scene_.slack, frame_.pivot, frame_.camera.position, frame_.basis.forward,
                            frame_.eye_distance, frame_.camera.projection == Projection::orthographic);
    if (!seen.in_front) return nullptr;
    Primitive& primitive = scene_.primitives.emplace_back();
    primitive.bound = glm::vec4(glm::vec3(seen.center), static_cast<float>(seen.radius));
    primitive.nearest = static_cast<float>(seen.nearest);
    primitive.first_row = static_cast<std::uint32_t>(scene_.rows.size());
    primitive.kind = kind;
    primitive.patch_index = primitive.tie_key = static_cast<std::uint32_t>(scene_.primitives.size() - 1);
    return &primitive;
  }

  void drop(const Primitive* primitive) {
    if (primitive) scene_.primitives.pop_back();
  }

  const Coloring& coloring_;
  const PictureFrame& frame_;
  RayCastPack& scene_;
};

}  // namespace

void pack_shapes(const Shapes& shapes, const Coloring& coloring, const PictureFrame& frame, float slack,
                 RayCastPack& scene) {
  scene.slack = slack;
  scene.primitives.clear();
  scene.rows.clear();
  ShapePacker packer(coloring, frame, scene);
  for (const SphereShape& sphere : shapes.spheres) packer.pack(sphere);
  for (const CylinderShape& cylinder : shapes.cylinders) packer.pack(cylinder);
  for (const std::array<std::uint32_t, 3>& corners : shapes.mesh.triangles) packer.pack(shapes.mesh, corners);
}

}  // namespace meniscus
