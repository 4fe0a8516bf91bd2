// SPDX-License-Identifier: BSD-3-Clause
// Casts rays from balls, all around or towards a viewer, and finds those that meet no other ball; finds holes in the
// shadows of balls.
#include "core/camera/open_side.h"

#include <array>
#include <bit>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace meniscus {
namespace {

/// Å: the growth of balls that closes the gaps between them as the surface does. Among values from 0 to 1.4 this one
/// showed most of the ligands of six complexes.
constexpr double kClosed = 0.4;
constexpr std::size_t kTriedSides = 500, kPoints = 500, kPointsOfBall = 12;

/// A lookup of atoms by their centres, because radii depend on the kind of surface.
class Centers {
 public:
  explicit Centers(std::span<const Ball> balls) {
    for (const Ball& ball : balls) keys_.insert(key_of(ball));
  }
  bool has(const Ball& ball) const { return keys_.contains(key_of(ball)); }

 private:
  static std::tuple<double, double, double> key_of(const Ball& ball) {
    return {ball.center.x, ball.center.y, ball.center.z};
  }
  std::set<std::tuple<double, double, double>> keys_;
};

/// Returns the balls of `all` that are not in `seen`, grown by kClosed.
std::vector<Ball> others_of(std::span<const Ball> seen, std::span<const Ball> all) {
  const Centers own(seen);
  std::vector<Ball> others;
  for (const Ball& ball : all)
    if (!own.has(ball)) others.push_back({ball.center, ball.radius + kClosed});
  return others;
}

/// Returns points on the balls that lie inside none of them; of many balls a few are taken, evenly.
std::vector<glm::dvec3> points_on(std::span<const Ball> balls) {
  const std::size_t step = std::max<std::size_t>(1, balls.size() * kPointsOfBall / kPoints);
  std::vector<glm::dvec3> points;
  for (std::size_t b = 0; b < balls.size(); b += step) {
    for (std::size_t n = 0; n < kPointsOfBall; ++n) {
      const glm::dvec3 point = balls[b].center + balls[b].radius * spiral_direction(n, kPointsOfBall);
      const auto holds = [&](const Ball& ball) {
        return &ball != &balls[b] && glm::distance(point, ball.center) < ball.radius;
      };
      if (std::ranges::none_of(balls, holds)) points.push_back(point);
    }
  }
  return points;
}

/// The result for one direction.
struct Openness {
  std::size_t free = 0;  ///< number of free points
  double cover = 0.0;    ///< Å: sum of the distances from covered points to where their rays leave the last ball
};

/// Returns the distance from the point to where its ray leaves the ball; 0 if the ray misses it.
double exit_from(const Ball& ball, const glm::dvec3& point, const glm::dvec3& toward) {
  const glm::dvec3 from = ball.center - point;
  const double along = glm::dot(from, toward);
  const double half = ball.radius * ball.radius - (glm::dot(from, from) - along * along);
  return half > 0.0 ? std::max(along + std::sqrt(half), 0.0) : 0.0;
}

/// Returns nothing if fewer than `least` points are free.
std::optional<Openness> openness(const glm::dvec3& toward, std::span<const glm::dvec3> points,
                                 std::span<const Ball> others, const Ball& around, std::size_t least) {
  // Only balls in front of the points can hide them.
  std::vector<Ball> near;
  for (const Ball& ball : others) {
    const glm::dvec3 from = ball.center - around.center;
    const double along = glm::dot(from, toward), reach = around.radius + ball.radius;
    if (along > -reach && glm::dot(from, from) - along * along < reach * reach) near.push_back(ball);
  }
  std::size_t may_be_free = points.size();
  for (const glm::dvec3& point : points) {
    const auto hides = [&](const Ball& ball) { return exit_from(ball, point, toward) > 0.0; };
    const auto hiding = std::ranges::find_if(near, hides);
    if (hiding == near.end()) continue;
    if (--may_be_free < least) return {};
    std::swap(*hiding, near.front());  // it may hide the next point, too
  }
  Openness open;
  for (const glm::dvec3& point : points) {
    double exit = 0.0;
    for (const Ball& ball : near) exit = std::max(exit, exit_from(ball, point, toward));
    if (exit > 0.0)
      open.cover += exit;
    else
      ++open.free;
  }
  return open;
}

/// Returns the direction across the view along which the balls extend farthest.
glm::dvec3 longest_across(const glm::dvec3& toward, std::span<const Ball> balls) {
  const glm::dvec3 some = std::abs(toward.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(some, toward)), v = glm::cross(toward, u);
  glm::dvec3 middle(0.0);
  for (const Ball& ball : balls) middle += ball.center / static_cast<double>(balls.size());
  double uu = 0.0, uv = 0.0, vv = 0.0;
  for (const Ball& ball : balls) {
    const double x = glm::dot(ball.center - middle, u), y = glm::dot(ball.center - middle, v);
    uu += x * x;
    uv += x * y;
    vv += y * y;
  }
  const double angle = 0.5 * std::atan2(2.0 * uv, uu - vv);
  return std::cos(angle) * u + std::sin(angle) * v;
}

}  // namespace

ViewBasis open_side(std::span<const Ball> seen, std::span<const Ball> all) {
  const std::vector<Ball> others = others_of(seen, all);
  const std::vector<glm::dvec3> points = points_on(seen);
  Ball around{glm::dvec3(0.0), 0.0};
  for (const Ball& ball : seen) around.center += ball.center / static_cast<double>(seen.size());
  for (const Ball& ball : seen)
    around.radius = std::max(around.radius, glm::distance(ball.center, around.center) + ball.radius);
  glm::dvec3 best = spiral_direction(0, kTriedSides);
  Openness most = *openness(best, points, others, around, 0);
  for (std::size_t n = 1; n < kTriedSides; ++n) {
    const glm::dvec3 toward = spiral_direction(n, kTriedSides);
    const std::optional<Openness> open = openness(toward, points, others, around, most.free);
    if (!open || (open->free == most.free && open->cover >= most.cover)) continue;
    best = toward;
    most = *open;
  }
  const glm::dvec3 right = longest_across(best, seen);
  return {right, glm::cross(best, right), -best};
}

namespace {

/// The resolution of the grid of squares for shadows.
struct Grid {
  double square;  ///< Å; narrower gaps are not counted
  int most;       ///< most squares along a side; larger molecules have larger squares
};
constexpr Grid kCoarse{0.75, 130}, kFine{0.3, 500};
constexpr int kNear = 6;                  // directions around the best one, to each side
constexpr double kNearStep = 0.035;       // radians between neighbours
constexpr double kLeastWidth = 2.0;       // Å, between balls grown by kClosed
constexpr std::size_t kTriedAxes = 2000;  // spread over the sphere: 4.5 degrees between neighbours

/// Parallel shadows of balls on squares of a plane.
class Shadows {
 public:
  Shadows(std::span<const Ball> around, std::span<const Ball> all, const Grid& grid) : around_(around), all_(all) {
    for (const Ball& ball : around) middle_ += ball.center / static_cast<double>(around.size());
    double reach = 0.0;
    for (const Ball& ball : around)
      reach = std::max(reach, glm::distance(ball.center, middle_) + ball.radius + kClosed);
    square_ = std::max(grid.square, 2.0 * reach / (grid.most - 4));
    side_ = static_cast<int>(std::ceil(2.0 * reach / square_)) + 4;
  }

  struct Cylinder {
    double width = 0.0, length = 0.0;  // Å
  };

  /// Returns the widest cylinder through the hole along this direction, as long as atoms surround it.
  Cylinder channel(const glm::dvec3& toward) {
    const glm::dvec3 some = std::abs(toward.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    u_ = glm::normalize(glm::cross(some, toward));
    v_ = glm::cross(toward, u_);
    squares_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), Square::hole);
    cast(around_);
    flood();
    if (std::ranges::find(squares_, Square::hole) == squares_.end()) return {};
    if (all_.size() > around_.size()) cast(all_);  // it includes around_
    double widest = 0.0;
    glm::ivec2 middle(0);
    for (int row = 0; row < side_; ++row) {
      for (int column = 0; column < side_; ++column) {
        const double width = at(column, row) == Square::hole ? 2.0 * square_ * room({column, row}) : 0.0;
        if (width <= widest) continue;
        widest = width;
        middle = {column, row};
      }
    }
    if (widest < kLeastWidth) return {};
    const glm::dvec2 from_corner = square_ * (glm::dvec2(middle) + 0.5 - 0.5 * side_);
    return {widest, surrounded(middle_ + from_corner.x * u_ + from_corner.y * v_, toward)};
  }

 private:
  enum class Square : std::uint8_t { hole, wall, outside };

  Square& at(int column, int row) {
    return squares_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(column)];
  }

  /// Marks the squares with a shadow on their middle.
  void cast(std::span<const Ball> balls) {
    for (const Ball& ball : balls) {
      const glm::dvec3 from = ball.center - middle_;
      const double x = glm::dot(from, u_) / square_ + 0.5 * side_, y = glm::dot(from, v_) / square_ + 0.5 * side_,
                   radius = (ball.radius + kClosed) / square_;
      const int last_row = std::min(side_ - 1, static_cast<int>(std::floor(y + radius - 0.5)));
      for (int row = std::max(0, static_cast<int>(std::ceil(y - radius - 0.5))); row <= last_row; ++row) {
        const double up = row + 0.5 - y, half = std::sqrt(std::max(0.0, radius * radius - up * up));
        const int last = std::min(side_ - 1, static_cast<int>(std::floor(x + half - 0.5)));
        for (int column = std::max(0, static_cast<int>(std::ceil(x - half - 0.5))); column <= last; ++column)
          at(column, row) = Square::wall;
      }
    }
  }

  /// Fills the outside from a corner, which no shadow covers.
  void flood() {
    std::vector<glm::ivec2> waiting{{0, 0}};
    at(0, 0) = Square::outside;
    while (!waiting.empty()) {
      const glm::ivec2 here = waiting.back();
      waiting.pop_back();
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
        const glm::ivec2 next = here + step;
        if (next.x < 0 || next.y < 0 || next.x >= side_ || next.y >= side_ || at(next.x, next.y) != Square::hole)
          continue;
        at(next.x, next.y) = Square::outside;
        waiting.push_back(next);
      }
    }
  }

  /// Returns the distance, in squares, from the middle of this square to the nearest square outside the hole. Squares
  /// at the rim never belong to a hole.
  double room(glm::ivec2 here) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int ring = 1; ring < nearest; ++ring)
      for (int along = -ring; along <= ring; ++along)
        for (const glm::ivec2 step :
             {glm::ivec2(along, ring), glm::ivec2(along, -ring), glm::ivec2(ring, along), glm::ivec2(-ring, along)})
          if (at(here.x + step.x, here.y + step.y) != Square::hole)
            nearest = std::min(nearest, std::hypot(step.x, step.y));
    return nearest;
  }

  /// Returns the length, Å, of the slices across the line through this point that have atoms on all sides.
  double surrounded(const glm::dvec3& point, const glm::dvec3& along) const {
    constexpr double kSlice = 3.0;  // Å
    constexpr double kSides = 6.0;
    std::map<int, unsigned> sides;  // key: slice; value: one bit for each side
    for (const Ball& ball : around_) {
      const glm::dvec3 from = ball.center - point;
      const double turn = std::atan2(glm::dot(from, v_), glm::dot(from, u_)) / (2.0 * std::numbers::pi) + 0.5;
      sides[static_cast<int>(std::floor(glm::dot(from, along) / kSlice))] |=
          1U << static_cast<unsigned>(std::min(kSides * turn, kSides - 1.0));
    }
    const unsigned all = (1U << static_cast<unsigned>(kSides)) - 1U;
    return kSlice * static_cast<double>(std::ranges::count(sides, all, &std::pair<const int, unsigned>::second));
  }

  std::span<const Ball> around_, all_;
  glm::dvec3 middle_{0.0}, u_{0.0}, v_{0.0};
  double square_ = 1.0;  // Å
  int side_ = 0;
  std::vector<Square> squares_;
};

}  // namespace

std::optional<ViewBasis> channel_end(std::span<const Ball> around, std::span<const Ball> all) {
  glm::dvec3 best(0.0);
  double most = 0.0;
  // A hole looks the same from both ends.
  Shadows coarse(around, all, kCoarse);
  for (std::size_t n = kTriedAxes / 2; n < kTriedAxes; ++n) {
    const glm::dvec3 toward = spiral_direction(n, kTriedAxes);
    const Shadows::Cylinder cylinder = coarse.channel(toward);
    const double volume = cylinder.width * cylinder.width * cylinder.length;
    if (volume <= most) continue;
    most = volume;
    best = toward;
  }
  if (most <= 0.0) return {};
  // The mean of the directions along which the hole is open.
  Shadows fine(around, all, kFine);
  const glm::dvec3 x = longest_across(best, around), y = glm::cross(best, x);
  glm::dvec3 sum(0.0);
  for (int row = -kNear; row <= kNear; ++row) {
    for (int column = -kNear; column <= kNear; ++column) {
      const glm::dvec3 toward =
          glm::normalize(best + kNearStep * (static_cast<double>(column) * x + static_cast<double>(row) * y));
      const double width = fine.channel(toward).width;
      sum += width * width * toward;
    }
  }
  if (const glm::dvec3 middle = glm::normalize(sum + 1e-9 * best); fine.channel(middle).width > 0.0) best = middle;
  if (best.z < 0.0) best = -best;
  const glm::dvec3 right = longest_across(best, around);
  return ViewBasis{right, glm::cross(best, right), -best};
}

namespace {

/// The share of the ball's radius that is drawn: atoms to be seen are usually sticks, which are narrower.
constexpr double kDrawn = 0.6;
constexpr double kHiddenShare = 0.05;
constexpr int kRaysAcross = 45;

/// Returns where a ray enters and leaves a ball, Å from its origin; nothing if it misses the ball.
std::optional<std::array<double, 2>> crossing(const Ray& ray, const Ball& ball) {
  const glm::dvec3 from = ball.center - ray.origin;
  const double along = glm::dot(from, ray.direction);
  const double half = ball.radius * ball.radius - (glm::dot(from, from) - along * along);
  if (half <= 0.0 || along + std::sqrt(half) <= 0.0) return {};
  return std::array{along - std::sqrt(half), along + std::sqrt(half)};
}

/// The part of a picture that some balls fill, on the plane through the camera's target.
class Window {
 public:
  Window(std::span<const Ball> balls, const Camera& camera)
      : camera_(camera),
        basis_(view_basis(camera)),
        distance_(std::max(1e-6, glm::dot(camera.target - camera.position, basis_.forward))) {
    for (const Ball& ball : balls) {
      const std::optional<Square> square = square_around(ball);
      if (!square) continue;
      low_ = glm::min(low_, square->middle - square->half);
      high_ = glm::max(high_, square->middle + square->half);
    }
  }

  /// True if rays() may meet the ball.
  bool may_meet(const Ball& ball) const {
    if (glm::dot(ball.center - camera_.position, basis_.forward) < -ball.radius) return false;
    const std::optional<Square> square = square_around(ball);
    return !square || glm::all(glm::lessThan(low_, square->middle + square->half) &&
                               glm::lessThan(square->middle - square->half, high_));
  }

  std::vector<Ray> rays() const {
    std::vector<Ray> rays;
    for (int row = 0; low_.x < high_.x && row < kRaysAcross; ++row) {
      for (int column = 0; column < kRaysAcross; ++column) {
        const glm::dvec2 at =
            low_ + (high_ - low_) * (glm::dvec2(column, row) + 0.5) / static_cast<double>(kRaysAcross);
        const glm::dvec3 across = at.x * basis_.right + at.y * basis_.up;
        if (camera_.projection == Projection::perspective)
          rays.push_back({camera_.position, glm::normalize(across + distance_ * basis_.forward)});
        else
          rays.push_back({camera_.position + across, basis_.forward});
      }
    }
    return rays;
  }

 private:
  struct Square {
    glm::dvec2 middle;
    double half;
  };

  /// Returns a square that contains the ball's image; nothing if the image is unbounded.
  std::optional<Square> square_around(const Ball& ball) const {
    const glm::dvec3 from = ball.center - camera_.position;
    const glm::dvec2 across(glm::dot(from, basis_.right), glm::dot(from, basis_.up));
    if (camera_.projection == Projection::orthographic) return Square{across, ball.radius};
    const double depth = glm::dot(from, basis_.forward), front = depth - ball.radius;
    if (front <= 0.0) return {};
    // The ball is replaced by a box around it.
    const double near_scale = distance_ / front, middle_scale = distance_ / depth;
    const double shift = (near_scale - middle_scale) * std::max(std::abs(across.x), std::abs(across.y));
    return Square{middle_scale * across, near_scale * ball.radius + shift};
  }

  Camera camera_;
  ViewBasis basis_;
  double distance_;
  glm::dvec2 low_{std::numeric_limits<double>::infinity()}, high_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

bool shows_more_behind(const ViewBasis& view, std::span<const Ball> balls, std::span<const std::uint32_t> group) {
  constexpr double kAcross = 160.0, kClearly = 0.03;
  glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
  const auto middle_of = [&](const Ball& ball) {
    return glm::dvec2(glm::dot(ball.center, view.right), glm::dot(ball.center, view.up));
  };
  for (const Ball& ball : balls) {
    low = glm::min(low, middle_of(ball) - ball.radius);
    high = glm::max(high, middle_of(ball) + ball.radius);
  }
  const double pixel = std::max(0.5, std::max(high.x - low.x, high.y - low.y) / kAcross);
  const glm::ivec2 size = glm::ivec2((high - low) / pixel) + 1;
  struct Pixel {
    std::array<double, 2> depth{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    std::array<std::uint32_t, 2> group{kCountedGroups, kCountedGroups};  // nearest from the front and from behind
    std::uint64_t covered_by = 0;                                        // one bit per group
  };
  std::vector<Pixel> pixels(static_cast<std::size_t>(size.x) * size.y);
  for (std::size_t b = 0; b < balls.size(); ++b) {
    const glm::dvec2 middle = (middle_of(balls[b]) - low) / pixel;
    const double radius = balls[b].radius / pixel, depth = glm::dot(balls[b].center, view.forward) / pixel;
    const glm::ivec2 first(glm::max(middle - radius, 0.0)), last = glm::min(glm::ivec2(middle + radius), size - 1),
                                                            own(middle);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const glm::dvec2 from = glm::dvec2(x + 0.5, y + 0.5) - middle;
        const double square = radius * radius - glm::dot(from, from);
        if (square < 0.0 && glm::ivec2(x, y) != own) continue;
        Pixel& seen = pixels[static_cast<std::size_t>(y) * size.x + x];
        const double half = std::sqrt(std::max(square, 0.0));
        for (const int side : {0, 1}) {
          const double front = (side == 0 ? depth : -depth) - half;
          if (front >= seen.depth[side]) continue;
          seen.depth[side] = front;
          seen.group[side] = group[b];
        }
        if (group[b] < kCountedGroups) seen.covered_by |= std::uint64_t{1} << group[b];
      }
  }
  std::array<std::array<double, kCountedGroups + 1>, 3> area{};  // areas seen from the front, from behind, and alone
  for (const Pixel& seen : pixels) {
    for (const int side : {0, 1}) ++area[side][seen.group[side]];
    for (std::uint64_t bits = seen.covered_by; bits != 0; bits &= bits - 1) ++area[2][std::countr_zero(bits)];
  }
  double gain = 0.0, most = 0.0;
  for (std::size_t g = 0; g < kCountedGroups; ++g) {
    gain += std::sqrt(area[1][g]) - std::sqrt(area[0][g]);
    most += std::sqrt(area[2][g]);
  }
  return gain > kClearly * most;
}

OpenDepth open_depth(std::span<const Ball> seen, std::span<const Ball> all, const Camera& camera) {
  std::vector<Ball> drawn(seen.begin(), seen.end());
  for (Ball& ball : drawn) ball.radius *= kDrawn;
  const Window window(drawn, camera);
  std::vector<Ball> others = others_of(seen, all);
  std::erase_if(others, [&](const Ball& ball) { return !window.may_meet(ball); });
  const glm::dvec3 forward = view_basis(camera).forward;
  double nearest = std::numeric_limits<double>::infinity(), limit = nearest;
  const Centers own(seen);
  for (const Ball& ball : all) {
    const double front = glm::dot(ball.center, forward) - ball.radius;
    nearest = std::min(nearest, front);
    if (own.has(ball)) limit = std::min(limit, front);
  }
  // The depth to which the balls in front of a ball to be seen must be cut, for each ray that meets such a ball.
  std::vector<double> depths;
  for (const Ray& ray : window.rays()) {
    double hit = std::numeric_limits<double>::infinity();
    for (const Ball& ball : drawn)
      if (const auto at = crossing(ray, ball)) hit = std::min(hit, (*at)[0]);
    if (!std::isfinite(hit)) continue;
    double covered = -std::numeric_limits<double>::infinity();
    for (const Ball& ball : others)
      if (const auto at = crossing(ray, ball); at && (*at)[0] < hit)
        covered = std::max(covered, std::min(hit, (*at)[1]));
    depths.push_back(std::isfinite(covered) ? glm::dot(ray.origin + covered * ray.direction, forward) : nearest);
  }
  OpenDepth open{nearest, 1.0, false};
  if (depths.empty()) return open;
  std::ranges::sort(depths);
  const auto needed = static_cast<std::size_t>(std::ceil((1.0 - kHiddenShare) * static_cast<double>(depths.size())));
  open.depth = std::max(nearest, depths[needed - 1]);
  open.is_limited = open.depth > limit;
  open.depth = std::min(open.depth, limit);
  open.seen = static_cast<double>(std::ranges::upper_bound(depths, open.depth) - depths.begin()) /
              static_cast<double>(depths.size());
  return open;
}

}  // namespace meniscus
