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
#include "core/mesh/evener.h"

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

/// visit(PlacedTriangle) for those that a change makes.
template <typename Visit>
void Evener::each_made(const Change& change, const Visit& visit) const {
  const std::uint32_t m = links_.vertex_count();
  switch (change.kind) {
    case Change::Kind::flip: {
      const std::uint32_t a = links_.from(change.where), b = links_.to(change.where);
      const std::uint32_t c = links_.opposite(change.where), d = links_.opposite(links_.twin(change.where));
      visit(placed(d, c, a));
      visit(placed(c, d, b));
      break;
    }
    case Change::Kind::collapse: {
      const std::uint32_t b = links_.to(change.where);
      links_.around(links_.from(change.where), [&](std::uint32_t edge) {
        const std::uint32_t c = links_.to(edge), d = links_.opposite(edge);
        if (c != b && d != b) visit(placed(b, c, d));
      });
      break;
    }
    case Change::Kind::split:
      for (const std::uint32_t side : {change.where, links_.twin(change.where)}) {
        const std::uint32_t from = links_.from(side), to = links_.to(side), c = links_.opposite(side);
        visit(PlacedTriangle{{from, m, c}, {position_[from], change.at.position, position_[c]}});
        visit(PlacedTriangle{{m, to, c}, {change.at.position, position_[to], position_[c]}});
      }
      break;
    case Change::Kind::poke:
      for (std::uint32_t half = 3 * change.where; half < 3 * change.where + 3; ++half) {
        const std::uint32_t a = links_.from(half), b = links_.to(half);
        visit(PlacedTriangle{{a, b, m}, {position_[a], position_[b], change.at.position}});
      }
      break;
    case Change::Kind::move:
      links_.around(change.where, [&](std::uint32_t half) {
        PlacedTriangle moved = placed(change.where, links_.to(half), links_.opposite(half));
        moved.at[0] = change.at.position;
        visit(moved);
      });
  }
}

/// visit(triangle) for those that a change takes away.
template <typename Visit>
void Evener::each_gone(const Change& change, const Visit& visit) const {
  switch (change.kind) {
    case Change::Kind::flip:
    case Change::Kind::split:
      visit(change.where / 3);
      visit(links_.twin(change.where) / 3);
      break;
    case Change::Kind::poke:
      visit(change.where);
      break;
    case Change::Kind::collapse:
    case Change::Kind::move: {
      const bool moves = change.kind == Change::Kind::move;
      links_.around(moves ? change.where : links_.from(change.where), [&](std::uint32_t half) { visit(half / 3); });
    }
  }
}

Evener::Exchange Evener::exchange(const Change& change) const {
  Exchange all;
  all.made.reserve(kMostEdges);
  all.gone.reserve(kMostEdges);
  each_made(change, [&](const PlacedTriangle& t) { all.made.push_back(t); });
  each_gone(change, [&](std::uint32_t t) { all.gone.push_back(t); });
  return all;
}

bool Evener::is_free(const Change& change) const {
  const Exchange all = exchange(change);
  return guard_.crossings(all.made, all.gone) == 0;
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

/// If `steep`, triangles may lean almost at a right angle against the surface. What is no better than the bar is not
/// looked at to its end.
double Evener::score_after(const Change& change, bool steep, double bar) const {
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
  each_made(change, [&](const PlacedTriangle& t) {
    if (looks.score() > bar) looks.add(look(t, newcomer, steep));
  });
  return looks.score();
}

double Evener::score_before(const Change& change, bool steep) const {
  Looks looks;
  each_gone(change, [&](std::uint32_t t) { looks.add(steep ? look(guard_.placed(t), {}, true) : look_of(t)); });
  return looks.score();
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
std::ptrdiff_t Evener::fewer_crossings(const Exchange& exchange) const {
  std::vector<PlacedTriangle> now;
  now.reserve(exchange.gone.size());
  for (const std::uint32_t t : exchange.gone) now.push_back(guard_.placed(t));
  return static_cast<std::ptrdiff_t>(guard_.crossings(now, exchange.gone)) -
         static_cast<std::ptrdiff_t>(guard_.crossings(exchange.made, exchange.gone));
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

/// visit(change, the score of what it takes away) for all small changes of a triangle.
template <typename Visit>
void Evener::each_change(std::uint32_t triangle, bool steep, const Visit& visit) const {
  const auto offer = [&](const Change& change) { visit(change, score_before(change, steep)); };
  for (std::uint32_t half = 3 * triangle; half < 3 * triangle + 3; ++half) {
    const std::uint32_t other = links_.twin(half);
    const std::uint32_t c = links_.opposite(half), d = links_.opposite(other);
    const bool has_room = links_.valence(c) < kMostEdges && links_.valence(d) < kMostEdges;
    if (has_room && links_.can_flip(half)) offer({Change::Kind::flip, half, {}});
    if (links_.valence(links_.from(half)) + links_.valence(links_.to(half)) < kMostEdges + 4)
      for (const std::uint32_t side : {half, other})
        if (may_merge(side) && stays_short(side) && links_.can_collapse(side))
          offer({Change::Kind::collapse, side, {}});
    if (has_room && length(half) > 2.0 * kTooShort * wanted(half))
      if (const auto at = middle_of(half)) offer({Change::Kind::split, half, *at});
  }
  for (const std::uint32_t v : links_.corners(triangle)) {
    const double now = score_before({Change::Kind::move, v, {}}, steep);
    each_place_near(v, [&](const SurfacePoint& at) { visit(Change{Change::Kind::move, v, at}, now); });
  }
}

bool Evener::is_wrong(std::uint32_t triangle, const Allowed& allowed) const {
  const PlacedTriangle x = guard_.placed(triangle);
  return guard_.crossings({&x, 1}, {&triangle, 1}) > 0 || !allowed(x);
}

std::ptrdiff_t Evener::fewer_forbidden(const Exchange& exchange, const Allowed& allowed) const {
  std::ptrdiff_t fewer = 0;
  for (const std::uint32_t t : exchange.gone) fewer += !allowed(guard_.placed(t));
  for (const PlacedTriangle& t : exchange.made) fewer -= !allowed(t);
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
    const Exchange all = exchange(change);
    const std::ptrdiff_t allowances = fewer_forbidden(all, allowed);
    if (allowances < 0) return allowances;
    const std::ptrdiff_t crossings = fewer_crossings(all);
    return crossings < 0 ? crossings : crossings + allowances;
  };
  const bool sliver = look(guard_.placed(triangle), {}, true) < kSliver;
  std::vector<Candidate> candidates;
  each_change(triangle, sliver, [&](const Change& change, double now) {
    if (wrong) {
      if (const std::ptrdiff_t fewer = fewer_wrong(change); fewer > 0)
        candidates.push_back({fewer, score_after(change, sliver) - now, change});
      return;
    }
    // Short edges go even where a worse triangle stays.
    const bool shortens = change.kind == Change::Kind::collapse && is_too_short(change.where);
    const double bar = now + (shortens ? -kBetter : kBetter), score = score_after(change, sliver, bar);
    if (score > bar) candidates.push_back({0, score - now, change});
  });
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.fewer != b.fewer ? a.fewer > b.fewer : a.gain > b.gain;
  });
  if (!sliver && candidates.size() > kTries) candidates.erase(candidates.begin() + kTries, candidates.end());
  for (const Candidate& candidate : candidates) {
    const Change& change = candidate.change;
    if (!wrong) {
      const Exchange all = exchange(change);
      if (guard_.crossings(all.made, all.gone) > 0 || fewer_forbidden(all, allowed) < 0) continue;
    }
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
    const auto consider = [&](const Change& change) {
      const double now = score_after(change, false);
      if (best && now <= score) return;
      if (const Exchange all = exchange(change); fewer_crossings(all) < 0 || fewer_forbidden(all, allowed) < 0) return;
      best = change;
      score = now;
    };
    consider({Change::Kind::poke, place.triangle, place.at});
    for (std::uint32_t half = 3 * place.triangle; half < 3 * place.triangle + 3; ++half) {
      if (links_.crease(half) == kNone) consider({Change::Kind::split, half, place.at});
      if (const std::uint32_t v = links_.from(half); !on_crease(v)) consider({Change::Kind::move, v, place.at});
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
  look_at_all();
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
  }
  watch_no_longer();
}

}  // namespace meniscus
