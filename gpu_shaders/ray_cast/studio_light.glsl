// SPDX-License-Identifier: BSD-3-Clause
// Computes studio light on a surface with normal n. All directions are in the camera's axes (x right, y up, z towards
// the camera).
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu). The includer provides `params`
// with the numbers of the lamps, of RayCastParameters or FinishParameters.

// The part of the key light that reaches a point.
struct KeyLight {
  real diffuse;  // share by which the surface is turned towards it
  real open;     // share of the lamp that nothing covers
};

// Returns the unoccluded key light at a point with normal n. Wrapped diffuse light makes the terminator soft.
GEOMETRY KeyLight open_key_light(real3 n) {
  KeyLight key;
  key.diffuse = max((dot(n, params.key_direction) + 0.25) / 1.25, 0.0);
  key.open = real(1.0);
  return key;
}

// Returns the light on a matt white surface: a key light (from the upper left behind the camera by default), a dim fill
// light from the right, and a sky that is brighter above. Colours are linear.
GEOMETRY real3 matt_light(real3 n, real3 to_camera, KeyLight key) {
  real fill_light = max((dot(n, params.fill_direction) + 0.3) / 1.3, 0.0);
  real sky = 0.5 + 0.5 * n.y;
  real facing = max(dot(n, to_camera), 0.0);
  real falloff = mix(key.diffuse, real(1.0), real(params.roughness));
  real3 light = params.key_strength * (params.key_color * (params.key_share * key.diffuse * falloff)) +
                params.fill_color * (params.fill_share * fill_light) +
                mix(real3(params.ground), real3(params.sky), sky) * (0.35 + 0.65 * facing);
  // A share of the ambient light comes from the lamp, so there is less of it in the lamp's shadow.
  if (params.ambient > 0.0) light = mix(light, real3(1.0 - params.key_share * (1.0 - key.open)), real(params.ambient));
  return light;
}

// Returns the Blinn-Phong highlight of a surface with normal n.
GEOMETRY real sheen(real3 n, real3 to_camera, vec3 key_direction, float strength, float specular, float shininess) {
  real3 half_way = normalize(key_direction + to_camera);
  return strength * (specular * pow(max(dot(n, half_way), 0.0), shininess));
}

// Returns a colour in studio light with a highlight.
GEOMETRY real3 studio_light(real3 albedo, real3 n, real3 to_camera, KeyLight key) {
  real3 light = matt_light(n, to_camera, key);
  if (params.specular == 0.0) return albedo * light;
  return albedo * light + real3(key.open * sheen(n, to_camera, params.key_direction, params.key_strength,
                                                 params.specular, params.shininess));
}
