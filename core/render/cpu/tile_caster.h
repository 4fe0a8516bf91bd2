// SPDX-License-Identifier: BSD-3-Clause
// Casts the rays of one tile in packets. Only lanes_*.cpp include it.
//
// Rays are in bundles of 4 x 4 pixels, with up to four samples of each. Bounds are tested once per bundle, a packet of
// them at a time, and the rows of a patch are read once for all its rays. The bundle is the same for every width.
#pragma once

#include "core/render/cpu/shadow_rays.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

inline constexpr int kPixelPackets = kBundleEdge * kBundleEdge / kLanes;
inline constexpr int kMostPackets = kPixelPackets * LaneTile::kMostSamples;

inline constexpr int kPacketRows = kLanes / kBundleEdge;

// The places of a bundle's pixels, row by row, which is the order of pictures.
inline constexpr int kPixelX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
inline constexpr int kPixelY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

/// The rays of a bundle and their nearest hits so far.
class Bundle : protected LightedPack {
 public:
  Bundle(const LanePack& scene, const LaneTile& tile, glm::ivec2 origin)
      : LightedPack(scene), tile_(tile), origin_(origin), packet_count_(kPixelPackets * tile.sample_count) {
    aim();
  }

  void trace() {
    trace([this](uint index) { meet(index, rays_, packet_count_); });
  }

  void write() {
    for (int v = 0; v < kPixelPackets; ++v) {
      real4 sums{0.0f, 0.0f, 0.0f, 0.0f};
      for (int s = 0; s < tile_.sample_count; ++s) {
        const int n = s * kPixelPackets + v;
        const Shaded shaded = shade(n);
        const real alpha = select(shaded.met, real(1.0f), real(0.0f));
        sums = sums + real4{shaded.color.x, shaded.color.y, shaded.color.z, alpha};
        if (s == 0 && tile_.hits) write_hits(v, rays_[n], shaded);
        if (tile_.samples.color) write_sample(v, rays_[n], shaded, alpha);
      }
      if (tile_.sums) add_sums(v, sums);
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
    // Samples lie within half a pixel of a centre, and slightly more covers their rounding.
    view.sample_offset = vec2(0.0f);
    const real3 p = ray_point_at(vec2(origin_) + (0.5f * kBundleEdge - 0.5f));
    const real3 d = ray_direction(p);
    middle_ = vec3(lane(p.x, 0), lane(p.y, 0), lane(p.z, 0));
    middle_direction_ = vec3(lane(d.x, 0), lane(d.y, 0), lane(d.z, 0));
    middle_eye_ = lane(eye_parameter(d), 0);
    spread_ = 2.9f * view.pixel_size;
  }

  /// Returns the distance from the camera beyond which everything is hidden.
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

  /// Calls meet_primitive(index) for primitives that may be nearer than the `t` of some ray.
  template <typename Meet>
  void trace(const Meet& meet_primitive) {
    const LaneList& list = tile_.list;
    for (int first = 0; first < list.count; first += kLanes) {
      const float farthest = farthest_distance();
      if (list.nearest[first] > farthest) return;  // all primitives after it are farther, too
      const real3 center(load(list.x + first), load(list.y + first), load(list.z + first));
      const truth missed = misses_bound(center, load(list.radius + first), real3(middle_), real3(middle_direction_),
                                        middle_eye_, spread_, farthest_t());
      for (uint left = bits(!(missed || load(list.nearest + first) > farthest)); left != 0; left &= left - 1)
        meet_primitive(list.primitive[first + std::countr_zero(left)]);
    }
  }

  /// Returns the number of a packet's sample among all samples of the pixels.
  int sample_of(int packet) const { return tile_.first_sample + packet / kPixelPackets; }

  Shaded shade(int n) {
    Shaded shaded = met_by(n);
    if (some(shaded.met)) light(n, shaded);
    return shaded;
  }

  /// Returns the hits of a packet without light.
  Shaded met_by(int n) {
    const Rays& rays = rays_[n];
    const real3 x = rays.p + rays.d * rays.t;
    Shaded shaded;
    shaded.met = rays.primitive != natural(kNoPrimitive);
    shaded.normal = real3(0.0f);
    shaded.atom = kNoPrimitive;
    shaded.color = real3(0.0f);
    shaded.visibility = 1.0f;
    if (!some(shaded.met)) return shaded;
    for (uint left = bits(shaded.met); left != 0;) {
      const uint index = lane(rays.primitive, std::countr_zero(left));
      const truth here = rays.primitive == natural(index);
      const SurfacePoint point = point_of(load_primitive(index), x);
      shaded.normal = select(here, point.normal, shaded.normal);
      shaded.atom = select(here, point.atom, shaded.atom);
      left &= ~bits(here);
    }
    return shaded;
  }

  void light(int n, Shaded& shaded) {
    const Rays& rays = rays_[n];
    const real3 x = rays.p + rays.d * rays.t;
    const real3 color = albedo(shaded.met, rays.kind, x, {shaded.normal, shaded.atom});
    const Lighted lighted = lit_at(color, {x, shaded.normal, rays.d, shaded.met}, sample_of(n));
    shaded.color = select(shaded.met, lighted.color, real3(0.0f));
    shaded.visibility = lighted.visibility;
  }

  /// Returns the colours of points on patches of these kinds.
  real3 albedo(truth met, natural kind, const real3& x, const SurfacePoint& point) const {
    return scene_.paint.map ? painted_albedo(met, x, point) : atom_albedo(met, kind, point.atom);
  }

  /// Returns the colours of points where a volume map colours them.
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
    const natural color = params.color_by_kind != 0u ? natural(params.atom_count) + kind : atom;
    const integer at = integer(Ints(select(met, color, natural(0u)).v)) << 2;
    const float* const colors = &scene_.colors[0].x;
    return select(met, real3(gather(colors, at), gather(colors + 1, at), gather(colors + 2, at)), real3(0.0f));
  }

  bool is_in_block() const { return origin_.x + kBundleEdge <= view.size.x && origin_.y + kBundleEdge <= view.size.y; }
  std::size_t place_in_block(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.x) + static_cast<std::size_t>(x);
  }
  /// Returns the place of a packet's first pixel in the block.
  std::size_t place_in_block(int v) const { return place_in_block(origin_.x, origin_.y + v * kPacketRows); }

  /// Calls write(lane, place) for the pixels of a packet that are in the block.
  template <typename Write>
  void for_each_pixel(int v, const Write& write) const {
    for (int n = 0; n < kLanes; ++n) {
      const int x = origin_.x + kPixelX[v * kLanes + n], y = origin_.y + kPixelY[v * kLanes + n];
      if (x < view.size.x && y < view.size.y) write(n, place_in_block(x, y));
    }
  }

  void put_pixels(real a, int v, float* values) const {
    if (!is_in_block()) return for_each_pixel(v, [&](int n, std::size_t at) { values[at] = lane(a, n); });
    float lanes[kLanes];
    store(a, lanes);
    for (int row = 0; row < kPacketRows; ++row)
      __builtin_memcpy(values + place_in_block(v) + static_cast<std::size_t>(row) * view.size.x,
                       lanes + row * kBundleEdge, kBundleEdge * sizeof(float));
  }

  void put_pixels(const real4& a, int v, vec4* values) const {
    if (is_in_block()) return store(a, values + place_in_block(v), view.size.x);
    for_each_pixel(
        v, [&](int n, std::size_t at) { values[at] = vec4(lane(a.x, n), lane(a.y, n), lane(a.z, n), lane(a.w, n)); });
  }

  void add_sums(int v, const real4& sums) const {
    if (is_in_block()) {
      vec4* const first = tile_.sums + place_in_block(v);
      return store(load(first, view.size.x) + sums, first, view.size.x);
    }
    for_each_pixel(v, [&](int n, std::size_t at) {
      tile_.sums[at] += vec4(lane(sums.x, n), lane(sums.y, n), lane(sums.z, n), lane(sums.w, n));
    });
  }

  void write_hits(int v, const Rays& rays, const Shaded& shaded) const {
    for_each_pixel(v, [&](int n, std::size_t at) {
      tile_.hits[at] = {
          lane_of(shaded.normal, n), lane(rays.t, n), lane(rays.primitive, n), lane(shaded.atom, n), 0u, 0u};
    });
  }

  void write_sample(int v, const Rays& rays, const Shaded& shaded, real alpha) const {
    const LaneSamples& samples = tile_.samples;
    put_pixels(real4{shaded.color.x, shaded.color.y, shaded.color.z, alpha}, v, samples.color);
    put_pixels(select(shaded.met, depth_at(rays.d, rays.t), real(kernel::kNothing)), v, samples.depth);
    put_pixels(shaded.normal.x, v, samples.normal[0]);
    put_pixels(shaded.normal.y, v, samples.normal[1]);
    put_pixels(shaded.normal.z, v, samples.normal[2]);
    if (samples.visibility) put_pixels(shaded.visibility, v, samples.visibility);
    if (!samples.mark) return;
    real mark(0.0f);
    if (some(shaded.met)) mark = gather(scene_.marks, integer(Ints(select(shaded.met, shaded.atom, natural(0u)).v)));
    put_pixels(select(shaded.met, mark, real(0.0f)), v, samples.mark);
  }

  const LaneTile& tile_;
  const glm::ivec2 origin_;  // place in the block, pixels
  const int packet_count_;
  vec3 middle_, middle_direction_;
  float middle_eye_, spread_;
  Rays rays_[kMostPackets];
};

/// Calls work(origin) for each bundle of a tile whose pixels count.
template <typename Work>
void for_each_bundle(const LanePack& scene, const LaneTile& tile, const Work& work) {
  const glm::ivec2 end = {
      scene.view.size.x < tile.origin.x + kernel::kTileEdge ? scene.view.size.x : tile.origin.x + kernel::kTileEdge,
      scene.view.size.y < tile.origin.y + kernel::kTileEdge ? scene.view.size.y : tile.origin.y + kernel::kTileEdge};
  for (int y = tile.origin.y; y < end.y; y += kBundleEdge)
    for (int x = tile.origin.x; x < end.x; x += kBundleEdge)
      if (!tile.counts || tile.counts[static_cast<std::size_t>(y) * scene.view.size.x + x] != 0.0f)
        work(glm::ivec2(x, y));
}

inline void cast_tile(const LanePack& scene, const LaneTile& tile) {
  for_each_bundle(scene, tile, [&](glm::ivec2 origin) {
    Bundle bundle(scene, tile, origin);
    bundle.trace();
    bundle.write();
  });
}

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
