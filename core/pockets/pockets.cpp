// SPDX-License-Identifier: BSD-3-Clause
// Finds the pockets of a molecule, measures them and their mouths, and tells which pocket a point lies in.
#include "core/pockets/pockets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/union_find.h"
#include "core/pockets/hull.h"
#include "core/queries/surface_parts.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

/// Returns how dense places of the large probe must be so that a small probe's centre x that is kept from it by
/// `clearance`, and touches no atom, is kept from all places by clearance - tolerance. Let y be the place nearest to x,
/// at the distance D.
///  * If y is on an arc or a sphere with a place z next to it, which bulges towards x: |x - z|² <= D² + |y - z|².
///  * If y touches atom a alone, x lies on the line to its centre, so it overlaps a unless D <= R - r, or D is larger
///    than 2 r_a + R + r. Places on such spheres therefore need only keep out what is between the hull and the large
///    probe.
/// A point of a face has a place of the sphere within 0.77 of its step, or beyond the face's border, which is nearer
/// then and has a place half a step away.
PlaceSteps place_steps(const PocketRequest& request, double clearance) {
  const double R = request.large_probe_radius, r = request.probe_radius, trim = request.trim;
  const double least = std::max(0.0, clearance - request.tolerance);
  const double near = std::sqrt(clearance * clearance - least * least);
  const double far = std::max(near, std::sqrt(clearance * clearance - (R - r) * (R - r)));
  const double half_step = 0.7 * near;
  return {2 * half_step,
          [=](double atom_radius) { return ((trim < 2 * atom_radius ? far : near) - half_step) / 0.77; }};
}

/// A pocket before it is cut out of the surface.
struct Part {
  Cavity cavity;
  std::vector<std::uint32_t> components;  // its own component, then the components that float in it
};

/// Finds the pockets as cavities of a surface with closed mouths.
class PocketFinder {
 public:
  PocketFinder(std::span<const Ball> atoms, const PocketRequest& request, const ComputeSurface& compute)
      : atoms_(atoms),
        request_(request),
        compute_(compute),
        clearance_(request.large_probe_radius + request.trim + request.probe_radius),
        hull_(closed_surface(request.large_probe_radius)),
        cells_(atoms, request.probe_radius, hull_, clearance_ - request.tolerance - kSamePlace) {}

  Pockets run() {
    found_.request = request_;
    found_.between_volume = hull_.volume() - closed_surface(request_.probe_radius).volume;
    if (cells_.count() == 0) return std::move(found_);
    close_mouths();
    const std::vector<Part> parts = list_parts();
    found_.pockets.resize(parts.size());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t n) { found_.pockets[n] = pocket_of(parts[n]); });
    return std::move(found_);
  }

 private:
  /// Returns the closed surface of the molecule for a probe radius (Å).
  Surface closed_surface(double probe_radius) const {
    Surface surface = compute_(atoms_, probe_radius);
    require_closed(surface);
    return surface;
  }

  /// Computes the surface with closed mouths. It has the balls that can touch a probe in a pocket, or a probe that
  /// overlaps such a one; all others change nothing about the pockets.
  void close_mouths() {
    const double r = request_.probe_radius;
    std::vector<Ball> balls;
    for (std::uint32_t a = 0; a < atoms_.size(); ++a) {
      if (!cells_.within(atoms_[a].center, atoms_[a].radius + 3 * r)) continue;
      balls.push_back(atoms_[a]);
      atom_.push_back(a);
    }
    first_probe_ = static_cast<std::uint32_t>(balls.size());
    for (const glm::dvec3& place : probe_places(
             hull_.surface(), place_steps(request_, clearance_), cells_.bounds(clearance_ + 2 * r),
             [&](const glm::dvec3&point, double reach) { return cells_.within(point, clearance_ + 2 * r + reach); }))
      balls.push_back({place, request_.large_probe_radius + request_.trim});
    atom_.resize(balls.size(), kNone);
    found_.probe_count = balls.size() - first_probe_;
    found_.surface = compute_(balls, r);
    if (!found_.surface.certificate.closed)
      throw OpenSurfaceError(
          message("the surface of {} atoms and of {} large probes around them is not closed; try another "
                  "@mouth-tolerance@, and please report this structure",
                  first_probe_, found_.probe_count));
  }

  /// Returns the pockets, the largest first. A bounded part of the solvent is a pocket if probes in it are where
  /// pockets can be; elsewhere balls are missing.
  std::vector<Part> list_parts() const {
    const Surface& s = found_.surface;
    const std::vector<Cavity> cavities = cavities_of(s);
    std::vector<Part> parts;
    std::size_t next = 0;
    for (std::uint32_t c = 0; c < s.components.size(); ++c) {
      if (s.components[c].kind != ComponentKind::cavity) continue;
      const Cavity& cavity = cavities[next++];
      if (cells_.within(cavity.probes.front(), 0.0)) parts.push_back({cavity, {c}});
    }
    add_islands(parts);
    std::erase_if(parts, [&](const Part& part) { return part.cavity.volume < request_.min_volume; });
    std::ranges::stable_sort(parts, std::greater(), [](const Part& part) { return part.cavity.volume; });
    return parts;
  }

  /// Adds atoms that float in a pocket, and takes their volume from it.
  void add_islands(std::vector<Part>& parts) const {
    const Surface& s = found_.surface;
    const std::vector<bool> reached = reached_from_outside(s);
    for (std::uint32_t c = 0; c < s.components.size(); ++c) {
      if (reached[c] || s.components[c].kind != ComponentKind::outer) continue;
      const std::vector<std::uint32_t> atoms = atoms_of(c);
      Part* enclosing = nullptr;
      for (Part& part : parts)
        if (winding_number(s, part.components.front(), s.atoms[atoms.front()].center) != 0 &&
            (!enclosing || part.cavity.volume < enclosing->cavity.volume))
          enclosing = &part;
      if (!enclosing) continue;
      enclosing->components.push_back(c);
      enclosing->cavity.volume -= s.components[c].volume;
      enclosing->cavity.area += s.components[c].area;
      enclosing->cavity.atoms.insert(enclosing->cavity.atoms.end(), atoms.begin(), atoms.end());
    }
  }

  /// Returns the atoms with a contact patch on the component. An outer one has some (components.h).
  std::vector<std::uint32_t> atoms_of(std::uint32_t component) const {
    std::vector<std::uint32_t> atoms;
    for (const ConvexPatch& patch : found_.surface.convex)
      for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
        if (found_.surface.faces[f].component == component && (atoms.empty() || atoms.back() != patch.atom))
          atoms.push_back(patch.atom);
    return atoms;
  }

  /// Cuts a pocket out of the surface, and measures it.
  Pocket pocket_of(const Part& part) const {
    Pocket pocket;
    pocket.cavity = part.cavity;
    pocket.cavity.atoms.clear();
    for (const std::uint32_t a : part.cavity.atoms)
      if (a < first_probe_) pocket.cavity.atoms.push_back(atom_[a]);
    std::ranges::sort(pocket.cavity.atoms);
    for (const glm::dvec3& probe : part.cavity.probes)
      pocket.depth = std::max(pocket.depth, hull_.to_probe(probe) - request_.large_probe_radius);
    std::vector<bool> keep(found_.surface.components.size(), false);
    for (const std::uint32_t c : part.components) keep[c] = true;
    SurfacePart cut = part_of(found_.surface, keep);
    std::vector<bool> is_probe;
    for (const std::uint32_t a : cut.atom) {
      is_probe.push_back(a >= first_probe_);
      pocket.atom.push_back(atom_[a]);
    }
    pocket.surface = std::move(cut.surface);
    pocket.mouth_areas =
        mouth_areas(pocket.surface, is_probe, 2 * std::numbers::pi * request_.probe_radius * request_.tolerance);
    return pocket;
  }

  std::span<const Ball> atoms_;
  const PocketRequest& request_;
  const ComputeSurface& compute_;
  double clearance_;  // Å, of the small probe's centre from the large one's
  Hull hull_;
  ProbeCells cells_;
  std::uint32_t first_probe_ = 0;
  std::vector<std::uint32_t> atom_;  // per ball of found_.surface: index of the given atom; kNone: a large probe
  Pockets found_;
};

}  // namespace

double Pocket::mouth_area() const { return std::accumulate(mouth_areas.begin(), mouth_areas.end(), 0.0); }

const char* Pocket::kind() const {
  return mouth_areas.empty() ? "cavity" : mouth_areas.size() == 1 ? "pocket" : "tunnel";
}

std::string pocket_fault(const PocketRequest& request) {
  if (!(request.probe_radius > 0.0))
    return message("@probe@: give a radius above 0 Å; pockets are the space that the probe fills");
  if (!(request.large_probe_radius > request.probe_radius))
    return message("@large-probe@: {} Å must be above the small probe's {} Å; pockets lie between the two",
                   request.large_probe_radius, request.probe_radius);
  if (!(request.trim >= 0.0)) return message("@trim@: {} Å is negative; give 0 or more", request.trim);
  if (!(request.tolerance > 0.0)) return message("@mouth-tolerance@: {} Å; give a number above 0", request.tolerance);
  return {};
}

Pockets find_pockets(std::span<const Ball> atoms, const PocketRequest& request, const ComputeSurface& compute) {
  if (const std::string fault = pocket_fault(request); !fault.empty()) throw RequestError(fault);
  return PocketFinder(atoms, request, compute).run();
}

namespace {

/// Returns true for each face that touches large probes only.
std::vector<bool> faces_of_mouths(const Surface& s, const std::vector<bool>& is_probe) {
  const auto probe = [&](std::uint32_t atom) -> bool { return is_probe[atom]; };
  std::vector<bool> of_mouth(s.faces.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const std::uint32_t patch = s.faces[f].patch;
    switch (s.faces[f].kind) {
      case PatchKind::convex:
        of_mouth[f] = probe(s.convex[patch].atom);
        break;
      case PatchKind::toroidal:
        of_mouth[f] = std::ranges::all_of(s.toroidal[patch].atom, probe);
        break;
      case PatchKind::concave: {
        const auto first = s.contacts.begin() + s.concave[patch].first_contact;
        of_mouth[f] = std::all_of(first, first + s.concave[patch].contact_count, probe);
        break;
      }
    }
  }
  return of_mouth;
}

}  // namespace

std::vector<double> mouth_areas(const Surface& s, const std::vector<bool>& is_probe, double least) {
  const std::vector<bool> of_mouth = faces_of_mouths(s, is_probe);
  if (std::ranges::find(of_mouth, true) == of_mouth.end()) return {};
  UnionFind mouths(s.faces.size());
  for (const Border& border : s.borders)
    if (of_mouth[border.face[0]] && of_mouth[border.face[1]]) mouths.unite(border.face[0], border.face[1]);
  for (const ConvexPatch& patch : s.convex)
    for (std::uint32_t n = 1; n < patch.face_count && is_probe[patch.atom]; ++n)
      mouths.unite(patch.first_face, patch.first_face + n);

  std::vector<double> of_probes_alone(s.faces.size(), 0.0), area(s.faces.size(), 0.0);
  for (std::uint32_t f = 0; f < s.faces.size(); ++f)
    if (of_mouth[f]) of_probes_alone[mouths.find(f)] += s.faces[f].area;
  const std::vector<double> by_atom = atom_areas(s).surface;
  for (const ConvexPatch& patch : s.convex)
    if (is_probe[patch.atom]) area[mouths.find(patch.first_face)] += by_atom[patch.atom];
  std::vector<double> areas;
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    if (of_probes_alone[f] > least) areas.push_back(area[f]);
  std::ranges::sort(areas, std::greater());
  return areas;
}

PocketLocator::PocketLocator(const Pockets& pockets) : probe_radius_(pockets.request.probe_radius) {
  if (pockets.pockets.empty()) return;
  anywhere_.emplace(pockets.surface);
  for (const Pocket& pocket : pockets.pockets) each_.emplace_back(pocket.surface);
}

// If a probe may be at the point, the nearest place where it touches something is one of its own pocket. Elsewhere the
// point lies in the pockets with probes that are near enough. Distances to places of one pocket equal those to places
// of all pockets to the last digit, as they come from the same numbers.
std::optional<std::size_t> PocketLocator::operator()(const glm::dvec3& point) const {
  if (!anywhere_) return std::nullopt;
  const bool in_sas = anywhere_->in_sas(point);
  const double nearest = anywhere_->to_probe(point);
  if (in_sas && nearest >= probe_radius_) return std::nullopt;
  for (std::size_t n = 0; n < each_.size(); ++n)
    if (const double distance = each_[n].to_probe(point); in_sas ? distance < probe_radius_ : distance <= nearest)
      return n;
  return std::nullopt;
}

}  // namespace meniscus
