// SPDX-License-Identifier: BSD-3-Clause
// Makes shapes of marked atoms, and colours them by the scheme of the surface.
#include "core/scene/representations.h"

namespace meniscus {
namespace {

using Kind = RepresentationRequest::Kind;
using By = ColorScheme::By;

}  // namespace

void Representations::mark_atoms(ReadOptions& reading) const {
  if (!empty() && reading.copy_mode == CopyMode::instances)
    throw RequestError(
        message("@instances@: copies of one surface cannot be drawn with sticks, balls or spheres; leave it out"));
  for (const RepresentationRequest& request : requests) {
    reading.shown.push_back({shape_word(request.kind), request.atoms, draws_each_atom(request.kind), request.lack});
    // It is found for all atoms of the file, because hydrogen bonds lead to residues that are not shown.
    if (request.kind == Kind::backbone) reading.secondary_structure = true;
  }
}

namespace {

/// Returns the shapes. They are found by whole rings, so throws InputError if atoms are selected but none belongs to
/// such a ring.
Shapes found(const Structure& all, Shapes shapes, const std::vector<bool>& selected, Kind kind, const char* what) {
  if (shapes.empty() && std::ranges::find(selected, true) != selected.end())
    throw InputError(all.file, 0, "{} draws nothing: its atoms are of no {} with a whole ring",
                     option_name(shape_word(kind)), what);
  return shapes;
}

}  // namespace

Shapes shapes_of_atoms(const Structure& all, Kind kind, const std::vector<bool>& selected,
                       const std::vector<Bond>& bonds, const ShapeRadii& radii) {
  const double tube = radii.tube_radius.value_or(kTubeRadius);
  switch (kind) {
    case Kind::sticks:
      return sticks(all, selected, bonds, radii.stick_radius.value_or(kStickRadius));
    case Kind::balls_and_sticks:
      return balls_and_sticks(all, selected, bonds, kBallShare, radii.stick_radius.value_or(kThinStickRadius));
    case Kind::backbone:
      return cartoon(all, selected, tube, radii.stick_radius.value_or(kStickRadius * tube / kTubeRadius));
    case Kind::bases:
      return found(all, bases(all, selected, radii.stick_radius.value_or(kStickRadius)), selected, kind, "base");
    case Kind::sugar_symbols:
      return found(all, sugar_symbols(all, selected, radii.stick_radius.value_or(kStickRadius)), selected, kind,
                   "sugar");
    case Kind::spheres:
    case Kind::hydrogen_bonds:  // shapes of pairs of atoms, made by make_objects()
    case Kind::distance:
      break;
  }
  return spheres(all, selected);
}

ColorScheme with_scale_of(const Structure& structure, std::size_t shown, ColorScheme scheme) {
  scheme = resolved_scheme(structure, std::move(scheme));
  for (ColorRule& rule : scheme.rules) rule.paint = with_scale_of(structure, shown, std::move(rule.paint));
  if (!scheme.has_scale() || scheme.of_points()) return scheme;
  const ColorScale scale = color_scale(structure, scheme);
  const auto has_number = [](const Atom& atom) { return (atom.shown & ~kCompanionBits) != 0; };
  if (scale.map == ColorMap::categorical && std::ranges::any_of(structure.extra_atoms, has_number))
    throw RequestError(message(
        "@map categorical@: atoms outside the surface may have numbers without a colour; choose another @map@"));
  scheme.range = scale.range;
  std::vector<double>& numbers =
      scheme.file.numbers;  // one number per atom of the file, or one per atom of the surface
  const bool of_atoms = scheme.takes_file() || scheme.is_measured();
  if (of_atoms && numbers.size() == structure.atoms.size())
    numbers.resize(shown, std::numeric_limits<double>::quiet_NaN());
  return scheme;
}

ColorScheme::By scheme_of_shapes(By scheme, Kind kind) {
  if (scheme != By::automatic) return scheme;
  return kind == Kind::backbone ? By::chain : By::chain_element;
}

// With By::automatic the backbone of a single chain has the colours of its surface.
ColorScheme extras_scheme(const Structure& structure, std::size_t shown, ColorScheme scheme, Kind kind) {
  ColorScheme resolved = resolved_scheme(structure, scheme);
  if (kind == Kind::backbone && resolved.by == By::rainbow) scheme = std::move(resolved);
  scheme.by = scheme_of_shapes(scheme.by, kind);
  if (scheme.by == By::kind || scheme.by == By::component || scheme.of_points()) scheme.by = By::element;
  scheme.opacities.clear();  // opacities apply to the surface only, which is transparent to show what is in it
  return with_scale_of(structure, shown, std::move(scheme));
}

std::vector<Atom> shown_atoms(const Structure& structure) {
  std::vector<Atom> atoms = structure.atoms;
  atoms.insert(atoms.end(), structure.extra_atoms.begin(), structure.extra_atoms.end());
  return atoms;
}

Structure structure_of_shown(const Structure& structure) {
  Structure all;
  all.file = structure.file;
  all.report = structure.report;
  all.chains = structure.chains;
  all.added = structure.added;
  all.frame = structure.frame;
  all.atoms = shown_atoms(structure);
  return all;
}

std::vector<bool> marked_atoms(const Structure& all, std::size_t mark) {
  std::vector<bool> marked(all.atoms.size());
  for (std::size_t n = 0; n < marked.size(); ++n) marked[n] = ((all.atoms[n].shown >> mark) & 1u) != 0;
  return marked;
}

ColoredShapes shown_shapes(const Structure& structure, const Representations& representations,
                           const ColorScheme& scheme) {
  ColoredShapes shown;
  if (representations.empty()) return shown;
  const Structure all = structure_of_shown(structure);
  const std::vector<RepresentationRequest>& requests = representations.requests;
  unsigned tubes = 0;
  for (std::size_t bit = 0; bit < requests.size(); ++bit)
    if (requests[bit].kind == Kind::backbone) tubes |= 1u << bit;
  std::vector<std::uint32_t> of_backbones;
  for (std::size_t bit = 0; bit < requests.size(); ++bit) {
    const Kind kind = requests[bit].kind;
    std::vector<bool> marked = marked_atoms(all, bit);
    // Tubes have the bases of polymers already.
    for (std::size_t n = 0; kind == Kind::bases && n < marked.size(); ++n)
      if ((all.atoms[n].shown & tubes) != 0 && all.atoms[n].kind == AtomClass::polymer) marked[n] = false;
    const Shapes own = shapes_of_atoms(all, kind, marked, *structure.shown_bonds, representations);
    if (kind == Kind::backbone) of_backbones.insert(of_backbones.end(), own.mesh.atoms.begin(), own.mesh.atoms.end());
    append(shown.shapes, own);
  }
  const auto colors = [&](Kind kind) {
    return color_atoms(all, extras_scheme(structure, all.atoms.size(), scheme, kind));
  };
  shown.coloring = colors(Kind::sticks);
  if (scheme.by != By::automatic || of_backbones.empty()) return shown;
  const Coloring by_chain = colors(Kind::backbone);
  for (const std::uint32_t atom : of_backbones) shown.coloring.atom[atom] = by_chain.atom[atom];
  return shown;
}

}  // namespace meniscus
