// SPDX-License-Identifier: BSD-3-Clause
// Casts the rays of one tile through a layer: solids cut by planes, and all points of transparent parts. Only
// lanes_*.cpp include it.
#pragma once

#include "core/render/cpu/tile_caster.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

/// A bundle that collects points instead of colours.
class LayerBundle : Bundle {
 public:
  LayerBundle(const LanePack& scene, const LaneTile& tile, glm::ivec2 origin, const LayerTask& task, LayerHits& hits)
      : Bundle(scene, tile, origin), task_(task), hits_(hits) {
    for (int n = 0; n < packet_count_; ++n) bound(n);
  }

  void cast() {
    if (task_.all) {
      trace([this](uint index) { collect(index); });
      return;
    }
    trace([this](uint index) { meet(index, rays_, packet_count_); });
    for (int n = 0; n < packet_count_; ++n) {
      const Shaded shaded = shade_before_caps(n);
      add(n, shaded.met, rays_[n].t, rays_[n].primitive, {shaded.normal, shaded.atom},
          {shaded.color, shaded.visibility});
    }
  }

 private:
  /// Shades the points of a packet. Points behind caps need no light, because only their existence matters.
  Shaded shade_before_caps(int packet) {
    Shaded shaded = met_by(packet);
    const Rays& rays = rays_[packet];
    const truth behind_cap = task_.has_caps && rays.from > rays.eye_t && dot(shaded.normal, rays.d) > 0.0f;
    if (some(shaded.met && !behind_cap)) light(packet, shaded);
    return shaded;
  }

  /// A ray outside of the block.
  static constexpr uint kNoRay = ~0u;
  uint ray_of(int packet, int n) const {
    const int sample = packet / kPixelPackets, place = packet % kPixelPackets * kLanes + n;
    const int x = origin_.x + kPixelX[place], y = origin_.y + kPixelY[place];
    if (x >= view.size.x || y >= view.size.y) return kNoRay;
    return LaneTile::ray_number(sample, x - tile_.origin.x, y - tile_.origin.y);
  }

  /// Sets the intervals along its rays in which a packet searches for hits.
  void bound(int packet) {
    Rays& rays = rays_[packet];
    if (task_.plane_count > 0) clip(packet);
    for (int n = 0; n < kLanes; ++n) {
      const uint ray = ray_of(packet, n);
      if (ray == kNoRay)
        rays.t.v[n] = -kMiss;  // no hit is nearer
      else if (task_.farthest)
        rays.t.v[n] = task_.farthest[ray];
    }
  }

  void clip(int packet) {
    Rays& rays = rays_[packet];
    const KeptPart kept = kept_part(rays.p, rays.d, rays.eye_t);
    rays.from = kept.from;
    for (int n = 0; n < kLanes; ++n) {
      const uint ray = ray_of(packet, n);
      if (ray == kNoRay) continue;
      task_.clipped[ray] = {lane(kept.from, n), lane(kept.to, n), lane(kept.from_plane, n), lane(kept.to_plane, n)};
      if (lane(kept.to, n) <= lane(kept.from, n)) rays.t.v[n] = -kMiss;
    }
  }

  void collect(uint index) {
    const Primitive& primitive = load_primitive(index);
    for (int n = 0; n < packet_count_; ++n) {
      if (primitive.kind == kToroidal) {
        collect_torus(index, n);
      } else if (primitive.kind == kCylinder) {
        const CylinderMeeting meeting = meet_cylinder(primitive, rays_[n].p, rays_[n].d);
        collect_at(index, n, meeting.near_found, meeting.near_t);
        collect_at(index, n, meeting.far_found, meeting.far_t);
      } else if (primitive.kind == kTriangle) {
        const TriangleHit hit = meet_triangle(primitive, rays_[n].p, rays_[n].d);
        collect_at(index, n, hit.found, hit.t);
      } else {
        collect_sphere(index, n);
      }
    }
  }

  truth in_reach(const Rays& rays, real t) const { return t > rays.from && t <= rays.t; }

  void collect_sphere(uint index, int packet) {
    const Primitive& primitive = load_primitive(index);
    const Rays& rays = rays_[packet];
    const vec4& center = row(primitive.first_row);
    const SphereMeeting meeting = meet_sphere(center, rays.p, rays.d);
    if (!some(meeting.found)) return;
    const truth near = meeting.found && in_reach(rays, meeting.near_t);
    if (some(near)) collect_at(index, packet, on_patch(primitive, meeting.near_point, center.w, near), meeting.near_t);
    const truth far = meeting.found && in_reach(rays, meeting.far_t);
    if (some(far)) collect_at(index, packet, on_patch(primitive, meeting.far_point, center.w, far), meeting.far_t);
  }

  void collect_torus(uint index, int packet) {
    const TorusPatch saddle = load_torus(index);
    const Rays& rays = rays_[packet];
    LocalRay ray = to_torus(saddle, rays.p, rays.d);
    ray.low = max(ray.low, rays.from - ray.shift);
    const truth towards = goes_towards_torus(ray, rays.t);
    if (!some(towards)) return;
    ray.high = select(towards, ray.high, ray.low);
    TorusRuns runs = torus_runs(ray.o, ray.d, saddle.major, params.probe_radius, ray.low, ray.high);
    while (some(runs.waiting != 0)) {
      const real root = torus_run(ray.o, ray.d, saddle.major, params.probe_radius, 2e-7, kMiss, runs);
      const real3 x = ray.o + ray.d * root;
      collect_at(index, packet, root < real(kMiss) && on_toroidal_patch(saddle, x), root + ray.shift);
    }
  }

  void collect_at(uint index, int packet, truth found, real t) {
    const Rays& rays = rays_[packet];
    found = found && in_reach(rays, t);
    if (!some(found)) return;
    const Primitive& primitive = load_primitive(index);
    const real3 x = rays.p + rays.d * t;
    const SurfacePoint point = point_of(primitive, x);
    const real3 color = albedo(found, natural(primitive.kind), x, point);
    add(packet, found, t, natural(index), point, lit_at(color, {x, point.normal, rays.d, found}, sample_of(packet)));
  }

  void add(int packet, truth found, real t, natural primitive, const SurfacePoint& point, const Lighted& lighted) {
    const Rays& rays = rays_[packet];
    const real depth = depth_at(rays.d, t), facing = dot(point.normal, rays.d);
    for (uint left = bits(found); left != 0; left &= left - 1) {
      const int n = std::countr_zero(left);
      const uint ray = ray_of(packet, n);
      if (ray == kNoRay) continue;
      if (hits_.count == hits_.capacity) hits_.grow(hits_);
      LayerHit& hit = hits_.hits[hits_.count++];
      hit.t = lane(t, n);
      hit.ray = ray;
      hit.primitive = lane(primitive, n);
      hit.atom = lane(point.atom, n);
      hit.facing = lane(facing, n);
      hit.depth = lane(depth, n);
      hit.color = vec4(lane_of(lighted.color, n), task_.all ? opacity(hit.atom, lane(facing, n)) : 1.0f);
      hit.normal = lane_of(point.normal, n);
      hit.visibility = lane(lighted.visibility, n);
    }
  }

  float opacity(uint atom, float facing) {
    const float straight = scene_.colors[atom].w;
    if (!task_.thickens || straight >= 1.0f || straight <= 0.0f) return straight;
    return lane(film_opacity(straight, facing), 0);
  }

  int plane_count() const { return task_.plane_count; }
  const vec4& plane(int i) const { return task_.planes[i]; }
#include "gpu_shaders/ray_cast/layers.glsl"

  const LayerTask& task_;
  LayerHits& hits_;
};

inline void cast_layer(const LanePack& scene, const LaneTile& tile, const LayerTask& task, LayerHits& hits) {
  for_each_bundle(scene, tile, [&](glm::ivec2 origin) { LayerBundle(scene, tile, origin, task, hits).cast(); });
}

/// Lights points of a tile's rays, a packet of points at a time.
class PointLighter : LightedPack {
 public:
  PointLighter(const LanePack& scene, const LaneTile& tile)
      : LightedPack(scene), tile_(tile), first_offset_(scene.view.first_offset) {
    // The places contain both offsets: integers are added first, so that there is a single rounding, as for rays.
    view.first_offset = view.sample_offset = vec2(0.0f);
  }

  /// Returns the number of the tile's sample that has the point.
  static std::uint32_t sample_of(const LayerHit& point) { return point.ray / (kernel::kTileEdge * kernel::kTileEdge); }

  /// Lights points of one sample.
  void light(LayerHit* points, int count) {
    Floats x, y;
    real t;
    real3 normal, albedo;
    for (int n = 0; n < kLanes; ++n) {
      const LayerHit& point = points[n < count ? n : 0];
      const int in_tile = static_cast<int>(point.ray) % (kernel::kTileEdge * kernel::kTileEdge);
      const vec2 offset = tile_.offset[sample_of(point)];
      x[n] = first_offset_.x + static_cast<float>(tile_.origin.x + in_tile % kernel::kTileEdge) + offset.x;
      y[n] = first_offset_.y + static_cast<float>(tile_.origin.y + in_tile / kernel::kTileEdge) + offset.y;
      t.v[n] = point.t;
      put(point.normal, n, normal);
      put(vec3(point.color), n, albedo);
    }
    const real3 p = ray_point_at(real2(x, y)), d = ray_direction(p);
    const truth met = lane_numbers() < integer(count);
    const int sample = tile_.first_sample + static_cast<int>(sample_of(points[0]));
    const Lighted lighted = lit_at(albedo, {p + d * t, normal, d, met}, sample);
    const real depth = depth_at(d, t);
    for (int n = 0; n < count; ++n) {
      points[n].color = vec4(lane_of(lighted.color, n), points[n].color.w);
      points[n].visibility = lane(lighted.visibility, n);
      points[n].depth = lane(depth, n);
    }
  }

 private:
  const LaneTile& tile_;
  const vec2 first_offset_;
};

inline void light_points(const LanePack& scene, const LaneTile& tile, LayerHit* points, std::uint32_t count) {
  PointLighter lighter(scene, tile);
  for (std::uint32_t first = 0, end = 0; first < count; first = end) {
    const std::uint32_t sample = PointLighter::sample_of(points[first]);
    while (end < count && end - first < kLanes && PointLighter::sample_of(points[end]) == sample) ++end;
    lighter.light(points + first, static_cast<int>(end - first));
  }
}

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
