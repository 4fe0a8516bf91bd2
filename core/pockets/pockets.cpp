// SPDX-License-Identifier: BSD-3-Clause
// Builds the filled solid of a large probe, finds the cells for a small probe in it, and measures the pockets that they
// make and their mouths.
#include "core/pockets/pockets.h"

#include <iterator>

#include <glm/vector_relational.hpp>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/union_find.h"
#include "core/queries/surface_parts.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"

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
  /// overlaps one in a pocket; all others change nothing about the pockets.
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
  double clearance_;  // Å; distance of the small probe's centre from the large one's
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

Hull::Hull(Surface surface) : whole_(std::move(surface)), anywhere_(whole_) {
  const std::vector<bool> reached = reached_from_outside(whole_);
  for (std::size_t c = 0; c < reached.size(); ++c)
    if (reached[c]) volume_ += whole_.components[c].volume;
  if (std::ranges::find(reached, false) == reached.end()) return;
  part_ = part_of(whole_, reached).surface;
  outside_.emplace(*part_);
}

// If a probe may be at the point, it gets to the nearest place where it touches an atom without leaving such places. If
// that is not a place of the outside, the point lies in a cavity.
double Hull::to_probe(const glm::dvec3& point) const {
  const bool in_sas = anywhere_.in_sas(point);
  if (!outside_) return in_sas ? anywhere_.to_probe(point) : 0.0;
  const double outside = outside_->to_probe(point);
  return in_sas || anywhere_.to_probe(point) < outside ? outside : 0.0;
}

namespace {

/// Adds the wanted centres of fixed probes.
void add_fixed(const Surface& s, const NearWanted& wanted, std::vector<glm::dvec3>& places) {
  for (const ConcavePatch& patch : s.concave)
    if (wanted(patch.center, 0.0)) places.push_back(patch.center);
}

/// Adds wanted places along arcs, at most `step` (Å) apart.
void add_on_arcs(const Surface& s, double step, const NearWanted& wanted, std::vector<glm::dvec3>& places) {
  for (const ToroidalPatch& t : s.toroidal) {
    if (!wanted(t.center, t.radius)) continue;
    const auto count = static_cast<std::size_t>(std::ceil(t.sweep * t.radius / step));
    const glm::dvec3 across = glm::cross(t.axis, t.start);
    for (std::size_t n = t.free() ? 0 : 1; n < count; ++n) {
      const double angle = t.sweep * static_cast<double>(n) / static_cast<double>(count);
      const glm::dvec3 place = t.center + t.radius * (std::cos(angle) * t.start + std::sin(angle) * across);
      if (wanted(place, 0.0)) places.push_back(place);
    }
  }
}

/// Returns the first direction of a spiral of `count` directions that may lie above a height over a sphere's centre;
/// all later ones are higher.
std::size_t first_above(double height, double radius, std::size_t count) {
  const double n = 0.5 * (height / radius + 1.0) * static_cast<double>(count) - 2.0;  // one more, for rounding
  return n <= 0.0 ? 0 : n >= static_cast<double>(count) ? count : static_cast<std::size_t>(n);
}

/// Adds wanted places on the faces of the SAS.
void add_on_faces(const Surface& s, const PlaceSteps& steps, const Box& bounds, const NearWanted& wanted,
                  std::vector<glm::dvec3>& places) {
  for (const ConvexPatch& patch : s.convex) {
    const Ball& atom = s.atoms[patch.atom];
    const double radius = atom.radius + s.probe_radius;
    if (!wanted(atom.center, radius)) continue;
    const double step = steps.on_sphere(atom.radius);
    const std::span<const Plane> planes(s.planes.data() + patch.first_plane, patch.plane_count);
    const auto count = static_cast<std::size_t>(std::ceil(4 * std::numbers::pi * std::pow(radius / step, 2)));
    // The sphere of an atom far larger than others has far more places than are wanted.
    const std::size_t end = std::min(count, first_above(bounds.high.z - atom.center.z, radius, count) + 4);
    for (std::size_t n = first_above(bounds.low.z - atom.center.z, radius, count); n < end; ++n) {
      const glm::dvec3 direction = spiral_direction(n, count), foot = atom.center + atom.radius * direction;
      if (std::ranges::all_of(planes,
                              [&](const Plane& plane) { return glm::dot(plane.normal, foot) <= plane.offset; }) &&
          wanted(atom.center + radius * direction, 0.0))
        places.push_back(atom.center + radius * direction);
    }
  }
}

/// Returns the places without those that coincide with an earlier one.
std::vector<glm::dvec3> without_doubles(const std::vector<glm::dvec3>& places) {
  const BallGrid grid(places, 1.0);
  std::vector<bool> kept(places.size(), true);
  std::vector<glm::dvec3> result;
  for (std::uint32_t n = 0; n < places.size(); ++n) {
    grid.for_each_near(places[n], kSamePlace, [&](std::uint32_t m) { kept[n] = kept[n] && (m >= n || !kept[m]); });
    if (kept[n]) result.push_back(places[n]);
  }
  return result;
}

constexpr double kFinest = 0.25, kCoarsest = 2.0;  // Å, half edges of cells and of the cubes that they come from
constexpr int kRegion = 8;                         // coarsest cubes along an edge of a region
constexpr double kRounding = 1e-6;                 // Å, far above the rounding error of coordinates

/// A cube, and the atoms that matter within it.
struct Region {
  glm::dvec3 middle;
  double half;
  std::vector<std::uint32_t> near;

  double reach() const { return half * std::numbers::sqrt3; }  // Å, from the middle to a corner
};

/// Finds the cells by dividing cubes.
class CellFinder {
 public:
  CellFinder(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance)
      : atoms_(atoms), hull_(hull), clearance_(clearance), probe_radius_(probe_radius) {}

  std::vector<Box> run() const {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Ball& atom : atoms_) {
      low = glm::min(low, atom.center);
      high = glm::max(high, atom.center);
    }
    // The hull is no larger than the convex hull of the balls.
    low -= largest_radius();
    const glm::ivec3 size = glm::ivec3(glm::ceil((high + largest_radius() - low) / (2 * kCoarsest)));
    int edge = kRegion;
    while (edge < std::max({size.x, size.y, size.z})) edge *= 2;
    std::vector<std::uint32_t> all(atoms_.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<CubeRange> regions;
    divide({low, glm::ivec3(0), size}, edge, all, regions);
    std::vector<std::vector<Box>> found(regions.size());
    tbb::parallel_for(std::size_t{0}, regions.size(),
                      [&](std::size_t n) { visit_cubes(regions[n], kRegion, regions[n].near, found[n]); });
    std::vector<Box> boxes;
    for (const std::vector<Box>& some : found) boxes.insert(boxes.end(), some.begin(), some.end());
    return boxes;
  }

 private:
  /// A range of cubes of half edge kCoarsest, counted from the low corner of the searched space.
  struct CubeRange {
    glm::dvec3 low;
    glm::ivec3 first, size;  // the first cube of the range; the number of cubes in all
    std::vector<std::uint32_t> near = {};

    glm::dvec3 middle(const glm::dvec3& cubes) const { return low + 2 * kCoarsest * (glm::dvec3(first) + cubes); }
  };

  /// Returns eighth n of a range with `edge` cubes along each axis.
  static CubeRange eighth_of(const CubeRange& corner, int edge, int n) {
    return {corner.low, corner.first + edge / 2 * glm::ivec3(n & 1, n >> 1 & 1, n >> 2), corner.size};
  }

  /// Returns the largest SAS radius (Å).
  double largest_radius() const {
    double radius = 0.0;
    for (const Ball& atom : atoms_) radius = std::max(radius, atom.radius);
    return radius + probe_radius_;
  }

  /// Divides a range into regions in which there may be cells, with the atoms near them. A ball far larger than others
  /// makes the space so large that most of it must be left out as a whole.
  void divide(const CubeRange& corner, int edge, std::span<const std::uint32_t> near,
              std::vector<CubeRange>& regions) const {
    if (glm::any(glm::greaterThanEqual(corner.first, corner.size))) return;
    const Region region = region_of(near, corner, edge, 2 * hull_.surface().probe_radius);
    if (holds_no_cell(region)) return;
    if (edge == kRegion) {
      regions.push_back(corner);
      regions.back().near = region.near;
      return;
    }
    for (int n = 0; n < 8; ++n) divide(eighth_of(corner, edge, n), edge / 2, region.near, regions);
  }

  /// Returns the region of a range with `edge` cubes along each axis, with the atoms within `away` of it.
  Region region_of(std::span<const std::uint32_t> atoms, const CubeRange& corner, int edge, double away) const {
    Region region{corner.middle(glm::dvec3(0.5 * edge)), kCoarsest * edge, {}};
    const double far = region.reach() + away + kRounding;
    std::ranges::copy_if(atoms, std::back_inserter(region.near), [&](std::uint32_t a) {
      return glm::distance(region.middle, atoms_[a].center) < atoms_[a].radius + far;
    });
    return region;
  }

  /// True if visit() would certainly find nothing in a region, for a reason that holds in all of it.
  bool holds_no_cell(const Region& region) const {
    const double reach = region.reach() + kRounding;
    for (const std::uint32_t a : region.near)
      if (glm::distance(region.middle, atoms_[a].center) < atoms_[a].radius + probe_radius_ - reach) return true;
    // If only one atom is near, a small probe that touches no atom is no farther from a large probe on that atom than
    // the difference of their radii; if no atom is near, its distance from a large one is 0. Cells extend farther by
    // the finest's diagonal.
    const double large = hull_.surface().probe_radius;
    return region.near.size() <= 1 && !hull_.has_cavities() &&
           large - probe_radius_ + 2 * kFinest * std::numbers::sqrt3 + kRounding < clearance_;
  }

  /// Visits the cubes of a range with `edge` cubes along each axis.
  void visit_cubes(const CubeRange& corner, int edge, std::span<const std::uint32_t> near,
                   std::vector<Box>& found) const {
    if (glm::any(glm::greaterThanEqual(corner.first, corner.size))) return;
    const Region region = region_of(near, corner, edge, probe_radius_);
    if (edge == 1) return visit(region, found);
    for (int n = 0; n < 8; ++n) visit_cubes(eighth_of(corner, edge, n), edge / 2, region.near, found);
  }

  /// Adds the cells of a cube, which is divided if only a part of it may belong to cells.
  void visit(const Region& cube, std::vector<Box>& found) const {
    const double reach = cube.reach();
    if (is_in_one_ball(cube)) return;
    const double away = hull_.to_probe(cube.middle);
    if (away < clearance_ - reach) return;
    if (cube.half <= kFinest || (away >= clearance_ + reach && is_in_no_ball(cube))) {
      found.push_back({cube.middle - cube.half, cube.middle + cube.half});
      return;
    }
    for (int corner = 0; corner < 8; ++corner)
      visit({cube.middle + 0.5 * cube.half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1),
             0.5 * cube.half, cube.near},
            found);
  }

  /// True if one grown ball covers the cube.
  bool is_in_one_ball(const Region& cube) const {
    return std::ranges::any_of(cube.near, [&](std::uint32_t a) {
      return glm::distance(cube.middle, atoms_[a].center) < atoms_[a].radius + probe_radius_ - cube.reach();
    });
  }

  /// True if no grown ball meets the cube.
  bool is_in_no_ball(const Region& cube) const {
    return std::ranges::all_of(cube.near, [&](std::uint32_t a) {
      return glm::distance(cube.middle, atoms_[a].center) > atoms_[a].radius + probe_radius_ + cube.reach();
    });
  }

  std::span<const Ball> atoms_;
  const Hull& hull_;
  double clearance_, probe_radius_;
};

}  // namespace

std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted) {
  std::vector<glm::dvec3> places;
  add_fixed(surface, wanted, places);
  add_on_arcs(surface, steps.on_arcs, wanted, places);
  add_on_faces(surface, steps, bounds, wanted, places);
  return without_doubles(places);
}

ProbeCells::ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance)
    : boxes_(CellFinder(atoms, probe_radius, hull, clearance).run()), tree_(boxes_) {}

Box ProbeCells::bounds(double reach) const {
  Box all = boxes_.front();
  for (const Box& box : boxes_) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  return {all.low - reach, all.high + reach};
}

bool ProbeCells::within(const glm::dvec3& point, double reach) const {
  bool found = false;
  // The tree leaves out balls that are as far away as its limit.
  tree_.nearest(point, reach + 1.0, [&](std::uint32_t n, double wanted) {
    found = found || boxes_[n].squared_distance(point) <= reach * reach;
    return found ? 0.0 : wanted;
  });
  return found;
}

}  // namespace meniscus
