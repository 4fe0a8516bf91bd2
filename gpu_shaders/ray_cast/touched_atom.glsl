// SPDX-License-Identifier: BSD-3-Clause
// Which atom a point takes its colour from, and whether that atom is shown: points of hidden atoms are no hits.

bool shows(uint atom) { return atom_color[atom].a > 0.0; }

// On a concave patch; x: from the probe's centre. The nearest contact wins; of two, the smaller atom, in whatever order
// they stand.
uint concave_atom(Primitive primitive, vec3 x, float radius) {
  uint first_contact = primitive.first_row + 1u + primitive.plane_count;
  uint atom = kNoPrimitive;
  float best = -2.0 * radius;
  for (uint i = 0u; i < primitive.atom; ++i) {
    vec4 contact = row(first_contact + i);
    float nearness = dot(contact.xyz, x);
    uint candidate = floatBitsToUint(contact.w);
    if (nearness > best || (nearness == best && candidate < atom)) {
      best = nearness;
      atom = candidate;
    }
  }
  return atom;
}

// On a toroidal patch; x: in the torus's own frame.
uint toroidal_atom(Primitive primitive, vec3 x, float major) {
  vec4 atoms = row(primitive.first_row + 4u);
  return toroidal_second_atom(x, major, atoms.x, atoms.y, atoms.z, atoms.w) ? primitive.second_atom : primitive.atom;
}

// Not asked where nothing is hidden: software GL would pay for the answer all the same.
#ifdef SOME_HIDDEN

// x: from the centre of a convex or concave patch.
bool shows_sphere_point(Primitive primitive, vec3 x, float radius) {
  return shows(primitive.kind == kConvex ? primitive.atom : concave_atom(primitive, x, radius));
}

bool shows_torus_point(Primitive primitive, vec3 x, float major) { return shows(toroidal_atom(primitive, x, major)); }

#else

bool shows_sphere_point(Primitive primitive, vec3 x, float radius) { return true; }

bool shows_torus_point(Primitive primitive, vec3 x, float major) { return true; }

#endif
