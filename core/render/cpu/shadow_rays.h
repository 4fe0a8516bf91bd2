// SPDX-License-Identifier: BSD-3-Clause
// Casts rays from points of surfaces towards the lamp and the sky (Appel 1968). Only lanes_*.cpp include it.
//
// All rays of a packet have one direction, which is the same for every point of a picture: the visibility of a point
// depends on the point alone, and is constant in a film. Rays traverse a tree of boxes (Rubin & Whitted 1980).
#pragma once

#include "core/render/cpu/pack_reader.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

/// Tests packets of rays against one object.
class OccluderRays : RayMeeter {
 public:
  explicit OccluderRays(const LaneOccluder& occluder) : RayMeeter(occluder.scene), occluder_(occluder) {}

  /// Returns which of the given rays (`asked`) hit something opaque before `reach`, Å.
  truth block(const real3& from, const vec3& direction, float reach, truth asked) {
    if (!occluder_.boxes) return truth(false);
    Rays rays;
    const glm::mat3& turn = occluder_.turn;
    vec3 d = turn * direction;
    for (int axis = 0; axis < 3; ++axis) d[axis] = d[axis] == 0.0f ? 1e-9f : d[axis];  // boxes are entered by division
    rays.p = turn[0] * from.x + turn[1] * from.y + turn[2] * from.z + occluder_.shift;
    rays.d = real3(d);
    rays.eye_t = rays.from = 0.0f;
    const real3 inverse = real3(1.0f / d.x, 1.0f / d.y, 1.0f / d.z);
    return occluder_.is_opaque && occluder_.plane_count == 0 ? block_any(rays, inverse, reach, asked)
                                                             : block_first(rays, inverse, reach, asked);
  }

 private:
  static constexpr int kDeepest = 64;

  static truth enters(const OccluderBox& box, const Rays& rays, const real3& inverse) {
    const real3 a = (real3(box.low) - rays.p) * inverse, b = (real3(box.high) - rays.p) * inverse;
    const real in = max(max(min(a.x, b.x), min(a.y, b.y)), max(min(a.z, b.z), rays.from));
    const real out = min(min(max(a.x, b.x), max(a.y, b.y)), min(max(a.z, b.z), rays.t));
    return in <= out;
  }

  /// Calls visit(index) for primitives that may be nearer than the `t` of some ray, until it returns false.
  template <typename Visit>
  void visit_near(const Rays& rays, const real3& inverse, const Visit& visit) {
    constexpr float kRoom = 1e-3f;  // Å, for rounding: the result must not depend on which rays share a packet
    std::uint32_t waiting[kDeepest];
    int waiting_count = 0;
    for (std::uint32_t at = 0;;) {
      const OccluderBox& box = occluder_.boxes[at];
      if (some(enters(box, rays, inverse))) {
        if (box.count == 0) {
          waiting[waiting_count++] = box.first;
          ++at;
          continue;
        }
        for (std::uint32_t n = box.first; n < box.first + box.count; ++n) {
          const uint index = occluder_.order[n];
          const vec4& bound = load_primitive(index).bound;
          const truth missed =
              misses_bound(real3(vec3(bound)), real(bound.w), rays.p, rays.d, real(0.0f), real(kRoom), rays.t);
          if (some(!missed) && !visit(index)) return;
        }
      }
      if (waiting_count == 0) return;
      at = waiting[--waiting_count];
    }
  }

  truth block_any(Rays& rays, const real3& inverse, float reach, truth asked) {
    rays.primitive = rays.kind = rays.tie_key = kNoPrimitive;
    rays.t = select(asked, real(reach), real(-kMiss));
    visit_near(rays, inverse, [&](uint index) {
      meet(index, &rays, 1);
      rays.t = select(rays.primitive != natural(kNoPrimitive), real(-kMiss), rays.t);
      return some(rays.t > real(0.0f));
    });
    return rays.primitive != natural(kNoPrimitive);
  }

  /// Returns the same for objects with cuts or with some transparent atoms. A ray that leaves a solid has been inside
  /// it, from the plane on through which it entered.
  truth block_first(Rays& rays, const real3& inverse, float reach, truth asked) {
    constexpr int kMostTries = 64;  // transparent atoms one after the other
    real in(0.0f), out(kMiss);
    for (int i = 0; i < occluder_.plane_count; ++i) {
      const vec4& plane = occluder_.planes[i];
      const real room = plane.w - dot(rays.p, vec3(plane)), slope = dot(rays.d, vec3(plane));
      const real t = room / slope;
      in = select(slope < 0.0f && t > in, t, in);
      out = select(slope > 0.0f && t < out, t, out);
      out = select(slope == 0.0f && room <= 0.0f, real(-kMiss), out);
    }
    rays.from = in;
    truth blocked(false), going = asked && in < out && in < real(reach);
    const truth cut = occluder_.is_solid && occluder_.plane_count > 0;
    for (int n = 0; n < kMostTries && some(going); ++n) {
      rays.primitive = rays.kind = rays.tie_key = kNoPrimitive;
      rays.t = select(going, real(kMiss), real(-kMiss));
      visit_near(rays, inverse, [&](uint index) {
        meet(index, &rays, 1);
        return true;
      });
      const truth met = rays.primitive != natural(kNoPrimitive);
      const Met surface = met_at(rays, met);
      const truth comes_out = cut && surface.facing > 0.0f;
      const real at = select(comes_out, select(in > 0.0f, in, min(rays.t, out)), rays.t);
      blocked = blocked || (met && surface.opaque && at < real(reach) && (comes_out || rays.t < out));
      going = met && !surface.opaque && rays.t < out && rays.t < real(reach);
      rays.from = select(going, rays.t + params.slack, rays.from);
    }
    return blocked;
  }

  struct Met {
    truth opaque;
    real facing;  // above 0: the ray leaves the solid
  };

  Met met_at(const Rays& rays, truth met) {
    const real3 x = rays.p + rays.d * rays.t;
    Met result{truth(false), real(0.0f)};
    for (uint left = bits(met); left != 0;) {
      const uint index = lane(rays.primitive, std::countr_zero(left));
      const truth here = rays.primitive == natural(index);
      const SurfacePoint point = point_of(load_primitive(index), x);
      result.facing = select(here, dot(point.normal, rays.d), result.facing);
      for (uint some_left = bits(here); some_left != 0; some_left &= some_left - 1) {
        const int n = std::countr_zero(some_left);
        result.opaque.v[n] = scene_.colors[lane(point.atom, n)].w >= 1.0f ? -1 : 0;
      }
      left &= ~bits(here);
    }
    return result;
  }

  const LaneOccluder& occluder_;
};

/// Points where rays of these directions hit.
struct SeenPoints {
  real3 x, normal, d;
  truth met;
};

/// A scene in the light that its occluders let pass.
class LightedPack : protected RayMeeter {
 protected:
  using RayMeeter::RayMeeter;

  struct Lighted {
    real3 color;
    real visibility;
  };

  /// Returns the light of points. sample: the number among all samples of a pixel.
  Lighted lit_at(const real3& albedo, const SeenPoints& points, int sample) {
    const real3 n = shown_normal(points.normal, points.d);
    KeyLight key = open_key_light(n);
    Lighted lighted{real3(0.0f), real(1.0f)};
    if (scene_.light && some(points.met)) {
      const real3 outward = select(dot(points.normal, points.d) > 0.0f, -points.normal, points.normal);
      const real3 from = points.x + outward * scene_.light->lift;
      cast_shadows(from, outward, points.met, sample, key);
      if (scene_.light->sky_rays > 0) lighted.visibility = sky_seen(from, outward, points.met, sample);
    }
    lighted.color = studio_light(albedo, n, -in_camera_axes(points.d), key);
    return lighted;
  }

  /// Returns the visible share of the hemisphere, weighted by the cosine (Zhukov, Iones & Kronin 1998).
  real sky_seen(const real3& from, const real3& outward, truth met, int sample) const {
    const LaneLight& light = *scene_.light;
    real seen(0.0f), all(1e-6f);
    for (int n = 0; n < light.sky_rays; ++n) {
      const vec3& direction = light.sky[sample * light.sky_rays + n];
      const real cosine = dot(outward, direction);
      const truth asked = met && cosine > 0.0f;
      if (!some(asked)) continue;
      const truth open = asked && !blocked(from, direction, light.sky_reach, asked);
      seen += select(open, cosine, real(0.0f));
      all += select(asked, cosine, real(0.0f));
    }
    return seen / all;
  }

 private:
  truth blocked(const real3& from, const vec3& direction, float reach, truth asked) const {
    truth result(false);
    for (int n = 0; n < scene_.light->occluder_count && some(asked); ++n) {
      const truth here = OccluderRays(scene_.light->occluders[n]).block(from, direction, reach, asked);
      result = result || here;
      asked = asked && !here;
    }
    return result;
  }

  /// Darkens the key light where occluders hide the lamp. Diffuse light is the visible share of the lamp, weighted by
  /// the cosine of the angle between its direction and the normal.
  void cast_shadows(const real3& from, const real3& outward, truth met, int sample, KeyLight& key) const {
    const LaneLight& light = *scene_.light;
    if (light.lamp_rays == 0) return;
    real diffuse(0.0f), open(0.0f);
    for (int n = 0; n < light.lamp_rays; ++n) {
      const vec3& direction = light.lamp[sample * light.lamp_rays + n];
      const real cosine = dot(outward, direction);
      const truth asked = met && cosine > 0.0f;
      const truth seen = asked && !blocked(from, direction, kMiss, asked);
      diffuse += select(seen, cosine, real(0.0f));
      open += select(seen, real(1.0f), real(0.0f));
    }
    const float share = 1.0f / static_cast<float>(light.lamp_rays);
    key.diffuse = mix(key.diffuse, diffuse * share, real(light.shadow));
    key.open = mix(real(1.0f), open * share, real(light.shadow));
  }
};

/// Computes the visibility of the sky for points that are not in a picture.
class SkyWatcher : LightedPack {
 public:
  explicit SkyWatcher(const LanePack& scene) : LightedPack(scene) {}

  void watch(const vec3* points, const vec3* normals, float* seen, int count) const {
    Floats lanes[6] = {};
    for (int n = 0; n < kLanes; ++n)
      for (int axis = 0; axis < 3; ++axis) {
        lanes[axis][n] = points[n < count ? n : 0][axis];
        lanes[3 + axis][n] = normals[n < count ? n : 0][axis];
      }
    const real3 x(lanes[0], lanes[1], lanes[2]), outward(lanes[3], lanes[4], lanes[5]);
    const real result = sky_seen(x + outward * scene_.light->lift, outward, lane_numbers() < integer(count), 0);
    for (int n = 0; n < count; ++n) seen[n] = lane(result, n);
  }
};

inline void see_sky(const LaneLight& light, const glm::vec3* points, const glm::vec3* normals, float* seen,
                    std::uint32_t count) {
  LanePack scene;
  scene.light = &light;
  const SkyWatcher watcher(scene);
  for (std::uint32_t first = 0; first < count; first += kLanes)
    watcher.watch(points + first, normals + first, seen + first,
                  count - first < kLanes ? static_cast<int>(count - first) : kLanes);
}

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
