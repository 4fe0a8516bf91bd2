// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest points of one primitive on the four rays of an invocation.
//
// Four rays share each fetch of a primitive's rows, because on software GL fetching costs more than all arithmetic.
// Both sides of a patch count, because the camera may be inside the solid.

struct Rays {
  vec3 p[4];  // points on the plane through the pivot
  vec3 d[4];  // unit length
};

// The nearest hits so far, with the values that decide between two hits at one distance.
struct Nearest {
  vec4 t;
  uvec4 primitive;
  uvec4 kind;
  uvec4 tie_key;
};

// Keeps the nearer hit. If two hits are at the same distance, the choice does not depend on their order.
void keep_nearest(uint index, Primitive primitive, int k, float t, inout Nearest nearest) {
  bool tie_won = primitive.kind < nearest.kind[k] ||
                 (primitive.kind == nearest.kind[k] && primitive.tie_key < nearest.tie_key[k]);
  if (t < nearest.t[k] || (t == nearest.t[k] && tie_won)) {
    nearest.t[k] = t;
    nearest.primitive[k] = index;
    nearest.kind[k] = primitive.kind;
    nearest.tie_key[k] = primitive.tie_key;
  }
}

// Returns which of the four points x are on the patch. x: points relative to the patch's centre; tested: true for each
// point to test.
bvec4 on_clipped_sphere(Primitive primitive, vec3 x[4], float radius, bvec4 tested) {
  uint end = primitive.first_row + 1u + primitive.plane_count;
  for (uint i = primitive.first_row + 1u; i < end && any(tested); ++i) {
    vec4 plane = row(i);
    for (int k = 0; k < 4; ++k) tested[k] = tested[k] && in_half_space(x[k], plane.xyz, plane.w, params.slack);
  }
  for (int k = 0; k < 4; ++k) tested[k] = tested[k] && shows_sphere_point(primitive, x[k], radius);
  return tested;
}

void hit_clipped_sphere(uint index, Primitive primitive, Rays rays, inout Nearest nearest) {
  vec4 place = row(primitive.first_row);
  vec3 x[4];
  vec3 far_x[4];
  vec4 t;
  vec4 far_t;
  bvec4 found;
  bvec4 far_found;
  for (int k = 0; k < 4; ++k) {
    SphereMeeting meeting = meet_sphere(place, rays.p[k], rays.d[k]);
    float low = eye_parameter(rays.d[k]);
    x[k] = meeting.near_point;
    far_x[k] = meeting.far_point;
    t[k] = meeting.near_t;
    far_t[k] = meeting.far_t;
    found[k] = meeting.found && t[k] > low && t[k] <= nearest.t[k];
    far_found[k] = meeting.found && far_t[k] > low;
  }
  found = on_clipped_sphere(primitive, x, place.w, found);
  for (int k = 0; k < 4; ++k) {
    if (found[k]) keep_nearest(index, primitive, k, t[k], nearest);
    far_found[k] = far_found[k] && !found[k] && far_t[k] <= nearest.t[k];
  }
  far_found = on_clipped_sphere(primitive, far_x, place.w, far_found);
  for (int k = 0; k < 4; ++k)
    if (far_found[k]) keep_nearest(index, primitive, k, far_t[k], nearest);
}

// Returns the bits of the rays that may meet torus `index` before their nearest hits so far.
uint rays_towards_torus(uint index, Nearest nearest) {
  TorusPatch saddle = load_torus(index);
  uint rays = 0u;
  for (int k = 0; k < 4; ++k) {
    vec3 p = ray_point(k);
    if (goes_towards_torus(to_torus(saddle, p, ray_direction(p)), nearest.t[k])) rays |= 1u << k;
  }
  return rays;
}

void hit_toroidal(uint index, int k, inout Nearest nearest) {
  TorusPatch saddle = load_torus(index);
  vec3 p = ray_point(k);
  float t = hit_torus(saddle, to_torus(saddle, p, ray_direction(p)));
  if (t < kMiss) keep_nearest(index, saddle.primitive, k, t, nearest);
}
