// SPDX-License-Identifier: BSD-3-Clause
// Cuts saddles by a latitude and re-entrant faces by bisector planes; integrates along the borders of the shares.
#include "core/surface/measure.h"

#include <numeric>

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/surface/spherical.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kMisfit = 1e-9;        // largest misfit of a loop for which its turning is trusted
constexpr double kShort = 3;            // radians: shorter arcs are classified without trigonometry
constexpr double kClear = 1e-9;         // relative to the probe radius: rounding is a millionth of it
constexpr double kLargestRest = 1e-4;   // Å² per patch: the known error of shares at blurred corners
constexpr double kTouching = 1 - 5e-9;  // relative to the probe radius; the cap beyond such a plane is 1e-4 radian wide

/// One thread's lists.
struct DividerScratch {
  std::vector<glm::dvec3> contacts;
  std::vector<double> area;  // Å² per contact
  std::vector<std::uint32_t> planes;
  ArcIntervals cell;
  std::vector<glm::dvec2> ends;  // begin and end of each kept part of a bisector; fewer if one part is not short
  struct Course {                // the cosine of the distance to a contact, along an arc
    std::array<double, 3> value, slope;
    double middle;
  };
  std::vector<Course> courses;  // per contact

  /// The part of a border that is nearest to one contact, between two parameters of the border.
  struct Line {
    std::uint32_t border, contact;
    bool is_backwards;  ///< the half-border that belongs to the face
    double from, to;
  };
  bool keeps_lines = false;
  std::vector<Line> lines;                                // parts of all borders of the patch
  std::vector<std::array<std::uint32_t, 2>> bisected_by;  // pairs of contacts with a common line on their bisector
};

/// Returns the path of the probe's centre while the probe touches a border of a contact patch. At the rim of a part of
/// a surface no saddle has this path; there it is the border seen from the atom's centre, `ratio` times as large.
Border way_of_probe(const Surface& surface, Border border, const glm::dvec3& center, double ratio) {
  border.center = center + (border.center - center) * ratio;
  border.radius *= ratio;
  for (const std::uint32_t f : border.face) {
    if (f == kNone || surface.faces[f].kind != PatchKind::toroidal) continue;
    border.center = surface.toroidal[surface.faces[f].patch].center;
    border.radius = surface.toroidal[surface.faces[f].patch].radius;
  }
  return border;
}

/// Prefetches what way_of_probe() will read of later half-borders: borders first, then their faces, then the patches.
[[gnu::always_inline]] inline void prefetch_ways(const Surface& surface, std::size_t half_border) {
  prefetch_border(surface, half_border + 3 * kPrefetchAhead);
  for (const std::size_t ahead : {2 * kPrefetchAhead, kPrefetchAhead}) {
    const std::size_t border = border_at(surface, half_border + ahead);
    if (border >= surface.borders.size()) continue;
    for (const std::uint32_t f : surface.borders[border].face) {
      if (ahead > kPrefetchAhead)
        prefetch(surface.faces, f);
      else if (f != kNone && surface.faces[f].kind == PatchKind::toroidal)
        prefetch(surface.toroidal, surface.faces[f].patch);
    }
  }
}

class AreaDivider {
 public:
  /// group_of_face: empty if all faces belong to one group.
  explicit AreaDivider(const Surface& surface, std::span<const std::uint32_t> group_of_face = {})
      : s_(surface), group_of_face_(group_of_face) {}

  /// Returns the areas of each group.
  std::vector<AtomAreas> run(std::uint32_t count = 1) {
    const std::vector<double> none(s_.atoms.size(), 0.0);
    areas_.assign(count, AtomAreas{none, none});
    for (const ConvexPatch& patch : s_.convex) add(patch);
    add_toroidal();
    std::vector<double> share(s_.contacts.size(), 0.0);
    tbb::enumerable_thread_specific<DividerScratch> lists;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.concave.size(), 64), [&](const auto& range) {
      DividerScratch& scratch = lists.local();
      for (std::size_t n = range.begin(); n != range.end(); ++n)
        std::ranges::copy(divide(s_.concave[n], Cuts::beyond_touching, scratch),
                          share.begin() + s_.concave[n].first_contact);
    });
    for (const ConcavePatch& patch : s_.concave)
      for (std::uint32_t n = patch.first_contact; n < patch.first_contact + patch.contact_count; ++n)
        areas_of(patch.face_count ? patch.first_face : kNone).surface[s_.contacts[n]] += share[n];
    shares_ = std::move(share);
    return std::move(areas_);
  }

  /// Returns the areas of groups of atoms.
  AtomAreas run_by_atoms(std::span<const std::uint32_t> group_of_atom, std::uint32_t count) const {
    AtomAreas areas{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
    for (const ConvexPatch& patch : s_.convex)
      for (const Face& face : faces_of(s_, patch)) {
        areas.surface[group_of_atom[patch.atom]] += face.area;
        areas.accessible[group_of_atom[patch.atom]] += accessible_area(s_, face);
      }
    for (const ToroidalPatch& patch : s_.toroidal) {
      const std::array<std::uint32_t, 2> group{group_of_atom[patch.atom[0]], group_of_atom[patch.atom[1]]};
      for (std::uint32_t n = 0; n < patch.face_count; ++n) {
        const double whole = s_.faces[patch.first_face + n].area;
        const double second = group[0] == group[1] ? 0.0 : halves_of(patch, n)[1];
        areas.surface[group[0]] += whole - second;
        areas.surface[group[1]] += second;
      }
    }
    DividerScratch scratch;
    for (const ConcavePatch& patch : s_.concave) {
      const std::uint32_t first = group_of_atom[first_atom(s_, patch)];
      const auto contacts = std::span(s_.contacts).subspan(patch.first_contact, patch.contact_count);
      if (std::ranges::all_of(contacts, [&](std::uint32_t atom) { return group_of_atom[atom] == first; })) {
        for (const Face& face : faces_of(s_, patch)) areas.surface[first] += face.area;
        continue;
      }
      const std::vector<double>& share = divide(patch, Cuts::beyond_touching, scratch);
      for (std::size_t n = 0; n < contacts.size(); ++n) areas.surface[group_of_atom[contacts[n]]] += share[n];
    }
    return areas;
  }

  // Checks, for faces of either engine, that the areas of the atoms add up to the surface's area.
  static void require_sum(const std::vector<AtomAreas>& areas, double of_surface) {
    const double noise = 1e-6 * (1 + of_surface);
    double sum = 0, least = 0;
    for (const AtomAreas& group : areas)
      for (const double area : group.surface) {
        sum += area;
        least = std::min(least, area);
      }
    if (std::abs(sum - of_surface) <= noise && least >= -noise) return;
    throw OpenSurfaceError(
        "the areas of atoms, {} Å² in sum and {} Å² the least, do not make up the surface's {} Å²; nothing "
        "was written; please report this structure",
        sum, least, of_surface);
  }

  // Lists the atoms of patches whose shares do not add up; call it after run().
  void list_contradicted(std::vector<std::uint32_t>& atoms) const {
    for (const ConcavePatch& patch : s_.concave) {
      double left = 0;
      for (const Face& face : faces_of(s_, patch)) left += face.area;
      const std::uint32_t past = patch.first_contact + patch.contact_count;
      for (std::uint32_t n = patch.first_contact; n < past; ++n) left -= shares_[n];
      if (std::abs(left) > kLargestRest)
        atoms.insert(atoms.end(), s_.contacts.begin() + patch.first_contact, s_.contacts.begin() + past);
    }
  }

  // Computes the shares of the contacts, Å². The cell of a contact holds the points of the sphere to which no other
  // contact is nearer. Its border consists of parts of the patch's borders and of the bisectors. A cell never holds the
  // antipode of its own contact, because every other contact is nearer to it: so the contact serves as the pole of the
  // integral. A probe that only touches the sphere cuts nothing off, but its plane may take a tiny part of a bisector
  // for which no border compensates: such planes are left out. To find disagreement between planes and borders, all
  // planes are used.
  enum class Cuts { beyond_touching, all };
  const std::vector<double>& divide(const ConcavePatch& patch, Cuts cuts, DividerScratch& w) const {
    w.area.assign(patch.contact_count, 0.0);
    w.lines.clear();
    w.bisected_by.clear();
    if (patch.face_count == 0) return w.area;
    w.contacts.clear();
    for (std::uint32_t n = 0; n < patch.contact_count; ++n)
      w.contacts.push_back(glm::normalize(s_.atoms[s_.contacts[patch.first_contact + n]].center - patch.center));
    for (const Face& face : faces_of(s_, patch)) add_borders(face, patch.center, w);
    list_planes(patch, cuts, w.planes);
    for (std::uint32_t k = 1; k < w.contacts.size(); ++k)
      for (std::uint32_t j = 0; j < k; ++j) add_bisector(patch, j, k, w);
    for (double& share : w.area) share = share * s_.probe_radius * s_.probe_radius;
    return w.area;
  }

 private:
  /// Returns the areas of a face's group; a patch without any face has no area to add.
  AtomAreas& areas_of(std::uint32_t face) {
    return areas_[group_of_face_.empty() || face == kNone ? 0 : group_of_face_[face]];
  }

  void add(const ConvexPatch& patch) {
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f) {
      areas_of(f).surface[patch.atom] += s_.faces[f].area;
      areas_of(f).accessible[patch.atom] += accessible_area(s_, s_.faces[f]);
    }
  }

  /// Returns the areas (Å²) of a saddle's face that belong to its two atoms. The contacts are the two ends of the
  /// tube's arc, so the nearest contact changes half-way in angle.
  std::array<double, 2> halves_of(const ToroidalPatch& patch, std::uint32_t face) const {
    const std::array<double, 2> contact = contact_tube_angles(s_, patch);
    const auto [low, high] = tube_range(s_, patch, face);
    const double cut = std::clamp(0.5 * (contact[0] + contact[1]), low, high);
    return {toroidal_area(s_, patch, low, cut), toroidal_area(s_, patch, cut, high)};
  }

  // A patch has at most two faces, and each face two shares, which are added in the order of the patches.
  void add_toroidal() {
    std::vector<std::array<double, 4>> shares(s_.toroidal.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.toroidal.size(), 128), [&](const auto& range) {
      for (std::size_t t = range.begin(); t != range.end(); ++t) {
        for (std::uint32_t n = 0; n < s_.toroidal[t].face_count; ++n) {
          const std::array<double, 2> halves = halves_of(s_.toroidal[t], n);
          std::ranges::copy(halves, shares[t].begin() + 2 * n);
        }
      }
    });
    for (std::size_t t = 0; t < shares.size(); ++t)
      for (std::uint32_t n = 0; n < s_.toroidal[t].face_count; ++n)
        for (std::size_t side = 0; side < 2; ++side)
          areas_of(s_.toroidal[t].first_face + n).surface[s_.toroidal[t].atom[side]] += shares[t][2 * n + side];
  }

  void add_borders(const Face& face, const glm::dvec3& center, DividerScratch& w) const {
    for_each_half_border(s_, face, [&](HalfBorder half) {
      // Seen from inside the sphere, the face is on the other side.
      const SphereArc arc = sphere_arc(s_.borders[border_of(half)], !is_backwards(half), center, s_.probe_radius);
      const SphereCircle circle = circle_of(arc);
      const bool is_short = std::abs(arc.sweep) < kShort && std::abs(arc.sweep) > kClear;
      if (is_short) follow_contacts(circle, arc, w);
      for (std::size_t k = 0; k < w.contacts.size(); ++k) {
        if (is_short && surely_elsewhere(k, w)) continue;
        w.cell.restart(std::abs(arc.sweep));
        for (std::size_t j = 0; j < w.contacts.size(); ++j)
          if (j != k && !(is_short && surely_farther(j, k, w))) w.cell.keep(circle, w.contacts[j] - w.contacts[k], 0.0);
        for (const auto& [from, to] : w.cell.kept()) w.area[k] += area_swept_from(w.contacts[k], circle, from, to);
        if (w.keeps_lines) keep_lines(border_of(half), is_backwards(half), std::abs(arc.sweep), k, w);
      }
    });
  }

  // The face is seen from inside, so its walk is the reverse of the half-border's.
  static void keep_lines(std::uint32_t border, bool is_backwards, double sweep, std::size_t contact,
                         DividerScratch& w) {
    for (const auto& [from, to] : w.cell.kept())
      w.lines.push_back({border, static_cast<std::uint32_t>(contact), is_backwards, is_backwards ? from : sweep - to,
                         is_backwards ? to : sweep - from});
  }

  static void follow_contacts(const SphereCircle& circle, const SphereArc& arc, DividerScratch& w) {
    const ArcPoints points(circle, arc.from, arc.to);
    w.courses.clear();
    for (const glm::dvec3& contact : w.contacts) {
      DividerScratch::Course& course = w.courses.emplace_back();
      for (std::size_t n = 0; n < 3; ++n) {
        course.value[n] = glm::dot(contact, points.point[n]);
        course.slope[n] = glm::dot(contact, points.onwards[n]);
      }
      course.middle = circle.height * glm::dot(contact, circle.axis);
    }
  }

  // Returns how much nearer contact j is than contact k, along one half of the arc.
  static ArcRange nearer(std::size_t j, std::size_t k, std::size_t half, const DividerScratch& w) {
    const DividerScratch::Course &a = w.courses[j], &b = w.courses[k];
    return range_along({a.value[half] - b.value[half], a.value[half + 1] - b.value[half + 1]},
                       {a.slope[half] - b.slope[half], a.slope[half + 1] - b.slope[half + 1]}, a.middle - b.middle);
  }

  // True if contact j takes nothing of the arc from contact k, even with rounding at its ends.
  static bool surely_farther(std::size_t j, std::size_t k, const DividerScratch& w) {
    return nearer(j, k, 0, w).most < -kClear && nearer(j, k, 1, w).most < -kClear;
  }

  // True if other contacts take all of the arc from contact k: along each half, one contact is nearer throughout.
  static bool surely_elsewhere(std::size_t k, const DividerScratch& w) {
    const auto taken = [&](std::size_t half) {
      for (std::size_t j = 0; j < w.courses.size(); ++j)
        if (j != k && nearer(j, k, half, w).least > kClear) return true;
      return false;
    };
    return taken(0) && taken(1);
  }

  void list_planes(const ConcavePatch& patch, Cuts cuts, std::vector<std::uint32_t>& planes) const {
    planes.resize(patch.plane_count());
    std::iota(planes.begin(), planes.end(), patch.first_plane);
    if (cuts == Cuts::all || patch.cut_count == 0) return;
    const std::vector<std::uint32_t> beyond = probes_beyond_cusps(patch);
    std::erase_if(planes, [&](std::uint32_t plane) {
      const std::uint32_t n = plane - patch.first_plane;
      if (n < patch.side_count || n >= patch.side_count + patch.cut_count) return false;
      if (s_.planes[plane].offset - glm::dot(s_.planes[plane].normal, patch.center) < kTouching * s_.probe_radius)
        return false;
      const std::uint32_t cut = s_.cuts[patch.first_cut + n - patch.side_count];
      return cut != kNone && std::ranges::find(beyond, cut) == beyond.end();
    });
  }

  std::vector<std::uint32_t> probes_beyond_cusps(const ConcavePatch& patch) const {
    std::vector<std::uint32_t> probes;
    for (const Face& face : faces_of(s_, patch))
      for_each_border(s_, face, [&](const Border& border) {
        if (border.kind != BorderKind::cusp) return;
        for (const std::uint32_t beyond : border.face)
          if (beyond != kNone) probes.push_back(s_.faces[beyond].patch);
      });
    return probes;
  }

  // Adds the bisector of two contacts. Counter-clockwise about its axis it has the cell of k on its left and the cell
  // of j on its right. As a rule the side between the two contacts cuts it first, and the remainder needs no other
  // plane; the order of the planes does not change the result.
  void add_bisector(const ConcavePatch& patch, std::uint32_t j, std::uint32_t k, DividerScratch& w) const {
    const SphereCircle circle = great_circle(glm::normalize(w.contacts[k] - w.contacts[j]));
    ArcIntervals& common = w.cell;
    common.restart(kTurn);
    for (std::size_t other = 0; other < w.contacts.size(); ++other)
      if (other != j && other != k) common.keep(circle, w.contacts[other] - w.contacts[k], 0.0);
    const std::uint32_t between = patch.first_plane + (j + 1 == k ? j : k);
    keep_within(circle, s_.planes[between], patch.center, w);
    for (const std::uint32_t n : w.planes)
      if (n != between && !surely_within(circle, s_.planes[n], patch.center, w))
        keep_within(circle, s_.planes[n], patch.center, w);
    double length = 0.0;
    for (const auto& [from, to] : common.kept()) {
      length += to - from;
      w.area[k] += area_swept_from(w.contacts[k], circle, from, to);
      w.area[j] -= area_swept_from(w.contacts[j], circle, from, to);
    }
    if (w.keeps_lines && length > kClear) w.bisected_by.push_back({j, k});
  }

  void keep_within(const SphereCircle& circle, const Plane& plane, const glm::dvec3& center, DividerScratch& w) const {
    w.cell.keep(circle, plane.normal, (plane.offset - glm::dot(plane.normal, center)) / s_.probe_radius);
    w.ends.clear();
    for (const auto& [from, to] : w.cell.kept()) {
      if (to - from > kShort) return;
      for (const double t : {from, to}) w.ends.emplace_back(std::cos(t), std::sin(t));
    }
  }

  // True if the plane takes nothing of the kept parts, even with rounding at their ends.
  bool surely_within(const SphereCircle& circle, const Plane& plane, const glm::dvec3& center,
                     const DividerScratch& w) const {
    if (w.ends.size() != 2 * w.cell.kept().size()) return false;
    const double along = glm::dot(plane.normal, circle.x), across = glm::dot(plane.normal, circle.y);
    const double middle = circle.height * glm::dot(plane.normal, circle.axis) -
                          (plane.offset - glm::dot(plane.normal, center)) / s_.probe_radius;
    for (std::size_t n = 0; n < w.ends.size(); n += 2) {
      std::array<double, 2> value, slope;
      for (std::size_t end = 0; end < 2; ++end) {
        const glm::dvec2 e = w.ends[n + end];
        value[end] = middle + along * e.x + across * e.y;
        slope[end] = across * e.x - along * e.y;
      }
      if (!(range_along(value, slope, middle).most < -kClear)) return false;
    }
    return true;
  }

  const Surface& s_;
  std::span<const std::uint32_t> group_of_face_;
  std::vector<AtomAreas> areas_;
  std::vector<double> shares_;  // shares of re-entrant patches, per contact
};

/// Lists shares and finds the pairs that meet: shares of one patch where it is divided, and shares of two patches with
/// a part of a border in common.
class ShareLister {
 public:
  explicit ShareLister(const Surface& surface) : s_(surface), ends_(surface.borders.size()) {}

  AtomShares run() {
    for (const ConvexPatch& patch : s_.convex) add(patch);
    for (const ToroidalPatch& patch : s_.toroidal) add(patch);
    scratch_.keeps_lines = true;
    for (const ConcavePatch& patch : s_.concave) add(patch);
    for (const std::array<std::vector<Line>, 2>& sides : ends_)
      for (const Line& left : sides[0])
        for (const Line& right : sides[1])
          if (std::min(left.to, right.to) - std::max(left.from, right.from) > kClear) meet(left.share, right.share);
    return std::move(shares_);
  }

 private:
  /// The part of a border that belongs to a share.
  struct Line {
    std::uint32_t share;
    double from, to;
  };

  std::uint32_t add_share(std::uint32_t atom, double area) {
    shares_.shares.push_back({atom, area});
    return static_cast<std::uint32_t>(shares_.shares.size() - 1);
  }

  void meet(std::uint32_t a, std::uint32_t b) { shares_.meetings.push_back({a, b}); }

  void add_line(HalfBorder half, const Line& line) { ends_[border_of(half)][is_backwards(half)].push_back(line); }

  void add(const ConvexPatch& patch) {
    for (const Face& face : faces_of(s_, patch)) {
      const std::uint32_t share = add_share(patch.atom, face.area);
      for_each_half_border(s_, face, [&](HalfBorder half) {
        add_line(half, {share, 0.0, s_.borders[border_of(half)].sweep});
      });
    }
  }

  void add(const ToroidalPatch& patch) {
    const std::array<double, 2> contact = contact_tube_angles(s_, patch);
    const double middle = 0.5 * (contact[0] + contact[1]);
    for (std::uint32_t n = 0; n < patch.face_count; ++n) {
      const auto [low, high] = tube_range(s_, patch, n);
      const double cut = std::clamp(middle, low, high);
      const std::array<std::uint32_t, 2> half{add_share(patch.atom[0], toroidal_area(s_, patch, low, cut)),
                                              add_share(patch.atom[1], toroidal_area(s_, patch, cut, high))};
      if (low < cut && cut < high) meet(half[0], half[1]);
      for_each_half_border(s_, s_.faces[patch.first_face + n], [&](HalfBorder h) { add_border(patch, half, h); });
    }
  }

  /// On the tube the nearer of the two contacts has each point; on a contact circle its own atom has all points.
  void add_border(const ToroidalPatch& patch, const std::array<std::uint32_t, 2>& share, HalfBorder half) {
    const Border& border = s_.borders[border_of(half)];
    if (border.kind == BorderKind::contact) {
      const std::uint32_t beyond = border.face[is_backwards(half) ? 0 : 1];
      if (beyond == kNone) return;
      const bool is_second = s_.convex[s_.faces[beyond].patch].atom == patch.atom[1];
      return add_line(half, {share[is_second], 0.0, border.sweep});
    }
    const SphereArc arc = sphere_arc(border, false, border.center, border.radius);
    const SphereCircle circle = circle_of(arc);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto toward = [&](std::size_t side) {
        return glm::normalize(s_.atoms[patch.atom[side]].center - border.center);
      };
      cell_.restart(border.sweep);
      cell_.keep(circle, toward(1 - k) - toward(k), 0.0);
      for (const auto& [from, to] : cell_.kept()) add_line(half, {share[k], from, to});
    }
  }

  void add(const ConcavePatch& patch) {
    if (patch.face_count == 0) return;
    const std::vector<double>& area = divider_.divide(patch, AreaDivider::Cuts::beyond_touching, scratch_);
    const auto first = static_cast<std::uint32_t>(shares_.shares.size());
    for (std::uint32_t n = 0; n < patch.contact_count; ++n) add_share(s_.contacts[patch.first_contact + n], area[n]);
    for (const auto& [j, k] : scratch_.bisected_by) meet(first + j, first + k);
    for (const DividerScratch::Line& line : scratch_.lines)
      ends_[line.border][line.is_backwards].push_back({first + line.contact, line.from, line.to});
  }

  const Surface& s_;
  AreaDivider divider_{s_};
  DividerScratch scratch_;
  ArcIntervals cell_;
  AtomShares shares_;
  std::vector<std::array<std::vector<Line>, 2>>
      ends_;  // per border: the lines from its left face and from its right face
};

}  // namespace

AtomShares atom_shares(const Surface& surface) { return ShareLister(surface).run(); }

AtomAreas atom_areas(const Surface& surface) {
  if (surface.sums) return {surface.sums->atom_surface, surface.sums->atom_accessible};
  return std::move(atom_areas(surface, {}, 1).front());
}

AtomAreas atom_areas(const Surface& surface, std::vector<std::uint32_t>& contradicted) {
  AreaDivider divider(surface);
  AtomAreas areas = std::move(divider.run().front());
  divider.list_contradicted(contradicted);
  return areas;
}

std::vector<AtomAreas> atom_areas(const Surface& surface, std::span<const std::uint32_t> group_of_face,
                                  std::uint32_t count) {
  std::vector<AtomAreas> areas = AreaDivider(surface, group_of_face).run(count);
  AreaDivider::require_sum(areas, surface.area);
  return areas;
}

AtomAreas group_areas(const Surface& surface, std::span<const std::uint32_t> group_of_atom, std::uint32_t count) {
  if (!surface.sums) {
    AtomAreas areas = AreaDivider(surface).run_by_atoms(group_of_atom, count);
    AreaDivider::require_sum({areas}, surface.area);
    return areas;
  }
  AtomAreas areas{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
  for (std::size_t a = 0; a < group_of_atom.size(); ++a) {
    areas.surface[group_of_atom[a]] += surface.sums->atom_surface[a];
    areas.accessible[group_of_atom[a]] += surface.sums->atom_accessible[a];
  }
  return areas;
}

double accessible_area(const Surface& surface) {
  if (surface.sums) return surface.sums->accessible;
  double area = 0.0;
  for (const ConvexPatch& patch : surface.convex) {
    double of_atom = 0.0;  // summed in the same order as in blocks
    for (const Face& face : faces_of(surface, patch)) of_atom += accessible_area(surface, face);
    area += of_atom;
  }
  return area;
}

// Seen from the atom's centre, the probe's centre and its point of contact lie in one direction, so face and accessible
// part fill the same solid angle. It is measured on the SAS sphere, because rounding moves borders on a sphere that is
// tiny compared with its coordinates. Where ties have left loops open, the solid angle of the face counts.
double accessible_area(const Surface& surface, const Face& face) {
  const Ball& atom = surface.atoms[surface.convex[face.patch].atom];
  const double grown = atom.radius + surface.probe_radius, ratio = grown / atom.radius;
  double angle = 2 * kTurn;
  std::vector<SphereArc> walk;
  for (const Loop& loop : loops_of(surface, face)) {
    walk.clear();
    for (std::size_t n = loop.first_half_border, past = n + loop.half_border_count; n < past; ++n) {
      prefetch_ways(surface, n);
      const HalfBorder half = surface.half_borders[n];
      const Border way = way_of_probe(surface, surface.borders[border_of(half)], atom.center, ratio);
      walk.push_back(sphere_arc(way, is_backwards(half), atom.center, grown));
    }
    if (misfit_of(walk) > kMisfit) return face.area * ratio * ratio;
    angle += area_left_of(walk) - 2 * kTurn;
  }
  return std::clamp(angle, 0.0, 2 * kTurn) * grown * grown;
}

double divided_area(const Surface& surface, const ConcavePatch& patch) {
  DividerScratch scratch;
  const std::vector<double>& shares = AreaDivider(surface).divide(patch, AreaDivider::Cuts::all, scratch);
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

}  // namespace meniscus
