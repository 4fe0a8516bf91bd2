// SPDX-License-Identifier: BSD-3-Clause
// Takes the atoms of each object by their marks, and computes its surface as if they were alone.
#include "core/scene/figure_object.h"

#include "core/queries/copies.h"
#include "core/scene/surface_objects.h"
#include "core/structure/bonds.h"

namespace meniscus {
namespace {

/// Returns the atoms of one object, taken from all shown atoms, and writes their places to `places`.
Structure structure_of(const Structure& all, const std::vector<bool>& selected, std::vector<std::uint32_t>& places) {
  Structure own;
  own.file = all.file;
  own.report = all.report;
  own.chains = all.chains;
  own.frame = all.frame;
  for (std::uint32_t a = 0; a < all.atoms.size(); ++a) {
    if (!selected[a]) continue;
    own.atoms.push_back(all.atoms[a]);
    places.push_back(a);
  }
  return own;
}

/// Returns the surface of an object, without colours.
SurfaceObject surface_of(const FigureObjectRequest& request, const Structure& all, const std::vector<bool>& selected) {
  std::vector<std::uint32_t> places;
  const Structure own = structure_of(all, selected, places);
  SurfaceRequest wanted;
  wanted.cpu = true;
  wanted.kind = request.kind;
  wanted.probe_radius = request.kind == SurfaceKind::vdw ? 0.0 : request.probe_radius;
  SurfaceComputer computer(wanted);
  SurfaceObject object = std::move(surface_objects(own, {}, computer).front());
  for (std::uint32_t& atom : object.atom) atom = places[atom];
  return object;
}

/// Draws dashed lines. partners: nothing: all atoms that are drawn.
void add_dashes(const FigureObjectRequest& request, const Structure& all, const std::vector<bool>& selected,
                std::vector<bool> partners, FigureObject& object) {
  for (const Atom& atom : all.atoms)
    if (!request.partners) partners.push_back(atom.shown != 1u << kHiddenCompanion);
  std::vector<Bond> pairs;
  if (request.shapes == RepresentationRequest::Kind::hydrogen_bonds)
    pairs = hydrogen_bonds(all, selected, partners);
  else if (const std::optional<Bond> pair = closest_pair(all.atoms, selected, partners))
    pairs.push_back(*pair);
  object.shapes.shapes = dashes(all, pairs, request.radius.value_or(kDashRadius));
  for (const auto& [from, to] : pairs) {
    const glm::dvec3 along = 0.5 * (all.atoms[to].position - all.atoms[from].position);
    object.lengths.push_back(
        {fmt::format("{:.1f} Å", 2.0 * glm::length(along)), all.atoms[from].position + along, false, along});
  }
}

}  // namespace

FigureObjectRequest parse_dashes(RepresentationRequest::Kind kind, std::string_view text) {
  constexpr std::string_view kTo = " to ";
  for (std::size_t at = text.find(kTo); at != std::string_view::npos; at = text.find(kTo, at + 1)) {
    const std::string_view left = text.substr(0, at), right = text.substr(at + kTo.size());
    try {
      return {.atoms = parse_selection(left), .shapes = kind, .partners = parse_selection(right)};
    } catch (const SelectionError&) {
      continue;  // "to" may be part of a range, as in "resid 5 to 10"
    }
  }
  if (kind == RepresentationRequest::Kind::hydrogen_bonds) return {.atoms = parse_selection(text), .shapes = kind};
  throw RequestError(in_quotes(text) + " is not EXPR to EXPR, such as 'ligand to resid 25'");
}

ColorScheme scheme_of(const FigureObjectRequest& request, const Structure& structure, std::size_t shown,
                      const ColorScheme& scheme) {
  ColorScheme own = request.color ? *request.color : scheme;
  if (request.is_dashed() && !request.color) {
    own.by = ColorScheme::By::fixed;
    own.fixed = kDashColor;
    own.rules.clear();
  }
  if (request.is_companion && own.by != ColorScheme::By::element && own.by != ColorScheme::By::element_cpk) {
    // Carbon of a colour that no chain has keeps ligands apart from the surface.
    static const ColorRule kCarbon = parse_color_rule("element C=#45a878");
    own.by = ColorScheme::By::element_cpk;
    own.rules.insert(own.rules.begin(), kCarbon);
  }
  if (request.color && own.uses_file()) own.set_numbers(scheme.file);
  if (request.color && request.shapes) own.by = scheme_of_shapes(own.by, *request.shapes);
  if (!request.color)
    own = request.shapes ? extras_scheme(structure, shown, std::move(own), *request.shapes)
                         : with_scale_of(structure, shown, std::move(own));
  own.opacities = request.opacities;
  return own;
}

namespace {

void color_surface(const FigureObjectRequest& request, const Structure& all, const ColorScheme& scheme,
                   SurfaceObject& object) {
  object.coloring = color_object(all, object.atom, scheme, 0);
  if (!request.show) return;
  std::vector<SurfaceObject> one;
  one.push_back(std::move(object));
  hide(hidden_atoms(*request.show, all), one);
  object = std::move(one.front());
}

}  // namespace

const FigureObjectRequest& request_of(std::span<const FigureObjectRequest> objects, std::size_t n) {
  static const FigureObjectRequest kCompanions{
      .atoms = parse_selection("ligand or ion"), .shapes = RepresentationRequest::Kind::sticks, .is_companion = true};
  return n < objects.size() ? objects[n] : kCompanions;
}

std::vector<FigureObjectRequest> all_requests(std::span<const FigureObjectRequest> objects,
                                              const Structure& structure) {
  std::vector<FigureObjectRequest> all(objects.begin(), objects.end());
  if (structure.companions == Companions::drawn) all.push_back(request_of(objects, objects.size()));
  return all;
}

void mark_atoms(std::span<const FigureObjectRequest> objects, ReadOptions& reading) {
  if (!objects.empty() && reading.copy_mode == CopyMode::instances)
    throw RequestError(message("@instances@: copies of one surface cannot be drawn with other objects; leave it out"));
  for (const FigureObjectRequest& object : objects) {
    reading.shown.push_back({object.option(), object.atoms, object.shapes && draws_each_atom(*object.shapes)});
    if (object.partners) reading.shown.push_back({object.option(), *object.partners});
    if (object.shapes == RepresentationRequest::Kind::backbone ||
        (object.color && object.color->uses(ColorScheme::By::secondary)))
      reading.secondary_structure = true;
  }
  if (reading.shown.size() > kMostShown)
    throw RequestError(
        message("@object@: at most {} sets of atoms can be drawn in addition to the surface", kMostShown));
}

std::vector<FigureObject> make_objects(std::span<const FigureObjectRequest> objects, const Structure& structure,
                                       std::size_t first_mark, const ColorScheme& scheme) {
  std::vector<FigureObject> made;
  if (objects.empty() && structure.companions != Companions::drawn) return made;
  const Structure all = structure_of_shown(structure);
  std::size_t mark = first_mark;
  for (const FigureObjectRequest& request : objects) {
    const std::vector<bool> selected = marked_atoms(all, mark++);
    FigureObject& object = made.emplace_back();
    if (request.is_dashed())
      add_dashes(request, all, selected, request.partners ? marked_atoms(all, mark++) : std::vector<bool>(), object);
    else if (request.shapes)
      object.shapes.shapes = shapes_of_atoms(
          all, *request.shapes, selected, *structure.shown_bonds,
          {*request.shapes == RepresentationRequest::Kind::backbone ? std::nullopt : request.radius, request.radius});
    else
      object.surface = surface_of(request, all, selected);
    object.cut_atoms = cut_atoms(request.cuts, structure);
  }
  if (structure.companions == Companions::drawn) {
    Shapes& shapes = made.emplace_back().shapes.shapes;
    shapes = sticks(all, marked_atoms(all, kCompanionSticks), *structure.shown_bonds, kCompanionRadius);
    append(shapes, spheres(all, marked_atoms(all, kCompanionSpheres)));
  }
  color_objects(objects, structure, scheme, made);
  return made;
}

void color_objects(std::span<const FigureObjectRequest> requests, const Structure& structure, const ColorScheme& scheme,
                   std::vector<FigureObject>& objects) {
  if (objects.empty()) return;
  const Structure all = structure_of_shown(structure);
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const FigureObjectRequest& request = request_of(requests, n);
    const ColorScheme own = scheme_of(request, structure, all.atoms.size(), scheme);
    if (objects[n].surface)
      color_surface(request, all, own, *objects[n].surface);
    else
      objects[n].shapes.coloring = color_atoms(all, own);
  }
}

std::vector<Ball> balls_of(const FigureObject& object) {
  return object.surface ? object.surface->surface.atoms : balls_around(object.shapes.shapes);
}

PictureObject picture_object(const FigureObject& object, const FigureObjectRequest& request, const Camera& camera,
                             std::span<const Ball> balls) {
  PictureObject shown;
  shown.material = request.material;
  if (!object.surface) {
    shown.shapes = &object.shapes.shapes;
    shown.coloring = &object.shapes.coloring;
    return shown;
  }
  shown.surface = &object.surface->surface;
  shown.coloring = &object.surface->coloring;
  shown.cap = request.cap;
  shown.thickens = request.thickens;
  std::vector<Ball> own;
  if (uses_atoms(request.cuts)) own = shown_balls(shown.surface->atoms, *shown.coloring);
  shown.clip = clip_planes(request.cuts, object.cut_atoms, {camera, balls, own});
  return shown;
}

}  // namespace meniscus
