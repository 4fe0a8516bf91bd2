// SPDX-License-Identifier: BSD-3-Clause
// Joins surfaces and their copies into one, and searches for copies that come too close to each other.
#include "core/queries/copies.h"

#include <cassert>
#include <iterator>
#include <tuple>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "core/base/error.h"
#include "core/queries/surface_object.h"

namespace meniscus {
namespace {

bool is_identity(const RigidMotion& motion) {
  return motion.rotation == glm::dmat3(1.0) && motion.translation == glm::dvec3(0.0);
}

// Throws CapacityError if a table would get too many rows. Half-borders are numbered up to twice the number of borders,
// and no other table is longer.
void check_capacity(const Surface& whole, const Surface& part) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 2;
  if (whole.borders.size() + part.borders.size() < kMost && whole.planes.size() + part.planes.size() < kMost) return;
  throw CapacityError("all surfaces together have too many patches for one picture or mesh; draw fewer copies");
}

/// Appends the moved rows of a surface to another one.
class Appender {
 public:
  Appender(Surface& whole, const Surface& part, const RigidMotion& motion)
      : whole_(whole),
        part_(part),
        motion_(motion),
        atom_(size(whole.atoms)),
        concave_(size(whole.concave)),
        plane_(size(whole.planes)),
        vertex_(size(whole.vertices)),
        border_(size(whole.borders)),
        face_(size(whole.faces)) {}

  void run() {
    append_patches();
    append_boundary();
    whole_.area += part_.area;
    whole_.volume += part_.volume;
  }

  void append_patches() {
    const std::uint32_t contact = size(whole_.contacts), cut = size(whole_.cuts);
    add(whole_.convex, part_.convex, [&](ConvexPatch& patch) {
      patch.atom += atom_;
      patch.first_plane += plane_;
      patch.first_face += face_;
    });
    add(whole_.toroidal, part_.toroidal, [&](ToroidalPatch& patch) {
      for (std::uint32_t& atom : patch.atom) atom += atom_;
      for (std::uint32_t& probe : patch.probe) shift(probe, concave_);
      patch = moved(patch, motion_);
      patch.first_face += face_;
    });
    add(whole_.concave, part_.concave, [&](ConcavePatch& patch) {
      patch = moved(patch, motion_);
      patch.first_contact += contact;
      patch.first_plane += plane_;
      patch.first_cut += cut;
      patch.first_face += face_;
    });
    add(whole_.atoms, part_.atoms, [&](Ball& ball) { ball = moved(ball, motion_); });
    add(whole_.planes, part_.planes, [&](Plane& plane) { plane = moved(plane, motion_); });
    add(whole_.contacts, part_.contacts, [&](std::uint32_t& atom) { atom += atom_; });
    add(whole_.cuts, part_.cuts, [&](std::uint32_t& probe) { shift(probe, concave_); });
  }

 private:
  template <typename Row>
  static std::uint32_t size(const std::vector<Row>& rows) {
    return static_cast<std::uint32_t>(rows.size());
  }

  /// Appends rows, each changed by move(row).
  template <typename Row, typename Move>
  static void add(std::vector<Row>& rows, const std::vector<Row>& more, Move&& move) {
    std::transform(more.begin(), more.end(), std::back_inserter(rows), [&](Row row) {
      move(row);
      return row;
    });
  }

  /// Adds to an index unless it is kNone.
  static void shift(std::uint32_t& index, std::uint32_t by) {
    if (index != kNone) index += by;
  }

  void move(glm::dvec3& point) const { point = motion_(point); }
  void turn(glm::dvec3& direction) const { direction = motion_.rotation * direction; }

  void append_boundary() {
    const std::uint32_t half_border = size(whole_.half_borders), loop = size(whole_.loops);
    const std::uint32_t component = size(whole_.components);
    const std::array<std::uint32_t, 3> first_patch{size(whole_.convex) - size(part_.convex),
                                                   size(whole_.toroidal) - size(part_.toroidal), concave_};
    add(whole_.vertices, part_.vertices, [&](glm::dvec3& vertex) { move(vertex); });
    add(whole_.borders, part_.borders, [&](Border& border) {
      move(border.center);
      turn(border.axis);
      turn(border.start);
      for (std::uint32_t& vertex : border.vertex) shift(vertex, vertex_);
      for (std::uint32_t& face : border.face) shift(face, face_);
    });
    add(whole_.half_borders, part_.half_borders, [&](HalfBorder& half) { half += 2 * border_; });
    add(whole_.loops, part_.loops, [&](Loop& walk) { walk.first_half_border += half_border; });
    add(whole_.faces, part_.faces, [&](Face& face) {
      face.patch += first_patch[static_cast<std::size_t>(face.kind)];
      face.first_loop += loop;
      face.component += component;
      shift(face.tip, vertex_);
    });
    add(whole_.components, part_.components, [](Component&) {});
    whole_.certificate.grown_by = std::max(whole_.certificate.grown_by, part_.certificate.grown_by);
    whole_.certificate.exact_within = std::max(whole_.certificate.exact_within, part_.certificate.exact_within);
    add(whole_.certificate.open_atoms, part_.certificate.open_atoms, [&](std::uint32_t& atom) { atom += atom_; });
  }

  Surface& whole_;
  const Surface& part_;
  const RigidMotion& motion_;
  // The numbers of rows that the tables had before, by which indices are shifted.
  std::uint32_t atom_, concave_, plane_, vertex_, border_, face_;
};

/// Appends a column of atoms, which stays empty if all have the usual value.
template <typename Value>
void append_column(std::vector<Value>& whole, const std::vector<Value>& part, std::size_t atoms_before,
                   std::size_t atoms, Value usual) {
  if (part.empty() && whole.empty()) return;
  whole.resize(atoms_before, usual);
  whole.insert(whole.end(), part.begin(), part.end());
  whole.resize(atoms_before + atoms, usual);
}

void append_coloring(Coloring& whole, const Coloring& part, std::size_t atoms_before, std::size_t atoms) {
  whole.atom.insert(whole.atom.end(), part.atom.begin(), part.atom.end());
  if (!part.part.empty()) {  // copies and objects are separate parts
    const std::uint32_t before = whole.part.empty() ? 0 : *std::ranges::max_element(whole.part) + 1;
    std::ranges::transform(part.part, std::back_inserter(whole.part), [&](std::uint32_t n) { return before + n; });
  }
  append_column(whole.own_color, part.own_color, atoms_before, atoms, false);
  append_column(whole.hidden, part.hidden, atoms_before, atoms, false);
  append_column(whole.in_patch, part.in_patch, atoms_before, atoms, false);
  append_column(whole.opacity, part.opacity, atoms_before, atoms, 1.0f);
}

}  // namespace

void append(Surface& whole, const Surface& part, const RigidMotion& motion) {
  if (whole.atoms.empty()) {
    whole.probe_radius = part.probe_radius;
    whole.certificate.closed = true;
  }
  assert(&whole != &part && whole.probe_radius == part.probe_radius);
  check_capacity(whole, part);
  Appender(whole, part, motion).run();
  whole.certificate.closed = whole.certificate.closed && part.certificate.closed;
}

SurfaceObject merged(std::vector<SurfaceObject> objects) {
  if (objects.size() == 1 && objects[0].copies.size() == 1 && is_identity(objects[0].copies[0]))
    return std::move(objects[0]);
  SurfaceObject whole;
  if (objects.empty()) return whole;
  whole.name = objects.front().name;
  whole.coloring.kind = objects.front().coloring.kind;
  whole.coloring.volume = objects.front().coloring.volume;
  for (SurfaceObject& object : objects) {
    assert(object.coloring.kind == whole.coloring.kind);
    for (const RigidMotion& copy : object.copies) {
      append_coloring(whole.coloring, object.coloring, whole.surface.atoms.size(), object.surface.atoms.size());
      append(whole.surface, object.surface, copy);
      whole.atom.insert(whole.atom.end(), object.atom.begin(), object.atom.end());
    }
    object = {};  // frees its memory before the copies of the next object need some
  }
  return whole;
}

bool copies_differ(std::span<const SurfaceObject> objects) {
  return std::ranges::any_of(
      objects, [](const SurfaceObject& object) { return object.copies.size() > 1 && object.coloring.volume; });
}

std::uint32_t merged_atom(std::span<const SurfaceObject> objects, std::size_t atom) {
  for (const SurfaceObject& object : objects) {
    const std::size_t count = object.copies.size() * object.atom.size();
    if (atom < count) return object.atom[atom % object.atom.size()];
    atom -= count;
  }
  assert(false);
  return kNone;
}

std::vector<Ball> placed_balls(std::span<const SurfaceObject> objects) {
  std::size_t count = 0;
  for (const SurfaceObject& object : objects) count += object.copies.size() * object.surface.atoms.size();
  std::vector<Ball> balls;
  balls.reserve(count);
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const Ball& ball : object.surface.atoms) balls.push_back({copy(ball.center), ball.radius});
  return balls;
}

namespace {

constexpr double kRounding = 1e-6;  // Å

/// The gap between two balls, and their numbers. The smallest pair is the closest; ties go to the lowest numbers.
struct Pair {
  double gap = 0.0;
  std::uint32_t a = kNone, b = kNone;
  bool operator<(const Pair& other) const { return std::tie(gap, a, b) < std::tie(other.gap, other.a, other.b); }
};

/// All copies of balls in their places.
struct PlacedBalls {
  std::vector<CopiedBall> who;
  std::vector<Ball> balls;
};

PlacedBalls place_copies(std::span<const CopiedBalls> groups) {
  PlacedBalls placed;
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    for (std::uint32_t c = 0; c < groups[g].motions.size(); ++c) {
      for (std::uint32_t b = 0; b < groups[g].balls.size(); ++b) {
        placed.who.push_back({g, c, b});
        placed.balls.push_back({groups[g].motions[c](groups[g].balls[b].center), groups[g].balls[b].radius});
      }
    }
  }
  return placed;
}

}  // namespace

std::optional<CopyContact> closest_contact(std::span<const CopiedBalls> groups, double probe_radius) {
  const PlacedBalls placed = place_copies(groups);
  double largest = 0.0;
  for (const Ball& ball : placed.balls) largest = std::max(largest, ball.radius);
  const BallGrid grid(std::span<const Ball>(placed.balls), largest + probe_radius);
  // Balls of one group move together, so those with the same motion belong to one copy.
  const auto same_copy = [&](std::uint32_t a, std::uint32_t b) {
    return placed.who[a].group == placed.who[b].group && placed.who[a].copy == placed.who[b].copy;
  };
  const auto search = [&](const tbb::blocked_range<std::uint32_t>& range, Pair closest) {
    for (std::uint32_t a = range.begin(); a != range.end(); ++a) {
      const Ball& ball = placed.balls[a];
      const double reach = ball.radius + largest + 2.0 * probe_radius + kRounding;
      grid.for_each_near(ball.center, reach, [&](std::uint32_t b) {
        if (b <= a || same_copy(a, b)) return;
        const double radii = ball.radius + placed.balls[b].radius;
        const Pair pair{glm::distance(ball.center, placed.balls[b].center) - radii, a, b};
        if (pair.gap <= 2.0 * probe_radius + kRounding && (closest.a == kNone || pair < closest)) closest = pair;
      });
    }
    return closest;
  };
  const auto nearer = [](const Pair& x, const Pair& y) {
    if (x.a == kNone || y.a == kNone) return x.a == kNone ? y : x;
    return std::min(x, y);
  };
  const Pair closest =
      tbb::parallel_reduce(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(placed.balls.size()), 1024),
                           Pair{}, search, nearer);
  if (closest.a == kNone) return std::nullopt;
  return CopyContact{{placed.who[closest.a], placed.who[closest.b]},
                     glm::distance(placed.balls[closest.a].center, placed.balls[closest.b].center)};
}

namespace {

constexpr std::size_t kMostListed = 1'000'000;

/// Returns the atoms among these whose balls reach farthest in one of 124 directions, ascending.
std::vector<std::uint32_t> farthest_atoms(std::span<const Ball> balls, std::span<const std::uint32_t> atoms) {
  std::vector<std::uint32_t> farthest;
  constexpr int kSteps = 2;
  for (int x = -kSteps; x <= kSteps; ++x)
    for (int y = -kSteps; y <= kSteps; ++y)
      for (int z = -kSteps; z <= kSteps; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(x, y, z));
        farthest.push_back(*std::ranges::max_element(
            atoms, {}, [&](std::uint32_t a) { return glm::dot(direction, balls[a].center) + balls[a].radius; }));
      }
  std::ranges::sort(farthest);
  farthest.erase(std::unique(farthest.begin(), farthest.end()), farthest.end());
  return farthest;
}

}  // namespace

std::size_t placed_count(std::span<const Instances> copies) {
  std::size_t count = 0;
  for (const Instances& group : copies) count += group.atoms.size() * group.motions.size();
  return count;
}

std::vector<CopiedAtom> placed_atoms(std::span<const Instances> copies) {
  std::vector<CopiedAtom> placed;
  placed.reserve(placed_count(copies));
  for (const Instances& group : copies)
    for (std::uint32_t copy = 0; copy < group.motions.size(); ++copy)
      for (const std::uint32_t atom : group.atoms) placed.push_back({atom, copy});
  return placed;
}

std::vector<Ball> placed_balls(std::span<const Ball> balls, std::span<const Instances> copies) {
  std::vector<Ball> placed;
  placed.reserve(placed_count(copies));
  for (const Instances& group : copies)
    for (const RigidMotion& motion : group.motions)
      for (const std::uint32_t atom : group.atoms) placed.push_back({motion(balls[atom].center), balls[atom].radius});
  return placed;
}

Coloring coloring_of(const Coloring& coloring, std::span<const std::uint32_t> atoms) {
  Coloring of;
  of.kind = coloring.kind;
  for (const std::uint32_t atom : atoms) {
    of.atom.push_back(coloring.atom[atom]);
    if (!coloring.hidden.empty()) of.hidden.push_back(coloring.hidden[atom]);
    if (!coloring.opacity.empty()) of.opacity.push_back(coloring.opacity[atom]);
    if (!coloring.in_patch.empty()) of.in_patch.push_back(coloring.in_patch[atom]);
    if (!coloring.part.empty()) of.part.push_back(coloring.part[atom]);
  }
  return of;
}

std::vector<Ball> standing_balls(const Structure& structure, const std::vector<bool>& picked) {
  const std::vector<Ball> balls = balls_of(structure);
  const auto is_out = [&picked](std::uint32_t atom) { return !picked.empty() && !picked[atom]; };
  if (!structure.instances.empty()) {
    std::vector<Instances> copies = structure.instances;
    for (Instances& group : copies) std::erase_if(group.atoms, is_out);
    std::erase_if(copies, [](const Instances& group) { return group.atoms.empty(); });
    return reaching_balls(balls, copies);
  }
  std::vector<Ball> standing;
  for (std::uint32_t a = 0; a < balls.size(); ++a)
    if (!is_out(a)) standing.push_back(balls[a]);
  return standing;
}

std::vector<Ball> reaching_balls(std::span<const Ball> balls, std::span<const Instances> copies) {
  if (placed_count(copies) <= kMostListed) return placed_balls(balls, copies);
  std::vector<Instances> outer(copies.begin(), copies.end());
  for (Instances& group : outer) group.atoms = farthest_atoms(balls, group.atoms);
  return placed_balls(balls, outer);
}

}  // namespace meniscus
