// SPDX-License-Identifier: BSD-3-Clause
// Chooses the balls that a camera is aimed at.
#include "core/scene/view_aim.h"

#include <tuple>

#include "core/camera/open_side.h"
#include "core/queries/copies.h"
#include "core/structure/superposition.h"

namespace meniscus {
namespace {

std::vector<Ball> picked(std::span<const Ball> balls, const std::vector<bool>& of_atom) {
  if (of_atom.empty()) return {balls.begin(), balls.end()};
  std::vector<Ball> result;
  for (std::size_t n = 0; n < balls.size(); ++n)
    if (of_atom[n]) result.push_back(balls[n]);
  return result;
}

/// Returns the balls of the picked atoms, for every copy of every object.
std::vector<Ball> picked(std::span<const SurfaceObject> objects, const std::vector<bool>& of_atom) {
  std::vector<Ball> result;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (std::size_t n = 0; n < object.surface.atoms.size(); ++n)
        if (of_atom.empty() || of_atom[object.atom[n]])
          result.push_back({copy(object.surface.atoms[n].center), object.surface.atoms[n].radius});
  return result;
}

/// Returns the motions of the copies of an assembly, found from the atoms that they share with the first.
std::vector<RigidMotion> copy_motions(const Structure& structure) {
  std::vector<RigidMotion> motions;
  for (const Instances& instances : structure.instances)
    if (instances.motions.size() > motions.size()) motions = instances.motions;
  std::unordered_map<std::uint32_t, glm::dvec3> first;  // key: place in the file
  std::map<std::uint32_t, std::vector<const Atom*>> copies;
  for (const Atom& atom : structure.atoms) {
    if (atom.copy == 0) first.emplace(atom.index, atom.position);
    copies[atom.copy].push_back(&atom);
  }
  if (copies.size() < 2) return motions;
  for (const auto& [copy, atoms] : copies) {
    std::vector<glm::dvec3> here, there;
    std::vector<std::uint32_t> all;
    for (const Atom* atom : atoms) {
      const auto same = first.find(atom->index);
      if (same == first.end()) continue;
      all.push_back(static_cast<std::uint32_t>(here.size()));
      here.push_back(same->second);
      there.push_back(atom->position);
    }
    if (all.size() >= 3) motions.push_back(superposition(there, here, all));
  }
  return motions;
}

}  // namespace

ViewAim::ViewAim(const ViewRequest& request, const std::optional<Selection>& show, const Structure& structure) {
  if (show) {
    shown_ = hidden_atoms(*show, structure);
    shown_.flip();
  }
  framed_ = shown_;
  for (std::size_t a = 0; a < framed_.size(); ++a) framed_[a] = framed_[a] || is_drawn_beside(structure.atoms[a]);
  for (const Atom& atom : structure.extra_atoms) frames_extra_.push_back(is_drawn_beside(atom));
  frames_all_ = !request.zoom_to;
  if (request.zoom_to) {
    const std::vector<Atom> atoms = shown_atoms(structure);
    framed_ = request.zoom_to->evaluate(atoms);
    if (std::ranges::find(framed_, true) == framed_.end())
      throw RequestError(message("@zoom-to {}@: selects none of the {} atoms that are shown; {}",
                                 in_quotes(request.zoom_to->text()), with_thousands(atoms.size()),
                                 request.zoom_to->why_none(atoms)));
    const auto first_extra = framed_.begin() + static_cast<std::ptrdiff_t>(structure.atoms.size());
    frames_extra_.assign(first_extra, framed_.end());
    framed_.erase(first_extra, framed_.end());
  }
  extra_balls_ = framed_extras(structure);
  if (request.camera_file.empty()) forward_ = clear_side(structure);
  using Axes = ViewDirection::Frame;
  if (request.direction && request.direction->frame == Axes::open && !request.zoom_to)
    throw RequestError(message("@view open@ looks at the atoms of @zoom-to@; add it"));
  if (!request.direction ||
      (request.direction->frame != Axes::symmetry && request.direction->frame != Axes::symmetry_side))
    return;
  symmetry_ = symmetry_axis(copy_motions(structure));
  if (!symmetry_)
    throw RequestError(
        message("@view symmetry@: there is no axis: build an assembly whose copies are turned (@assembly@), or choose "
                "another side"));
}

std::vector<Ball> ViewAim::framed_extras(const Structure& structure) const {
  std::vector<Ball> balls;
  for (std::size_t n = 0; n < structure.extra_atoms.size(); ++n)
    if (frames_extra_[n]) balls.push_back({structure.extra_atoms[n].position, structure.extra_atoms[n].radius});
  return balls;
}

ViewedAtoms ViewAim::viewed(const Figure& figure) const {
  ViewedAtoms seen = viewed(figure.molecule.objects);
  if (!frames_all_) return seen;
  const std::vector<Ball> drawn = figure.extras.balls();
  seen.framed.insert(seen.framed.end(), drawn.begin(), drawn.end());
  return seen;
}

ViewedAtoms ViewAim::viewed(std::span<const SurfaceObject> objects) const {
  const std::vector<Ball> all = placed_balls(objects);
  if (shown_.empty() && framed_.empty() && extra_balls_.empty()) return {all, all};
  std::vector<Ball> shown = picked(objects, shown_), framed = picked(objects, framed_);
  // The selected atoms may belong to a part of the surface that was dropped (--cavities).
  if (shown.empty()) shown = all;
  for (std::vector<Ball>* const balls : {&shown, &framed})
    balls->insert(balls->end(), extra_balls_.begin(), extra_balls_.end());
  if (framed.empty()) framed = shown;
  return {shown, framed};
}

Camera ViewAim::camera(const ViewRequest& layout, const std::optional<Camera>& given, const ViewedAtoms& seen) const {
  return view_camera(layout, given, viewed_balls(seen.shown, seen.framed));
}

Camera ViewAim::camera(const ViewRequest& layout, const std::optional<Camera>& given,
                       std::span<const Ball> balls) const {
  const std::vector<Ball> shown = picked(balls, shown_), framed = picked(balls, framed_);
  return view_camera(layout, given, viewed_balls(shown, framed));
}

std::optional<glm::dvec3> ViewAim::clear_side(const Structure& structure) const {
  if (!structure.instances.empty()) return {};
  using Group = std::tuple<std::int32_t, std::uint32_t, std::string_view, std::uint32_t>;
  std::map<Group, std::uint32_t> groups;
  std::vector<Ball> balls;
  std::vector<std::uint32_t> group;
  const auto add = [&](const Atom& atom) {
    balls.push_back({atom.position, atom.radius});
    const bool polymer = atom.kind == AtomClass::polymer;
    if (!polymer && atom.kind != AtomClass::ligand) return group.push_back(kCountedGroups);
    const auto next = std::min(static_cast<std::uint32_t>(groups.size()), kCountedGroups);
    group.push_back(
        groups.try_emplace({atom.model, atom.copy, atom.chain, polymer ? 0 : atom.residue + 1}, next).first->second);
  };
  for (std::size_t a = 0; a < structure.atoms.size(); ++a)
    if (shown_.empty() || shown_[a]) add(structure.atoms[a]);
  for (const Atom& atom : structure.extra_atoms)
    if (is_drawn_beside(atom)) add(atom);
  if (groups.size() < 2) return {};
  const ViewBasis broad = broad_side(balls);
  return shows_more_behind(broad, balls, group) ? -broad.forward : broad.forward;
}

std::vector<Ball> ViewAim::shown(const Structure& structure) const { return standing_balls(structure, shown_); }

std::vector<Ball> ViewAim::framed(const Structure& structure) const {
  std::vector<Ball> balls = standing_balls(structure, framed_);
  const std::vector<Ball> extras = framed_extras(structure);
  balls.insert(balls.end(), extras.begin(), extras.end());
  return balls;
}

PictureFit picture_fit(Camera camera, glm::ivec2 size, int height, std::span<const Ball> balls, glm::ivec2 margin) {
  const ViewBasis basis = view_basis(camera);
  const double focus = glm::distance(camera.position, camera.target);
  glm::dvec2 reach(0.0);  // distance from the middle of the picture, Å at the target
  for (const Ball& ball : balls) {
    const glm::dvec3 to = ball.center - camera.position;
    const auto edge = [&](double side, double depth) {
      if (camera.projection == Projection::orthographic) return side + ball.radius;
      return focus * std::tan(std::atan2(side, depth) + std::asin(ball.radius / std::hypot(side, depth)));
    };
    const double depth = glm::dot(to, basis.forward);
    reach.x = std::max(reach.x, edge(std::abs(glm::dot(to, basis.right)), depth));
    reach.y = std::max(reach.y, edge(std::abs(glm::dot(to, basis.up)), depth));
  }
  reach /= angstroms_per_pixel(camera, size);
  const double zoom = std::max(1.0, size.x - 2.0 * margin.x) / (2.0 * reach.x), share = height / (zoom * size.y);
  const double half = camera.vertical_fov * std::numbers::pi / 360.0;
  camera.vertical_fov = 360.0 / std::numbers::pi * std::atan(std::tan(half) * share);
  camera.height *= share;
  return {camera, static_cast<int>(std::lround(2.0 * zoom * reach.y)) + 2 * margin.y};
}

bool sees_nothing(const Camera& camera, double aspect, const Structure& structure, double probe) {
  const std::vector<Ball> balls = balls_of(structure);
  if (structure.instances.empty()) return sees_nothing(camera, aspect, balls, probe);
  for (const Instances& instances : structure.instances) {
    for (const RigidMotion& motion : instances.motions) {
      std::vector<Ball> copy;
      for (const std::uint32_t atom : instances.atoms) copy.push_back({motion(balls[atom].center), balls[atom].radius});
      if (!sees_nothing(camera, aspect, copy, probe)) return false;
    }
  }
  return true;
}

}  // namespace meniscus
