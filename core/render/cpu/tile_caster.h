// SPDX-License-Identifier: BSD-3-Clause
// Casts the rays of one tile in packets; included by lanes_*.cpp alone.
//
// Rays go in bundles of 4 x 4 pixels, with up to four samples of each: bounds are tried once for a bundle, a packet of
// them at a time, and what a patch's rows say is fetched once for all its rays. The bundle is the same for every width.
#pragma once

#include "core/render/cpu/shadow_rays.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

inline constexpr int kBundleEdge = 4;  // pixels
inline constexpr int kPixelPackets = kBundleEdge * kBundleEdge / kLanes;
inline constexpr int kMostPackets = kPixelPackets * LaneTile::kMostSamples;

// Places of a bundle's pixels, squares first: 2 x 2, 4 x 2, 4 x 4.
inline constexpr int kPixelX[16] = {0, 1, 0, 1, 2, 3, 2, 3, 0, 1, 0, 1, 2, 3, 2, 3};
inline constexpr int kPixelY[16] = {0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3};

/// The rays of a bundle and their nearest hits so far.
class Bundle : protected LightedScene {
 public:
  Bundle(const LaneScene& scene, const LaneTile& tile, glm::ivec2 origin)
      : LightedScene(scene), tile_(tile), origin_(origin), packet_count_(kPixelPackets * tile.sample_count) {
    aim();
  }

  void trace() {
    trace([this](uint index) { meet(index, rays_, packet_count_); });
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
  struct Shaded {
    truth met;
    real3 color, normal;
    natural atom;
    real visibility;
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

  /// Of a packet, among all that the pixels get.
  int sample_of(int packet) const { return tile_.first_sample + packet / kPixelPackets; }

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
    const real3 color = albedo(shaded.met, rays.kind, x, {shaded.normal, shaded.atom});
    const Lighted lighted = lit_at(color, {x, shaded.normal, rays.d, shaded.met}, sample_of(n));
    shaded.color = select(shaded.met, lighted.color, real3(0.0f));
    shaded.visibility = lighted.visibility;
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
      if (samples.visibility) samples.visibility[at] = lane(shaded.visibility, n);
      samples.normal[0][at] = lane(shaded.normal.x, n);
      samples.normal[1][at] = lane(shaded.normal.y, n);
      samples.normal[2][at] = lane(shaded.normal.z, n);
      if (samples.mark) samples.mark[at] = lane(alpha, n) > 0.0f ? scene_.marks[lane(shaded.atom, n)] : 0.0f;
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
