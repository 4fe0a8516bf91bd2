// SPDX-License-Identifier: BSD-3-Clause
// Makes the objects of a picture from a figure, and moves their points.
#include "core/scene/figure.h"

#include "core/queries/copies.h"
#include "core/scene/renderers.h"

namespace meniscus {

std::vector<glm::dvec3> placed_ways(std::span<const SurfaceObject> objects, std::span<const glm::dvec3> atoms) {
  std::vector<glm::dvec3> ways;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const std::uint32_t atom : object.atom) ways.push_back(copy.rotation * atoms[atom]);
  return ways;
}

void PointMotion::add(const Surface& surface, std::span<const glm::dvec3> atoms) {
  Object& object = objects_.emplace_back();
  object.atoms.assign(atoms.begin(), atoms.end());
  object.surface.emplace_back(surface, atoms);
}

glm::vec2 PointMotion::at(const SeenPoint& point) const {
  if (point.atom == kNone) return glm::vec2(0.0f);
  const Object& object = objects_[point.object];
  glm::dvec3 way = (object.surface.empty() ? motion_.atoms : object.atoms)[point.atom];
  if (!object.surface.empty() && point.kind < Framebuffer::kShape)
    way = object.surface.front().at(static_cast<PatchKind>(point.kind), point.patch, point.position, point.normal);
  const glm::dvec2 change =
      place_in_picture(motion_.camera, size_, point.position + way) - place_in_picture(camera_, size_, point.position);
  return {static_cast<float>(change.x), static_cast<float>(-change.y)};
}

namespace {

/// Pictures of copies with more atoms than this are made without all copies in memory. With fewer it is not worthwhile.
constexpr std::size_t kMostMergedAtoms = 1'000'000;

constexpr const char* kNothingShown = "the surface is not shown, and there is nothing beside it";

std::size_t placed_atoms(std::span<const SurfaceObject> objects) {
  std::size_t count = 0;
  for (const SurfaceObject& object : objects)
    if (object.copies.size() > 1) count += object.copies.size() * object.surface.atoms.size();
  return count;
}

/// Replaces places in the tables of surfaces by places in the structure. surfaces: one per object in the picture,
/// nullptr for shapes.
void name_atoms(std::span<const SurfaceObject* const> surfaces, Framebuffer& picture) {
  for (std::size_t n = 0; n < picture.atom.size(); ++n) {
    if (picture.atom[n] == kNone) continue;
    const SurfaceObject* const surface = surfaces[picture.object.empty() ? 0 : picture.object[n]];
    if (surface) picture.atom[n] = surface->atom[picture.atom[n]];
  }
}

/// Replaces places in shown_atoms() by places in the file.
void name_atoms_as_the_file(const Structure& structure, Framebuffer& picture) {
  const std::size_t own = structure.atoms.size();
  for (std::uint32_t& atom : picture.atom)
    if (atom != kNone) atom = (atom < own ? structure.atoms[atom] : structure.extra_atoms[atom - own]).index;
}

}  // namespace

std::vector<Ball> FigureExtras::balls() const {
  std::vector<Ball> balls = balls_around(shapes.shapes);
  for (const FigureObject& object : objects) {
    const std::vector<Ball> own = balls_of(object);
    balls.insert(balls.end(), own.begin(), own.end());
  }
  return balls;
}

std::vector<PlaceLabel> FigureExtras::lengths() const {
  std::vector<PlaceLabel> lengths;
  for (const FigureObject& object : objects)
    lengths.insert(lengths.end(), object.lengths.begin(), object.lengths.end());
  return lengths;
}

std::vector<Ball> Figure::balls() const {
  std::vector<Ball> balls = placed_balls(molecule.objects);
  const std::vector<Ball> more = extras.balls();
  balls.insert(balls.end(), more.begin(), more.end());
  return balls;
}

void FigureRequest::mark_atoms(ReadOptions& reading) const {
  representations.mark_atoms(reading);
  meniscus::mark_atoms(objects, reading);
  reading.companions = bare ? Companions::hidden : Companions::drawn;
}

void FigureRequest::check() const {
  if (hides_surface && representations.empty() && objects.empty()) throw RequestError(kNothingShown);
}

FigureExtras make_extras(const Structure& structure, const FigureRequest& request, const ColorScheme& scheme) {
  FigureExtras extras;
  if (!request.representations.empty()) extras.shapes = shown_shapes(structure, request.representations, scheme);
  extras.objects = make_objects(request.objects, structure, request.representations.requests.size(), scheme);
  extras.cut_atoms = cut_atoms(request.cuts, structure);
  return extras;
}

void color_extras(const Structure& structure, const FigureRequest& request, const ColorScheme& scheme,
                  FigureExtras& extras) {
  if (!request.representations.empty()) extras.shapes = shown_shapes(structure, request.representations, scheme);
  color_objects(request.objects, structure, scheme, extras.objects);
}

Figure make_figure(Molecule molecule, const FigureRequest& request) {
  Figure figure;
  figure.extras = make_extras(molecule.structure, request, molecule.color);
  figure.molecule = std::move(molecule);
  return figure;
}

std::vector<ClipPlane> surface_planes(const FigureRequest& request, const CutAtoms& cut_atoms, const Camera& camera,
                                      std::span<const SurfaceObject> objects) {
  if (request.cuts.empty()) return {};
  return clip_planes(request.cuts, cut_atoms, {camera, placed_balls(objects), shown_balls(objects)});
}

namespace {

/// True if a plane that cuts the surface would also cut something drawn in addition to it.
bool lies_beyond(const FigureRequest& request, const Figure& figure, const Camera& camera) {
  const std::vector<Ball> extras = figure.extras.balls();
  const auto is_beyond = [&](const ClipPlane& plane) {
    return std::ranges::any_of(
        extras, [&](const Ball& ball) { return glm::dot(plane.normal, ball.center) + ball.radius > plane.offset; });
  };
  return std::ranges::any_of(surface_planes(request, figure.extras.cut_atoms, camera, figure.molecule.objects),
                             is_beyond);
}

}  // namespace

std::vector<std::string> ineffective_cuts(const FigureRequest& request, const Figure& figure, const Camera& camera) {
  std::vector<std::string> sentences;
  const auto of_objects = [](const FigureObjectRequest& object) { return !object.cuts.empty(); };
  if (request.cuts.empty() && std::ranges::none_of(request.objects, of_objects)) return sentences;
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  if (!request.hides_surface && !balls.empty())
    sentences = ineffective_cuts(request.cuts, figure.extras.cut_atoms,
                                 {camera, balls, shown_balls(figure.molecule.objects)}, balls);
  if (!request.cuts_all && !request.cuts.empty() && !balls.empty() && lies_beyond(request, figure, camera))
    sentences.push_back(
        message("cuts only the surface, but some sticks, balls or other objects lie beyond the plane; @clip-all@ cuts "
                "them, too"));
  for (std::size_t n = 0; n < figure.extras.objects.size(); ++n) {
    const FigureObject& object = figure.extras.objects[n];
    if (!object.surface || object.surface->surface.atoms.empty()) continue;
    const std::vector<Ball> shown = shown_balls({&*object.surface, 1});
    for (const std::string& sentence : ineffective_cuts(request_of(request.objects, n).cuts, object.cut_atoms,
                                                        {camera, balls, shown}, object.surface->surface.atoms))
      sentences.push_back(fmt::format("{}, of object {}", sentence, n + 1));
  }
  return sentences;
}

std::vector<PictureObject> picture_objects(const Surface& surface, const Coloring& coloring,
                                           const FigureRequest& request, const FigureExtras* extras,
                                           const Camera& camera, std::span<const Ball> atoms) {
  std::vector<PictureObject> shown;
  std::vector<ClipPlane> planes;
  if (!request.hides_surface || request.cuts_all) {
    std::vector<Ball> own;
    if (uses_atoms(request.cuts)) own = shown_balls(surface.atoms, coloring);
    planes = clip_planes(request.cuts, extras ? extras->cut_atoms : CutAtoms(), {camera, atoms, own});
  }
  if (!request.hides_surface) {
    PictureObject& whole = shown.emplace_back();
    whole.surface = &surface;
    whole.coloring = &coloring;
    whole.clip = planes;
    whole.cap = request.cap;
    whole.thickens = request.thickens;
  }
  const std::size_t first_extra = shown.size();
  if (extras && !extras->shapes.empty()) {
    PictureObject& shapes = shown.emplace_back();
    shapes.shapes = &extras->shapes.shapes;
    shapes.coloring = &extras->shapes.coloring;
  }
  for (std::size_t n = 0; extras && n < extras->objects.size(); ++n) {
    const FigureObject& object = extras->objects[n];
    if (object.surface || !object.shapes.empty())
      shown.push_back(picture_object(object, request_of(request.objects, n), camera, atoms));
  }
  if (shown.empty()) throw RequestError(kNothingShown);
  if (request.cuts_all)
    for (std::size_t n = first_extra; n < shown.size(); ++n)
      shown[n].clip.insert(shown[n].clip.end(), planes.begin(), planes.end());
  return shown;
}

const SurfaceObject* extra_surface(const FigureExtras& extras, const PictureObject& shown) {
  for (const FigureObject& object : extras.objects)
    if (object.surface && &object.surface->surface == shown.surface) return &*object.surface;
  return nullptr;
}

Framebuffer draw(StillRenderer& renderer, Figure figure, const FigureRequest& request, const Camera& camera,
                 const RenderSettings& settings, const Survey& survey, const FigureMotion* motion) {
  // The picture comes in bands or as a whole, depending on the renderer.
  const auto renamed = [&](const auto& render, const auto& rename, const auto& name_seen) {
    if (survey)
      survey([&](const Camera& seen_from, glm::ivec2 size) {
        RenderSettings own;
        own.size = size;
        own.aovs = true;
        Framebuffer seen = render(seen_from, own);
        rename(seen);
        return seen;
      });
    RenderSettings own = settings;
    own.name_seen = name_seen;
    if (settings.take_band)
      own.take_band = [&](Framebuffer band, int first_row) {
        rename(band);
        settings.take_band(std::move(band), first_row);
      };
    Framebuffer picture = render(camera, own);
    rename(picture);
    return picture;
  };
  std::vector<SurfaceObject>& objects = figure.molecule.objects;
  const bool opaque = std::ranges::none_of(objects, [](const SurfaceObject& o) { return o.coloring.is_translucent(); });
  // Points of copies that are not in memory have no velocities.
  if (request.plain() && opaque && !settings.motion && placed_atoms(objects) > kMostMergedAtoms) {
    return renamed([&](const Camera& seen_from,
                       const RenderSettings& own) { return renderer.render_copies(objects, seen_from, own); },
                   [&](Framebuffer& picture) {
                     for (std::uint32_t& atom : picture.atom)
                       if (atom != kNone) atom = merged_atom(objects, atom);
                     name_atoms_as_the_file(figure.molecule.structure, picture);
                   },
                   [&](std::uint32_t, std::uint32_t atom) { return merged_atom(objects, atom); });
  }
  // Planes along the view cut between the nearest atom of the molecule and its farthest.
  const std::vector<Ball> balls = request.plain() ? std::vector<Ball>{} : placed_balls(objects);
  std::vector<glm::dvec3> ways;
  if (settings.motion) ways = placed_ways(objects, motion->atoms);
  const SurfaceObject whole = merged(std::move(objects));
  std::vector<const SurfaceObject*> surfaces;
  return renamed(
      [&](const Camera& seen_from, RenderSettings own) {
        const std::vector<PictureObject> shown =
            picture_objects(whole.surface, whole.coloring, request, &figure.extras, seen_from, balls);
        surfaces.clear();
        for (const PictureObject& object : shown)
          surfaces.push_back(object.surface == &whole.surface ? &whole : extra_surface(figure.extras, object));
        std::optional<PointMotion> moving;
        if (own.motion) {
          moving.emplace(*motion, seen_from, own.size);
          for (const SurfaceObject* const surface : surfaces)
            surface ? moving->add(surface->surface, surface == &whole ? ways : placed_ways({surface, 1}, motion->atoms))
                    : moving->add_shapes();
          own.move = [&](const SeenPoint& point) { return moving->at(point); };
        }
        return renderer.render(shown, seen_from, own);
      },
      [&](Framebuffer& picture) {
        name_atoms(surfaces, picture);
        name_atoms_as_the_file(figure.molecule.structure, picture);
      },
      [&](std::uint32_t object, std::uint32_t atom) {
        return surfaces[object] && atom != kNone ? surfaces[object]->atom[atom] : atom;
      });
}

}  // namespace meniscus
