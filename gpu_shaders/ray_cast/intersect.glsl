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

// Nearest hits so far, and what decides between two at one distance.
struct Nearest {
  vec4 t;
  uvec4 primitive;
  uvec4 kind;
  uvec4 tie_key;
};

// True if no point p + t*d with t < high of any ray within `spread` (Å, at the pivot, growing as the rays spread) of
// this one is in the sphere. This is where most candidates end.
bool misses_bound(vec4 bound, vec3 p, vec3 d, float eye_t, float spread, float high) {
  vec3 to_bound = p - bound.xyz;
  float bound_t = -dot(to_bound, d);
  vec3 closest = to_bound + d * bound_t;
  // At the far end of the sphere neighbouring rays are farthest from this one.
  float widest = view.orthographic != 0u ? spread : spread * max((bound_t + bound.w - eye_t) / -eye_t, 0.0);
  float reach = bound.w + widest;
  float room = reach * reach - dot(closest, closest);
  return room < 0.0 || bound_t - sqrt(room) > high;
}

// Keeps the nearer hit; of two at the same distance the same one in any order.
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

// Which of the four points x, relative to the patch's centre, are on the patch; asks only where `asked`.
bvec4 on_clipped_sphere(Primitive primitive, vec3 x[4], float radius, bvec4 asked) {
  uint end = primitive.first_row + 1u + primitive.plane_count;
  for (uint i = primitive.first_row + 1u; i < end && any(asked); ++i) {
    vec4 plane = row(i);
    for (int k = 0; k < 4; ++k) asked[k] = asked[k] && in_half_space(x[k], plane.xyz, plane.w, params.slack);
  }
  for (int k = 0; k < 4; ++k) asked[k] = asked[k] && shows_sphere_point(primitive, x[k], radius);
  return asked;
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
    vec3 o = rays.p[k] - place.xyz;
    float shift = -dot(o, rays.d[k]);
    o += rays.d[k] * shift;
    SphereHits hits = ray_sphere(o, rays.d[k], place.w);
    float low = eye_parameter(rays.d[k]);
    x[k] = o + rays.d[k] * hits.near_t;
    far_x[k] = o + rays.d[k] * hits.far_t;
    t[k] = hits.near_t + shift;
    far_t[k] = hits.far_t + shift;
    found[k] = hits.found && t[k] > low && t[k] <= nearest.t[k];
    far_found[k] = hits.found && far_t[k] > low;
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

const float kMiss = 3.0e38;

// A toroidal patch, as its rows say.
struct TorusPatch {
  Primitive primitive;
  vec3 center;
  vec3 x_axis;
  vec3 y_axis;
  vec3 z_axis;
  float major;
  float cos_sweep;
  float sin_sweep;
  vec4 shape;  // z_low, z_high, clip z, clip radius
};

TorusPatch load_torus(uint index) {
  TorusPatch saddle;
  saddle.primitive = load_primitive(index);
  vec4 place = row(saddle.primitive.first_row);
  vec4 x_axis = row(saddle.primitive.first_row + 1u);
  vec4 z_axis = row(saddle.primitive.first_row + 2u);
  saddle.shape = row(saddle.primitive.first_row + 3u);
  saddle.center = place.xyz;
  saddle.major = place.w;
  saddle.x_axis = x_axis.xyz;
  saddle.cos_sweep = x_axis.w;
  saddle.z_axis = z_axis.xyz;
  saddle.sin_sweep = z_axis.w;
  saddle.y_axis = cross(z_axis.xyz, x_axis.xyz);
  return saddle;
}

// A ray in a torus's own frame, from its closest approach on, which is `shift` along it; the patch may only be met from
// `low` to `high`, and not at all if low >= high.
struct LocalRay {
  vec3 o;
  vec3 d;
  float shift;
  float low;
  float high;
};

LocalRay to_torus(TorusPatch saddle, int k) {
  LocalRay ray;
  vec3 p = ray_point(k);
  vec3 d = ray_direction(p);
  vec3 o = p - saddle.center;
  ray.shift = -dot(o, d);
  o += d * ray.shift;
  ray.o = vec3(dot(o, saddle.x_axis), dot(o, saddle.y_axis), dot(o, saddle.z_axis));
  ray.d = vec3(dot(d, saddle.x_axis), dot(d, saddle.y_axis), dot(d, saddle.z_axis));
  // The sphere through both contact circles holds the whole patch and nothing of the outer half of the torus.
  SphereHits chord = ray_sphere(ray.o - vec3(0.0, 0.0, saddle.shape.z), ray.d, saddle.shape.w + params.slack);
  ray.low = max(eye_parameter(d) - ray.shift, chord.near_t - params.slack);
  ray.high = chord.far_t + params.slack;
  if (saddle.primitive.plane_count == uint(kUpToHalfTurn)) {
    clip_to_half_space(-ray.o.y - params.slack, -ray.d.y, ray.low, ray.high);
    clip_to_half_space(ray.o.y * saddle.cos_sweep - ray.o.x * saddle.sin_sweep - params.slack,
                       ray.d.y * saddle.cos_sweep - ray.d.x * saddle.sin_sweep, ray.low, ray.high);
  }
  if (!chord.found) ray.high = ray.low;
  return ray;
}

// Bits of the rays that may meet torus `index` before their hits so far.
uint rays_towards_torus(uint index, Nearest nearest) {
  TorusPatch saddle = load_torus(index);
  uint rays = 0u;
  for (int k = 0; k < 4; ++k) {
    LocalRay ray = to_torus(saddle, k);
    // A little more than to the nearest hit, for the rounding of the sum in hit_toroidal.
    if (ray.low < ray.high && ray.low <= nearest.t[k] - ray.shift + params.slack) rays |= 1u << k;
  }
  return rays;
}

// Roots are looked for by the patch alone: hits so far would leave their mark on the last bits.
void hit_toroidal(uint index, int k, inout Nearest nearest) {
  TorusPatch saddle = load_torus(index);
  LocalRay ray = to_torus(saddle, k);
  TorusRuns runs = torus_runs(ray.o, ray.d, saddle.major, params.probe_radius, ray.low, ray.high);
  float t = kMiss;
  do {
    float root = torus_run(ray.o, ray.d, saddle.major, params.probe_radius, 2e-7, kMiss, runs);
    vec3 x = ray.o + ray.d * root;
    if (root < kMiss &&
        in_toroidal_patch(x, saddle.major, saddle.shape.x, saddle.shape.y, saddle.cos_sweep, saddle.sin_sweep,
                          int(saddle.primitive.plane_count), params.slack) &&
        shows_torus_point(saddle.primitive, x, saddle.major))
      t = root;
  } while (t == kMiss && runs.waiting != 0);
  if (t < kMiss) keep_nearest(index, saddle.primitive, k, t + ray.shift, nearest);
}
