// SPDX-License-Identifier: BSD-3-Clause
// How much of the sky each hit sees over what else the picture shows: ground-truth ambient occlusion (Jimenez, Wu,
// Pesce & Jarabo 2016), the visible arc of each slice in closed form.
//
// Each pixel looks along a few directions only, which differ within blocks of 4 x 4 pixels in a fixed pattern
// (interleaved sampling, Keller & Heidrich 2001); finish.glsl averages over such blocks, and nothing of it stays.
// Horizons are those of the whole picture: one map of its depths serves all blocks, and shade reaches as far in a large
// picture as in a small one at the same cost.
// GLSL and, as the body of a struct, C++: see view_space.glsl. The includer provides `occlusion` of OcclusionParameters
// and map_depth_or_nothing() of a texel of the map, which may lie outside.

const int kSliceCount = 2;
const float kPi = 3.14159265;

// Places of 0 to 15 in a block such that each row, column and quarter has small and large ones (Bayer 1973).
GEOMETRY integer pattern(integer2 pixel) {
  integer x = (pixel.x ^ pixel.y) & 3;
  return (x & 1) << 3 | (pixel.y & 1) << 2 | (x & 2) | (pixel.y & 2) >> 1;
}

// What is some pixels on from a pixel at `from`: where it is seen, in pixels from the picture's middle, and its depth.
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

// How far it is looked, in pixels.
struct Steps {
  real ways[kStepCount];
};

// Closer steps near by, where small clefts are.
GEOMETRY Steps steps_within(real reach, real offset) {
  Steps steps;
  for (int k = 0; k < kStepCount; ++k) {
    real share = (float(k) + offset) / float(kStepCount);
    steps.ways[k] = max(share * share * reach, float(k) + 1.0);
  }
  return steps;
}

// Cosine of the horizon, seen from p, on the way along `direction`, at least `lowest`; in the picture's axes. range: Å.
GEOMETRY real horizon(pixel_row pixel, real3 p, real3 to_viewer, real2 direction, Steps steps, real range, real lowest) {
  // All are fetched first: each takes its time, but they do not wait for each other.
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
    // What is far away shades less and less; a step at the radius would show as a rim.
    real weight = clamp((1.0 - distance / range) / 0.6, 0.0, 1.0);
    real cosine = mix(lowest, dot(to_other, to_viewer) / max(distance, 1e-6), weight);
    highest = select(depth != real(kNothing), max(highest, cosine), highest);
  }
  return highest;
}

// The cosine-weighted arc between the viewer's direction and the horizon at angle h, both in a slice where the normal
// is at angle n.
GEOMETRY real arc(real h, real n) { return 0.25 * (cos(n) + 2.0 * h * sin(n) - cos(2.0 * h - n)); }

// How far around a hit at this depth is looked for what hides the sky, in pixels.
GEOMETRY real shade_reach(real depth) {
  return min(occlusion.radius / pixel_size_at(depth), occlusion.longest_reach);
}

// Of a pixel whose ray met something, at this depth.
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
