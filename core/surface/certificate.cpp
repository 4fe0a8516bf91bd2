// SPDX-License-Identifier: BSD-3-Clause
// Makes the checks in the order of the header; each names the atoms at which it fails.
#include "core/surface/certificate.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/math/ball.h"
#include "core/surface/convex_planes.h"
#include "core/surface/measure.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

constexpr double kSlack = 1e-9;  // relative: of areas and volumes that may be 0 or whole
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLargestShift = 1e-5;  // Å for a probe of radius 0: the largest shift of a plane by merged probes
constexpr double kClose = 1e-3;         // Å: half the distance of probes whose bisector rounding may turn

std::array<glm::dvec3, 32> spread_directions() {
  std::array<glm::dvec3, 32> directions;
  for (std::size_t n = 0; n < directions.size(); ++n) directions[n] = spiral_direction(n, directions.size());
  return directions;
}

class Examination {
 public:
  Examination(const Surface& surface, const MeasurementDoubts& doubts, const ConvexPlanes& planes)
      : s_(surface), doubts_(doubts), planes_(planes) {}

  std::vector<std::uint32_t> run(bool with_components) {
    if (with_components) check_components();
    check_faces();
    for_each(s_.convex, [&](std::size_t c) { check_atom(static_cast<std::uint32_t>(c)); });
    for (const std::uint32_t f : doubts_.disputed) add_atoms_of(s_.faces[f]);
    for_each(s_.concave, [&](std::size_t n) {
      check_contacts(s_.concave[n]);
      check_planes(s_.concave[n]);
    });
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& found : open_) all.insert(all.end(), found.begin(), found.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  template <typename Row, typename Check>
  static void for_each(const std::vector<Row>& table, const Check& check) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, table.size(), 256), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) check(n);
    });
  }

  // Returns the atoms that this thread has found.
  std::vector<std::uint32_t>& open() { return open_.local(); }

  void add_atoms_of(const Face& face) {
    if (face.kind == PatchKind::convex) open().push_back(s_.convex[face.patch].atom);
    if (face.kind == PatchKind::toroidal)
      for (const std::uint32_t atom : s_.toroidal[face.patch].atom) open().push_back(atom);
    if (face.kind == PatchKind::concave) add_atoms_of(s_.concave[face.patch]);
  }

  void check_components() {
    std::vector<char> bad(s_.components.size(), 0);
    for (std::size_t c = 0; c < bad.size(); ++c) bad[c] = !is_sound(s_.components[c], s_.probe_radius);
    if (std::ranges::find(bad, 1) == bad.end()) return;
    for (const Face& face : s_.faces)
      if (bad[face.component]) add_atoms_of(face);
  }

  double largest_area(const Face& face) const {
    const double p = s_.probe_radius;
    if (face.kind == PatchKind::concave) return 2 * std::numbers::pi * p * p;
    if (face.kind == PatchKind::toroidal)
      return 4 * std::numbers::pi * std::numbers::pi * p * (s_.toroidal[face.patch].radius + p);
    const double r = s_.atoms[s_.convex[face.patch].atom].radius;
    return 4 * std::numbers::pi * r * r;
  }

  void check_faces() {
    for_each(s_.faces, [&](std::size_t f) {
      const Face& face = s_.faces[f];
      const double most = largest_area(face), slack = kSlack * (1 + most);
      if (!(face.area >= -slack && face.area <= most + slack)) add_atoms_of(face);
    });
  }

  void check_atom(std::uint32_t convex) {
    const ConvexPatch& patch = s_.convex[convex];
    const Ball& atom = s_.atoms[patch.atom];
    double sum = 0;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f) sum += s_.faces[f].area;
    const double whole = 4 * std::numbers::pi * atom.radius * atom.radius, share = whole > 0 ? sum / whole : 0;
    const bool little = share<1e-3, much = share> 1 - 1e-3;
    if (!(sum <= whole * (1 + kSlack)) || (little && leaves_most(convex)) || (much && !leaves_most(convex)))
      open().push_back(patch.atom);
  }

  // If the bordering circles leave little, all planes do, and none need be found.
  bool leaves_most(std::uint32_t convex) const {
    const Ball& atom = s_.atoms[s_.convex[convex].atom];
    return most_is_left(planes_.of(convex, PlaneChoice::bordering), atom) &&
           most_is_left(planes_.of(convex, PlaneChoice::all), atom);
  }

  // True if the clip planes leave most of an atom's sphere, judged by evenly spread points.
  bool most_is_left(const std::vector<Plane>& planes, const Ball& atom) const {
    std::size_t left = 0;
    for (const glm::dvec3& direction : spread_) {
      const glm::dvec3 x = atom.center + atom.radius * direction;
      left += cut_off_by(planes, x) ? 0 : 1;
    }
    return 2 * left > spread_.size();
  }

  void add_atoms_of(const ConcavePatch& patch) {
    open().insert(open().end(), s_.contacts.begin() + patch.first_contact,
                  s_.contacts.begin() + patch.first_contact + patch.contact_count);
  }

  // Checks that every contact lies within the planes of all sides: then the contacts go around in the right sense,
  // without a reflex corner.
  void check_contacts(const ConcavePatch& patch) {
    for (std::uint32_t n = 0; n < patch.side_count; ++n)
      for (std::uint32_t m = 0; m < patch.contact_count; ++m) {
        const glm::dvec3 d = s_.atoms[s_.contacts[patch.first_contact + m]].center - patch.center;
        if (glm::dot(s_.planes[patch.first_plane + n].normal, d) > kLargestShift * (1 + s_.probe_radius)) {
          add_atoms_of(patch);
          return;
        }
      }
  }

  bool has_cusp(const ConcavePatch& patch) const {
    bool found = false;
    for (const Face& face : faces_of(s_, patch))
      for_each_border(s_, face, [&](const Border& border) { found = found || border.kind == BorderKind::cusp; });
    return found;
  }

  // Checks the area of a re-entrant patch that merges several probes, has a nearby cut, has a cut without effect, or
  // has blurred corners: divided among its atoms along its planes, it must have the area that its borders give.
  void check_planes(const ConcavePatch& patch) {
    double sum = 0;
    bool doubtful = patch.contact_count > 3;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f) {
      sum += s_.faces[f].area;
      doubtful = doubtful || std::ranges::binary_search(doubts_.doubtful, f);
    }
    for (std::uint32_t c = patch.first_plane + patch.side_count; c < patch.first_plane + patch.plane_count(); ++c)
      doubtful = doubtful || s_.planes[c].offset - glm::dot(s_.planes[c].normal, patch.center) < kClose;
    if (!doubtful && (patch.cut_count == 0 || patch.face_count == 0 || has_cusp(patch))) return;
    const double p = s_.probe_radius, divided = divided_area(s_, patch);
    if (std::abs(divided - sum) <= 1e-8 * (4 * std::numbers::pi * p * p)) return;
    add_atoms_of(patch);
  }

  const Surface& s_;
  const MeasurementDoubts& doubts_;
  const ConvexPlanes& planes_;
  const std::array<glm::dvec3, 32> spread_ = spread_directions();
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> open_;
};

}  // namespace

void certify(Surface& surface, const MeasurementDoubts& doubts, const ConvexPlanes& planes) {
  std::vector<std::uint32_t>& open = surface.certificate.open_atoms;
  const std::vector<std::uint32_t> found = Examination(surface, doubts, planes).run(true);
  open.insert(open.end(), found.begin(), found.end());
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  surface.certificate.closed = open.empty();
}

std::vector<std::uint32_t> unsound_atoms(const Surface& surface, const MeasurementDoubts& doubts,
                                         const ConvexPlanes& planes) {
  return Examination(surface, doubts, planes).run(false);
}

bool is_sound(const Component& component, double probe_radius) {
  const bool is_cavity = component.kind == ComponentKind::cavity;
  const double slack = kSlack * (1 + component.area), p = probe_radius;
  const double most = is_cavity ? -4 * std::numbers::pi / 3 * p * p * p + slack : kLargest;
  const double least = is_cavity ? -kLargest : -slack;
  const bool sided = component.volume >= least && component.volume <= most;
  return component.euler % 2 == 0 && component.euler <= 2 && sided;
}

void certify(Surface& surface, const MeasurementDoubts& doubts) { certify(surface, doubts, ListedPlanes(surface)); }

}  // namespace meniscus
