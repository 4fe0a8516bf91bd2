// SPDX-License-Identifier: BSD-3-Clause
// Implements the sequential rolling probe: first face, next face by smallest angle, restarts for other components.
#include "app/bench/rolling_probe.h"

#include <utility>

#include "core/math/ball.h"

namespace meniscus {
namespace {

// An RS face: the probe touches atoms a < b < c and is on one side of their plane. The face is stored with atom a. Its
// edges lie on the circles (a, b), (a, c), (b, c); the arc of each begins or ends at the face.
struct RollingFace {
  std::uint32_t b;
  std::uint32_t c;
  bool side;  // true: the side of cross(b - a, c - a)
  std::array<bool, 3> rolled{};
};

struct FaceName {
  std::uint32_t a;
  std::size_t index;  // index among the faces stored with a
};

// One end of an arc of the circle (i, j), i < j, where the probe touches k.
struct ArcEnd {
  std::uint32_t i;
  std::uint32_t j;
  std::uint32_t k;
  bool begins;  // true if the arc begins here, counter-clockwise about the axis from i to j
};

class RollingProbe {
 public:
  RollingProbe(std::span<const Ball> atoms, double probe_radius)
      : atoms_(atoms),
        weights_(decision_weights(atoms, probe_radius)),
        swallowed_(swallowed_atoms(atoms)),
        largest_radius_(largest_radius()),
        grid_(atoms, largest_radius_),
        neighbors_(atoms.size()),
        listed_(atoms.size(), 0),
        faces_(atoms.size()) {}

  ReducedSurface run(RollingScope scope) {
    if (scope == RollingScope::outer_component)
      start_outside();
    else
      start_everywhere();
    std::sort(rs_.arcs.begin(), rs_.arcs.end());
    if (scope == RollingScope::complete) find_whole_spheres(atoms_, weights_, swallowed_, rs_);
    return std::move(rs_);
  }

 private:
  double largest_radius() const {
    double largest = 0;
    for (const double w : weights_) largest = std::max(largest, std::sqrt(w));
    return largest;
  }

  // Returns the atoms whose balls overlap that of atom i, nearest first.
  const std::vector<RollingNeighbor>& neighbors_of(std::uint32_t i) {
    std::vector<RollingNeighbor>& list = neighbors_[i];
    if (listed_[i]) return list;
    listed_[i] = 1;
    const double radius = std::sqrt(weights_[i]);
    grid_.for_each_near(atoms_[i].center, radius + largest_radius_, [&](std::uint32_t j) {
      if (j == i || swallowed_[j]) return;
      const glm::dvec3 d = atoms_[j].center - atoms_[i].center;
      const double reach = radius + std::sqrt(weights_[j]) + 1e-12;
      if (glm::dot(d, d) < reach * reach) list.push_back({d, weights_[j], j});
    });
    std::sort(list.begin(), list.end(), [](const RollingNeighbor& x, const RollingNeighbor& y) {
      const double xx = glm::dot(x.center, x.center), yy = glm::dot(y.center, y.center);
      return xx < yy || (xx == yy && x.atom < y.atom);
    });
    return list;
  }

  // Evaluates a predicate on the circle of atom i and its n-th neighbour, in quadruple precision if necessary.
  template <typename Question>
  auto ask(std::uint32_t i, std::size_t n, Question&& question) {
    const std::vector<RollingNeighbor>& neighbors = neighbors_of(i);
    circle_.place(weights_[i], neighbors, n);
    if (circle_.certain()) {
      const auto answer = question(circle_);
      if (circle_.certain()) return answer;
    }
    quad_circle_.place(weights_[i], neighbors, n);
    return question(quad_circle_);
  }

  std::size_t neighbor_index(std::uint32_t i, std::uint32_t j) {
    const std::vector<RollingNeighbor>& list = neighbors_of(i);
    const auto found = std::find_if(list.begin(), list.end(), [&](const RollingNeighbor& n) { return n.atom == j; });
    return static_cast<std::size_t>(found - list.begin());
  }

  // Returns the arc's end. Side and edge numbers follow from the order of the three atoms: exchanging k with one of
  // them flips the triangle.
  static ArcEnd arc_end(std::uint32_t a, const RollingFace& face, int edge) {
    if (edge == 0) return {a, face.b, face.c, face.side};
    if (edge == 1) return {a, face.c, face.b, !face.side};
    return {face.b, face.c, a, face.side};
  }

  // Returns the face at the end of an arc, stored if it is new, with the number of the arc's edge in it.
  FaceName face_at(const ArcEnd& end, int& edge, bool& is_new) {
    const auto [a, b, c, side] = geometry::triple_at(end.i, end.j, end.k, !end.begins);
    const RollingFace face{b, c, side != 0};
    edge = static_cast<int>(geometry::role_of_third(end.i, end.j, end.k));
    std::vector<RollingFace>& filed = faces_[a];
    const auto same = [&](const RollingFace& f) { return f.b == face.b && f.c == face.c && f.side == face.side; };
    const auto found = std::find_if(filed.begin(), filed.end(), same);
    is_new = found == filed.end();
    const auto index = static_cast<std::size_t>(found - filed.begin());
    if (is_new) filed.push_back(face);
    return {a, index};
  }

  // Rolls over every edge of the face, of the faces met there, and so on (Sanner's treatment of edges).
  void roll_from(const ArcEnd& start) {
    int edge = 0;
    bool is_new = false;
    const FaceName first = face_at(start, edge, is_new);
    if (!is_new) return;
    waiting_.push_back(first);
    while (!waiting_.empty()) {
      const FaceName name = waiting_.back();
      waiting_.pop_back();
      for (int e = 0; e < 3; ++e)
        if (!faces_[name.a][name.index].rolled[e]) roll_over(name, e);
    }
  }

  void roll_over(const FaceName& name, int edge) {
    RollingFace& face = faces_[name.a][name.index];
    face.rolled[edge] = true;
    const ArcEnd from = arc_end(name.a, face, edge);
    const std::uint32_t met =
        ask(from.i, neighbor_index(from.i, from.j), [&](auto& circle) { return circle.roll(from.k, from.begins); });
    if (met == kNone) return;
    if (from.begins)
      rs_.arcs.push_back({from.i, from.j, from.k, met});
    else
      rs_.arcs.push_back({from.i, from.j, met, from.k});
    int other_edge = 0;
    bool is_new = false;
    const FaceName other = face_at({from.i, from.j, met, !from.begins}, other_edge, is_new);
    faces_[other.a][other.index].rolled[other_edge] = true;
    if (is_new) waiting_.push_back(other);
  }

  // The leftmost point of all balls is free: from there the probe slides over that atom's ball until it meets a second
  // one, and rolls in contact with both until it meets a third.
  void start_outside() {
    std::uint32_t leftmost = kNone;
    double least = 0;
    for (std::uint32_t i = 0; i < atoms_.size(); ++i) {
      if (swallowed_[i]) continue;
      const double left = atoms_[i].center.x - std::sqrt(weights_[i]);
      if (leftmost == kNone || left < least) {
        least = left;
        leftmost = i;
      }
    }
    if (leftmost == kNone) return;
    const std::vector<RollingNeighbor>& neighbors = neighbors_of(leftmost);
    if (neighbors.empty()) rs_.lone_atoms.push_back(leftmost);
    for (const RollingNeighbor& towards : neighbors)
      if (slide(leftmost, towards.center)) return;
  }

  // Slides over the ball of atom i from its leftmost point towards a point; returns false if rounding spoils the start.
  bool slide(std::uint32_t i, const glm::dvec3& towards) {
    const glm::dvec3 left(-1, 0, 0);
    const glm::dvec3 across = towards - left * glm::dot(left, towards);
    const glm::dvec3 ahead = glm::length(across) > 1e-6 ? glm::normalize(across) : geometry::perpendicular(left);
    const std::vector<RollingNeighbor>& neighbors = neighbors_of(i);
    const double radius = std::sqrt(weights_[i]);
    double first_angle = 2 * std::numbers::pi;
    std::size_t second = neighbors.size();
    for (std::size_t n = 0; n < neighbors.size(); ++n) {
      const glm::dvec3& d = neighbors[n].center;
      const double height = (weights_[i] + glm::dot(d, d) - neighbors[n].weight) / (2 * radius);
      const double x = glm::dot(left, d), y = glm::dot(ahead, d), length = std::hypot(x, y);
      if (height >= length) continue;
      double angle = std::atan2(y, x) - std::acos(std::max(-1.0, height / length));
      if (angle < 0) angle += 2 * std::numbers::pi;
      if (angle < first_angle) {
        first_angle = angle;
        second = n;
      }
    }
    if (second == neighbors.size()) return false;
    const glm::dvec3 point = radius * (std::cos(first_angle) * left + std::sin(first_angle) * ahead);
    return start_on(i, second, point);
  }

  bool start_on(std::uint32_t i, std::size_t n, const glm::dvec3& point) {
    const std::uint32_t j = neighbors_of(i)[n].atom;
    if (ask(i, n, [](auto& circle) { return circle.free(); })) {
      rs_.arcs.push_back({std::min(i, j), std::max(i, j), kNone, kNone});
      return true;
    }
    const std::uint32_t k = ask(i, n, [&](auto& circle) { return circle.first_from(point); });
    if (k == kNone) return false;
    const bool accessible = ask(i, n, [&](auto& circle) {
      for (std::size_t m = 0; m < circle.met_count(); ++m)
        if (circle.met_atom(m) == k) return circle.accessible(m, false);
      return false;
    });
    // Seen from the other atom, the circle runs in the opposite sense.
    if (accessible) roll_from(i < j ? ArcEnd{i, j, k, false} : ArcEnd{j, i, k, true});
    return accessible;
  }

  void start_everywhere() {
    std::vector<ArcEnd> starts;
    for (std::uint32_t i = 0; i < atoms_.size(); ++i) {
      if (swallowed_[i]) continue;
      const std::size_t count = neighbors_of(i).size();
      for (std::size_t n = 0; n < count; ++n) {
        const std::uint32_t j = neighbors_[i][n].atom;
        if (j < i) continue;
        const bool whole = ask(i, n, [&](auto& circle) {
          list_starts(circle, i, j, starts);
          return circle.free();
        });
        if (whole) rs_.arcs.push_back({i, j, kNone, kNone});
        for (const ArcEnd& start : starts) roll_from(start);
      }
    }
  }

  // Lists the unvisited ends of arcs of the circle (i, j) at later atoms where the probe fits.
  template <typename Circle>
  void list_starts(Circle& circle, std::uint32_t i, std::uint32_t j, std::vector<ArcEnd>& starts) const {
    starts.clear();
    if (circle.covered()) return;
    for (std::size_t m = 0; m < circle.met_count(); ++m) {
      const std::uint32_t k = circle.met_atom(m);
      if (k < j) continue;
      for (const bool begins : {false, true}) {
        const auto been = [&](const RollingFace& f) { return f.b == j && f.c == k && f.side == begins; };
        if (std::any_of(faces_[i].begin(), faces_[i].end(), been)) continue;
        if (circle.accessible(m, begins)) starts.push_back({i, j, k, begins});
      }
    }
  }

  std::span<const Ball> atoms_;
  std::vector<double> weights_;
  std::vector<bool> swallowed_;
  double largest_radius_;
  BallGrid grid_;
  std::vector<std::vector<RollingNeighbor>> neighbors_;
  std::vector<char> listed_;
  std::vector<std::vector<RollingFace>> faces_;  // by smallest atom
  std::vector<FaceName> waiting_;
  RollingCircle<DoublePrecision> circle_;
  RollingCircle<QuadPrecision> quad_circle_;
  ReducedSurface rs_;
};

}  // namespace

ReducedSurface roll_probe(std::span<const Ball> atoms, double probe_radius, RollingScope scope) {
  return RollingProbe(atoms, probe_radius).run(scope);
}

}  // namespace meniscus
