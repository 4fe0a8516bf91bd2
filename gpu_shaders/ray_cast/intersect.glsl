// SPDX-License-Identifier: BSD-3-Clause
// Nearest points of one primitive on the four rays of an invocation.
//
// Four rays share each fetch of a primitive's rows: on software GL fetching costs more than all arithmetic. Both sides
// of a patch count, because a camera may stand inside the solid. Each ray is moved to its closest approach first:
// there the numbers are as small as the primitive, and single precision is good to about 1e-6 Å.
// What a ray hits of a primitive depends on nothing but the two, to the bit: not on the hits so far, nor on the order
// in which primitives come. Pictures of more or fewer hidden primitives are therefore the same.

struct Rays {
  vec3 p[4];  // on the plane through the pivot
  vec3 d[4];  // unit length
};

// Nearest hits so far.
struct Nearest {
  vec4 t;
  uvec4 primitive;
};

// True if no point p + t*d with t < high of any ray within `spread` (Å, at the pivot, growing as the rays spread) of
// this one is in the sphere. This is where most candidates end.
bool misses_bound(vec4 bound, vec3 p, vec3 d, float eye_t, float spread, float high) {
  vec3 to_bound = p - bound.xyz;
  float bound_t = -dot(to_bound, d);
  vec3 closest = to_bound + d * bound_t;
  // At the far end of the sphere neighbouring rays are farthest from this one.
  float widest = orthographic != 0u ? spread : spread * max((bound_t + bound.w - eye_t) / -eye_t, 0.0);
  float reach = bound.w + widest;
  float room = reach * reach - dot(closest, closest);
  return room < 0.0 || bound_t - sqrt(room) > high;
}

// Keeps the nearer hit; of two at the same distance the same one in any order.
void keep_nearest(uint index, Primitive primitive, int k, float t, inout Nearest nearest) {
  if (t > nearest.t[k]) return;
  if (t == nearest.t[k]) {
    Primitive other = load_primitive(nearest.primitive[k]);
    if (other.kind < primitive.kind || (other.kind == primitive.kind && other.tie_key <= primitive.tie_key)) return;
  }
  nearest.t[k] = t;
  nearest.primitive[k] = index;
}

void hit_clipped_sphere(uint index, Primitive primitive, Rays rays, inout Nearest nearest) {
  vec4 place = row(primitive.first_row);
  vec3 near_x[4];
  vec3 far_x[4];
  vec4 near_t;
  vec4 far_t;
  bvec4 near_in;
  bvec4 far_in;
  for (int k = 0; k < 4; ++k) {
    vec3 o = rays.p[k] - place.xyz;
    float shift = -dot(o, rays.d[k]);
    o += rays.d[k] * shift;
    SphereHits hits = ray_sphere(o, rays.d[k], place.w);
    near_x[k] = o + rays.d[k] * hits.near_t;
    far_x[k] = o + rays.d[k] * hits.far_t;
    near_t[k] = hits.near_t + shift;
    far_t[k] = hits.far_t + shift;
    float low = eye_parameter(rays.d[k]);
    near_in[k] = hits.found && near_t[k] > low && near_t[k] <= nearest.t[k];
    far_in[k] = hits.found && far_t[k] > low && far_t[k] <= nearest.t[k];
  }
  uint end = primitive.first_row + 1u + primitive.plane_count;
  for (uint i = primitive.first_row + 1u; i < end && (any(near_in) || any(far_in)); ++i) {
    vec4 plane = row(i);
    for (int k = 0; k < 4; ++k) {
      near_in[k] = near_in[k] && in_half_space(near_x[k], plane.xyz, plane.w, slack);
      far_in[k] = far_in[k] && in_half_space(far_x[k], plane.xyz, plane.w, slack);
    }
  }
  for (int k = 0; k < 4; ++k) {
    near_in[k] = near_in[k] && shows_sphere_point(primitive, near_x[k], place.w);
    far_in[k] = far_in[k] && shows_sphere_point(primitive, far_x[k], place.w);
    if (near_in[k] || far_in[k]) keep_nearest(index, primitive, k, near_in[k] ? near_t[k] : far_t[k], nearest);
  }
}

const float kMiss = 3.0e38;

// One ray in the torus's own frame; kMiss if it misses. Hits beyond `high` may be left out.
float hit_torus_patch(Primitive primitive, vec3 o, vec3 d, float major, vec4 shape, float cos_sweep, float sin_sweep,
                      float low, float high) {
  int range = int(primitive.plane_count);
  // The sphere through both contact circles holds the whole patch and nothing of the outer half of the torus.
  SphereHits chord = ray_sphere(o - vec3(0.0, 0.0, shape.z), d, shape.w + slack);
  if (!chord.found) return kMiss;
  low = max(low, chord.near_t - slack);
  float end = chord.far_t + slack;
  if (range == kUpToHalfTurn) {
    clip_to_half_space(-o.y - slack, -d.y, low, end);
    clip_to_half_space(o.y * cos_sweep - o.x * sin_sweep - slack, d.y * cos_sweep - d.x * sin_sweep, low, end);
  }
  // Roots are bracketed by the patch alone: `high` would leave its mark on their last bits.
  if (!(low < end) || low > high) return kMiss;
  TorusHits hits = ray_torus(o, d, major, probe_radius, low, end, 2e-7);
  for (int i = 0; i < hits.count; ++i) {
    vec3 x = o + d * hits.t[i];
    if (in_toroidal_patch(x, major, shape.x, shape.y, cos_sweep, sin_sweep, range, slack) &&
        shows_torus_point(primitive, x, major))
      return hits.t[i];
  }
  return kMiss;
}

void hit_toroidal(uint index, Primitive primitive, inout Nearest nearest) {
  vec4 place = row(primitive.first_row);
  vec4 x_axis = row(primitive.first_row + 1u);
  vec4 z_axis = row(primitive.first_row + 2u);
  vec4 shape = row(primitive.first_row + 3u);
  vec3 y_axis = cross(z_axis.xyz, x_axis.xyz);
  for (int k = 0; k < 4; ++k) {
    vec3 p = ray_point(k);
    vec3 d = ray_direction(p);
    vec3 o = p - place.xyz;
    float shift = -dot(o, d);
    o += d * shift;
    vec3 local_o = vec3(dot(o, x_axis.xyz), dot(o, y_axis), dot(o, z_axis.xyz));
    vec3 local_d = vec3(dot(d, x_axis.xyz), dot(d, y_axis), dot(d, z_axis.xyz));
    // A little more than to the nearest hit, for the rounding of the sum below.
    float high = nearest.t[k] - shift + slack;
    float t = hit_torus_patch(primitive, local_o, local_d, place.w, shape, x_axis.w, z_axis.w,
                              eye_parameter(d) - shift, high);
    if (t < kMiss) keep_nearest(index, primitive, k, t + shift, nearest);
  }
}
