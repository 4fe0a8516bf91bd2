// SPDX-License-Identifier: BSD-3-Clause
// Computes the highlight of the key light.
//
// Written in GLSL and, as the body of a struct, in C++ (core/render/cpu). All directions are in the camera's axes.

// Returns the Blinn-Phong highlight of a surface with normal n.
GEOMETRY real sheen(real3 n, real3 to_camera, vec3 key_direction, float strength, float specular, float shininess) {
  real3 half_way = normalize(key_direction + to_camera);
  return strength * (specular * pow(max(dot(n, half_way), 0.0), shininess));
}
