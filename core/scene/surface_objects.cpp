// SPDX-License-Identifier: BSD-3-Clause
// Computes the surfaces of groups of atoms, marks atoms as hidden for renderers and exporters, and sums areas and
// gradients by the atoms of a file.
#include "core/scene/surface_objects.h"

#include <numeric>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/queries/copies.h"
#include "core/queries/surface_parts.h"

namespace meniscus {
namespace {

std::vector<AtomGroup> groups_of(const Structure& structure, const Division& division) {
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
      "the surface is not closed at {} atoms ({}); nothing was written; please report "
      "this structure",
      certificate.open_atoms.size(), atoms);
}

/// A group of atoms, and the motions of its copies. Only atoms with the same motions can share a surface.
struct PlacedGroup {
  AtomGroup group;
  std::vector<RigidMotion> copies{RigidMotion{}};
};

std::vector<PlacedGroup> placed_groups(const Structure& structure, const Division& division) {
  std::vector<PlacedGroup> placed;
  std::vector<std::uint32_t> instances_of(structure.atoms.size(), 0);
  for (std::uint32_t n = 0; n < structure.instances.size(); ++n) {
    for (const std::uint32_t a : structure.instances[n].atoms) instances_of[a] = n;
  }
  for (AtomGroup& group : groups_of(structure, division)) {
    if (structure.instances.empty()) {
      placed.push_back({std::move(group)});
      continue;
    }
    std::map<std::uint32_t, AtomGroup> parts;
    for (const std::uint32_t a : group.atoms) parts[instances_of[a]].atoms.push_back(a);
    for (auto& [n, part] : parts) {
      part.name = group.name;
      placed.push_back({std::move(part), structure.instances[n].motions});
    }
  }
  return placed;
}

SurfaceObject compute(const Structure& structure, PlacedGroup placed, SurfaceComputer& computer) {
  AtomGroup& group = placed.group;
  std::vector<Ball> balls;
  for (const std::uint32_t a : group.atoms) balls.push_back({structure.atoms[a].position, structure.atoms[a].radius});
  SurfaceObject object;
  object.name = std::move(group.name);
  object.surface = computer.compute(balls);
  object.atom = std::move(group.atoms);
  object.copies = std::move(placed.copies);
  require_closed(object, structure);
  return object;
}

/// Throws InputError if a probe can touch two copies. atoms: for each group, the places of its balls in the structure.
void require_apart(const Structure& structure, std::span<const CopiedBalls> groups,
                   std::span<const std::span<const std::uint32_t>> atoms, double probe_radius) {
  const std::optional<CopyContact> contact = closest_contact(groups, probe_radius);
  if (!contact) return;
  const auto place = [&](const CopiedBall& ball) {
    return fmt::format("{} in copy {}", atom_place(structure.atoms[atoms[ball.group][ball.ball]]), ball.copy + 1);
  };
  throw InputError(structure.file, 0,
                   message("{} and {} are {:.2f} Å apart, so near that a probe can touch both copies; leave "
                           "@instances@ out, or choose @instances separate@",
                           place(contact->ball[0]), place(contact->ball[1]), contact->distance));
}

/// Throws InputError if copies do not keep clear of each other. They need not if each has a surface as if it were
/// alone: with --instances separate, or if groups are chains or residues, because each copy has its own.
void require_apart(const Structure& structure, const Division& division, std::span<const SurfaceObject> objects) {
  if (division.instances != InstanceMode::exact) return;
  if (division.groups == Grouping::chain || division.groups == Grouping::residue) return;
  for (std::size_t first = 0, past = 0; first < objects.size(); first = past) {
    std::vector<CopiedBalls> copied;
    std::vector<std::span<const std::uint32_t>> atoms;
    for (past = first; past < objects.size() && objects[past].name == objects[first].name; ++past) {
      copied.push_back({objects[past].surface.atoms, objects[past].copies});
      atoms.emplace_back(objects[past].atom);
    }
    require_apart(structure, copied, atoms, objects[first].surface.probe_radius);
  }
}

// Returns an object of some components of another one.
SurfaceObject part_of(const SurfaceObject& whole, const std::vector<bool>& keep, std::string name) {
  SurfacePart part = part_of(whole.surface, keep);
  SurfaceObject object;
  object.name = std::move(name);
  object.surface = std::move(part.surface);
  for (const std::uint32_t a : part.atom) object.atom.push_back(whole.atom[a]);
  object.copies = whole.copies;
  object.whole = false;
  return object;
}

std::vector<bool> wanted_components(const Surface& surface, Cavities cavities) {
  if (cavities == Cavities::keep) return std::vector<bool>(surface.components.size(), true);
  std::vector<bool> wanted = reached_from_outside(surface);
  if (cavities == Cavities::only) wanted.flip();
  return wanted;
}

void divide(SurfaceObject object, const Division& division, std::vector<SurfaceObject>& objects) {
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

std::vector<SurfaceObject> surface_objects(const Structure& structure, const Division& division,
                                           SurfaceComputer& computer) {
  std::vector<SurfaceObject> wholes, objects;
  for (PlacedGroup& placed : placed_groups(structure, division))
    wholes.push_back(compute(structure, std::move(placed), computer));
  require_apart(structure, division, wholes);
  for (SurfaceObject& whole : wholes) divide(std::move(whole), division, objects);
  if (objects.empty())
    throw InputError(structure.file, 0,
                     division.cavities == Cavities::only ? "the surface has no cavities, so there is nothing to show"
                                                         : "the surface has no parts, so there is nothing to show");
  return objects;
}

void require_apart(const Structure& structure, double probe_radius) {
  std::vector<std::vector<Ball>> balls;
  std::vector<CopiedBalls> copied;
  std::vector<std::span<const std::uint32_t>> atoms;
  for (const Instances& group : structure.instances) {
    balls.emplace_back();
    for (const std::uint32_t a : group.atoms)
      balls.back().push_back({structure.atoms[a].position, structure.atoms[a].radius});
  }
  for (std::size_t n = 0; n < balls.size(); ++n) {
    copied.push_back({balls[n], structure.instances[n].motions});
    atoms.emplace_back(structure.instances[n].atoms);
  }
  require_apart(structure, copied, atoms, probe_radius);
}

RadiiChange change_of_radii(const std::vector<SurfaceObject>& objects) {
  RadiiChange largest;
  for (const SurfaceObject& object : objects) {
    largest.grown_by = std::max(largest.grown_by, object.surface.certificate.grown_by);
    largest.exact_within = std::max(largest.exact_within, object.surface.certificate.exact_within);
  }
  return largest;
}

std::vector<bool> hidden_atoms(const Selection& shown, const Structure& structure) {
  std::vector<bool> visible = shown.evaluate(structure);
  if (std::find(visible.begin(), visible.end(), true) == visible.end())
    throw InputError(structure.file, 0, "none of the {} atoms used is shown by {}; {}",
                     with_thousands(structure.atoms.size()), in_quotes(shown.text()), shown.why_none(structure.atoms));
  visible.flip();
  return visible;
}

void hide(const std::vector<bool>& hidden, std::vector<SurfaceObject>& objects) {
  for (SurfaceObject& object : objects) {
    std::vector<bool>& of_object = object.coloring.hidden;
    of_object.resize(object.atom.size());
    for (std::size_t a = 0; a < of_object.size(); ++a) of_object[a] = of_object[a] || hidden[object.atom[a]];
  }
}

double AreaColumn::total_of(const AtomGroup& group) const {
  return std::accumulate(group.atoms.begin(), group.atoms.end(), 0.0,
                         [&](double sum, std::uint32_t a) { return sum + values[a]; });
}

std::vector<AreaColumn> area_totals(const std::vector<SurfaceObject>& objects, SurfaceKind kind) {
  AreaColumn surface{std::string(kind_word(kind)) + "_area", {}, 0.0}, accessible{"sas_area", {}, 0.0};
  for (const SurfaceObject& object : objects) {
    const auto copies = static_cast<double>(object.copies.size());
    surface.total += copies * object.surface.area;
    if (kind == SurfaceKind::ses) accessible.total += copies * accessible_area(object.surface);
  }
  if (kind == SurfaceKind::ses) return {surface, accessible};
  return {surface};
}

std::vector<AreaColumn> area_sums(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                  SurfaceKind kind, std::span<const AtomGroup> groups) {
  const std::vector<double> none(groups.size(), 0.0);
  AreaColumn surface{std::string(kind_word(kind)) + "_area", {}, 0.0, none}, accessible{"sas_area", {}, 0.0, none};
  std::vector<std::uint32_t> group_of(structure.atoms.size(), 0);
  for (std::uint32_t g = 0; g < groups.size(); ++g)
    for (const std::uint32_t atom : groups[g].atoms) group_of[atom] = g;
  for (const SurfaceObject& object : objects) {
    std::vector<std::uint32_t> groups_here(object.atom.size());
    std::ranges::transform(object.atom, groups_here.begin(), [&](std::uint32_t atom) { return group_of[atom]; });
    const AtomAreas areas = group_areas(object.surface, groups_here, static_cast<std::uint32_t>(groups.size()));
    const auto copies = static_cast<double>(object.copies.size());
    surface.total += copies * object.surface.area;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      surface.sums[g] += areas.surface[g];
      accessible.sums[g] += areas.accessible[g];
      accessible.total += copies * areas.accessible[g];
    }
  }
  if (kind == SurfaceKind::ses) return {surface, accessible};
  return {surface};
}

std::vector<AreaColumn> area_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                     SurfaceKind kind) {
  AreaColumn surface{std::string(kind_word(kind)) + "_area", std::vector<double>(structure.atoms.size(), 0.0), 0.0};
  AreaColumn accessible{"sas_area", surface.values, 0.0};
  for (const SurfaceObject& object : objects) {
    const AtomAreas areas = atom_areas(object.surface);
    const auto copies = static_cast<double>(object.copies.size());
    for (std::size_t n = 0; n < object.atom.size(); ++n) {
      surface.values[object.atom[n]] += areas.surface[n];
      accessible.values[object.atom[n]] += areas.accessible[n];
      surface.total += copies * areas.surface[n];
      accessible.total += copies * areas.accessible[n];
    }
  }
  if (kind == SurfaceKind::ses) return {surface, accessible};
  return {surface};
}

namespace {

void refuse_ties(const Structure& structure, const std::vector<SurfaceObject>& objects) {
  for (const SurfaceObject& object : objects) {
    std::string names;
    for (const std::uint32_t a : tied_atoms(object.surface))
      names += (names.empty() ? "" : ", ") + label_of(structure.atoms[object.atom[a]]);
    if (names.empty()) continue;
    throw InputError(structure.file, 0,
                     message("one probe touches more than three atoms at once ({}), so the surface has no derivatives "
                             "there; move one atom slightly, or choose @surface sas@",
                             names));
  }
}

}  // namespace

std::vector<GradientColumn> gradient_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                             SurfaceKind kind) {
  std::vector<GradientColumn> columns;
  const auto add = [&](std::string name, auto&& gradient_of) {
    GradientColumn column{std::move(name), Gradient(structure.atoms.size(), glm::dvec3(0.0))};
    for (const SurfaceObject& object : objects) {
      const Gradient gradient = gradient_of(object.surface);
      for (std::size_t a = 0; a < gradient.size(); ++a) column.values[object.atom[a]] += gradient[a];
    }
    columns.push_back(std::move(column));
  };
  if (kind == SurfaceKind::ses) refuse_ties(structure, objects);
  const std::string word = kind_word(kind);
  add(word + "_area", area_gradient);
  add(word + "_volume", volume_gradient);
  if (kind != SurfaceKind::ses) return columns;
  add("sas_area", [](const Surface& surface) { return accessible_area_gradient(surface); });
  add("sas_volume", accessible_volume_gradient);
  return columns;
}

}  // namespace meniscus
