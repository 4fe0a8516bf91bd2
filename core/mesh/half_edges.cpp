// SPDX-License-Identifier: BSD-3-Clause
// Splits, collapses and flips edges of triangle meshes, and lists the triangles at each vertex.
#include "core/mesh/half_edges.h"

#include <algorithm>
#include <numeric>

#include "core/base/error.h"

namespace meniscus {
namespace {

/// The number of neighbours of a vertex that are compared at once; few vertices have more.
constexpr std::size_t kRing = 16;

}  // namespace

HalfEdges::HalfEdges(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count)
    : HalfEdges(triangles, CornerLists(triangles, vertex_count), Open::refused) {}

HalfEdges HalfEdges::of_part(std::span<const std::array<std::uint32_t, 3>> triangles, const CornerLists& corners) {
  return {triangles, corners, Open::allowed};
}

HalfEdges::HalfEdges(std::span<const std::array<std::uint32_t, 3>> triangles, const CornerLists& corners, Open open)
    : from_(3 * triangles.size()),
      twin_(3 * triangles.size(), kNone),
      crease_(3 * triangles.size(), kNone),
      leaving_(corners.vertex_count(), kNone) {
  for (std::uint32_t half = 0; half < half_edge_count(); ++half) {
    from_[half] = triangles[half / 3][half % 3];
    leaving_[from_[half]] = half;
  }
  for (std::uint32_t half = 0; half < half_edge_count(); ++half) {
    if (twin_[half] != kNone) continue;
    const std::uint32_t a = from_[half];
    std::uint32_t back = kNone, count = 0;
    for (const std::uint32_t leaves : corners.at(to(half))) {
      if (to(leaves) != a) continue;
      back = leaves;
      ++count;
    }
    if (count == 1 && twin_[back] == kNone) {
      link(half, back, kNone);
    } else if (open == Open::refused) {
      throw OpenSurfaceError(count > 1 ? "the mesh to be evened has two edges between the same vertices"
                                       : "the mesh to be evened is not closed");
    }
  }
}

std::uint32_t HalfEdges::between(std::uint32_t a, std::uint32_t b) const {
  std::uint32_t found = kNone;
  for_each_leaving(a, [&](std::uint32_t half) {
    if (to(half) == b) found = half;
  });
  return found;
}

std::uint32_t HalfEdges::split(std::uint32_t half) {
  // (a, b, c) and (b, a, d) become (a, m, c), (m, b, c), (m, a, d), (b, m, d).
  const std::uint32_t other = twin_[half], border = crease_[half];
  const std::uint32_t bc = next(half), ad = next(other);
  const std::uint32_t b = to(half), a = from_[half], c = from_[last(half)], d = from_[last(other)];
  const std::uint32_t outer_bc = twin_[bc], outer_ad = twin_[ad];
  const std::uint32_t crease_bc = crease_[bc], crease_ad = crease_[ad];
  const std::uint32_t m = vertex_count(), first = half_edge_count();
  from_.insert(from_.end(), {m, b, c, m, a, d});
  twin_.resize(first + 6);
  crease_.resize(first + 6, kNone);
  from_[next(half)] = m;   // half: a to m, then m to c
  from_[next(other)] = m;  // other: b to m, then m to d
  link(half, first + 3, border);
  link(other, first, border);
  link(first + 1, outer_bc, crease_bc);
  link(first + 2, next(half), kNone);
  link(first + 4, outer_ad, crease_ad);
  link(first + 5, next(other), kNone);
  leaving_.push_back(first);
  leaving_[a] = half;
  leaving_[b] = other;
  leaving_[c] = last(half);
  leaving_[d] = last(other);
  return m;
}

std::uint32_t HalfEdges::poke(std::uint32_t triangle) {
  // (a, b, c) becomes (a, b, m), (b, c, m), (c, a, m).
  const std::uint32_t ab = 3 * triangle, bc = ab + 1, ca = ab + 2;
  const std::uint32_t a = from_[ab], b = from_[bc], c = from_[ca];
  const std::uint32_t outer_bc = twin_[bc], outer_ca = twin_[ca], crease_bc = crease_[bc], crease_ca = crease_[ca];
  const std::uint32_t m = vertex_count(), first = half_edge_count();
  from_.insert(from_.end(), {b, c, m, c, a, m});
  twin_.resize(first + 6);
  crease_.resize(first + 6, kNone);
  from_[ca] = m;  // bc: b to m, ca: m to a
  link(first, outer_bc, crease_bc);
  link(first + 3, outer_ca, crease_ca);
  link(bc, first + 2, kNone);
  link(first + 1, first + 5, kNone);
  link(first + 4, ca, kNone);
  leaving_.push_back(ca);
  leaving_[a] = ab;
  leaving_[b] = bc;
  leaving_[c] = first + 1;
  return m;
}

void HalfEdges::unpoke(std::uint32_t half) {
  // (a, b, m), (m, b, c), (m, c, a) become (a, b, c).
  const std::uint32_t bm = next(half), ma = last(half), mb = twin_[bm], am = twin_[ma];
  const std::uint32_t bc = next(mb), ca = last(am);
  const std::uint32_t a = from_[half], b = from_[bm], m = from_[ma], c = from_[last(mb)];
  from_[ma] = c;
  link(bm, twin_[bc], crease_[bc]);
  link(ma, twin_[ca], crease_[ca]);
  leaving_[a] = half;
  leaving_[b] = bm;
  leaving_[c] = ma;
  leaving_[m] = kNone;
  for (const std::uint32_t t : {mb / 3, am / 3}) from_[3 * t] = from_[3 * t + 1] = from_[3 * t + 2] = kNone;
}

/// Tests the link condition of a closed mesh without doubled edges: a third common neighbour would leave a cycle of
/// three edges, and a tetrahedron would leave two triangles back to back.
bool HalfEdges::can_collapse(std::uint32_t half) const {
  const CommonNeighbors neighbors = common_neighbors(*this, from_[half], to(half));
  return neighbors.common == 2 && neighbors.sum > 6;
}

void HalfEdges::collapse(std::uint32_t half) {
  const std::uint32_t other = twin_[half];
  const std::uint32_t a = from_[half], b = to(half), c = opposite(half), d = opposite(other);
  std::uint32_t rim = half;  // half-edges that left a leave b from now on
  do {
    const std::uint32_t following = next(twin_[rim]);
    from_[rim] = b;
    rim = following;
  } while (rim != half);
  const std::uint32_t bc = next(half), ca = last(half), ad = next(other), db = last(other);
  const std::uint32_t outer_bc = twin_[bc], outer_ca = twin_[ca], outer_ad = twin_[ad], outer_db = twin_[db];
  const std::uint32_t c_crease = crease_[bc] != kNone ? crease_[bc] : crease_[ca];
  const std::uint32_t d_crease = crease_[ad] != kNone ? crease_[ad] : crease_[db];
  link(outer_bc, outer_ca, c_crease);
  link(outer_ad, outer_db, d_crease);
  leaving_[b] = outer_ca;  // from b to c
  leaving_[c] = outer_bc;
  leaving_[d] = outer_ad;
  leaving_[a] = kNone;
  for (const std::uint32_t gone : {half, bc, ca, other, ad, db}) from_[gone] = kNone;
}

bool HalfEdges::can_flip(std::uint32_t half) const {
  const std::uint32_t c = opposite(half), d = opposite(twin_[half]);
  return crease_[half] == kNone && c != d && between(c, d) == kNone;
}

void HalfEdges::flip(std::uint32_t half) {
  // (a, b, c) and (b, a, d) become (d, c, a) and (c, d, b).
  const std::uint32_t other = twin_[half];
  const std::uint32_t a = from_[half], b = to(half), c = opposite(half), d = opposite(other);
  const std::uint32_t bc = next(half), ca = last(half), ad = next(other), db = last(other);
  const std::uint32_t outer_bc = twin_[bc], outer_ca = twin_[ca], outer_ad = twin_[ad], outer_db = twin_[db];
  const std::uint32_t crease_bc = crease_[bc], crease_ca = crease_[ca], crease_ad = crease_[ad],
                      crease_db = crease_[db];
  from_[half] = d;
  from_[bc] = c;
  from_[ca] = a;
  from_[other] = c;
  from_[ad] = d;
  from_[db] = b;
  link(half, other, kNone);       // d to c
  link(bc, outer_ca, crease_ca);  // c to a
  link(ca, outer_ad, crease_ad);  // a to d
  link(ad, outer_db, crease_db);  // d to b
  link(db, outer_bc, crease_bc);  // b to c
  leaving_[a] = ca;
  leaving_[b] = db;
  leaving_[c] = bc;
  leaving_[d] = ad;
}

void HalfEdges::put_first(std::uint32_t half) {
  for (const std::uint32_t first = half - half % 3; half != first; half = last(half)) {
    const std::array<std::uint32_t, 3> from{from_[first + 1], from_[first + 2], from_[first]};
    const std::array<std::uint32_t, 3> twin{twin_[first + 1], twin_[first + 2], twin_[first]};
    const std::array<std::uint32_t, 3> crease{crease_[first + 1], crease_[first + 2], crease_[first]};
    for (std::uint32_t k = 0; k < 3; ++k) {
      from_[first + k] = from[k];
      crease_[first + k] = crease[k];
      twin_[first + k] = twin[k];
      if (twin[k] != kNone) twin_[twin[k]] = first + k;
      leaving_[from[k]] = first + k;
    }
  }
}

std::vector<std::uint32_t> HalfEdges::compact() {
  std::vector<std::uint32_t> old_vertex, new_vertex(vertex_count(), kNone), new_half(half_edge_count(), kNone);
  for (std::uint32_t v = 0; v < vertex_count(); ++v) {
    if (!is_vertex_alive(v)) continue;
    new_vertex[v] = static_cast<std::uint32_t>(old_vertex.size());
    old_vertex.push_back(v);
  }
  std::uint32_t count = 0;
  for (std::uint32_t half = 0; half < half_edge_count(); ++half)
    if (is_alive(half)) new_half[half] = count++;
  for (std::uint32_t half = 0; half < half_edge_count(); ++half) {
    if (new_half[half] == kNone) continue;
    from_[new_half[half]] = new_vertex[from_[half]];
    twin_[new_half[half]] = new_half[twin_[half]];
    crease_[new_half[half]] = crease_[half];
  }
  from_.resize(count);
  twin_.resize(count);
  crease_.resize(count);
  leaving_.assign(old_vertex.size(), kNone);
  for (std::uint32_t half = count; half-- > 0;) leaving_[from_[half]] = half;
  return old_vertex;
}

CommonNeighbors common_neighbors(const HalfEdges& links, std::uint32_t a, std::uint32_t b) {
  std::array<std::uint32_t, kRing> ring{};  // some neighbours of a
  std::size_t count = 0;
  CommonNeighbors found;
  const auto compare = [&] {
    std::uint32_t neighbors = 0;
    links.for_each_leaving(b, [&](std::uint32_t half) {
      found.common += std::find(ring.begin(), ring.begin() + count, links.to(half)) != ring.begin() + count;
      ++neighbors;
    });
    return neighbors;
  };
  links.for_each_leaving(a, [&](std::uint32_t half) {
    ring[count++] = links.to(half);
    ++found.sum;
    if (count < kRing) return;
    compare();
    count = 0;
  });
  found.sum += compare();
  return found;
}

std::vector<std::array<std::uint32_t, 3>> all_triangles(const HalfEdges& links) {
  std::vector<std::array<std::uint32_t, 3>> all(links.triangle_count());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = links.corners(t);
  return all;
}

CornerLists::CornerLists(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t vertex_count)
    : first_(std::size_t{vertex_count} + 1, 0), corners_(3 * triangles.size()) {
  for (const auto& t : triangles)
    for (const std::uint32_t v : t) ++first_[v];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  auto corner = static_cast<std::uint32_t>(corners_.size());
  for (std::size_t t = triangles.size(); t-- > 0;)
    for (std::size_t k = 3; k-- > 0;) corners_[--first_[triangles[t][k]]] = --corner;
}

bool is_closed_fan(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return false;
  const auto after = [&](std::uint32_t c) { return triangles[c / 3][(c % 3 + 1) % 3]; };
  const auto before = [&](std::uint32_t c) { return triangles[c / 3][(c % 3 + 2) % 3]; };
  std::uint32_t at = corners[0];
  for (std::size_t n = 1;; ++n) {
    std::uint32_t found = kNone;
    for (const std::uint32_t c : corners) {
      if (after(c) != before(at)) continue;
      if (found != kNone) return false;
      found = c;
    }
    if (found == kNone) return false;
    if (found == corners[0]) return n == corners.size();
    if (n == corners.size()) return false;
    at = found;
  }
}

}  // namespace meniscus
