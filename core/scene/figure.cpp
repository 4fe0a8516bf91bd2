// SPDX-License-Identifier: BSD-3-Clause
// Merges what can be merged, and gives the renderer the rest as objects.
#include "core/scene/figure.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/queries/combine.h"

namespace meniscus {
namespace {

/// Of copies with more atoms than this a picture is made without having all of them in memory: with fewer it would
/// not pay.
constexpr std::size_t kMostMergedAtoms = 1'000'000;

std::size_t placed_atoms(std::span<const SurfaceObject> objects) {
  std::size_t count = 0;
  for (const SurfaceObject& object : objects)
    if (object.copies.size() > 1) count += object.copies.size() * object.surface.atoms.size();
  return count;
}

/// From places in the surface's tables to those in the structure.
void name_atoms(const SurfaceObject& whole, Framebuffer& picture) {
  for (std::size_t n = 0; n < picture.atom.size(); ++n)
    if (picture.atom[n] != kNone && (picture.object.empty() || picture.object[n] == 0))
      picture.atom[n] = whole.atom[picture.atom[n]];
}

}  // namespace

std::vector<Ball> Figure::balls() const {
  std::vector<Ball> balls = placed_balls(molecule.objects);
  const std::vector<Ball> more = balls_around(shapes.shapes);
  balls.insert(balls.end(), more.begin(), more.end());
  return balls;
}

Figure make_figure(Molecule molecule, const FigureRequest& request) {
  Figure figure;
  if (!request.representations.empty())
    figure.shapes = shown_shapes(molecule.structure, request.representations, molecule.color);
  figure.molecule = std::move(molecule);
  return figure;
}

Framebuffer draw(SurfaceRenderer& renderer, Figure figure, const FigureRequest& request, const Camera& camera,
                 const RenderSettings& settings) {
  std::vector<SurfaceObject>& objects = figure.molecule.objects;
  const bool opaque = std::ranges::none_of(objects, [](const SurfaceObject& o) { return o.coloring.is_translucent(); });
  if (request.plain() && opaque && placed_atoms(objects) > kMostMergedAtoms) {
    Framebuffer picture = renderer.render_copies(objects, camera, settings);
    for (std::uint32_t& atom : picture.atom)
      if (atom != kNone) atom = merged_atom(objects, atom);
    return picture;
  }
  const std::vector<Ball> balls = request.cuts.empty() ? std::vector<Ball>{} : placed_balls(objects);
  const SurfaceObject whole = merged(std::move(objects));
  std::vector<PictureObject> shown(1);
  shown[0].surface = &whole.surface;
  shown[0].coloring = &whole.coloring;
  shown[0].cap = request.cap;
  shown[0].thickens = request.thickens;
  for (const Cut& cut : request.cuts) shown[0].clip.push_back(clip_plane(cut, camera, balls));
  if (!figure.shapes.empty()) {
    PictureObject& beside = shown.emplace_back();
    beside.shapes = &figure.shapes.shapes;
    beside.coloring = &figure.shapes.coloring;
  }
  Framebuffer picture = renderer.render(shown, camera, settings);
  name_atoms(whole, picture);
  return picture;
}

}  // namespace meniscus
