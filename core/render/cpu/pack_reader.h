// SPDX-License-Identifier: BSD-3-Clause
// Computes where packets of rays hit the primitives of a scene. Only lanes_*.cpp include it.
#pragma once

#include "core/render/cpu/lane_kernels.h"
#include "core/render/cpu/packet.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using ray_cast::Hit;
using ray_cast::kConcave;
using ray_cast::kConvex;
using ray_cast::kCylinder;
using ray_cast::kNoPrimitive;
using ray_cast::kToroidal;
using ray_cast::kTriangle;
using ray_cast::Primitive;

inline uint floatBitsToUint(float a) { return std::bit_cast<uint>(a); }

#include "gpu_shaders/geometry/patch_membership.glsl"
#include "gpu_shaders/geometry/ray_shapes.glsl"
#include "gpu_shaders/geometry/ray_torus.glsl"

/// Presents the scene to the shared sources.
struct PackReader {
  explicit PackReader(const LanePack& scene)
      : scene_(scene), params(scene.params), view(scene.view), some_hidden(scene.some_hidden) {}

  const vec4& row(uint index) const { return scene_.rows[index]; }
  const Primitive& load_primitive(uint index) const { return scene_.primitives[index]; }
  truth shows(natural atom) const {
    Ints result;
    for (int n = 0; n < kLanes; ++n) {
      const uint a = lane(atom, n);
      result[n] = a != kNoPrimitive && scene_.colors[a].w > 0.0f ? -1 : 0;
    }
    return result;
  }

  const LanePack& scene_;
  const kernel::RayCastParameters& params;
  kernel::BlockView view;
  const bool some_hidden;

#include "gpu_shaders/ray_cast/pixel_rays.glsl"
#include "gpu_shaders/ray_cast/patch_hits.glsl"
#include "gpu_shaders/ray_cast/studio_light.glsl"
#include "gpu_shaders/ray_cast/shade.glsl"
#include "gpu_shaders/ray_cast/shape_hits.glsl"

  /// Returns a point of a patch or of a shape.
  SurfacePoint point_of(const Primitive& primitive, const real3& p) {
    if (primitive.kind == kCylinder) return cylinder_point(primitive, p);
    if (primitive.kind == kTriangle) return triangle_point(primitive, p);
    return surface_point(primitive, p);
  }

  /// Returns the depth along the view axis, Å. Rays count from the pivot's plane; in a perspective, a ray is longer
  /// than its component along the axis.
  real depth_at(const real3& d, real t) const {
    const real along = view.orthographic != 0u ? t : t * dot(d, view.forward);
    return view.eye_distance + along;
  }
};

/// Rays, and their first hits.
class RayMeeter : protected PackReader {
 protected:
  using PackReader::PackReader;

  struct Rays {
    real3 p, d;
    real eye_t;
    real from;  // hits lie beyond it
    real t;
    natural primitive, kind, tie_key;
  };

  /// Updates each ray with the hit of a primitive that is nearer than its `t`.
  void meet(uint index, Rays* rays, int count) {
    const Primitive& primitive = load_primitive(index);
    if (primitive.kind == kToroidal) {
      const TorusPatch saddle = load_torus(index);
      for (int n = 0; n < count; ++n) meet_torus(index, saddle, rays[n]);
    } else if (primitive.kind == kCylinder) {
      for (int n = 0; n < count; ++n) meet_stick(index, primitive, rays[n]);
    } else if (primitive.kind == kTriangle) {
      for (int n = 0; n < count; ++n) meet_facet(index, primitive, rays[n]);
    } else {
      const vec4 center = row(primitive.first_row);
      for (int n = 0; n < count; ++n) meet_clipped_sphere(index, primitive, center, rays[n]);
    }
  }

  /// Keeps the nearer hit. If two hits are at the same distance, the choice does not depend on their order.
  static void keep_nearest(uint index, const Primitive& primitive, truth met, real t, Rays& rays) {
    const natural kind = primitive.kind, tie_key = primitive.tie_key;
    const truth tie_won = kind < rays.kind || (kind == rays.kind && tie_key < rays.tie_key);
    const truth wins = met && (t < rays.t || (t == rays.t && tie_won));
    rays.t = select(wins, t, rays.t);
    rays.primitive = select(wins, natural(index), rays.primitive);
    rays.kind = select(wins, kind, rays.kind);
    rays.tie_key = select(wins, tie_key, rays.tie_key);
  }

  truth on_patch(const Primitive& primitive, const real3& x, float radius, truth asked) {
    const uint first = primitive.first_row + 1u, end = first + primitive.plane_count;
    for (uint i = first; i < end; ++i) {
      const vec4& plane = row(i);
      asked = asked && in_half_space(x, vec3(plane), plane.w, params.slack);
      if (!some(asked)) return asked;
    }
    if (some_hidden) asked = asked && shows_sphere_point(primitive, x, radius);
    return asked;
  }

  void meet_clipped_sphere(uint index, const Primitive& primitive, const vec4& center, Rays& rays) {
    const SphereMeeting meeting = meet_sphere(center, rays.p, rays.d);
    if (!some(meeting.found)) return;
    truth found = meeting.found && meeting.near_t > rays.from && meeting.near_t <= rays.t;
    if (some(found)) {
      found = on_patch(primitive, meeting.near_point, center.w, found);
      keep_nearest(index, primitive, found, meeting.near_t, rays);
    }
    truth far_found = meeting.found && meeting.far_t > rays.from && !found && meeting.far_t <= rays.t;
    if (!some(far_found)) return;
    far_found = on_patch(primitive, meeting.far_point, center.w, far_found);
    keep_nearest(index, primitive, far_found, meeting.far_t, rays);
  }

  void meet_torus(uint index, const TorusPatch& saddle, Rays& rays) {
    LocalRay ray = to_saddle_ball(saddle, rays.p, rays.d);
    if (!some(goes_towards_torus(ray, rays.t))) return;
    clip_to_sweep(saddle, ray);
    ray.low = max(ray.low, rays.from - ray.shift);
    const truth towards = goes_towards_torus(ray, rays.t);
    if (!some(towards)) return;
    ray.high = select(towards, ray.high, ray.low);
    const real t = hit_torus(saddle, ray);
    keep_nearest(index, saddle.primitive, t < real(kMiss), t, rays);
  }

  static void meet_at(uint index, const Primitive& primitive, truth found, real t, Rays& rays) {
    keep_nearest(index, primitive, found && t > rays.from && t <= rays.t, t, rays);
  }

  void meet_stick(uint index, const Primitive& primitive, Rays& rays) {
    const CylinderMeeting meeting = meet_cylinder(primitive, rays.p, rays.d);
    meet_at(index, primitive, meeting.near_found, meeting.near_t, rays);
    meet_at(index, primitive, meeting.far_found, meeting.far_t, rays);
  }

  void meet_facet(uint index, const Primitive& primitive, Rays& rays) {
    const TriangleHit hit = meet_triangle(primitive, rays.p, rays.d);
    meet_at(index, primitive, hit.found, hit.t, rays);
  }

  static void put(const vec3& value, int n, real3& lanes) {
    lanes.x.v[n] = value.x;
    lanes.y.v[n] = value.y;
    lanes.z.v[n] = value.z;
  }
  static vec3 lane_of(const real3& a, int n) { return {lane(a.x, n), lane(a.y, n), lane(a.z, n)}; }
};

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
