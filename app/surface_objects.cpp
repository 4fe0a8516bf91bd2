// SPDX-License-Identifier: BSD-3-Clause
// Computes the surface of each group of atoms, and divides it into the parts that are wanted.
#include "app/surface_objects.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/surface/part.h"

namespace meniscus {
namespace {

std::vector<AtomGroup> groups_of(const Structure& structure, const DivisionOptions& division) {
  if (division.groups) return group_atoms(structure, *division.groups);
  AtomGroup all{"surface", std::vector<std::uint32_t>(structure.atoms.size())};
  std::iota(all.atoms.begin(), all.atoms.end(), 0u);
  return {all};
}

void require_closed(const SurfaceObject& object, const Structure& structure) {
  const Certificate& certificate = object.surface.certificate;
  if (certificate.closed) return;
  constexpr std::size_t kNamed = 8;
  std::string atoms;
  for (std::size_t n = 0; n < std::min(certificate.open_atoms.size(), kNamed); ++n)
    atoms += (n ? ", " : "") + atom_place(structure.atoms[object.atom[certificate.open_atoms[n]]]);
  if (certificate.open_atoms.size() > kNamed) atoms += ", ...";
  throw OpenSurfaceError(
      fmt::format("the surface is not closed at {} atoms ({}); nothing was written; please report "
                  "this structure",
                  certificate.open_atoms.size(), atoms));
}

SurfaceObject compute(const Structure& structure, AtomGroup group, SurfaceComputer& computer) {
  std::vector<Ball> balls;
  for (const std::uint32_t a : group.atoms) balls.push_back({structure.atoms[a].position, structure.atoms[a].radius});
  SurfaceObject object;
  object.name = std::move(group.name);
  object.surface = computer.compute(balls);
  object.atom = std::move(group.atoms);
  require_closed(object, structure);
  return object;
}

// The object made of some of another one's components.
SurfaceObject part_of(const SurfaceObject& whole, const std::vector<bool>& keep, std::string name) {
  SurfacePart part = part_of(whole.surface, keep);
  SurfaceObject object;
  object.name = std::move(name);
  object.surface = std::move(part.surface);
  for (const std::uint32_t a : part.atom) object.atom.push_back(whole.atom[a]);
  return object;
}

std::vector<bool> wanted_components(const Surface& surface, Cavities cavities) {
  if (cavities == Cavities::keep) return std::vector<bool>(surface.components.size(), true);
  std::vector<bool> wanted = reached_from_outside(surface);
  if (cavities == Cavities::only) wanted.flip();
  return wanted;
}

void divide(SurfaceObject object, const DivisionOptions& division, std::vector<SurfaceObject>& objects) {
  const std::vector<bool> wanted = wanted_components(object.surface, division.cavities);
  const auto count = std::count(wanted.begin(), wanted.end(), true);
  if (!division.components) {
    if (count == 0) return;
    const bool all = static_cast<std::size_t>(count) == wanted.size();
    objects.push_back(all ? std::move(object) : part_of(object, wanted, object.name));
    return;
  }
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    if (!wanted[c]) continue;
    std::vector<bool> one(wanted.size(), false);
    one[c] = true;
    const bool cavity = object.surface.components[c].kind == ComponentKind::cavity;
    objects.push_back(part_of(object, one, fmt::format("component {}{}", c, cavity ? " (cavity)" : "")));
  }
}

}  // namespace

std::vector<SurfaceObject> surface_objects(const Structure& structure, const DivisionOptions& division,
                                           SurfaceComputer& computer) {
  std::vector<SurfaceObject> objects;
  for (AtomGroup& group : groups_of(structure, division))
    divide(compute(structure, std::move(group), computer), division, objects);
  if (objects.empty())
    throw InputError(structure.file, 0,
                     division.cavities == Cavities::only ? "the surface has no cavities; nothing is left of it"
                                                         : "the surface has no part; nothing is left of it");
  return objects;
}

}  // namespace meniscus
