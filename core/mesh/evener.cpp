// SPDX-License-Identifier: BSD-3-Clause
// Passes over the edges and vertices of a mesh on a surface (Botsch & Kobbelt 2004, section 4).
#include "core/mesh/evener.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// Edges longer than this times the length wanted are split, those shorter than that collapsed: either makes edges
/// nearer to it (Botsch & Kobbelt 2004).
constexpr double kLong = 4.0 / 3.0, kShort = 4.0 / 5.0;
/// A foot farther below the middle of an edge than this share of its length is on another sheet.
constexpr double kDeepest = 0.35;
/// A vertex that would come nearer than this share of the edge to one that is there is not made.
constexpr double kTooNear = 0.2;
/// A crease is where mesh vertices are no farther (Å) from its circle.
constexpr double kOnCrease = 1e-6;
/// Edges between triangles as good as that are not flipped: their smallest angles are some 35 degrees.
constexpr double kFine = 0.82;
/// Passes that change fewer than one in so many triangles are the last ones of an approach.
constexpr std::uint32_t kFew = 16;
constexpr int kApproaches = 12;
/// Cosines between the normals of a triangle and of the surface at its vertices: the most asked for.
constexpr double kLeaning = 0.7;
/// Vertices of more edges are left alone.
constexpr std::uint32_t kMostEdges = 24;
/// Edges that are asked to be shorter than this share of what they were at first would not help either.
constexpr float kFinest = 0.25f;

}  // namespace

Evener::Evener(const Surface& surface, SurfaceWalk& walk, const TriangleMesh& base,
               std::vector<std::uint32_t> vertex_face, const std::vector<bool>& keep, EdgeLength edge)
    : surface_(surface),
      walk_(walk),
      edge_(std::move(edge)),
      links_(base.triangles, static_cast<std::uint32_t>(base.positions.size())),
      position_(base.positions),
      normal_(base.positions.size(), glm::dvec3(0.0)),
      face_(std::move(vertex_face)),
      border_(base.positions.size(), kNone),
      pinned_(base.positions.size(), 0),
      size_(base.positions.size(), 0.0f),
      scale_(base.positions.size(), 1.0f),
      outlook_(base.positions.size(), 0.0f),
      active_(base.positions.size(), 1),
      changed_(base.positions.size(), 1),
      watched_(base.positions.size(), 0),
      held_(base.positions.size(), 0),
      look_(base.triangles.size(), kUnseen),
      stale_(base.triangles.size(), 1) {
  walk.bar(keep);
  tbb::parallel_for(std::size_t{0}, face_.size(), [&](std::size_t n) {
    const auto v = static_cast<std::uint32_t>(n);
    settle(v, point(v), kNone);
  });
  mark_creases(base, keep);
  pin_corners();
}

/// Every number of a vertex that follows from where it is.
void Evener::settle(std::uint32_t vertex, const SurfacePoint& at, std::uint32_t border) {
  position_[vertex] = at.position;
  face_[vertex] = at.face;
  border_[vertex] = border;
  normal_[vertex] = walk_.normal(at);
  size_[vertex] = scale_[vertex] * static_cast<float>(edge_(at));
  outlook_[vertex] = static_cast<float>(least_outlook(vertex));
}

void Evener::mark_creases(const TriangleMesh& base, const std::vector<bool>& keep) {
  std::vector<bool> with_crease(surface_.faces.size(), false);
  for (std::uint32_t b = 0; b < keep.size(); ++b)
    if (keep[b])
      for (const std::uint32_t f : surface_.borders[b].face) with_crease[f] = true;
  for (std::uint32_t half = 0; half < links_.half_edge_count(); ++half) {
    const std::uint32_t f = base.face[half / 3], g = base.face[links_.twin(half) / 3];
    if (f == g || half > links_.twin(half) || !with_crease[f] || !with_crease[g]) continue;
    // Without a probe a border on either side has the same points; the first stands for both.
    const glm::dvec3 &a = position_[links_.from(half)], &b = position_[links_.to(half)];
    const std::uint32_t border = std::min(crease_of(a, b, f, keep), crease_of(a, b, g, keep));
    if (border != kNone) links_.set_crease(half, border);
  }
}

std::uint32_t Evener::crease_of(const glm::dvec3& a, const glm::dvec3& b, std::uint32_t face,
                                const std::vector<bool>& keep) const {
  std::uint32_t found = kNone;
  for_each_half_border(surface_, surface_.faces[face], [&](HalfBorder half) {
    const std::uint32_t n = border_of(half);
    if (!keep[n]) return;
    const Border& border = surface_.borders[n];
    for (const glm::dvec3& x : {a, b}) {
      const glm::dvec3 out = x - border.center;
      if (!(std::abs(glm::dot(out, border.axis)) < kOnCrease && std::abs(glm::length(out) - border.radius) < kOnCrease))
        return;
    }
    if (walk_.on_border(0.5 * (a + b), n)) found = std::min(found, n);
  });
  return found;
}

/// Vertices of two edges along one border move along it; those of one, or of more, or of two borders stay.
void Evener::pin_corners() {
  std::vector<std::uint8_t> count(position_.size(), 0);
  for (std::uint32_t half = 0; half < links_.half_edge_count(); ++half) {
    const std::uint32_t border = links_.crease(half), v = links_.from(half);
    if (border == kNone) continue;
    if (count[v]++ > 0 && border_[v] != border) pinned_[v] = 1;
    border_[v] = border;
  }
  for (std::uint32_t v = 0; v < count.size(); ++v)
    if (count[v] != 0 && count[v] != 2) pinned_[v] = 1;
  // The tip of a free spindle has a cone of normals.
  for (std::uint32_t v = 0; v < face_.size(); ++v) {
    const std::uint32_t tip = surface_.faces[face_[v]].tip;
    if (tip != kNone && position_[v] == surface_.vertices[tip]) pinned_[v] = 1;
  }
}

double Evener::length(std::uint32_t half) const {
  return glm::distance(position_[links_.from(half)], position_[links_.to(half)]);
}

/// How much a triangle may lean against the normal at a vertex, as a cosine: little where edges are short beside the
/// radius of curvature, almost a right angle where they are not.
double Evener::least_outlook(std::uint32_t vertex) const {
  const double turn = size_[vertex] / std::max(walk_.radius(face_[vertex]), 1e-9);
  return std::clamp(1.0 - 1.5 * turn * turn, kSteepest, approaching_ ? kSteepest : kLeaning);
}

bool Evener::leans_over(std::uint32_t vertex, const glm::dvec3& normal, double size) const {
  return !on_crease(vertex) && !(glm::dot(normal, normal_[vertex]) > outlook_[vertex] * size);
}

double Evener::look(std::uint32_t a, const glm::dvec3& x, std::uint32_t b, std::uint32_t c) const {
  const glm::dvec3 u = position_[b] - x, v = position_[c] - x, w = v - u;
  const glm::dvec3 normal = glm::cross(u, v);
  const double size = glm::length(normal), squares = glm::dot(u, u) + glm::dot(v, v) + glm::dot(w, w);
  if (!(size > 0.0)) return -kFold;
  const double quality = 2.0 * std::sqrt(3.0) * size / squares;
  const bool over = leans_over(a, normal, size) || leans_over(b, normal, size) || leans_over(c, normal, size);
  return over ? quality - kFold : quality;
}

double Evener::look_of(std::uint32_t triangle) const {
  if (look_[triangle] != kUnseen) return look_[triangle];
  const auto v = links_.corners(triangle);
  return look(v[0], position_[v[0]], v[1], v[2]);
}

void Evener::note_changes_around(std::uint32_t vertex) {
  changed_[vertex] = 1;
  links_.around(vertex, [&](std::uint32_t half) {
    look_[half / 3] = kUnseen;
    stale_[half / 3] = 1;
    if (watched_[vertex]) guard_.add(half / 3);
  });
}

void Evener::look_at_all() {
  tbb::parallel_for(std::uint32_t{0}, links_.triangle_count(), [&](std::uint32_t t) {
    if (links_.lives(3 * t)) look_[t] = static_cast<float>(look_of(t));
  });
}

std::uint32_t Evener::split_long(double limit) {
  const std::uint32_t count = links_.half_edge_count();  // new ones come to the end, and wait for the next round
  std::uint32_t done = 0;
  for (std::uint32_t half = 0; half < count; ++half)
    if (half < links_.twin(half) && links_.lives(half) && busy(half) && length(half) > limit * wanted(half))
      done += split(half);
  return done;
}

bool Evener::split(std::uint32_t half) {
  const auto at = middle_of(half);
  if (!at) return false;
  for (const std::uint32_t c : {links_.opposite(half), links_.opposite(links_.twin(half))})
    if (approaching_ && glm::distance(at->position, position_[c]) < kTooNear * length(half))
      return links_.crease(half) == kNone && try_flip(half);
  if ((watched_[links_.from(half)] || watched_[links_.to(half)]) && !is_free({Change::Kind::split, half, *at}))
    return false;
  put_vertex(half, *at);
  return true;
}

/// Where the surface is below the middle of an edge.
std::optional<SurfacePoint> Evener::middle_of(std::uint32_t half) const {
  const std::uint32_t a = links_.from(half), b = links_.to(half), border = links_.crease(half);
  const glm::dvec3 middle = 0.5 * (position_[a] + position_[b]);
  std::optional<SurfacePoint> at;
  if (border != kNone) {
    if (const auto on = walk_.on_border(middle, border)) at = SurfacePoint{*on, surface_.borders[border].face[0]};
  } else {
    at = walk_.below(middle, face_[a]);
    if (!at) at = walk_.below(middle, face_[b]);
  }
  const double deepest = kDeepest * length(half);
  if (border == kNone && (!at || glm::distance(at->position, middle) > deepest))
    at = walk_.on_near_cusp(middle, face_[a]);
  if (at && glm::distance(at->position, middle) > deepest) return std::nullopt;
  return at;
}

void Evener::put_vertex(std::uint32_t half, const SurfacePoint& at) {
  const std::uint32_t a = links_.from(half), b = links_.to(half), border = links_.crease(half);
  links_.split(half);
  add_vertex(a, b, at, border);
}

void Evener::poke(std::uint32_t triangle, const SurfacePoint& at) {
  const auto v = links_.corners(triangle);
  links_.poke(triangle);
  add_vertex(v[0], v[1], at, kNone);
}

/// The numbers of the last vertex, which has come between a and b.
void Evener::add_vertex(std::uint32_t a, std::uint32_t b, const SurfacePoint& at, std::uint32_t border) {
  const std::uint32_t m = links_.vertex_count() - 1;
  position_.emplace_back();
  normal_.emplace_back();
  face_.push_back(kNone);
  border_.push_back(kNone);
  pinned_.push_back(0);
  size_.push_back(0.0f);
  outlook_.push_back(0.0f);
  scale_.push_back(0.5f * (scale_[a] + scale_[b]));
  active_.push_back(1);
  changed_.push_back(1);
  watched_.push_back(watched_[a] | watched_[b]);
  held_.push_back(0);
  look_.resize(links_.triangle_count(), kUnseen);
  stale_.resize(links_.triangle_count(), 1);
  settle(m, at, border);
  note_changes_around(m);
}

std::uint32_t Evener::collapse_short() {
  std::uint32_t done = 0;
  for (std::uint32_t half = 0; half < links_.half_edge_count(); ++half) {
    if (!links_.lives(half) || half > links_.twin(half) || !busy(half)) continue;
    if (length(half) < kShort * wanted(half)) done += try_collapse(half) || try_collapse(links_.twin(half));
  }
  return done;
}

/// A vertex of a crease goes along it only, and where creases end or meet it stays.
bool Evener::may_vanish(std::uint32_t half) const {
  const std::uint32_t a = links_.from(half);
  if (pinned_[a]) return false;
  if (border_[a] != kNone && links_.crease(half) != border_[a]) return false;
  // Two creases must not fall together.
  const auto creased = [&](std::uint32_t edge) { return links_.crease(edge) != kNone; };
  const std::uint32_t other = links_.twin(half);
  return !(creased(HalfEdges::next(half)) && creased(HalfEdges::last(half))) &&
         !(creased(HalfEdges::next(other)) && creased(HalfEdges::last(other)));
}

bool Evener::try_collapse(std::uint32_t half) {
  const std::uint32_t a = links_.from(half), b = links_.to(half);
  if (held_[a] || !may_vanish(half)) return false;
  if (links_.valence(a) + links_.valence(b) > kMostEdges) return false;
  bool fits = true;
  links_.around(a, [&](std::uint32_t edge) {
    const std::uint32_t c = links_.to(edge);
    fits = fits && (c == b || glm::distance(position_[b], position_[c]) <= kLong * 0.5 * (size_[b] + size_[c]));
  });
  if (!fits || !links_.can_collapse(half)) return false;
  const double bar = std::min(score_around(a), kPoor);
  Looks after;
  links_.around(a, [&](std::uint32_t edge) {
    const std::uint32_t c = links_.to(edge), d = links_.opposite(edge);
    if (!fits || c == b || d == b) return;
    after.add(look(b, position_[b], c, d));
    fits = after.score() >= bar;
  });
  if (!fits || ((watched_[a] || watched_[b]) && !is_free({Change::Kind::collapse, half, {}}))) return false;
  active_[b] = 1;
  watched_[b] |= watched_[a];
  links_.collapse(half);
  note_changes_around(b);
  return true;
}

/// Edges between two triangles of which neither has changed have been asked before.
void Evener::flip_edges() {
  look_at_all();
  std::vector<std::uint8_t> stale(stale_.size(), 0);
  stale.swap(stale_);
  for (std::uint32_t half = 0; half < links_.half_edge_count(); ++half) {
    if (half > links_.twin(half) || !links_.lives(half) || !busy(half)) continue;
    const std::uint32_t t = half / 3, u = links_.twin(half) / 3;
    if (!stale[t] && !stale[u]) continue;
    if ((look_of(t) < kFine || look_of(u) < kFine) && try_flip(half)) stale[t] = stale[u] = 1;
  }
}

bool Evener::try_flip(std::uint32_t half) {
  if (links_.crease(half) != kNone) return false;
  const std::uint32_t a = links_.from(half), b = links_.to(half), other = links_.twin(half);
  const std::uint32_t c = links_.opposite(half), d = links_.opposite(other);
  Looks before, after;
  before.add(look_of(half / 3));
  before.add(look_of(other / 3));
  const double first = look(d, position_[d], c, a);
  after.add(first);
  if (!(after.score() > before.score() + kBetter)) return false;
  const double second = look(c, position_[c], d, b);
  after.add(second);
  if (!(after.score() > before.score() + kBetter) || !links_.can_flip(half)) return false;
  if (links_.valence(c) >= kMostEdges || links_.valence(d) >= kMostEdges) return false;
  const bool watched = watched_[a] || watched_[b] || watched_[c] || watched_[d];
  if (watched && !is_free({Change::Kind::flip, half, {}})) return false;
  links_.flip(half);
  look_[half / 3] = static_cast<float>(first);
  look_[other / 3] = static_cast<float>(second);
  stale_[half / 3] = stale_[other / 3] = 1;
  for (const std::uint32_t v : {a, b, c, d}) changed_[v] = 1;
  if (watched) guard_.add(half / 3), guard_.add(other / 3);
  return true;
}

/// Longest edges first, or halves of triangles would be slivers.
void Evener::approach() {
  approaching_ = true;
  settle_outlooks();
  flip_edges();
  double longest = 0.0;
  for (std::uint32_t half = 0; half < links_.half_edge_count(); ++half)
    longest = std::max(longest, length(half) / wanted(half));
  for (double limit = longest / std::sqrt(2.0); limit > kLong; limit /= std::sqrt(2.0)) {
    split_long(limit);
    flip_edges();
  }
  for (int n = 0; n < kApproaches; ++n) {
    const std::uint32_t changes = split_long(kLong) + collapse_short();
    flip_edges();
    compact();
    if (changes < links_.triangle_count() / kFew) break;
  }
  approaching_ = false;
  settle_outlooks();
}

void Evener::settle_outlooks() {
  tbb::parallel_for(std::uint32_t{0}, links_.vertex_count(),
                    [&](std::uint32_t v) { outlook_[v] = static_cast<float>(least_outlook(v)); });
  forget_looks();
}

void Evener::forget_looks() {
  look_.assign(look_.size(), kUnseen);
  stale_.assign(stale_.size(), 1);
}

void Evener::even_out(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    split_long(kLong);
    look_at_all();
    collapse_short();
    flip_edges();
    relax();
    flip_edges();
  }
}

double Evener::score_around(std::uint32_t vertex) const {
  Looks looks;
  links_.around(vertex, [&](std::uint32_t half) { looks.add(look_of(half / 3)); });
  return looks.score();
}

void Evener::forget_changes(std::span<const Place> but) {
  std::fill(changed_.begin(), changed_.end(), std::uint8_t{0});
  for (const Place& place : but)
    for (const std::uint32_t v : links_.corners(place.triangle)) changed_[v] = 1;
}

void Evener::refine(const std::vector<std::uint32_t>& triangles, double factor) {
  std::vector<std::uint8_t> bad(position_.size(), 0), beside(position_.size(), 0);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : links_.corners(t)) bad[v] = 1;
  for (std::uint32_t v = 0; v < bad.size(); ++v)
    if (bad[v]) links_.around(v, [&](std::uint32_t half) { beside[links_.to(half)] = 1; });
  for (std::uint32_t v = 0; v < bad.size(); ++v) {
    active_[v] = bad[v] | beside[v];
    const double asked = bad[v] ? factor : beside[v] ? std::sqrt(factor) : 1.0;
    const auto less = scale_[v] > kFinest ? static_cast<float>(asked) : 1.0f;
    scale_[v] *= less;
    size_[v] *= less;
    outlook_[v] = static_cast<float>(least_outlook(v));
  }
  forget_looks();
}

void Evener::compact() {
  std::uint32_t living = 0;
  for (std::uint32_t t = 0; t < links_.triangle_count(); ++t) {
    if (!links_.lives(3 * t)) continue;
    look_[living] = look_[t];
    stale_[living++] = stale_[t];
  }
  look_.resize(living);
  stale_.resize(living);
  const std::vector<std::uint32_t> old = links_.compact();
  const auto take = [&](auto& column) {
    for (std::size_t v = 0; v < old.size(); ++v) column[v] = column[old[v]];
    column.resize(old.size());
  };
  take(position_);
  take(normal_);
  take(face_);
  take(border_);
  take(pinned_);
  take(size_);
  take(scale_);
  take(outlook_);
  take(active_);
  take(changed_);
  take(watched_);
  take(held_);
  guard_.list(watched_);
}

}  // namespace meniscus
