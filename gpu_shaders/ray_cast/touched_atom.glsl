// SPDX-License-Identifier: BSD-3-Clause
// Which atom a point takes its colour from, and whether that atom is shown: points of hidden atoms are not hits.
//
// GLSL and, as the body of a struct, C++ (core/render/cpu): points may be packets, the primitive is the same for all.
// The includer provides row(), shows() of an atom, and `some_hidden`, without which nobody asks.

// On a concave patch; x: from the probe's centre. The nearest contact wins; of two, the smaller atom, in whatever order
// they are.
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

// On a toroidal patch; x: in the torus's own frame.
GEOMETRY natural toroidal_atom(Primitive primitive, real3 x, float major) {
  vec4 atoms = row(primitive.first_row + 4u);
  return select(toroidal_second_atom(x, major, atoms.x, atoms.y, atoms.z, atoms.w), natural(primitive.second_atom),
                natural(primitive.atom));
}

// x: from the centre of a convex or concave patch.
GEOMETRY truth shows_sphere_point(Primitive primitive, real3 x, float radius) {
  if (!some_hidden) return truth(true);
  if (primitive.kind == kConvex) return shows(natural(primitive.atom));
  return shows(concave_atom(primitive, x, radius));
}

GEOMETRY truth shows_torus_point(Primitive primitive, real3 x, float major) {
  if (!some_hidden) return truth(true);
  return shows(toroidal_atom(primitive, x, major));
}
