// SPDX-License-Identifier: BSD-3-Clause
// Intersects rays with patches, finds the atom whose colour a point has, and tests if that atom is shown, because points
// of hidden atoms are not hits.
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu), where rays may be packets with a
// common patch. The includer provides row(), load_primitive(), `view`, `params`, shows() of an atom, and `some_hidden`,
// which is false if all atoms are shown. Each ray is moved to its closest approach first. Numbers there are as small as
// the primitive, and single precision is good to about 1e-6 Å. The hit of a ray on a primitive depends on these two
// only, to the last bit: neither on earlier hits nor on the order of primitives. Therefore pictures with more or fewer
// hidden primitives are equal.

// Returns the atom of a point on a concave patch, which is the atom of the nearest contact. If two contacts are equally
// near, it is the atom with the smaller number, in any order of the contacts. x: point relative to the probe's centre.
GEOMETRY natural concave_atom(Primitive primitive, real3 x, float radius) {
  uint first_contact = primitive.first_row + 1u + primitive.plane_count;
  natural atom = natural(kNoPrimitive);
  real best = real(-2.0 * radius);
  for (uint i = 0u; i < primitive.atom; ++i) {
    vec4 contact = row(first_contact + i);
    real nearness = dot(vec3(contact), x);
    uint candidate = floatBitsToUint(contact.w);
    truth wins = nearness > best || (nearness == best && natural(candidate) < atom);
    best = select(wins, nearness, best);
    atom = select(wins, natural(candidate), atom);
  }
  return atom;
}

// Returns the atom of a point on a toroidal patch. x: point in the frame of the torus.
GEOMETRY natural toroidal_atom(Primitive primitive, real3 x, float major) {
  vec4 atoms = row(primitive.first_row + 4u);
  return select(toroidal_second_atom(x, major, atoms.x, atoms.y, atoms.z, atoms.w), natural(primitive.second_atom),
                natural(primitive.atom));
}

// True if the atom of a point on a convex or concave patch is shown. x: point relative to the centre of the sphere.
GEOMETRY truth shows_sphere_point(Primitive primitive, real3 x, float radius) {
  if (!some_hidden) return truth(true);
  if (primitive.kind == kConvex) return shows(natural(primitive.atom));
  return shows(concave_atom(primitive, x, radius));
}

GEOMETRY truth shows_torus_point(Primitive primitive, real3 x, float major) {
  if (!some_hidden) return truth(true);
  return shows(toroidal_atom(primitive, x, major));
}

const float kMiss = 3.0e38;

// True if no point p + t*d with t < high of this ray, or of any ray within `spread` of it, is in the sphere. It rejects
// most candidates. spread: Å at the pivot, growing as the rays diverge. The spheres may be packets, too.
GEOMETRY truth misses_bound(real3 center, real radius, real3 p, real3 d, real eye_t, real spread, real high) {
  real3 to_bound = p - center;
  real bound_t = -dot(to_bound, d);
  real3 closest = to_bound + d * bound_t;
  // Neighbouring rays are farthest from this one at the far end of the sphere.
  real widest = spread;
  if (view.orthographic == 0u) widest = spread * max((bound_t + radius - eye_t) / -eye_t, real(0.0));
  real reach = radius + widest;
  real room = reach * reach - dot(closest, closest);
  return room < real(0.0) || bound_t - sqrt(room) > high;
}

// The points where a ray enters and leaves the sphere of a patch, relative to its centre.
struct SphereMeeting {
  truth found;
  real near_t;
  real far_t;
  real3 near_point;
  real3 far_point;
};

GEOMETRY SphereMeeting meet_sphere(vec4 place, real3 p, real3 d) {
  SphereMeeting meeting;
  real3 o = p - vec3(place);
  real shift = -dot(o, d);
  o = o + d * shift;
  SphereHits hits = ray_sphere(o, d, place.w);
  meeting.found = hits.found;
  meeting.near_point = o + d * hits.near_t;
  meeting.far_point = o + d * hits.far_t;
  meeting.near_t = hits.near_t + shift;
  meeting.far_t = hits.far_t + shift;
  return meeting;
}

// A toroidal patch with the values of its rows.
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

GEOMETRY TorusPatch load_torus(uint index) {
  TorusPatch saddle;
  saddle.primitive = load_primitive(index);
  vec4 place = row(saddle.primitive.first_row);
  vec4 x_axis = row(saddle.primitive.first_row + 1u);
  vec4 z_axis = row(saddle.primitive.first_row + 2u);
  saddle.shape = row(saddle.primitive.first_row + 3u);
  saddle.center = vec3(place);
  saddle.major = place.w;
  saddle.x_axis = vec3(x_axis);
  saddle.cos_sweep = x_axis.w;
  saddle.z_axis = vec3(z_axis);
  saddle.sin_sweep = z_axis.w;
  saddle.y_axis = cross(saddle.z_axis, saddle.x_axis);
  return saddle;
}

// A ray in the frame of a torus, whose origin is its closest approach at the parameter `shift`. It can meet the patch
// only between `low` and `high`, and not at all if low >= high.
struct LocalRay {
  real3 o;
  real3 d;
  real shift;
  real low;
  real high;
};

// Returns the part of a ray inside the sphere through both contact circles, which contains the whole patch and nothing
// of the outer half of the torus.
GEOMETRY LocalRay to_saddle_ball(TorusPatch saddle, real3 p, real3 d) {
  LocalRay ray;
  real3 o = p - saddle.center;
  ray.shift = -dot(o, d);
  o = o + d * ray.shift;
  ray.o = real3(dot(o, saddle.x_axis), dot(o, saddle.y_axis), dot(o, saddle.z_axis));
  ray.d = real3(dot(d, saddle.x_axis), dot(d, saddle.y_axis), dot(d, saddle.z_axis));
  SphereHits chord = ray_sphere(ray.o - vec3(0.0, 0.0, saddle.shape.z), ray.d, saddle.shape.w + params.slack);
  ray.low = max(eye_parameter(d) - ray.shift, chord.near_t - params.slack);
  ray.high = select(chord.found, chord.far_t + params.slack, ray.low);
  return ray;
}

// Shortens a ray to the part between the ends of the patch, if these are at most half a turn apart.
GEOMETRY void clip_to_sweep(TorusPatch saddle, GEOMETRY_INOUT(LocalRay) ray) {
  if (saddle.primitive.plane_count != uint(kUpToHalfTurn)) return;
  clip_to_half_space(-ray.o.y - params.slack, -ray.d.y, ray.low, ray.high);
  clip_to_half_space(ray.o.y * saddle.cos_sweep - ray.o.x * saddle.sin_sweep - params.slack,
                     ray.d.y * saddle.cos_sweep - ray.d.x * saddle.sin_sweep, ray.low, ray.high);
}

GEOMETRY LocalRay to_torus(TorusPatch saddle, real3 p, real3 d) {
  LocalRay ray = to_saddle_ball(saddle, p, d);
  clip_to_sweep(saddle, ray);
  return ray;
}

// True if the ray may meet the patch before `nearest_t`, with a margin for the rounding of the sum in hit_torus().
GEOMETRY truth goes_towards_torus(LocalRay ray, real nearest_t) {
  return ray.low < ray.high && ray.low <= nearest_t - ray.shift + params.slack;
}

// True if a point of the torus is on the patch and shown. x: point in the frame of the torus.
GEOMETRY truth on_toroidal_patch(TorusPatch saddle, real3 x) {
  return in_toroidal_patch(x, saddle.major, saddle.shape.x, saddle.shape.y, saddle.cos_sweep, saddle.sin_sweep,
                           int(saddle.primitive.plane_count), params.slack) &&
         shows_torus_point(saddle.primitive, x, saddle.major);
}

// Returns the parameter of the first hit of a ray on a toroidal patch, or kMiss. The search does not depend on earlier
// hits, because they would change the last bits of the result.
GEOMETRY real hit_torus(TorusPatch saddle, LocalRay ray) {
  TorusRuns runs = torus_runs(ray.o, ray.d, saddle.major, params.probe_radius, ray.low, ray.high);
  real t = real(kMiss);
  while (some(runs.waiting != 0)) {
    real root = torus_run(ray.o, ray.d, saddle.major, params.probe_radius, 2e-7, kMiss, runs);
    real3 x = ray.o + ray.d * root;
    truth hit = t == real(kMiss) && root < real(kMiss) && on_toroidal_patch(saddle, x);
    t = select(hit, root, t);
    runs.waiting = select(hit, integer(0), runs.waiting);
  }
  return select(t < real(kMiss), t + ray.shift, t);
}
