// SPDX-License-Identifier: BSD-3-Clause
// The best of all small changes at a triangle, as long as there is one that helps.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/math/box_tree.h"
#include "exporters/mesh/evener.h"

namespace meniscus {
namespace {

/// The quality (4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle) from which on triangles are left
/// as they are: their smallest angles are 20 degrees or more if they are isosceles.
constexpr double kGood = 0.55;
constexpr int kRounds = 12;
/// Of the changes that make triangles better, so many are asked whether they are allowed, the best first.
constexpr std::size_t kTries = 8;
/// Of triangles worse than that all changes are, and those around them may lean.
constexpr double kSliver = 0.25;
/// Vertices of more edges are not made.
constexpr std::uint32_t kMostEdges = 16;
/// Edges shorter than this share of the length wanted are not made, and those where creases end may vanish.
constexpr double kTooShort = 0.2;
/// Edges longer than that are not made.
constexpr double kTooLong = 2.0;
/// Steps of a vertex, in edges wanted, along the surface to all sides; and in shares of the way to the middle of its
/// neighbours.
constexpr std::array kSteps{0.03, 0.1, 0.3};
constexpr std::array kShares{1.0, 0.6, 0.3};
constexpr int kDirections = 6;
/// How vertices are watched: for good, or while something is mended there.
constexpr std::uint8_t kLasting = 1, kMending = 2;
/// Triangles within this many of their longest edges may come to lie in the way.
constexpr double kReach = 2.5;

}  // namespace

void Evener::watch(std::span<const Ball> places) { mark_watched(places, kLasting); }

void Evener::mark_watched(std::span<const Ball> places, std::uint8_t kind) {
  if (!places.empty()) {
    std::vector<Box> boxes;
    for (const Ball& place : places) boxes.push_back({place.center - place.radius, place.center + place.radius});
    const BoxTree tree(boxes);
    tbb::parallel_for(std::size_t{0}, position_.size(), [&](std::size_t v) {
      constexpr double kInside = 1e-9;
      tree.nearest(position_[v], kInside, [&](std::uint32_t p, double limit) {
        if (glm::distance(position_[v], places[p].center) > places[p].radius) return limit;
        watched_[v] |= kind;
        return 0.0;
      });
    });
  }
  guard_.list(watched_);
}

void Evener::watch_around(std::span<const std::uint32_t> triangles) {
  std::vector<Ball> places;
  for (const std::uint32_t t : triangles) {
    const PlacedTriangle x = guard_.placed(t);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::distance(x.at[k], x.at[(k + 1) % 3]));
    places.push_back({(x.at[0] + x.at[1] + x.at[2]) / 3.0, kReach * longest});
  }
  mark_watched(places, kMending);
}

void Evener::watch_no_longer() {
  for (std::uint8_t& kind : watched_) kind &= kLasting;
  guard_.list(watched_);
}

Evener::Change Evener::flip_of(std::uint32_t half) const {
  const std::uint32_t other = links_.twin(half), a = links_.from(half), b = links_.to(half);
  const std::uint32_t c = links_.opposite(half), d = links_.opposite(other);
  return {Change::Kind::flip, half, {}, {placed(d, c, a), placed(c, d, b)}, {half / 3, other / 3}};
}

Evener::Change Evener::collapse_of(std::uint32_t half) const {
  const std::uint32_t b = links_.to(half);
  Change change{Change::Kind::collapse, half, {}, {}, {}};
  links_.around(links_.from(half), [&](std::uint32_t edge) {
    const std::uint32_t c = links_.to(edge), d = links_.opposite(edge);
    change.gone.push_back(edge / 3);
    if (c != b && d != b) change.made.push_back(placed(b, c, d));
  });
  return change;
}

Evener::Change Evener::split_of(std::uint32_t half, const SurfacePoint& at) const {
  const std::uint32_t m = links_.vertex_count();
  Change change{Change::Kind::split, half, at, {}, {half / 3, links_.twin(half) / 3}};
  for (const std::uint32_t side : {half, links_.twin(half)}) {
    const std::uint32_t from = links_.from(side), to = links_.to(side), c = links_.opposite(side);
    change.made.push_back({{from, m, c}, {position_[from], at.position, position_[c]}});
    change.made.push_back({{m, to, c}, {at.position, position_[to], position_[c]}});
  }
  return change;
}

Evener::Change Evener::poke_of(std::uint32_t triangle, const SurfacePoint& at) const {
  const std::uint32_t m = links_.vertex_count();
  Change change{Change::Kind::poke, triangle, at, {}, {triangle}};
  for (std::uint32_t half = 3 * triangle; half < 3 * triangle + 3; ++half) {
    const std::uint32_t a = links_.from(half), b = links_.to(half);
    change.made.push_back({{a, b, m}, {position_[a], position_[b], at.position}});
  }
  return change;
}

Evener::Change Evener::move_of(std::uint32_t vertex, const SurfacePoint& to) const {
  Change change{Change::Kind::move, vertex, to, {}, {}};
  links_.around(vertex, [&](std::uint32_t half) {
    change.made.push_back(placed(vertex, links_.to(half), links_.opposite(half)));
    change.made.back().at[0] = to.position;
    change.gone.push_back(half / 3);
  });
  return change;
}

void Evener::make(const Change& change) {
  switch (change.kind) {
    case Change::Kind::flip: {
      links_.flip(change.where);
      for (const std::uint32_t half : {change.where, links_.twin(change.where)}) {
        note_changes_around(links_.from(half));
        note_changes_around(links_.opposite(half));
      }
      break;
    }
    case Change::Kind::collapse: {
      const std::uint32_t a = links_.from(change.where), b = links_.to(change.where);
      if (on_crease(a) && (links_.crease(change.where) == kNone || pinned_[a])) pinned_[b] = 1;
      watched_[b] |= watched_[a];
      links_.collapse(change.where);
      note_changes_around(b);
      break;
    }
    case Change::Kind::split:
      put_vertex(change.where, change.at);
      break;
    case Change::Kind::poke:
      poke(change.where, change.at);
      break;
    case Change::Kind::move:
      settle(change.where, change.at, border_[change.where]);
      note_changes_around(change.where);
  }
}

/// Short edges at the ends of creases, which may otherwise not vanish, would be slivers for ever.
bool Evener::may_merge(std::uint32_t half) const { return may_vanish(half) || is_too_short(half); }

bool Evener::is_too_short(std::uint32_t half) const { return length(half) < kTooShort * wanted(half); }

/// Are no edges too long once the first vertex has gone to the second?
bool Evener::stays_short(std::uint32_t half) const {
  const std::uint32_t b = links_.to(half);
  bool fits = true;
  links_.around(links_.from(half), [&](std::uint32_t edge) {
    const std::uint32_t c = links_.to(edge);
    fits = fits && glm::distance(position_[b], position_[c]) <= kTooLong * 0.5 * (size_[b] + size_[c]);
  });
  return fits;
}

/// If `steep`, triangles may lean almost at a right angle against the surface.
Evener::Looks Evener::looks_of(const Change& change, bool steep) const {
  const bool moving = change.kind == Change::Kind::move, splitting = change.kind == Change::Kind::split;
  const bool placing = moving || splitting || change.kind == Change::Kind::poke;
  Newcomer newcomer;
  if (placing) {
    const std::uint32_t like = moving ? change.where : links_.from(splitting ? change.where : 3 * change.where);
    newcomer.vertex = moving ? change.where : links_.vertex_count();
    newcomer.normal = walk_.normal(change.at);
    newcomer.outlook = outlook_[like];
    newcomer.on_crease = moving ? on_crease(change.where) : splitting && links_.crease(change.where) != kNone;
  }
  Looks looks;
  for (const PlacedTriangle& t : change.made) looks.add(look(t, newcomer, steep));
  return looks;
}

Evener::Looks Evener::looks_now(const Change& change, bool steep) const {
  Looks looks;
  for (const std::uint32_t t : change.gone) looks.add(steep ? look(guard_.placed(t), {}, true) : look_of(t));
  return looks;
}

double Evener::look(const PlacedTriangle& t, const Newcomer& newcomer, bool steep) const {
  const glm::dvec3 normal = glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]);
  const double size = glm::length(normal);
  if (!(size > 0.0)) return -kFold;
  double squares = 0.0;
  bool over = false;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = t.vertex[k];
    const glm::dvec3 edge = t.at[(k + 1) % 3] - t.at[k];
    squares += glm::dot(edge, edge);
    const bool is_new = v == newcomer.vertex;
    if (is_new ? newcomer.on_crease : on_crease(v)) continue;
    const double outlook = steep ? kSteepest : is_new ? newcomer.outlook : outlook_[v];
    over = over || !(glm::dot(normal, is_new ? newcomer.normal : normal_[v]) > outlook * size);
  }
  const double quality = 2.0 * std::sqrt(3.0) * size / squares;
  return over ? quality - kFold : quality;
}

/// How many pairs of triangles cross fewer with the change.
std::ptrdiff_t Evener::fewer_crossings(const Change& change) const {
  std::vector<PlacedTriangle> now;
  for (const std::uint32_t t : change.gone) now.push_back(guard_.placed(t));
  return static_cast<std::ptrdiff_t>(guard_.crossings(now, change.gone)) -
         static_cast<std::ptrdiff_t>(guard_.crossings(change.made, change.gone));
}

template <typename Visit>
void Evener::each_place_near(std::uint32_t vertex, const Visit& visit) const {
  if (pinned_[vertex]) return;
  const glm::dvec3& x = position_[vertex];
  const double size = size_[vertex];
  if (const std::uint32_t border = border_[vertex]; border != kNone) {
    const auto middle = centroid_along_crease(vertex);
    if (!middle) return;
    for (const double share : {1.0, 0.5, 0.25, -0.25})
      if (const auto on = walk_.on_border(x + share * (*middle - x), border)) visit({*on, face_[vertex]});
    return;
  }
  const auto visit_below = [&](const glm::dvec3& y) {
    if (const auto at = walk_.below(y, face_[vertex]); at && glm::distance(at->position, x) < size) visit(*at);
  };
  const glm::dvec3 to_middle = centroid_around(vertex) - x, n = normal_[vertex];
  for (const double share : kShares) visit_below(x + share * to_middle);
  glm::dvec3 u = glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  u = glm::normalize(u);
  const glm::dvec3 w = glm::cross(n, u);
  for (const double step : kSteps)
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      visit_below(x + step * size * (std::cos(angle) * u + std::sin(angle) * w));
    }
}

/// visit(change), which may take it, for all small changes of a triangle.
template <typename Visit>
void Evener::each_change(std::uint32_t triangle, const Visit& visit) const {
  for (std::uint32_t half = 3 * triangle; half < 3 * triangle + 3; ++half) {
    const std::uint32_t other = links_.twin(half);
    const std::uint32_t c = links_.opposite(half), d = links_.opposite(other);
    if (links_.can_flip(half) && links_.valence(c) < kMostEdges && links_.valence(d) < kMostEdges) visit(flip_of(half));
    if (links_.valence(links_.from(half)) + links_.valence(links_.to(half)) < kMostEdges + 4)
      for (const std::uint32_t side : {half, other})
        if (may_merge(side) && stays_short(side) && links_.can_collapse(side)) visit(collapse_of(side));
    if (length(half) > 2.0 * kTooShort * wanted(half) && links_.valence(c) < kMostEdges &&
        links_.valence(d) < kMostEdges)
      if (const auto at = middle_of(half)) visit(split_of(half, *at));
  }
  for (const std::uint32_t v : links_.corners(triangle))
    each_place_near(v, [&](const SurfacePoint& at) { visit(move_of(v, at)); });
}

bool Evener::is_wrong(std::uint32_t triangle, const Allowed& allowed) const {
  const PlacedTriangle x = guard_.placed(triangle);
  return guard_.crossings({&x, 1}, {&triangle, 1}) > 0 || !allowed(x);
}

std::ptrdiff_t Evener::fewer_forbidden(const Change& change, const Allowed& allowed) const {
  std::ptrdiff_t fewer = 0;
  for (const std::uint32_t t : change.gone) fewer += !allowed(guard_.placed(t));
  for (const PlacedTriangle& t : change.made) fewer -= !allowed(t);
  return fewer;
}

/// Makes the change after which the worst triangle is best, or, at one that passes through others or is not allowed,
/// the fewest do and are.
bool Evener::improve(std::uint32_t triangle, bool wrong, const Allowed& allowed) {
  struct Candidate {
    std::ptrdiff_t fewer;
    double gain;
    Change change;
  };
  const auto fewer_wrong = [&](const Change& change) {
    const std::ptrdiff_t allowances = fewer_forbidden(change, allowed);
    if (allowances < 0) return allowances;
    const std::ptrdiff_t crossings = fewer_crossings(change);
    return crossings < 0 ? crossings : crossings + allowances;
  };
  const bool sliver = look(guard_.placed(triangle), {}, true) < kSliver;
  std::vector<Candidate> candidates;
  each_change(triangle, [&](Change&& change) {
    const double gain = looks_of(change, sliver).score() - looks_now(change, sliver).score();
    const std::ptrdiff_t fewer = wrong ? fewer_wrong(change) : 0;
    // Short edges go even where a worse triangle stays.
    const bool shortens = change.kind == Change::Kind::collapse && is_too_short(change.where);
    if (wrong ? fewer > 0 : gain > (shortens ? -kBetter : kBetter))
      candidates.push_back({fewer, gain, std::move(change)});
  });
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.fewer != b.fewer ? a.fewer > b.fewer : a.gain > b.gain;
  });
  if (!sliver && candidates.size() > kTries) candidates.erase(candidates.begin() + kTries, candidates.end());
  for (const Candidate& candidate : candidates) {
    const Change& change = candidate.change;
    if (!wrong && !(is_free(change) && fewer_forbidden(change, allowed) >= 0)) continue;
    make(change);
    return true;
  }
  return false;
}

void Evener::reach(std::span<const Place> places, const Allowed& allowed) {
  std::vector<std::uint32_t> triangles;
  for (const Place& place : places) triangles.push_back(place.triangle);
  watch_around(triangles);
  for (const Place& place : places) {
    if (place.at.face == kNone || !links_.lives(3 * place.triangle)) continue;
    std::optional<Change> best;
    double score = 0.0;
    const auto consider = [&](Change&& change) {
      const double now = looks_of(change, false).score();
      if ((best && now <= score) || fewer_crossings(change) < 0 || fewer_forbidden(change, allowed) < 0) return;
      best = std::move(change);
      score = now;
    };
    consider(poke_of(place.triangle, place.at));
    for (std::uint32_t half = 3 * place.triangle; half < 3 * place.triangle + 3; ++half) {
      if (links_.crease(half) == kNone) consider(split_of(half, place.at));
      if (const std::uint32_t v = links_.from(half); !on_crease(v)) consider(move_of(v, place.at));
    }
    if (!best) continue;
    const bool moves = best->kind == Change::Kind::move;
    make(*best);
    pinned_[moves ? best->where : links_.vertex_count() - 1] = 1;
  }
  watch_no_longer();
}

void Evener::mend(std::span<const std::uint32_t> triangles, const Allowed& allowed) {
  std::vector<std::uint8_t> doubtful(links_.triangle_count(), 0);  // and with them what comes about there
  for (const std::uint32_t t : triangles) doubtful[t] = 1;
  std::vector<std::uint32_t> bad;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t)
    if (doubtful[t] || look_of(t) < kGood) bad.push_back(t);
  watch_around(bad);
  for (int round = 0; round < kRounds && !bad.empty(); ++round) {
    std::vector<std::uint32_t> next;
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    for (const std::uint32_t t : bad) {
      if (!links_.lives(3 * t)) continue;
      const bool wrong = doubtful[t] && is_wrong(t, allowed);
      if ((!wrong && look_of(t) >= kGood) || !improve(t, wrong, allowed)) continue;
      doubtful.resize(links_.triangle_count(), 0);
      if (!links_.lives(3 * t)) continue;
      for (const std::uint32_t v : links_.corners(t))
        links_.around(v, [&](std::uint32_t half) {
          next.push_back(half / 3);
          if (wrong) doubtful[half / 3] = 1;
        });
    }
    bad = std::move(next);
    guard_.list(watched_);  // without what has gone
  }
  watch_no_longer();
}

}  // namespace meniscus
