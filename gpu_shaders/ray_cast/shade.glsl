// SPDX-License-Identifier: BSD-3-Clause
// Computes the normal and the atom of a hit, and applies studio light to its colour.
//
// Written in GLSL and, as the body of a struct, in C++ (core/render/cpu), where points may be packets with a common
// primitive. The includer provides everything that touched_atom.glsl needs, sheen.glsl, `view` and `params`.

struct SurfacePoint {
  real3 normal;  // towards the solvent
  natural atom;
};

GEOMETRY SurfacePoint surface_point(Primitive primitive, real3 p) {
  SurfacePoint point;
  vec4 place = row(primitive.first_row);
  real3 x = p - vec3(place);
  point.atom = natural(primitive.atom);
  if (primitive.kind == kConvex) {
    point.normal = x / place.w;
  } else if (primitive.kind == kConcave) {
    point.normal = -x / place.w;
    point.atom = concave_atom(primitive, x, place.w);
  } else {
    vec3 x_axis = vec3(row(primitive.first_row + 1u));
    vec3 z_axis = vec3(row(primitive.first_row + 2u));
    vec3 y_axis = cross(z_axis, x_axis);
    real3 local = real3(dot(x, x_axis), dot(x, y_axis), dot(x, z_axis));
    real3 normal = torus_normal(local, place.w, params.probe_radius);
    point.normal = x_axis * normal.x + y_axis * normal.y + z_axis * normal.z;
    point.atom = toroidal_atom(primitive, local, place.w);
  }
  point.normal = normalize(point.normal);
  return point;
}

// The part of the key light that reaches a point.
struct KeyLight {
  real diffuse;  // as much as the surface is turned towards it
  real open;     // share of the lamp that nothing covers
};

// Returns the unoccluded key light at a point with normal n. Wrapped diffuse light makes a soft terminator like a large
// lamp.
GEOMETRY KeyLight open_key_light(real3 n) {
  KeyLight key;
  key.diffuse = max((dot(n, params.key_direction) + 0.25) / 1.25, 0.0);
  key.open = real(1.0);
  return key;
}

// Returns a colour in studio light: a key light (from the upper left behind the camera by default), a dim fill light
// from the right, a sky that is brighter above, and a highlight. All directions are in the camera's axes (x right, y
// up, z towards the camera). Colours are linear.
GEOMETRY real3 studio_light(real3 albedo, real3 n, real3 to_camera, KeyLight key) {
  real fill_light = max((dot(n, params.fill_direction) + 0.3) / 1.3, 0.0);
  real sky = 0.5 + 0.5 * n.y;
  real facing = max(dot(n, to_camera), 0.0);
  real falloff = mix(key.diffuse, real(1.0), real(params.roughness));
  real3 light = params.key_strength * (params.key_color * (params.key_share * key.diffuse * falloff)) +
                params.fill_color * (params.fill_share * fill_light) +
                mix(real3(params.ground), real3(params.sky), sky) * (0.35 + 0.65 * facing);
  // A share of the ambient light comes from the lamp, so there is less of it in the lamp's shadow.
  if (params.ambient > 0.0) light = mix(light, real3(1.0 - params.key_share * (1.0 - key.open)), real(params.ambient));
  if (params.specular == 0.0) return albedo * light;
  return albedo * light + real3(key.open * sheen(n, to_camera, params.key_direction, params.key_strength,
                                                 params.specular, params.shininess));
}

GEOMETRY real3 in_camera_axes(real3 v) {
  return real3(dot(v, view.right), dot(v, view.up), -dot(v, view.forward));
}

// Returns a normal in the camera's axes, reversed if necessary so that it points to the camera's side. Surfaces are
// visible from inside the solid, and through hidden parts, too. d: direction of the ray.
GEOMETRY real3 shown_normal(real3 normal, real3 d) {
  real3 n = in_camera_axes(normal);
  return select(dot(n, -in_camera_axes(d)) < 0.0, -n, n);
}

// Returns a colour in studio light where a ray of direction d meets a surface with this normal.
GEOMETRY real3 lit(real3 albedo, real3 normal, real3 d) {
  real3 n = shown_normal(normal, d);
  return studio_light(albedo, n, -in_camera_axes(d), open_key_light(n));
}
