// SPDX-License-Identifier: BSD-3-Clause
// Computes the share of the sky that each hit sees above the other points of the picture: ground-truth ambient
// occlusion (Jimenez, Wu, Pesce & Jarabo 2016), with the visible arc of each slice in closed form.
//
// Each pixel uses a few directions only, which differ within blocks of 4 x 4 pixels in a fixed pattern (interleaved
// sampling, Keller & Heidrich 2001). finish.glsl averages over such blocks, so that the pattern disappears. Horizons
// are those of the whole picture: one map of its depths serves all blocks, and shade extends as far in a large picture
// as in a small one at the same cost. Written in GLSL and, as the body of a struct, in C++ (view_space.glsl). The
// includer provides `occlusion` of OcclusionParameters, and map_depth_or_nothing() of a texel, which may be outside of
// the map.

const int kSliceCount = 2;
const float kPi = 3.14159265;

// Returns a number from 0 to 15 for a pixel in a block, such that each row, column and quarter of the block has small
// and large numbers (Bayer 1973).
GEOMETRY integer pattern(integer2 pixel) {
  integer x = (pixel.x ^ pixel.y) & 3;
  return (x & 1) << 3 | (pixel.y & 1) << 2 | (x & 2) | (pixel.y & 2) >> 1;
}

// Returns the possible occluder at an offset of `way` pixels from a pixel at `from`: its place in pixels from the
// middle of the picture, and its depth.
GEOMETRY real3 occluder_at(pixel_row pixel, real2 from, real2 way, float texels, vec2 middle) {
  real2 texel = round((from + way) * texels + middle);
  real2 place = (texel - middle) * occlusion.texel_edge;
  real3 occluder = real3(place.x, place.y, map_depth_or_nothing(integer2(texel)));
  if (texels == 1.0) return occluder;
  truth is_near = length(way) < occlusion.near_reach;
  if (!some(is_near)) return occluder;
  integer2 other = pixel + integer2(round(way));
  place = place_of(other);
  return select(is_near, real3(place.x, place.y, depth_or_nothing(other)), occluder);
}

// The distances of the samples along a direction, in pixels.
struct Steps {
  real ways[kStepCount];
};

// Returns distances of samples up to `reach` pixels. They are denser near the pixel, to resolve small clefts.
GEOMETRY Steps steps_within(real reach, real offset) {
  Steps steps;
  for (int k = 0; k < kStepCount; ++k) {
    real share = (float(k) + offset) / float(kStepCount);
    steps.ways[k] = max(share * share * reach, float(k) + 1.0);
  }
  return steps;
}

// Returns the cosine of the horizon angle seen from p along `direction`, at least `lowest`, in the picture's axes.
// range: the distance beyond which nothing occludes, Å.
GEOMETRY real horizon(pixel_row pixel, real3 p, real3 to_viewer, real2 direction, Steps steps, real range, real lowest) {
  // All samples are fetched first, so that their latencies overlap.
  real3 occluder[kStepCount];
  real2 from = real2(place_of(pixel));
  float texels = 1.0 / occlusion.texel_edge;
  vec2 middle = occlusion.map_middle;
  for (int k = 0; k < kStepCount; ++k)
    occluder[k] = occluder_at(pixel, from, direction * steps.ways[k], texels, middle);
  real highest = lowest;
  for (int k = 0; k < kStepCount; ++k) {
    real depth = occluder[k].z;
    real3 to_other = seen_at(real2(occluder[k].x, occluder[k].y), depth, pixel_size_at(depth)) - p;
    real distance = length(to_other);
    // Occlusion decreases with distance, because a step at the radius would be visible as a rim.
    real weight = clamp((1.0 - distance / range) / 0.6, 0.0, 1.0);
    real cosine = mix(lowest, dot(to_other, to_viewer) / max(distance, 1e-6), weight);
    highest = select(depth != real(kNothing), max(highest, cosine), highest);
  }
  return highest;
}

// Returns the cosine-weighted arc between the viewer's direction and the horizon at angle h, in a slice where the
// normal is at angle n.
GEOMETRY real arc(real h, real n) { return 0.25 * (cos(n) + 2.0 * h * sin(n) - cos(2.0 * h - n)); }

// Returns the radius in pixels around a hit at this depth in which occluders are searched.
GEOMETRY real shade_reach(real depth) {
  return min(occlusion.radius / pixel_size_at(depth), occlusion.longest_reach);
}

// Returns the visibility of the sky, from 0 to 1, for a pixel with a hit at this depth.
GEOMETRY real sky_visibility(pixel_row pixel, real depth) {
  real3 p = position_at(pixel, depth);
  real3 to_viewer = to_viewer_at(p);
  real3 normal = facing(hit_normal_at(pixel), to_viewer);
  real reach = shade_reach(depth);
  real range = reach * pixel_size_at(depth);
  integer place = (pattern(pixel) + 5 * int(occlusion.sample_index)) & 15;
  real seen = real(0.0);
  real open = real(0.0);  // what it would see alone
  for (int s = 0; s < kSliceCount; ++s) {
    real angle = (float(s) + (real(place) + 0.5) / 16.0) * (kPi / float(kSliceCount));
    real3 direction = real3(cos(angle), sin(angle), 0.0);
    real3 in_slice = direction - to_viewer * dot(direction, to_viewer);
    real3 axis = normalize(cross(in_slice, to_viewer));
    real3 projected = normal - axis * dot(normal, axis);
    real length_projected = length(projected);
    real n = acos(clamp(dot(projected, to_viewer) / length_projected, -1.0, 1.0));
    n = select(dot(in_slice, projected) < 0.0, -n, n);
    real offset = (real((place * 7 + s * 5) & 15) + 0.5) / 16.0;
    real2 on_picture = real2(direction.x, -direction.y);
    real3 seen_from = turned_over(p);
    real3 seen_viewer = turned_over(to_viewer);
    Steps steps = steps_within(reach, offset);
    real ahead = horizon(pixel, seen_from, seen_viewer, on_picture, steps, range, cos(n + 0.5 * kPi));
    real behind = horizon(pixel, seen_from, seen_viewer, -on_picture, steps, range, cos(n - 0.5 * kPi));
    real slice_seen = length_projected * (arc(acos(clamp(ahead, -1.0, 1.0)), n) + arc(-acos(clamp(behind, -1.0, 1.0)), n));
    real slice_open = length_projected * (cos(n) + n * sin(n));
    truth counts = length_projected >= 1e-4;
    seen = select(counts, seen + slice_seen, seen);
    open = select(counts, open + slice_open, open);
  }
  return select(reach < 1.0, real(1.0), clamp(seen / max(open, 1e-6), 0.0, 1.0));
}
