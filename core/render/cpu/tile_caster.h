// SPDX-License-Identifier: BSD-3-Clause
// Casts the rays of one tile in packets; included by lanes_*.cpp alone.
//
// Rays go in bundles of 4 x 4 pixels, with up to four samples of each: bounds are tried once for a bundle, a packet of
// them at a time, and what a patch's rows say is fetched once for all its rays. The bundle is the same for every width.
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

inline constexpr int kBundleEdge = 4;  // pixels
inline constexpr int kPixelPackets = kBundleEdge * kBundleEdge / kLanes;
inline constexpr int kMostPackets = kPixelPackets * LaneTile::kMostSamples;

// Places of a bundle's pixels, squares first: 2 x 2, 4 x 2, 4 x 4.
inline constexpr int kPixelX[16] = {0, 1, 0, 1, 2, 3, 2, 3, 0, 1, 0, 1, 2, 3, 2, 3};
inline constexpr int kPixelY[16] = {0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3};

/// The scene as the shared sources want to see it.
struct TracedScene {
  explicit TracedScene(const LaneScene& scene)
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

  const LaneScene& scene_;
  const kernel::RayCastParameters& params;
  kernel::BlockView view;
  const bool some_hidden;

#include "gpu_shaders/ray_cast/pixel_rays.glsl"
#include "gpu_shaders/ray_cast/touched_atom.glsl"
#include "gpu_shaders/ray_cast/patch_hits.glsl"
#include "gpu_shaders/ray_cast/sheen.glsl"
#include "gpu_shaders/ray_cast/shade.glsl"
#include "gpu_shaders/ray_cast/shape_hits.glsl"

  /// Of a patch or a shape.
  SurfacePoint point_of(const Primitive& primitive, const real3& p) {
    if (primitive.kind == kCylinder) return cylinder_point(primitive, p);
    if (primitive.kind == kTriangle) return triangle_point(primitive, p);
    return surface_point(primitive, p);
  }

  /// Along the view axis, Å. Rays count from the pivot's plane; a perspective one is longer than its part along the
  /// axis.
  real depth_at(const real3& d, real t) const {
    const real along = view.orthographic != 0u ? t : t * dot(d, view.forward);
    return view.eye_distance + along;
  }
};

/// The rays of a bundle and their nearest hits so far.
class Bundle : protected TracedScene {
 public:
  Bundle(const LaneScene& scene, const LaneTile& tile, glm::ivec2 origin)
      : TracedScene(scene), tile_(tile), origin_(origin), packet_count_(kPixelPackets * tile.sample_count) {
    aim();
  }

  void trace() {
    trace([this](uint index) { meet(index); });
  }

  void write() {
    for (int v = 0; v < kPixelPackets; ++v) {
      const Pixels to = pixels(v);
      real sums[4] = {0.0f, 0.0f, 0.0f, 0.0f};
      for (int s = 0; s < tile_.sample_count; ++s) {
        const int n = s * kPixelPackets + v;
        const Shaded shaded = shade(n);
        sums[0] += shaded.color.x;
        sums[1] += shaded.color.y;
        sums[2] += shaded.color.z;
        sums[3] += select(shaded.met, real(1.0f), real(0.0f));
        if (s == 0 && tile_.hits) write_hits(to, rays_[n], shaded);
        if (tile_.samples.color) write_sample(to, rays_[n], shaded);
      }
      if (tile_.sums) add_sums(to, sums);
    }
  }

 protected:
  struct Rays {
    real3 p, d;
    real eye_t;
    real from;  // hits lie beyond it
    real t;
    natural primitive, kind, tie_key;
  };

  struct Shaded {
    truth met;
    real3 color, normal;
    natural atom;
  };

  real2 place(int v) const {
    Floats x, y;
    for (int n = 0; n < kLanes; ++n) {
      x[n] = static_cast<float>(origin_.x + kPixelX[v * kLanes + n]);
      y[n] = static_cast<float>(origin_.y + kPixelY[v * kLanes + n]);
    }
    return {x, y};
  }

  void aim() {
    for (int s = 0; s < tile_.sample_count; ++s) {
      view.sample_offset = tile_.offset[s];
      for (int v = 0; v < kPixelPackets; ++v) {
        Rays& rays = rays_[s * kPixelPackets + v];
        rays.p = ray_point_at(place(v));
        rays.d = ray_direction(rays.p);
        rays.eye_t = rays.from = eye_parameter(rays.d);
        rays.t = kMiss;
        rays.primitive = rays.kind = rays.tie_key = kNoPrimitive;
      }
    }
    // Samples lie within half a pixel of a centre; a little more covers their rounding.
    view.sample_offset = vec2(0.0f);
    const real3 p = ray_point_at(vec2(origin_) + (0.5f * kBundleEdge - 0.5f));
    const real3 d = ray_direction(p);
    middle_ = vec3(lane(p.x, 0), lane(p.y, 0), lane(p.z, 0));
    middle_direction_ = vec3(lane(d.x, 0), lane(d.y, 0), lane(d.z, 0));
    middle_eye_ = lane(eye_parameter(d), 0);
    spread_ = 2.9f * view.pixel_size;
  }

  /// From the camera, of what may still be hidden.
  float farthest_distance() const {
    real farthest = rays_[0].t - rays_[0].eye_t;
    for (int n = 1; n < packet_count_; ++n) farthest = max(farthest, rays_[n].t - rays_[n].eye_t);
    return greatest(farthest);
  }
  float farthest_t() const {
    real farthest = rays_[0].t;
    for (int n = 1; n < packet_count_; ++n) farthest = max(farthest, rays_[n].t);
    return greatest(farthest);
  }

  /// Calls meet_primitive(index) for what may lie nearer than some ray's `t`.
  template <typename Meet>
  void trace(const Meet& meet_primitive) {
    const LaneList& list = tile_.list;
    for (int first = 0; first < list.count; first += kLanes) {
      const float farthest = farthest_distance();
      if (list.nearest[first] > farthest) return;  // as do all that follow
      const real3 center(load(list.x + first), load(list.y + first), load(list.z + first));
      const truth missed = misses_bound(center, load(list.radius + first), real3(middle_), real3(middle_direction_),
                                        middle_eye_, spread_, farthest_t());
      for (uint left = bits(!(missed || load(list.nearest + first) > farthest)); left != 0; left &= left - 1)
        meet_primitive(list.primitive[first + std::countr_zero(left)]);
    }
  }

  void meet(uint index) {
    const Primitive& primitive = load_primitive(index);
    if (primitive.kind == kToroidal) {
      const TorusPatch saddle = load_torus(index);
      for (int n = 0; n < packet_count_; ++n) meet_torus(index, saddle, rays_[n]);
    } else if (primitive.kind == kCylinder) {
      for (int n = 0; n < packet_count_; ++n) meet_stick(index, primitive, rays_[n]);
    } else if (primitive.kind == kTriangle) {
      for (int n = 0; n < packet_count_; ++n) meet_facet(index, primitive, rays_[n]);
    } else {
      const vec4 center = row(primitive.first_row);
      for (int n = 0; n < packet_count_; ++n) meet_clipped_sphere(index, primitive, center, rays_[n]);
    }
  }

  /// Keeps the nearer hit; of two at the same distance the same one in any order.
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
    LocalRay ray = to_torus(saddle, rays.p, rays.d);
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

  Shaded shade(int n) {
    const Rays& rays = rays_[n];
    const real3 x = rays.p + rays.d * rays.t;
    Shaded shaded;
    shaded.met = rays.primitive != natural(kNoPrimitive);
    shaded.normal = real3(0.0f);
    shaded.atom = kNoPrimitive;
    for (uint left = bits(shaded.met); left != 0;) {
      const uint index = lane(rays.primitive, std::countr_zero(left));
      const truth here = rays.primitive == natural(index);
      const SurfacePoint point = point_of(load_primitive(index), x);
      shaded.normal = select(here, point.normal, shaded.normal);
      shaded.atom = select(here, point.atom, shaded.atom);
      left &= ~bits(here);
    }
    shaded.color =
        select(shaded.met, lit(albedo(shaded.met, rays.kind, x, {shaded.normal, shaded.atom}), shaded.normal, rays.d),
               real3(0.0f));
    return shaded;
  }

  /// Of points on patches of these kinds.
  real3 albedo(truth met, natural kind, const real3& x, const SurfacePoint& point) const {
    return scene_.paint.map ? painted_albedo(met, x, point) : atom_albedo(met, kind, point.atom);
  }

  /// Where a volume map colours points.
  real3 painted_albedo(truth met, const real3& x, const SurfacePoint& point) const {
    real3 result(0.0f);
    for (uint left = bits(met); left != 0; left &= left - 1) {
      const int n = std::countr_zero(left);
      const uint atom = lane(point.atom, n);
      const vec3 seen = painted(scene_.paint, atom, scene_.colors[atom], lane_of(x, n), lane_of(point.normal, n));
      result.x.v[n] = seen.x;
      result.y.v[n] = seen.y;
      result.z.v[n] = seen.z;
    }
    return result;
  }

  real3 atom_albedo(truth met, natural kind, natural atom) const {
    real3 result(0.0f);
    for (uint left = bits(met); left != 0; left &= left - 1) {
      const int n = std::countr_zero(left);
      const vec4& color = scene_.colors[params.color_by_kind != 0u ? params.atom_count + lane(kind, n) : lane(atom, n)];
      result.x.v[n] = color.x;
      result.y.v[n] = color.y;
      result.z.v[n] = color.z;
    }
    return result;
  }

  /// Lanes of a packet whose pixels are in the block, and their places there.
  struct Pixels {
    int count = 0;
    int lane[kLanes];
    std::size_t at[kLanes];
  };

  Pixels pixels(int v) const {
    Pixels result;
    for (int n = 0; n < kLanes; ++n) {
      const int x = origin_.x + kPixelX[v * kLanes + n], y = origin_.y + kPixelY[v * kLanes + n];
      if (x >= view.size.x || y >= view.size.y) continue;
      result.lane[result.count] = n;
      result.at[result.count++] = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.x) + x;
    }
    return result;
  }

  static vec3 lane_of(const real3& a, int n) { return {lane(a.x, n), lane(a.y, n), lane(a.z, n)}; }

  void add_sums(const Pixels& to, const real (&sums)[4]) const {
    for (int i = 0; i < to.count; ++i) {
      const int n = to.lane[i];
      tile_.sums[to.at[i]] += vec4(lane(sums[0], n), lane(sums[1], n), lane(sums[2], n), lane(sums[3], n));
    }
  }

  void write_hits(const Pixels& to, const Rays& rays, const Shaded& shaded) const {
    for (int i = 0; i < to.count; ++i) {
      const int n = to.lane[i];
      tile_.hits[to.at[i]] = {
          lane_of(shaded.normal, n), lane(rays.t, n), lane(rays.primitive, n), lane(shaded.atom, n), 0u, 0u};
    }
  }

  void write_sample(const Pixels& to, const Rays& rays, const Shaded& shaded) const {
    const real depth = select(shaded.met, depth_at(rays.d, rays.t), real(kernel::kNothing));
    const real alpha = select(shaded.met, real(1.0f), real(0.0f));
    const LaneSamples& samples = tile_.samples;
    for (int i = 0; i < to.count; ++i) {
      const int n = to.lane[i];
      const std::size_t at = to.at[i];
      samples.color[at] = vec4(lane_of(shaded.color, n), lane(alpha, n));
      samples.depth[at] = lane(depth, n);
      samples.normal[0][at] = lane(shaded.normal.x, n);
      samples.normal[1][at] = lane(shaded.normal.y, n);
      samples.normal[2][at] = lane(shaded.normal.z, n);
      if (samples.part) samples.part[at] = lane(alpha, n) > 0.0f ? scene_.parts[lane(shaded.atom, n)] : 0.0f;
    }
  }

  const LaneTile& tile_;
  const glm::ivec2 origin_;  // in the block, pixels
  const int packet_count_;
  vec3 middle_, middle_direction_;
  float middle_eye_, spread_;
  Rays rays_[kMostPackets];
};

/// Calls work(origin) for each bundle of a tile.
template <typename Work>
void for_each_bundle(const LaneScene& scene, const LaneTile& tile, const Work& work) {
  const glm::ivec2 end = {
      scene.view.size.x < tile.origin.x + kernel::kTileEdge ? scene.view.size.x : tile.origin.x + kernel::kTileEdge,
      scene.view.size.y < tile.origin.y + kernel::kTileEdge ? scene.view.size.y : tile.origin.y + kernel::kTileEdge};
  for (int y = tile.origin.y; y < end.y; y += kBundleEdge)
    for (int x = tile.origin.x; x < end.x; x += kBundleEdge) work(glm::ivec2(x, y));
}

inline void cast_tile(const LaneScene& scene, const LaneTile& tile) {
  for_each_bundle(scene, tile, [&](glm::ivec2 origin) {
    Bundle bundle(scene, tile, origin);
    bundle.trace();
    bundle.write();
  });
}

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
