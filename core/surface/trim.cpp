// SPDX-License-Identifier: BSD-3-Clause
// Finds the clip planes that bound a spherical patch and those that separate its faces.
//
// Finds the nearest points of two convex hulls of arcs by support points (Gilbert, Johnson & Keerthi 1988), and the
// plane half-way between them.
#include "core/surface/trim.h"

#include <iterator>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/ball.h"
#include "core/math/vector_loops.h"
#include "core/reduced_surface/contour/contour.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/parallel_tables.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

// Returns the contact-circle plane of atom a towards atom b: the patch lies where dot(normal, x) <= offset.
Plane contact_plane(const Ball& a, const Ball& b, double probe_radius) {
  const glm::dvec3 d = b.center - a.center;
  const double distance = glm::length(d);
  const double height = geometry::contact_height(distance, a.radius, a.radius + probe_radius, b.radius + probe_radius);
  const glm::dvec3 normal = d / distance;
  return {normal, glm::dot(normal, a.center) + height};
}

// An exposed arc of a contact circle, seen from one of its atoms.
struct BorderArc {
  std::uint32_t partner;
  std::uint32_t begin_by;
  std::uint32_t end_by;
  auto operator<=>(const BorderArc&) const = default;
};

struct BallColumns {
  const double *x, *y, *z, *weight;
};

// Computes the power of a point to each ball, with the sign that is positive inside.
MENISCUS_VECTOR_CLONES
void measure_inside(const glm::dvec3& point, const BallColumns& balls, std::size_t count, double* inside) {
  const double px = point.x, py = point.y, pz = point.z;
  const BallColumns b = balls;
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = 0; n < count; ++n) {
    const double dx = px - b.x[n], dy = py - b.y[n], dz = pz - b.z[n];
    inside[n] = b.weight[n] - (dx * dx + dy * dy + dz * dz);
  }
}

}  // namespace

class ConvexTrimmer::Search {
  enum Column : std::size_t { kX, kY, kZ, kWeight, kColumnCount };

 public:
  Search(const Surface& surface, const ReducedSurface& rs)
      : s_(surface), numbers_(rs.numbers), largest_(largest_radius(surface)) {
    list_arcs(rs);
  }

  std::uint32_t patch_count() const { return static_cast<std::uint32_t>(s_.convex.size()); }

  // The scratch memory of one thread.
  struct Worker {
    std::vector<std::uint32_t> kept;
    Blockers blockers;
    std::vector<double> inside;
    Contour contour;
  };

  // Appends the planes of one patch; returns their number.
  std::uint32_t append_planes(std::uint32_t convex, PlaneChoice choice, Worker& w, std::vector<Plane>& planes) const {
    const std::uint32_t a = s_.convex[convex].atom;
    keep_bordering(a, w);
    if (choice == PlaneChoice::all) keep_covering(a, w);
    for (const std::uint32_t b : w.kept) planes.push_back(plane_of(a, b));
    return static_cast<std::uint32_t>(w.kept.size());
  }

  // As a rule the planes of circles that border the patch cut off the point, or a ball covers it. All planes take more
  // work, and are found only where neither holds.
  bool cuts_off(std::uint32_t convex, const glm::dvec3& direction, Worker& w) const {
    const std::uint32_t a = s_.convex[convex].atom;
    const Ball& atom = s_.atoms[a];
    const glm::dvec3 point = atom.center + atom.radius * direction;
    const auto cut_by_kept = [&](std::size_t first) {
      return std::any_of(w.kept.begin() + static_cast<std::ptrdiff_t>(first), w.kept.end(), [&](std::uint32_t b) {
        const Plane plane = plane_of(a, b);
        return glm::dot(plane.normal, point) > plane.offset;
      });
    };
    keep_bordering(a, w);
    if (cut_by_kept(0)) return true;
    if (covering(a, atom.center + (atom.radius + s_.probe_radius) * direction, w) != kNone) return true;
    const std::size_t bordering = w.kept.size();
    keep_covering(a, w);
    return cut_by_kept(bordering);
  }

 private:
  Plane plane_of(std::uint32_t a, std::uint32_t b) const {
    return contact_plane(s_.atoms[a], s_.atoms[b], s_.probe_radius);
  }

  static double largest_radius(const Surface& surface) {
    double largest = 0;
    for (const Ball& b : surface.atoms) largest = std::max(largest, b.radius + surface.probe_radius + 2e-9);
    return largest;
  }

  // Lists the true borders of every atom's patch, sorted by partner. For the far atom an arc runs the other way.
  void list_arcs(const ReducedSurface& rs) {
    first_.assign(s_.atoms.size() + 1, 0);
    for (const RsArc& arc : rs.arcs) {
      ++first_[arc.i + 1];
      ++first_[arc.j + 1];
    }
    for (std::size_t a = 1; a < first_.size(); ++a) first_[a] += first_[a - 1];
    arcs_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const RsArc& arc : rs.arcs) {
      arcs_[next[arc.i]++] = {arc.j, arc.begin_by, arc.end_by};
      arcs_[next[arc.j]++] = {arc.i, arc.end_by, arc.begin_by};
    }
  }

  std::span<const BorderArc> arcs_of(std::uint32_t a) const {
    return {arcs_.data() + first_[a], arcs_.data() + first_[a + 1]};
  }

  void keep(std::uint32_t a, std::uint32_t b, Worker& w) const {
    w.kept.push_back(b);
    w.blockers.add(s_.atoms[b].center - s_.atoms[a].center, weight(b), b);
  }

  void keep_bordering(std::uint32_t a, Worker& w) const {
    w.kept.clear();
    w.blockers.restart(weight(a));
    for (const BorderArc& arc : arcs_of(a))
      if (std::find(w.kept.begin(), w.kept.end(), arc.partner) == w.kept.end()) keep(a, arc.partner, w);
  }

  // Keeps further circles. While some kept circle shows an arc that another atom covers, that atom's circle is needed
  // as well. When there is no such arc, the kept circles bound the patch: a spurious piece would have a spurious border
  // on one of them.
  void keep_covering(std::uint32_t a, Worker& w) const {
    for (std::size_t n = 0; n < w.blockers.size(); ++n) {
      w.contour.expose(w.blockers[n].center, w.blockers[n].weight, w.blockers, n);
      for (;;) {
        const std::uint32_t missing = missing_on_circle(a, w.blockers[n].label, w);
        if (missing == kNone) break;
        keep(a, missing, w);
        w.contour.expose_further(w.blockers[n].center, w.blockers[n].weight, w.blockers, n);
      }
    }
  }

  // Returns an atom that covers part of the contour on the circle (a, b), or kNone if the contour is right.
  std::uint32_t missing_on_circle(std::uint32_t a, std::uint32_t b, Worker& w) const {
    const auto arcs = arcs_of(a);
    const auto known = [&](const BorderArc& arc) { return std::find(arcs.begin(), arcs.end(), arc) != arcs.end(); };
    if (w.contour.whole()) return known({b, kNone, kNone}) ? kNone : covering_circle(a, 0.0, w);
    for (const ExposedArc& arc : w.contour.arcs()) {
      if (known({b, arc.begin_by, arc.end_by})) continue;
      const double middle = arc.begin + 0.5 * geometry::pseudo_sweep(arc.begin, arc.end);
      const std::uint32_t missing = covering_circle(a, middle < 4 ? middle : middle - 4, w);
      if (missing != kNone) return missing;
    }
    return kNone;
  }

  // Returns covering() of the point of the contour's circle at this pseudo-angle.
  std::uint32_t covering_circle(std::uint32_t a, double pseudo, Worker& w) const {
    const geometry::Circle& c = w.contour.circle();
    return covering(a, s_.atoms[a].center + c.axis * c.height + c.radius * w.contour.direction(pseudo), w);
  }

  // Returns the atom, not among the kept ones, that covers this point of the SAS sphere of `a` deepest, or kNone.
  std::uint32_t covering(std::uint32_t a, const glm::dvec3& point, Worker& w) const {
    const Balls& balls = this->balls();
    std::uint32_t deepest = kNone;
    double depth = 1e-8;  // decision weights blur the surface of a ball by 1e-8 Å² at most
    balls.grid.for_each_row_near(point, largest_, [&](std::uint32_t first, std::uint32_t past) {
      const std::size_t count = past - first;
      if (w.inside.size() < count) w.inside.resize(2 * count);
      const auto of = [&](Column column) { return balls.table.column(column) + first; };
      measure_inside(point, {of(kX), of(kY), of(kZ), of(kWeight)}, count, w.inside.data());
      for (std::size_t n = 0; n < count; ++n) {
        if (!(w.inside[n] > depth)) continue;  // the common case
        const std::uint32_t b = balls.grid.order()[first + n];
        if (b == a || std::find(w.kept.begin(), w.kept.end(), b) != w.kept.end()) continue;
        depth = w.inside[n];
        deepest = b;
      }
    });
    return deepest;
  }

  double weight(std::uint32_t a) const {
    return decision_weight(s_.atoms[a].radius + s_.probe_radius, number_of(numbers_, a));
  }

  // All balls, cell by cell. Swallowed balls cover nothing: where they reach beyond the atom that contains them, by at
  // most 1e-6 Å, their planes would take half of a patch.
  struct Balls {
    explicit Balls(const Search& search) : grid(search.s_.atoms, search.largest_) {
      const std::vector<bool> swallowed = swallowed_atoms(search.s_.atoms);
      const std::size_t count = grid.order().size();
      table.make_room(count);
      double *x = table.column(kX), *y = table.column(kY), *z = table.column(kZ), *weight = table.column(kWeight);
      for (std::size_t n = 0; n < count; ++n) {
        const std::uint32_t b = grid.order()[n];
        x[n] = search.s_.atoms[b].center.x;
        y[n] = search.s_.atoms[b].center.y;
        z[n] = search.s_.atoms[b].center.z;
        weight[n] = swallowed[b] ? 0.0 : search.weight(b);
      }
    }
    BallGrid grid;
    ColumnTable<kColumnCount> table;
  };

  // Requests for bordering circles alone do not need the balls.
  const Balls& balls() const {
    std::call_once(balls_made_, [&] { balls_.emplace(*this); });
    return *balls_;
  }

  const Surface& s_;
  AtomNumbers numbers_;
  double largest_;
  mutable std::once_flag balls_made_;
  mutable std::optional<Balls> balls_;
  std::vector<std::uint32_t> first_;
  std::vector<BorderArc> arcs_;
};

ConvexTrimmer::ConvexTrimmer(const Surface& surface, const ReducedSurface& rs)
    : search_(std::make_unique<Search>(surface, rs)) {}
ConvexTrimmer::~ConvexTrimmer() = default;

std::vector<Plane> ConvexTrimmer::planes_of(std::uint32_t convex, PlaneChoice choice) const {
  Search::Worker worker;
  std::vector<Plane> planes;
  search_->append_planes(convex, choice, worker, planes);
  return planes;
}

bool ConvexTrimmer::cuts_off(std::uint32_t convex, const glm::dvec3& direction) const {
  Search::Worker worker;
  return search_->cuts_off(convex, direction, worker);
}

void ConvexTrimmer::list_all(Surface& surface) const {
  constexpr std::uint32_t kChunk = 64;  // patches that share a list
  const std::uint32_t count = search_->patch_count(), chunks = (count + kChunk - 1) / kChunk;
  std::vector<std::vector<Plane>> planes(chunks);
  tbb::enumerable_thread_specific<Search::Worker> workers;
  tbb::parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t chunk) {
    Search::Worker& worker = workers.local();
    for (std::uint32_t c = chunk * kChunk; c < std::min(count, (chunk + 1) * kChunk); ++c)
      surface.convex[c].plane_count = search_->append_planes(c, PlaneChoice::all, worker, planes[chunk]);
  });
  std::size_t past = surface.planes.size();
  for (ConvexPatch& patch : surface.convex) {
    patch.first_plane = static_cast<std::uint32_t>(past);
    past += patch.plane_count;
  }
  surface.planes.resize(past);
  tbb::parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t chunk) {
    std::ranges::copy(planes[chunk], surface.planes.begin() + surface.convex[chunk * kChunk].first_plane);
  });
}

void list_concave_patches(Surface& surface, const FixedProbes& probes, const CuspParts& cusps) {
  surface.cuts = cusps.cuts;
  resize_large(surface.concave, probes.count());
  surface.contacts.reserve(probes.sides.size());
  for (const ProbeSide& side : probes.sides) surface.contacts.push_back(side.from);
  resize_large(surface.planes, probes.sides.size() + surface.cuts.size());
  tbb::parallel_for(std::size_t{0}, probes.count(), [&](std::size_t n) {
    const glm::dvec3 s = probes.position[n];
    ConcavePatch& patch = surface.concave[n];
    patch.center = s;
    patch.first_contact = probes.first_side[n];
    patch.contact_count = patch.side_count = probes.first_side[n + 1] - probes.first_side[n];
    patch.first_cut = cusps.first_cut[n];
    patch.cut_count = cusps.first_cut[n + 1] - cusps.first_cut[n];
    patch.first_plane = patch.first_contact + patch.first_cut;
    Plane* plane = surface.planes.data() + patch.first_plane;
    for (const ProbeSide& side : probes.sides_of(static_cast<std::uint32_t>(n))) {
      if (const std::size_t later = (&side - probes.sides.data()) + kPrefetchAhead; later < probes.sides.size())
        prefetch(surface.atoms, probes.sides[later].from);
      plane->normal =
          glm::normalize(glm::cross(surface.atoms[side.from].center - s, surface.atoms[side.to].center - s));
      plane->offset = glm::dot(plane->normal, s);
      ++plane;
    }
    for (std::uint32_t c = patch.first_cut; c < patch.first_cut + patch.cut_count; ++c) {
      const glm::dvec3 t = probes.position[cusps.cuts[c]];
      plane->normal = glm::normalize(t - s);
      plane->offset = glm::dot(plane->normal, 0.5 * (s + t));
      ++plane;
    }
  });
}

void trim_convex_patches(Surface& surface, const ReducedSurface& rs) { ConvexTrimmer(surface, rs).list_all(surface); }

namespace {

constexpr double kClearance = 1e-9;  // Å to either side: a thousand times the rounding of a position

/// The borders of some faces as a convex body.
class Hull {
 public:
  Hull(const Surface& surface, std::span<const std::uint32_t> faces) {
    for (const std::uint32_t f : faces)
      for_each_border(surface, surface.faces[f], [&](const Border& border) { arcs_.push_back(&border); });
  }

  bool empty() const { return arcs_.empty(); }

  /// Returns the farthest point of all arcs along a direction; it is exact, because each arc's is known in closed form.
  glm::dvec3 farthest(const glm::dvec3& direction) const {
    glm::dvec3 best(0.0);
    double most = -std::numeric_limits<double>::infinity();
    for (const Border* arc : arcs_) {
      const glm::dvec3 side = glm::cross(arc->axis, arc->start);
      double top = std::atan2(glm::dot(direction, side), glm::dot(direction, arc->start));
      if (top < 0) top += 2 * std::numbers::pi;
      for (const double t : {0.0, arc->sweep, std::min(top, arc->sweep)}) {
        const glm::dvec3 point = arc_point(*arc, t);
        if (const double reach = glm::dot(direction, point); reach > most) {
          most = reach;
          best = point;
        }
      }
    }
    return best;
  }

 private:
  std::vector<const Border*> arcs_;
};

/// Returns the point of the affine hull of some points that is nearest to the origin, if it is a combination of them
/// with positive weights; solves Gram's equations with pivoting.
std::optional<glm::dvec3> nearest_inside(std::span<const glm::dvec3> points) {
  const std::size_t count = points.size();
  // The unknowns are the weights and the multiplier of "weights sum to 1".
  std::array<std::array<double, 6>, 5> rows{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) rows[i][j] = glm::dot(points[i], points[j]);
    rows[i][count] = rows[count][i] = 1.0;
  }
  rows[count][count + 1] = 1.0;
  const std::size_t size = count + 1;
  for (std::size_t c = 0; c < size; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < size; ++r)
      if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
    if (rows[pivot][c] == 0.0) return std::nullopt;
    std::swap(rows[c], rows[pivot]);
    for (std::size_t r = 0; r < size; ++r) {
      if (r == c) continue;
      const double factor = rows[r][c] / rows[c][c];
      for (std::size_t k = c; k <= size; ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  glm::dvec3 nearest(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = rows[i][size] / rows[i][i];
    if (!(weight > 0.0)) return std::nullopt;
    nearest += weight * points[i];
  }
  return nearest;
}

/// Replaces a simplex of up to four points by its smallest face that contains its point nearest to the origin, and
/// returns that point. All faces are tried.
glm::dvec3 reduce(std::vector<glm::dvec3>& simplex) {
  std::vector<glm::dvec3> best{simplex.back()};
  glm::dvec3 nearest = simplex.back();
  for (unsigned mask = 1; mask < (1u << simplex.size()); ++mask) {
    std::vector<glm::dvec3> corners;
    for (std::size_t n = 0; n < simplex.size(); ++n)
      if (mask & (1u << n)) corners.push_back(simplex[n]);
    const std::optional<glm::dvec3> point = nearest_inside(corners);
    if (!point || glm::dot(*point, *point) >= glm::dot(nearest, nearest)) continue;
    nearest = *point;
    best = std::move(corners);
  }
  simplex = std::move(best);
  return nearest;
}

}  // namespace

std::optional<Plane> plane_between(const Surface& surface, std::span<const std::uint32_t> inside,
                                   std::span<const std::uint32_t> outside) {
  const Hull a(surface, inside), b(surface, outside);
  if (a.empty() || b.empty()) return std::nullopt;
  std::vector<glm::dvec3> simplex{a.farthest({1, 0, 0}) - b.farthest({1, 0, 0})};
  glm::dvec3 between = simplex.front();  // from b to a; its length decreases
  std::optional<Plane> best;
  double widest = kClearance;
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps; ++step) {
    const double length = glm::length(between);
    if (!(length > kClearance)) break;
    const glm::dvec3 normal = -between / length;  // from a to b
    const glm::dvec3 last_of_a = a.farthest(normal), first_of_b = b.farthest(-normal);
    const double low = glm::dot(normal, last_of_a), high = glm::dot(normal, first_of_b), gap = high - low;
    if (0.5 * gap > widest) {
      widest = 0.5 * gap;
      best = Plane{normal, 0.5 * (low + high)};
    }
    // The gap of the best plane is the distance of the hulls.
    if (length - gap <= 1e-3 * length) break;
    simplex.push_back(last_of_a - first_of_b);
    between = reduce(simplex);
    if (simplex.size() == 4) break;  // the origin is inside: the hulls intersect
  }
  return best;
}

namespace {

/// Returns planes that separate `faces` from every one of `others`; nothing if some cannot be separated. A plane that
/// separates several of them is listed once.
std::optional<std::vector<Plane>> planes_around(const Surface& surface, std::span<const std::uint32_t> faces,
                                                std::span<const std::uint32_t> others) {
  std::vector<Plane> planes;
  for (const std::uint32_t other : others) {
    const Hull hull(surface, std::span(&other, 1));
    const bool parted = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
      return glm::dot(plane.normal, hull.farthest(-plane.normal)) > plane.offset + kClearance;
    });
    if (parted) continue;
    const std::optional<Plane> plane = plane_between(surface, faces, std::span(&other, 1));
    if (!plane) return std::nullopt;
    planes.push_back(*plane);
  }
  return planes;
}

}  // namespace

std::vector<PartedFaces> part_faces(const Surface& surface, std::span<const std::uint32_t> kept,
                                    std::span<const std::uint32_t> dropped) {
  if (auto planes = planes_around(surface, kept, dropped)) return {{{kept.begin(), kept.end()}, std::move(*planes)}};
  std::vector<PartedFaces> parts;
  for (const std::uint32_t face : kept) {
    std::vector<std::uint32_t> others(dropped.begin(), dropped.end());
    std::copy_if(kept.begin(), kept.end(), std::back_inserter(others), [&](std::uint32_t k) { return k != face; });
    auto planes = planes_around(surface, std::span(&face, 1), others);
    if (!planes) {
      throw Error(
          message("one patch of the surface winds around another piece of itself, so that no plane separates them; "
                  "this part of the surface cannot be drawn alone (@cavities@, @by component@)"));
    }
    parts.push_back({{face}, std::move(*planes)});
  }
  return parts;
}

}  // namespace meniscus
