// SPDX-License-Identifier: BSD-3-Clause
// Computes bounds on the depths at which the rays of a block of pixels enter spheres. The bounds hold for every ray of
// the block.
//
// View coordinates have their origin at the eye, x right, y down, z forward, in Å. A depth is the distance along a ray
// from the eye (orthographic: from the plane through it). Pixels are counted from the middle of the picture.
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/tangent_slopes.glsl"
#include "gpu_shaders/shared/parameters.glsl"

layout(std140, binding = kViewBinding) uniform ViewBlock { View view; };

ivec2 tile_count() { return (view.picture_size + (kTileEdge - 1)) / kTileEdge; }

vec3 view_from_molecule(vec3 position) {
  vec3 v = position - view.eye;
  return vec3(dot(v, view.right), -dot(v, view.up), dot(v, view.forward));
}

// Returns the rectangle of pixels that a ball may touch, with one more pixel on each side: low corner, high corner,
// from the corner of the picture.
vec4 touched_pixels(vec3 v, float radius) {
  vec2 x = vec2(v.x - radius, v.x + radius);
  vec2 y = vec2(v.y - radius, v.y + radius);
  if (view.orthographic == 0u) {
    x = tangent_slopes(v.x, v.z, radius);
    y = tangent_slopes(v.y, v.z, radius);
  }
  vec4 range = vec4(x.x, y.x, x.y, y.y) / view.pixel_scale + vec4(-1.0, -1.0, 1.0, 1.0);
  vec2 size = vec2(view.picture_size);
  return clamp(range + 0.5 * size.xyxy, vec4(0.0), size.xyxy);
}

// A block of pixels, represented by the rays within `reach` pixels of `middle`.
struct RayBlock {
  vec2 middle;
  float reach;
};

RayBlock ray_block(ivec2 first_pixel, int edge) {
  return RayBlock(vec2(first_pixel) + 0.5 * (float(edge) - vec2(view.picture_size)), 0.70711 * float(edge));
}

// The distances of the rays of a block from a point.
struct Passing {
  float along;     // depth of the middle ray at its closest approach
  float distance;  // distance of the middle ray at its closest approach
  float spread;    // bound on the difference between the distances of other rays and that of the middle ray
};

// Returns the distances of the rays of a block from the point v. Two directions whose points on the plane at distance 1
// are e apart form an angle of at most e.
Passing pass_by(RayBlock block, vec3 v) {
  vec2 slope = block.middle * view.pixel_scale;
  if (view.orthographic != 0u) return Passing(v.z, length(v.xy - slope), block.reach * view.pixel_scale);
  vec3 d = normalize(vec3(slope, 1.0));
  float along = dot(v, d);
  return Passing(along, length(v - d * along), block.reach * view.pixel_scale * length(v));
}

float depth_on_sphere(vec3 v, float radius, float passing) {
  float half_chord = sqrt(max(radius * radius - passing * passing, 0.0));
  if (view.orthographic != 0u) return v.z - half_chord;
  return sqrt(max(dot(v, v) - passing * passing, 0.0)) - half_chord;
}

// Returns a depth before which no ray of the block enters the ball, or kNothing if none enters it.
float earliest_depth(RayBlock block, vec3 v, float radius) {
  Passing passing = pass_by(block, v);
  // For the angle a between the middle ray and v, sin(a - e) >= sin a (1 - e^2) - e.
  float e = view.orthographic != 0u ? 0.0 : block.reach * view.pixel_scale;
  float nearest = max(passing.distance * (1.0 - e * e) - passing.spread - view.margin, 0.0);
  return nearest < radius ? depth_on_sphere(v, radius, nearest) : kNothing;
}

// Returns a depth before which every ray of the block enters the ball, or kNothing if a ray may miss it or begin in it.
float latest_depth(RayBlock block, vec3 v, float radius) {
  Passing passing = pass_by(block, v);
  float farthest = passing.distance + passing.spread + view.margin;  // sin(a + e) <= sin a + e
  if (passing.along <= 0.0 || farthest >= radius) return kNothing;
  float depth = depth_on_sphere(v, radius, farthest) + view.margin;
  return depth > view.margin ? depth : kNothing;
}
