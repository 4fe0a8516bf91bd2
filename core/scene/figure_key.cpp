// SPDX-License-Identifier: BSD-3-Clause
// Marks the atoms that surfaces and shapes draw, and finds the meaning of their colours.
#include "core/scene/figure.h"

#include "core/color/lipophilicity.h"
#include "core/scene/run_framing.h"
#include "core/scene/scene.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;
using Kind = RepresentationRequest::Kind;

bool any_of(const std::vector<bool>& atoms) { return std::ranges::find(atoms, true) != atoms.end(); }

void mark(const ColoredShapes& shapes, std::vector<bool>& atoms) {
  const auto one = [&](std::uint32_t atom) { atoms[atom] = atoms[atom] || shapes.coloring.shows(atom); };
  for (const SphereShape& sphere : shapes.shapes.spheres) one(sphere.atom);
  for (const CylinderShape& cylinder : shapes.shapes.cylinders) {
    one(cylinder.from_atom);
    one(cylinder.to_atom);
  }
  for (const std::uint32_t atom : shapes.shapes.mesh.atoms) one(atom);
}

/// Marks the atoms of a surface. buried: true if atoms without a part of the surface count, too.
void mark(const SurfaceObject& object, bool buried, std::vector<bool>& atoms) {
  const Surface& surface = object.surface;
  std::vector<bool> open(object.atom.size(), buried);
  for (const ConvexPatch& patch : surface.convex) open[patch.atom] = true;
  for (const ToroidalPatch& patch : surface.toroidal)
    for (const std::uint32_t atom : patch.atom) open[atom] = true;
  for (const std::uint32_t atom : surface.contacts) open[atom] = true;
  for (std::uint32_t a = 0; a < open.size(); ++a)
    if (open[a] && object.coloring.shows(a)) atoms[object.atom[a]] = true;
}

void mark(const FigureObject& object, const FigureObjectRequest& request, std::vector<bool>& atoms) {
  if (object.surface)
    mark(*object.surface, !request.cuts.empty(), atoms);
  else
    mark(object.shapes, atoms);
}

/// Keeps the atoms that rules colour. A legend does not explain the elements of companions.
void keep_ruled(const ColorScheme& scheme, const Structure& structure, std::vector<bool>& atoms) {
  std::vector<bool> ruled(atoms.size(), false);
  for (const ColorRule& rule : scheme.rules) {
    const std::vector<bool> selected = rule.atoms.evaluate(structure.atoms);
    for (std::size_t a = 0; a < ruled.size(); ++a) ruled[a] = ruled[a] || selected[a];
  }
  for (std::size_t a = 0; a < atoms.size(); ++a) atoms[a] = atoms[a] && ruled[a];
}

}  // namespace

ColorKey figure_key(const Structure& structure, const ColorScheme& scheme, DrawnAtoms drawn,
                    const FigureRequest& request, const FigureExtras& extras) {
  if (request.hides_surface) drawn.atoms.assign(drawn.atoms.size(), false);
  if (extras.empty()) return color_key(structure, scheme, drawn);
  const Structure all = structure_of_shown(structure);
  const std::size_t count = all.atoms.size();
  std::vector<bool> shapes(count, false), backbones = shapes;
  drawn.atoms.resize(count, false);
  if (!extras.shapes.empty()) mark(extras.shapes, shapes);
  if (scheme.by == By::automatic)
    for (const std::uint32_t atom : extras.shapes.shapes.mesh.atoms) {  // these include the atoms of bases
      if (!shapes[atom] || all.atoms[atom].kind != AtomClass::polymer) continue;
      backbones[atom] = true;
      shapes[atom] = false;
    }
  const std::vector<FigureObjectRequest> requests = all_requests(request.objects, structure);
  for (std::size_t n = 0; n < extras.objects.size(); ++n) {
    if (requests[n].has_own_colors()) continue;
    const auto& kind = requests[n].shapes;
    mark(extras.objects[n], requests[n], !kind ? drawn.atoms : kind == Kind::backbone ? backbones : shapes);
  }
  const bool of_surfaces =
      scheme.by == By::automatic || scheme.by == By::kind || scheme.by == By::component || scheme.of_points();
  for (std::size_t a = 0; !of_surfaces && a < count; ++a) drawn.atoms[a] = drawn.atoms[a] || shapes[a] || backbones[a];
  ColorKey key = color_key(all, with_scale_of(structure, count, scheme), drawn);
  for (const auto& [kind, atoms] : {std::pair(Kind::backbone, &backbones), std::pair(Kind::sticks, &shapes)})
    if (of_surfaces && any_of(*atoms))
      add_key(key, color_key(all, extras_scheme(structure, count, scheme, kind), {.atoms = *atoms}), "beside");
  for (std::size_t n = 0; n < extras.objects.size(); ++n) {
    if (!requests[n].has_own_colors() || (requests[n].is_dashed() && !requests[n].color)) continue;
    std::vector<bool> own(count, false);
    mark(extras.objects[n], requests[n], own);
    const ColorScheme color = scheme_of(requests[n], structure, count, scheme);
    const std::string name = requests[n].text();
    if (requests[n].is_companion) keep_ruled(scheme, all, own);
    if (!any_of(own)) continue;
    if (color.by == By::fixed && color.rules.empty())
      key.classes.push_back({name, color.fixed});
    else
      add_key(key, color_key(all, color, {.atoms = own}), name);
  }
  if (scheme.by == By::fixed && scheme.rules.empty() && any_of(drawn.atoms)) add_other(key, "other", scheme.fixed);
  return key;
}

ColorKey key_of(const Molecule& molecule, const FigureRequest& request, const FigureExtras& extras) {
  DrawnAtoms drawn{std::vector<bool>(molecule.structure.atoms.size(), false)};
  for (const SurfaceObject& object : molecule.objects) {
    mark(object, !request.cuts.empty(), drawn.atoms);
    drawn.objects.push_back({object.name, object.atom});
  }
  ColorKey key = figure_key(molecule.structure, molecule.color, std::move(drawn), request, extras);
  const auto lacks = [&](auto Surface::*patches) {
    return std::ranges::all_of(molecule.objects, [&](const SurfaceObject& o) { return (o.surface.*patches).empty(); });
  };
  if (molecule.color.by == By::kind && lacks(&Surface::toroidal) && lacks(&Surface::concave)) key.classes.resize(1);
  if (molecule.beyond_map > 0.0 && key.scale) add_other(key, "outside of the map", key.scale->missing_color);
  return key;
}

ColorKey key_of(const FrameRun& run, const Scene& scene) {
  const Structure structure = numbered_structure(run);
  ColorScheme color = color_of(scene.molecule);
  DrawnAtoms drawn{std::vector<bool>(structure.atoms.size(), true), {}, true};
  if (scene.molecule.show) {
    drawn.atoms = scene.molecule.show->possible(shown_atoms(structure)).selected;
    drawn.atoms.resize(structure.atoms.size());
  }
  if (!scene.legend.is_requested() && !scene.figure.objects.empty())
    return figure_key(structure, color, std::move(drawn), {}, {});
  if (color.by == By::lipophilicity) color.volume = lipophilicity_paint(structure, color);
  return figure_key(structure, color, std::move(drawn), scene.figure, make_extras(structure, scene.figure, color));
}

}  // namespace meniscus
