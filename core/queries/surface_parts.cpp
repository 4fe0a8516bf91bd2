// SPDX-License-Identifier: BSD-3-Clause
// Copies the components of a surface that are kept, joins the shares of chosen atoms that meet, and computes properties
// of points in closed form.
#include "core/queries/surface_parts.h"

#include <cassert>
#include <initializer_list>
#include <iterator>

#include "core/math/double_geometry.h"
#include "core/math/union_find.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "core/surface/trim.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// Maps old rows to new ones, which are numbered in the order of their first use.
class Renumbering {
 public:
  explicit Renumbering(std::size_t count) : number_(count, kNone) {}

  std::uint32_t operator()(std::uint32_t old) {
    if (old == kNone) return kNone;
    if (number_[old] == kNone) {
      number_[old] = static_cast<std::uint32_t>(order_.size());
      order_.push_back(old);
    }
    return number_[old];
  }
  /// Returns the new row of an old one, kNone if it is not used.
  std::uint32_t known(std::uint32_t old) const { return old == kNone ? kNone : number_[old]; }
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  std::vector<std::uint32_t> number_, order_;
};

/// Copies some components of a surface into tables of their own.
class PartBuilder {
 public:
  PartBuilder(const Surface& whole, const std::vector<bool>& keep)
      : whole_(whole), keep_(keep), border_(whole.borders.size()), vertex_(whole.vertices.size()) {
    assert(keep.size() == whole.components.size());
  }

  SurfacePart run() {
    surface_.probe_radius = whole_.probe_radius;
    surface_.certificate = whole_.certificate;
    list_atoms();
    take_components();
    take_concave();
    take_toroidal();
    take_convex();
    refer_to_concave();
    take_borders();
    return std::move(part_);
  }

 private:
  /// True if the component of a face stays.
  bool is_kept(std::uint32_t face) const { return keep_[whole_.faces[face].component]; }

  /// Returns the faces of a patch that stay, or those that do not.
  template <typename Patch>
  std::vector<std::uint32_t> faces_that(bool stay, const Patch& patch) const {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      if (is_kept(f) == stay) faces.push_back(f);
    return faces;
  }

  /// Returns the faces of a patch that stay, with the planes that separate them from others.
  template <typename Patch>
  std::vector<PartedFaces> parted(const Patch& patch) const {
    const auto kept = faces_that(true, patch), dropped = faces_that(false, patch);
    if (kept.empty()) return {};
    if (dropped.empty()) return {{kept, {}}};
    return part_faces(whole_, kept, dropped);
  }

  // True if the probe radius is 0. Toroidal and concave patches then have no faces: what remains of them is the border
  // of the same number, and the probes at its ends.
  bool has_no_probe() const { return whole_.probe_radius == 0; }
  bool is_kept(std::uint32_t t, const ToroidalPatch& patch) const {
    return has_no_probe() ? is_kept(whole_.borders[t].face[0]) : !faces_that(true, patch).empty();
  }

  // Lists the atoms that the part touches, in their order.
  void list_atoms() {
    std::vector<bool> used(whole_.atoms.size(), false);
    for (const ConvexPatch& patch : whole_.convex)
      if (!faces_that(true, patch).empty()) used[patch.atom] = true;
    for (std::uint32_t t = 0; t < whole_.toroidal.size(); ++t)
      if (is_kept(t, whole_.toroidal[t]))
        for (const std::uint32_t a : whole_.toroidal[t].atom) used[a] = true;
    new_concave_.assign(whole_.concave.size(), kNone);
    needed_.assign(whole_.concave.size(), false);
    for (std::uint32_t t = 0; t < whole_.toroidal.size(); ++t)
      if (is_kept(t, whole_.toroidal[t]))
        for (const std::uint32_t probe : whole_.toroidal[t].probe)
          if (probe != kNone) needed_[probe] = true;
    for (std::uint32_t n = 0; n < whole_.concave.size(); ++n) {
      const ConcavePatch& patch = whole_.concave[n];
      needed_[n] = needed_[n] || !faces_that(true, patch).empty();
      for (std::uint32_t c = 0; needed_[n] && c < patch.contact_count; ++c)
        used[whole_.contacts[patch.first_contact + c]] = true;
    }
    new_atom_.assign(whole_.atoms.size(), kNone);
    for (std::uint32_t a = 0; a < whole_.atoms.size(); ++a) {
      if (!used[a]) continue;
      new_atom_[a] = static_cast<std::uint32_t>(part_.atom.size());
      part_.atom.push_back(a);
      surface_.atoms.push_back(whole_.atoms[a]);
    }
  }

  void take_components() {
    new_component_.assign(whole_.components.size(), kNone);
    for (std::uint32_t c = 0; c < whole_.components.size(); ++c) {
      if (!keep_[c]) continue;
      new_component_[c] = static_cast<std::uint32_t>(surface_.components.size());
      surface_.components.push_back(whole_.components[c]);
      surface_.area += whole_.components[c].area;
      surface_.volume += whole_.components[c].volume;
    }
  }

  std::uint32_t take_planes(std::uint32_t first, std::uint32_t count, const std::vector<Plane>& more) {
    const auto at = static_cast<std::uint32_t>(surface_.planes.size());
    surface_.planes.insert(surface_.planes.end(), whole_.planes.begin() + first, whole_.planes.begin() + first + count);
    surface_.planes.insert(surface_.planes.end(), more.begin(), more.end());
    return at;
  }

  std::uint32_t take_faces(const std::vector<std::uint32_t>& faces, std::size_t patch) {
    const auto first = static_cast<std::uint32_t>(surface_.faces.size());
    for (const std::uint32_t f : faces) {
      Face face = whole_.faces[f];
      face.patch = static_cast<std::uint32_t>(patch);
      face.component = new_component_[face.component];
      face.tip = vertex_(face.tip);
      const std::uint32_t first_loop = face.first_loop;
      face.first_loop = static_cast<std::uint32_t>(surface_.loops.size());
      for (std::uint32_t l = first_loop; l < first_loop + face.loop_count; ++l)
        take_loop(whole_.loops[l], static_cast<std::uint32_t>(surface_.faces.size()));
      surface_.faces.push_back(face);
    }
    return first;
  }

  void take_loop(const Loop& loop, std::uint32_t face) {
    surface_.loops.push_back({static_cast<std::uint32_t>(surface_.half_borders.size()), loop.half_border_count});
    for (const HalfBorder half : half_borders_of(whole_, loop)) {
      const std::uint32_t border = border_(border_of(half));
      if (border == surface_.borders.size()) surface_.borders.push_back(whole_.borders[border_of(half)]);
      surface_.borders[border].face[half & 1] = face;
      surface_.half_borders.push_back(2 * border + (half & 1));
    }
  }

  void take_concave() {
    for (std::uint32_t n = 0; n < whole_.concave.size(); ++n) {
      if (!needed_[n]) continue;
      new_concave_[n] = static_cast<std::uint32_t>(surface_.concave.size());
      std::vector<PartedFaces> parts = parted(whole_.concave[n]);
      if (parts.empty()) parts.push_back({});  // a probe between arcs, without visible faces
      for (const PartedFaces& part : parts) {
        ConcavePatch patch = whole_.concave[n];
        patch.first_plane = take_planes(patch.first_plane, patch.plane_count(), part.planes);
        patch.parting_count += static_cast<std::uint32_t>(part.planes.size());
        const auto contact = whole_.contacts.begin() + patch.first_contact;
        patch.first_contact = static_cast<std::uint32_t>(surface_.contacts.size());
        std::transform(contact, contact + patch.contact_count, std::back_inserter(surface_.contacts),
                       [&](std::uint32_t atom) { return new_atom_[atom]; });
        const auto cut = whole_.cuts.begin() + patch.first_cut;
        patch.first_cut = static_cast<std::uint32_t>(surface_.cuts.size());
        surface_.cuts.insert(surface_.cuts.end(), cut, cut + patch.cut_count);
        patch.face_count = static_cast<std::uint32_t>(part.faces.size());
        patch.first_face = take_faces(part.faces, surface_.concave.size());
        surface_.concave.push_back(patch);
      }
    }
  }

  void take_toroidal() {
    for (std::uint32_t t = 0; t < whole_.toroidal.size(); ++t) {
      ToroidalPatch patch = whole_.toroidal[t];
      if (!is_kept(t, patch)) continue;
      const auto faces = faces_that(true, patch);
      if (whole_.spindle(patch) && !has_no_probe()) {
        std::array<bool, 2> pieces{false, false};
        for (const std::uint32_t f : faces) pieces[patch.piece(f - patch.first_face)] = true;
        patch.has_piece = pieces;
      }
      if (has_no_probe()) {  // it has the border of the same number
        border_(t);
        surface_.borders.push_back(whole_.borders[t]);
      }
      for (std::uint32_t& atom : patch.atom) atom = new_atom_[atom];
      patch.face_count = static_cast<std::uint32_t>(faces.size());
      patch.first_face = take_faces(faces, surface_.toroidal.size());
      surface_.toroidal.push_back(patch);
    }
  }

  void take_convex() {
    for (const ConvexPatch& old : whole_.convex)
      for (const PartedFaces& part : parted(old)) {
        ConvexPatch patch = old;
        patch.atom = new_atom_[old.atom];
        patch.first_plane = take_planes(old.first_plane, old.plane_count, part.planes);
        patch.plane_count += static_cast<std::uint32_t>(part.planes.size());
        patch.face_count = static_cast<std::uint32_t>(part.faces.size());
        patch.first_face = take_faces(part.faces, surface_.convex.size());
        surface_.convex.push_back(patch);
      }
  }

  void refer_to_concave() {
    const auto renumber = [&](std::uint32_t& probe) {
      if (probe != kNone) probe = new_concave_[probe];
    };
    for (ToroidalPatch& patch : surface_.toroidal)
      for (std::uint32_t& probe : patch.probe) renumber(probe);
    for (std::uint32_t& probe : surface_.cuts) renumber(probe);
  }

  void take_borders() {
    for (Border& border : surface_.borders)
      for (std::uint32_t& vertex : border.vertex) vertex = vertex_(vertex);
    for (const std::uint32_t v : vertex_.order()) surface_.vertices.push_back(whole_.vertices[v]);
  }

  const Surface& whole_;
  const std::vector<bool>& keep_;
  SurfacePart part_;
  Surface& surface_ = part_.surface;
  Renumbering border_, vertex_;
  std::vector<std::uint32_t> new_atom_, new_component_, new_concave_;
  std::vector<bool> needed_;  // per concave patch: true if it stays
};

/// Returns the solid angle of a triangle seen from the origin, positive when counter-clockwise (Van Oosterom & Strackee
/// 1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
  return 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                        x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
}

// Returns how often faces wind around a point. Every face is replaced by triangles from one of its points to chords of
// its borders. Neighbours share the chords, so this is a closed polyhedron, and the solid angles of its triangles add
// up to whole turns. Faces and triangles lie in the convex hull of the face: in a ball, in a probe, or in the neck
// between two balls. The point is in none of these.
double winding(const Surface& surface, std::span<const std::uint32_t> faces, const glm::dvec3& point) {
  double sum = 0;
  for (const std::uint32_t f : faces) {
    const Face& face = surface.faces[f];
    if (face.loop_count == 0) {  // an atom's whole sphere
      const Ball& atom = surface.atoms[surface.convex[face.patch].atom];
      if (glm::distance(atom.center, point) < atom.radius) sum += 4 * std::numbers::pi;
    }
    std::optional<glm::dvec3> apex;
    for_each_half_border(surface, face, [&](HalfBorder half) {
      const Border& border = surface.borders[border_of(half)];
      const auto at = [&](double t) { return arc_point(border, t) - point; };
      if (!apex) apex = at(0);
      constexpr int kChords = 3;  // chords of a whole circle; for an arc one would do
      for (int k = 0; k < kChords; ++k) {
        const glm::dvec3 from = at(border.sweep * k / kChords), to = at(border.sweep * (k + 1) / kChords);
        sum += is_backwards(half) ? solid_angle(*apex, to, from) : solid_angle(*apex, from, to);
      }
    });
  }
  return sum / (4 * std::numbers::pi);
}

std::vector<std::vector<std::uint32_t>> faces_by_component(const Surface& surface) {
  std::vector<std::vector<std::uint32_t>> faces(surface.components.size());
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) faces[surface.faces[f].component].push_back(f);
  return faces;
}

}  // namespace

SurfacePart part_of(const Surface& surface, const std::vector<bool>& keep) {
  require_borders(surface);
  return PartBuilder(surface, keep).run();
}

int winding_number(const Surface& surface, std::uint32_t component, const glm::dvec3& point) {
  return static_cast<int>(std::lround(winding(surface, faces_by_component(surface)[component], point)));
}

std::vector<bool> reached_from_outside(const Surface& surface) {
  const auto faces = faces_by_component(surface);
  const auto is_cavity = [&](std::size_t c) { return surface.components[c].kind == ComponentKind::cavity; };
  std::vector<bool> reached;
  for (std::size_t c = 0; c < faces.size(); ++c) {
    // Every outer component has a convex face: its outermost point lies on an atom.
    const auto convex = std::find_if(faces[c].begin(), faces[c].end(),
                                     [&](std::uint32_t f) { return surface.faces[f].kind == PatchKind::convex; });
    bool outside = !is_cavity(c);
    for (std::size_t cavity = 0; cavity < faces.size() && outside; ++cavity) {
      if (!is_cavity(cavity)) continue;
      const glm::dvec3 point = surface.atoms[surface.convex[surface.faces[*convex].patch].atom].center;
      outside = std::abs(winding(surface, faces[cavity], point)) < 0.5;
    }
    reached.push_back(outside);
  }
  return reached;
}

std::vector<AtomPatch> atom_patches(const Surface& surface, const std::vector<bool>& chosen) {
  require_borders(surface);
  const AtomShares all = atom_shares(surface);
  UnionFind joined(all.shares.size());
  for (const auto& [a, b] : all.meetings)
    if (chosen[all.shares[a].atom] && chosen[all.shares[b].atom]) joined.unite(a, b);
  std::map<std::uint32_t, std::map<std::uint32_t, double>> areas;  // Å², by patch and by atom
  for (std::uint32_t n = 0; n < all.shares.size(); ++n) {
    const AtomShare& share = all.shares[n];
    if (chosen[share.atom] && share.area > 0.0) areas[joined.find(n)][share.atom] += share.area;
  }
  std::vector<AtomPatch> patches;
  for (const auto& [first, by_atom] : areas) {
    AtomPatch& patch = patches.emplace_back();
    for (const auto& [atom, area] : by_atom) {
      patch.area += area;
      patch.atoms.push_back(atom);
      patch.areas.push_back(area);
    }
  }
  std::ranges::stable_sort(patches, [](const AtomPatch& a, const AtomPatch& b) {
    return a.area != b.area ? a.area > b.area : a.atoms.front() < b.atoms.front();
  });
  return patches;
}

std::vector<bool> atoms_of_patches(const Surface& surface, std::vector<bool> chosen, double least) {
  if (least <= 0.0) return chosen;
  const std::vector<AtomPatch> patches = atom_patches(surface, chosen);
  UnionFind joined(chosen.size());
  for (const AtomPatch& patch : patches)
    for (const std::uint32_t atom : patch.atoms) joined.unite(patch.atoms.front(), atom);
  std::vector<bool> is_large(chosen.size(), false);
  for (const AtomPatch& patch : patches)
    if (patch.area >= least) is_large[joined.find(patch.atoms.front())] = true;
  for (std::uint32_t atom = 0; atom < chosen.size(); ++atom) chosen[atom] = chosen[atom] && is_large[joined.find(atom)];
  return chosen;
}

namespace {

Curvature of_sphere(double curvature) { return {curvature, curvature * curvature}; }

Curvature of_torus(const ToroidalPatch& t, double probe_radius, const glm::dvec3& point) {
  const glm::dvec3 from_center = point - t.center;
  const double from_axis = glm::length(from_center - glm::dot(from_center, t.axis) * t.axis);
  // R - p cos t is the distance from the axis; on a spindle's inner part, past the axis, there is no surface.
  const double cosine = (t.radius - from_axis) / probe_radius;
  const double along_tube = -1.0 / probe_radius, around_axis = cosine / std::max(from_axis, kCurvatureCore);
  return {0.5 * (along_tube + around_axis), along_tube * around_axis};
}

constexpr double kDoubt = 1e-6;  // Å from the surface within which a point may count as not in the solvent
// The most balls with triples that are tried: a million, in a tenth of a second.
constexpr std::size_t kMostBalls = 200;

/// The balls around a point that any accessible place near it must avoid, relative to the point.
class Surroundings {
 public:
  Surroundings(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point) : reach_(probe_radius) {
    for (const Ball& atom : atoms) {
      const Ball ball{atom.center - point, atom.radius + probe_radius};
      const double distance = glm::length(ball.center);
      covered_ = covered_ || distance < ball.radius;
      if (distance < ball.radius + probe_radius) balls_.push_back(ball);
    }
  }

  /// True if some accessible place is nearer to the point than the probe's radius.
  bool has_accessible_place() const {
    if (!covered_) return true;
    const bool few = balls_.size() <= kMostBalls;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const double distance = glm::length(balls_[i].center);
      if (distance > 0.0 && is_accessible(balls_[i].center * (1.0 - balls_[i].radius / distance), {i})) return true;
    }
    for (std::size_t i = 0; i < balls_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (has_accessible_on_two(i, j, few)) return true;
    return false;
  }

 private:
  // True if a place, relative to the point and on the spheres of `touching`, is near enough and in no other ball.
  bool is_accessible(const glm::dvec3& place, std::initializer_list<std::size_t> touching) const {
    if (glm::length(place) > reach_ - kDoubt) return false;
    for (std::size_t n = 0; n < balls_.size(); ++n) {
      const glm::dvec3 d = place - balls_[n].center;
      if (glm::dot(d, d) < balls_[n].radius * balls_[n].radius &&
          std::find(touching.begin(), touching.end(), n) == touching.end())
        return false;
    }
    return true;
  }

  /// True if the nearest place on the circle of two spheres is accessible or, with `and_on_three`, one on a third
  /// sphere.
  bool has_accessible_on_two(std::size_t i, std::size_t j, bool and_on_three) const {
    const Ball &a = balls_[i], &b = balls_[j];
    const geometry::Circle circle =
        geometry::circle_of_two_spheres(b.center - a.center, a.radius * a.radius, b.radius * b.radius);
    if (!(circle.radius_squared > 0.0)) return false;
    const glm::dvec3 center = a.center + circle.axis * circle.height;
    const glm::dvec3 across = -center + circle.axis * glm::dot(center, circle.axis);
    const double offset = glm::length(across);
    if (offset > 0.0 && is_accessible(center + across * (circle.radius / offset), {i, j})) return true;
    for (std::size_t k = 0; and_on_three && k < j; ++k)
      for (const double side : {-1.0, 1.0}) {
        const Ball& c = balls_[k];
        double h2 = 0.0;
        const glm::dvec3 place =
            a.center + geometry::probe_of_three(b.center - a.center, c.center - a.center, a.radius * a.radius,
                                                b.radius * b.radius, c.radius * c.radius, side, h2);
        if (h2 >= 0.0 && is_accessible(place, {i, j, k})) return true;
      }
    return false;
  }

  double reach_;
  bool covered_ = false;  // true if a SAS ball covers the point
  std::vector<Ball> balls_;
};

}  // namespace

Curvature curvature(const Surface& surface, std::uint32_t face, const glm::dvec3& point) {
  const Face& f = surface.faces[face];
  switch (f.kind) {
    case PatchKind::convex:
      return of_sphere(1.0 / surface.atoms[surface.convex[f.patch].atom].radius);
    case PatchKind::toroidal:
      return of_torus(surface.toroidal[f.patch], surface.probe_radius, point);
    default:
      return of_sphere(-1.0 / surface.probe_radius);
  }
}

bool in_solvent(std::span<const Ball> atoms, double probe_radius, const glm::dvec3& point) {
  return Surroundings(atoms, probe_radius, point).has_accessible_place();
}

}  // namespace meniscus
