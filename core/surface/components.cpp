// SPDX-License-Identifier: BSD-3-Clause
// Joins faces to components, computes their Euler characteristics, and distinguishes outer components from cavities.
#include "core/surface/components.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>

#include "core/math/union_find.h"
#include "core/surface/convex_planes.h"
#include "core/surface/parallel_tables.h"
#include "core/surface/primitives.h"
#include "core/surface/spherical.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

// Calls visit(range) for parts of a table, each long enough to outweigh its own overhead.
template <typename Visit>
void for_each_part(std::size_t size, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, 1024), visit);
}

// Adds to the Euler characteristics; most additions in a row go to the same component.
class EulerSum {
 public:
  explicit EulerSum(std::vector<Component>& components) : components_(components) {}
  ~EulerSum() { hand_over(); }
  EulerSum(const EulerSum&) = delete;
  EulerSum& operator=(const EulerSum&) = delete;

  void add(std::uint32_t component, int count) {
    if (component != component_) hand_over();
    component_ = component;
    sum_ += count;
  }

 private:
  void hand_over() {
    if (sum_ != 0) std::atomic_ref<int>(components_[component_].euler).fetch_add(sum_, std::memory_order_relaxed);
    sum_ = 0;
  }

  std::vector<Component>& components_;
  std::uint32_t component_ = 0;
  int sum_ = 0;
};

class ComponentFinder {
 public:
  explicit ComponentFinder(Surface& surface)
      : s_(surface), first_border_(std::make_unique_for_overwrite<std::atomic<std::uint32_t>[]>(s_.vertices.size())) {}

  bool run() {
    for_each_part(s_.vertices.size(), [&](const auto& range) {
      for (std::size_t v = range.begin(); v != range.end(); ++v)
        first_border_[v].store(kNone, std::memory_order_relaxed);
    });
    const bool closed = join_faces();
    count_borders();
    return closed;
  }

 private:
  bool join_faces() {
    SharedUnionFind joined(s_.faces.size());
    std::atomic<bool> closed = true;
    for_each_part(s_.borders.size(), [&](const auto& range) {
      for (std::size_t b = range.begin(); b != range.end(); ++b) {
        const Border& border = s_.borders[b];
        prefetch_ends(b + kPrefetchAhead);
        if (border.face[0] != kNone) claim_vertices(border, static_cast<std::uint32_t>(b));
        if (border.face[0] != kNone && border.face[1] != kNone)
          joined.unite(border.face[0], border.face[1]);
        else
          closed.store(false, std::memory_order_relaxed);
      }
    });
    number_components(joined);
    return closed;
  }

  // A set is named by its smallest face, so ascending names are components in the order of their first faces.
  void number_components(SharedUnionFind& joined) {
    const RowNumbers<std::uint32_t> numbers(s_.faces.size(), 0,
                                            [&](std::size_t f) { return joined.find(index(f)) == f ? 1u : 0u; });
    s_.components.resize(numbers.past());
    for (Component& component : s_.components) component.euler = 0;
    numbers.for_each([&](std::size_t f, std::uint32_t& next) {
      if (joined.find(index(f)) == f) s_.faces[f].component = next++;
    });
    for_each_part(s_.faces.size(), [&](const auto& range) {
      EulerSum euler(s_.components);
      for (std::size_t f = range.begin(); f != range.end(); ++f) {
        Face& face = s_.faces[f];
        if (const std::uint32_t root = joined.find(index(f)); root != f) face.component = s_.faces[root].component;
        euler.add(face.component, 2 - static_cast<int>(face.loop_count));
      }
    });
  }

  // Counts vertices - borders with ends + sum over faces of (2 - loops); whole circles count nothing.
  void count_borders() {
    for_each_part(s_.borders.size(), [&](const auto& range) {
      EulerSum euler(s_.components);
      for (std::size_t b = range.begin(); b != range.end(); ++b) {
        const Border& border = s_.borders[b];
        prefetch_ends(b + kPrefetchAhead);
        if (border.vertex[0] == kNone || border.face[0] == kNone) continue;
        const int vertices =
            claims(border.vertex[0], b) + (border.vertex[1] != border.vertex[0] ? claims(border.vertex[1], b) : 0);
        euler.add(s_.faces[border.face[0]].component, vertices - 1);
      }
    });
  }

  // Prefetches what is known of a later border's ends and of its left face.
  [[gnu::always_inline]] void prefetch_ends(std::size_t b) const {
    if (b >= s_.borders.size()) return;
    for (const std::uint32_t v : s_.borders[b].vertex)
      if (v != kNone) __builtin_prefetch(&first_border_[v]);
    prefetch(s_.faces, s_.borders[b].face[0]);
  }

  // Counts each vertex once, with the first border that has it.
  void claim_vertices(const Border& border, std::uint32_t b) {
    if (border.vertex[0] == kNone) return;
    for (const std::uint32_t v : border.vertex) {
      std::uint32_t first = first_border_[v].load(std::memory_order_relaxed);
      while (b < first && !first_border_[v].compare_exchange_weak(first, b, std::memory_order_relaxed)) {
      }
    }
  }

  int claims(std::uint32_t vertex, std::size_t b) const {
    return first_border_[vertex].load(std::memory_order_relaxed) == b ? 1 : 0;
  }

  static std::uint32_t index(std::size_t n) { return static_cast<std::uint32_t>(n); }

  Surface& s_;
  std::unique_ptr<std::atomic<std::uint32_t>[]> first_border_;  // per vertex
};

}  // namespace

bool connect_components(Surface& surface) { return ComponentFinder(surface).run(); }

namespace {

// A direction along which molecules are not likely to be aligned.
const glm::dvec3 kDirection = glm::normalize(glm::dvec3(0.5377266, 0.3183099, 0.7788008));

double farthest_of(const Border& border) {
  const glm::dvec3 across = kDirection - border.axis * glm::dot(border.axis, kDirection);
  const double length = glm::length(across), middle = glm::dot(border.center, kDirection);
  const glm::dvec3 side = glm::cross(border.axis, border.start);
  const double at_start = middle + border.radius * glm::dot(border.start, kDirection);
  if (!(length > 0)) return at_start;
  double turn = std::atan2(glm::dot(side, across), glm::dot(border.start, across));
  if (turn < 0) turn += 2 * std::acos(-1.0);
  if (border.vertex[0] == kNone || turn <= border.sweep) return middle + border.radius * length;
  const double at_end = middle + border.radius * glm::dot(arc_direction(border, border.sweep), kDirection);
  return std::max(at_start, at_end);
}

class SideTest {
 public:
  SideTest(const Surface& surface, const ConvexPlanes& planes)
      : s_(surface), planes_(planes), farthest_(surface.components.size()) {}

  std::vector<Farthest> run() {
    find_border_extents();
    find_pole_extents(
        s_.convex, [&](const ConvexPatch& patch) { return s_.atoms[patch.atom]; },
        [&](std::uint32_t n) { return planes_.cut_off(n, kDirection); }, &Farthest::convex);
    if (s_.probe_radius > 0)
      find_pole_extents(
          s_.concave,
          [&](const ConcavePatch& patch) {
            return Ball{patch.center, s_.probe_radius};
          },
          [&](std::uint32_t n) {
            const ConcavePatch& patch = s_.concave[n];
            return cut_off_by(std::span(s_.planes).subspan(patch.first_plane, patch.plane_count()),
                              pole_of({patch.center, s_.probe_radius}));
          },
          &Farthest::concave);
    return std::move(farthest_);
  }

 private:
  // Finds the extents of the borders. Each thread has its own list; the largest number is the same in any order.
  void find_border_extents() {
    tbb::enumerable_thread_specific<std::vector<double>> lists(
        [&] { return std::vector<double>(farthest_.size(), -std::numeric_limits<double>::infinity()); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.borders.size(), 1024), [&](const auto& range) {
      std::vector<double>& farthest = lists.local();
      for (std::size_t n = range.begin(); n != range.end(); ++n) include(s_.borders[n], farthest);
    });
    for (const std::vector<double>& list : lists)
      for (std::size_t c = 0; c < list.size(); ++c) farthest_[c].border = std::max(farthest_[c].border, list[c]);
  }

  void include(const Border& border, std::vector<double>& farthest) const {
    const std::uint32_t face = border.face[0] != kNone ? border.face[0] : border.face[1];
    if (face == kNone) return;
    double& best = farthest[s_.faces[face].component];
    if (glm::dot(border.center, kDirection) + border.radius > best) best = std::max(best, farthest_of(border));
  }

  // Returns the extent that a pole must exceed to matter: a convex pole that of the borders, a concave pole also that
  // of the convex poles.
  static double threshold(const Farthest& farthest, double Farthest::*which) {
    const double others = which == &Farthest::concave ? std::max(farthest.convex, farthest.border) : farthest.border;
    return std::max(farthest.*which, others);
  }

  // Finds the extents of the poles in one table of patches. `ball_of` returns the sphere of a patch, `without_pole` is
  // true if the patch's planes cut off the pole.
  template <typename Patch, typename BallOf, typename WithoutPole>
  void find_pole_extents(const std::vector<Patch>& patches, const BallOf& ball_of, const WithoutPole& without_pole,
                         double Farthest::*which) {
    tbb::enumerable_thread_specific<std::vector<std::uint32_t>> lists;  // patches that contain their pole
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, patches.size(), 64), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) {
        if (!may_be_farthest(patches[n], ball_of(patches[n]), which)) continue;
        const auto patch = static_cast<std::uint32_t>(n);
        if (!without_pole(patch)) lists.local().push_back(patch);
      }
    });
    for (const std::vector<std::uint32_t>& list : lists)
      for (const std::uint32_t patch : list) {
        const Ball ball = ball_of(patches[patch]);
        double& best = farthest_[s_.faces[face_at_pole(patches[patch], ball)].component].*which;
        best = std::max(best, glm::dot(pole_of(ball), kDirection));
      }
  }

  static glm::dvec3 pole_of(const Ball& ball) { return ball.center + ball.radius * kDirection; }

  template <typename Patch>
  bool may_be_farthest(const Patch& patch, const Ball& ball, double Farthest::*which) const {
    const double reached = glm::dot(pole_of(ball), kDirection);
    return std::ranges::any_of(faces_of(s_, patch),
                               [&](const Face& face) { return reached > threshold(farthest_[face.component], which); });
  }

  // Returns the face of the patch that contains the pole: the face whose loops have it farthest on their left.
  template <typename Patch>
  std::uint32_t face_at_pole(const Patch& patch, const Ball& ball) {
    std::uint32_t best = patch.first_face;
    double clearest = -3;
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count && patch.face_count > 1; ++f) {
      double least = 3;
      for (std::uint32_t l = s_.faces[f].first_loop; l < s_.faces[f].first_loop + s_.faces[f].loop_count; ++l) {
        walk_loop(s_, s_.loops[l], ball.center, ball.radius, s_.faces[f].kind == PatchKind::concave, loop_);
        least = std::min(least, distance_left_of(kDirection, loop_));
      }
      if (least <= clearest) continue;
      clearest = least;
      best = f;
    }
    return best;
  }

  const Surface& s_;
  const ConvexPlanes& planes_;
  std::vector<Farthest> farthest_;
  std::vector<SphereArc> loop_;
};

}  // namespace

void Farthest::include(const Farthest& other) {
  border = std::max(border, other.border);
  convex = std::max(convex, other.convex);
  concave = std::max(concave, other.concave);
}

std::vector<Farthest> farthest_of_components(const Surface& surface, const ConvexPlanes& planes) {
  return SideTest(surface, planes).run();
}

ComponentKind side_of(const Farthest& f, double probe_radius) {
  const bool cavity = probe_radius > 0 ? f.concave > std::max(f.convex, f.border) : !(f.convex > f.border);
  return cavity ? ComponentKind::cavity : ComponentKind::outer;
}

std::vector<ComponentKind> side_of_components(const Surface& surface, const ConvexPlanes& planes) {
  std::vector<ComponentKind> kinds;
  for (const Farthest& farthest : farthest_of_components(surface, planes))
    kinds.push_back(side_of(farthest, surface.probe_radius));
  return kinds;
}

}  // namespace meniscus
