// SPDX-License-Identifier: BSD-3-Clause
// Builds the boundary representation: joins half-borders to loops, loops to faces and faces to components.
#include "core/surface/boundary.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>

#include "core/math/union_find.h"
#include "core/surface/components.h"
#include "core/surface/parallel_tables.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

std::uint32_t vertex_at(std::span<const Border> borders, HalfBorder h, int end) {
  return borders[border_of(h)].vertex[is_backwards(h) ? 1 - end : end];
}

}  // namespace

void LoopChainer::chain_loops(std::span<const Border> borders, std::span<const HalfBorder> walk) {
  // The list is sorted by begin, so that the next half-border is found quickly on atoms with thousands of borders.
  open_.clear();
  for (const HalfBorder h : walk) open_.emplace_back(vertex_at(borders, h, 0), h);
  std::sort(open_.begin(), open_.end());
  taken_.assign(open_.size(), 0);
  for (std::size_t start = 0; start < open_.size(); ++start) {
    if (taken_[start]) continue;
    const std::size_t first = faces_.half_borders.size();
    const std::uint32_t home = open_[start].first;
    taken_[start] = 1;
    faces_.half_borders.push_back(open_[start].second);
    for (std::uint32_t at = vertex_at(borders, open_[start].second, 1); at != home;) {
      std::size_t next = static_cast<std::size_t>(
          std::lower_bound(open_.begin(), open_.end(), std::pair<std::uint32_t, HalfBorder>(at, 0)) - open_.begin());
      while (next < open_.size() && open_[next].first == at && taken_[next]) ++next;
      if (next == open_.size() || open_[next].first != at) {
        faces_.closed = false;
        break;
      }
      taken_[next] = 1;
      faces_.half_borders.push_back(open_[next].second);
      at = vertex_at(borders, open_[next].second, 1);
    }
    faces_.loop_sizes.push_back(static_cast<std::uint32_t>(faces_.half_borders.size() - first));
  }
}

void LoopChainer::list_arcs(std::span<const Border> borders, const Sphere& sphere) {
  arcs_.clear();
  first_arc_.assign(1, 0);
  std::size_t h = 0;
  for (const std::uint32_t size : faces_.loop_sizes) {
    for (const std::size_t past = h + size; h < past; ++h) {
      const HalfBorder half = faces_.half_borders[h];
      arcs_.push_back(sphere_arc(borders[border_of(half)], is_backwards(half) != sphere.seen_from_inside, sphere.center,
                                 sphere.radius));
    }
    if (sphere.seen_from_inside) std::reverse(arcs_.begin() + first_arc_.back(), arcs_.end());
    first_arc_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  }
}

// Two loops bound the same piece if each lies on the other's left and no third separates them.
void LoopChainer::group_loops() {
  const std::size_t count = faces_.loop_sizes.size();
  const auto arcs_of = [&](std::size_t loop) {
    return std::span<const SphereArc>(arcs_.data() + first_arc_[loop], arcs_.data() + first_arc_[loop + 1]);
  };
  left_.assign(count * count, 1);
  bool one_piece = true;
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t k = 0; k < count; ++k) {
      if (m == k) continue;
      left_[m * count + k] = lies_left_of(arcs_of(m), arcs_of(k));
      one_piece = one_piece && left_[m * count + k];
    }
  if (one_piece) return;  // this is the rule; the search below takes the cube of the number of loops
  const auto left = [&](std::size_t m, std::size_t k) { return left_[m * count + k] != 0; };
  UnionFind same(count);
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t n = m + 1; n < count; ++n) {
      bool together = left(m, n) && left(n, m);
      for (std::size_t k = 0; k < count && together; ++k) together = k == m || k == n || left(m, k) == left(n, k);
      if (together) same.unite(static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(n));
    }
  faces_.face_count = 0;
  std::vector<std::uint32_t> number(count, kNone);
  for (std::uint32_t l = 0; l < count; ++l) {
    const std::uint32_t root = same.find(l);
    if (number[root] == kNone) number[root] = faces_.face_count++;
    faces_.loop_face[l] = number[root];
  }
}

const PatchFaces& LoopChainer::chain(std::span<const Border> borders, std::span<const HalfBorder> walk,
                                     const glm::dvec3& center, double radius, bool seen_from_inside) {
  faces_.half_borders.clear();
  faces_.loop_sizes.clear();
  faces_.closed = true;
  chain_loops(borders, walk);
  faces_.loop_face.assign(faces_.loop_sizes.size(), 0);
  faces_.face_count = walk.empty() && seen_from_inside ? 0 : 1;
  if (faces_.loop_sizes.size() > 1 && faces_.closed) {
    list_arcs(borders, {center, radius, seen_from_inside});
    group_loops();
  }
  return faces_;
}

namespace {

// The numbers of faces, loops and half-borders that one spherical patch yields.
struct PatchNumbers {
  std::uint32_t loops = 0;
  std::uint32_t faces = 0;
  bool closed = true;
};

class BoundaryBuilder {
 public:
  BoundaryBuilder(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs)
      : s_(surface), probes_(probes), cusps_(cusps), rs_(rs), flat_(surface.probe_radius == 0) {}

  void run() {
    placed_ = place_borders(s_, probes_, cusps_);
    list_walks();
    chain_loops();
    number_faces();
    if (!connect_components(s_)) add_open_borders();
  }

 private:
  double p() const { return s_.probe_radius; }

  // Lists the half-borders that toroidal patches have between them, by atom and then by probe, so that each patch can
  // chain its own.
  void list_walks() {
    list_convex_patches();
    const auto count = [&](std::size_t t) { return numbers_of(placed_.of_patch[t]); };
    const std::uint32_t first_of_concave =
        RowNumbers<Numbers>(s_.toroidal.size(), {0, 0, first_of_atom_.back()}, count).past().half_border;
    list_cusps_of_probes();
    const auto walk_size = [&](std::size_t s) {
      std::uint32_t size = first_cusp_[s + 1] - first_cusp_[s];
      for (const ProbeSide& side : probes_.sides_of(static_cast<std::uint32_t>(s)))
        size += placed_.of_patch[side.toroidal].spindle ? 2 : 1;
      return size;
    };
    const RowNumbers<std::uint32_t> walks(concave_count(), first_of_concave, walk_size);
    first_of_probe_.resize(concave_count() + 1);
    first_of_probe_.back() = walks.past();
    walks.for_each([&](std::size_t s, std::uint32_t& next) {
      first_of_probe_[s] = next;
      next += walk_size(s);
    });
    resize_large(s_.half_borders, walks.past());
    list_walks_of_atoms();
    tbb::parallel_for(std::size_t{0}, concave_count(), [&](std::size_t s) { list_walk_of_probe(s); });
  }

  // With a probe of radius 0 concave patches have no borders.
  std::size_t concave_count() const { return flat_ ? 0 : s_.concave.size(); }

  void list_convex_patches() {
    first_of_atom_.assign(s_.atoms.size() + 1, 0);
    for (const ToroidalPatch& t : s_.toroidal)
      for (std::uint32_t a : t.atom) ++first_of_atom_[a + 1];
    std::size_t exposed = rs_.lone_atoms.size();
    for (std::size_t a = 1; a < first_of_atom_.size(); ++a) {
      exposed += first_of_atom_[a] > 0;
      first_of_atom_[a] += first_of_atom_[a - 1];
    }
    s_.convex.reserve(exposed);
    for (std::uint32_t a = 0, lone = 0; a < s_.atoms.size(); ++a) {
      const bool is_lone = lone < rs_.lone_atoms.size() && rs_.lone_atoms[lone] == a;
      if (is_lone) ++lone;
      if (first_of_atom_[a + 1] > first_of_atom_[a] || is_lone) s_.convex.push_back({a, 0, 0, 0, 0});
    }
  }

  void list_walks_of_atoms() {
    std::vector<std::uint32_t> next(first_of_atom_.begin(), first_of_atom_.end() - 1);
    std::vector<HalfBorder>& of_atom = s_.half_borders;
    for (std::uint32_t t = 0; t < s_.toroidal.size(); ++t) {
      // Counter-clockwise about the axis, the convex patch of atom[0] lies on the right, that of atom[1] on the left.
      of_atom[next[s_.toroidal[t].atom[0]]++] = placed_.of_patch[t].contact(0) * 2 + 1;
      of_atom[next[s_.toroidal[t].atom[1]]++] = placed_.of_patch[t].contact(flat_ ? 0 : 1) * 2;
    }
  }

  void list_cusps_of_probes() {
    first_cusp_.assign(probes_.count() + 1, 0);
    for (const CuspArc& arc : cusps_.arcs)
      for (std::uint32_t s : arc.probe) ++first_cusp_[s + 1];
    for (std::size_t s = 1; s < first_cusp_.size(); ++s) first_cusp_[s] += first_cusp_[s - 1];
    cusp_of_probe_.resize(first_cusp_.back());
    std::vector<std::uint32_t> next(first_cusp_.begin(), first_cusp_.end() - 1);
    for (std::uint32_t n = 0; n < cusps_.arcs.size(); ++n) {
      // Counter-clockwise about the axis from the first probe to the second, the first one's patch lies on the left.
      cusp_of_probe_[next[cusps_.arcs[n].probe[0]]++] = (placed_.first_cusp + n) * 2;
      cusp_of_probe_[next[cusps_.arcs[n].probe[1]]++] = (placed_.first_cusp + n) * 2 + 1;
    }
  }

  void list_walk_of_probe(std::size_t s) {
    auto next = std::copy(cusp_of_probe_.begin() + first_cusp_[s], cusp_of_probe_.begin() + first_cusp_[s + 1],
                          s_.half_borders.begin() + first_of_probe_[s]);
    for (const ProbeSide& side : probes_.sides_of(static_cast<std::uint32_t>(s))) {
      // At the start of a toroidal patch the concave patch lies on the left of its edge, at the end on the right.
      const PatchBorders& b = placed_.of_patch[side.toroidal];
      const std::uint32_t backwards = side.at_end ? 1 : 0;
      if (!b.spindle) {
        *next++ = b.edge(side.at_end) * 2 + backwards;
      } else {
        *next++ = b.half_edge(side.at_end, 0) * 2 + backwards;
        *next++ = b.half_edge(side.at_end, 1) * 2 + backwards;
      }
    }
  }

  void chain_loops() {
    loop_size_ = std::make_unique_for_overwrite<std::uint32_t[]>(s_.half_borders.size());
    convex_numbers_.resize(s_.convex.size());
    concave_numbers_.resize(concave_count());
    tbb::enumerable_thread_specific<LoopChainer> chainers;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.convex.size(), 64), [&](const auto& range) {
      LoopChainer& chainer = chainers.local();
      for (std::size_t c = range.begin(); c != range.end(); ++c) {
        const Ball& atom = s_.atoms[s_.convex[c].atom];
        prefetch_walk(first_of_atom_[s_.convex[std::min(c + 1, s_.convex.size() - 1)].atom], walk_of_convex(c).size());
        convex_numbers_[c] = put_in_order(
            walk_of_convex(c), chainer.chain(s_.borders, walk_of_convex(c), atom.center, atom.radius, false));
      }
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, concave_count(), 64), [&](const auto& range) {
      LoopChainer& chainer = chainers.local();
      for (std::size_t s = range.begin(); s != range.end(); ++s) {
        prefetch_walk(first_of_probe_[s + 1] + kPrefetchAhead, walk_of_concave(s).size());
        concave_numbers_[s] = put_in_order(
            walk_of_concave(s), chainer.chain(s_.borders, walk_of_concave(s), s_.concave[s].center, p(), true));
      }
    });
  }

  // Prefetches as many half-borders as a patch has, from the patches that come next.
  [[gnu::always_inline]] void prefetch_walk(std::size_t half_border, std::size_t count) const {
    for (std::size_t n = 0; n < count; ++n) prefetch_border(s_, half_border + n);
  }

  std::span<HalfBorder> walk_of_convex(std::size_t c) {
    const std::uint32_t a = s_.convex[c].atom;
    return {s_.half_borders.data() + first_of_atom_[a], s_.half_borders.data() + first_of_atom_[a + 1]};
  }

  std::span<HalfBorder> walk_of_concave(std::size_t s) {
    return {s_.half_borders.data() + first_of_probe_[s], s_.half_borders.data() + first_of_probe_[s + 1]};
  }

  // Puts a patch's half-borders into the order of its faces and their loops. The first half-border of a loop stores
  // twice the loop's length, plus 1 if the loop is the first of its face.
  PatchNumbers put_in_order(std::span<HalfBorder> walk, const PatchFaces& faces) {
    auto next = walk.begin();
    for (std::uint32_t f = 0; f < faces.face_count; ++f) {
      bool first_of_face = true;
      auto loop = faces.half_borders.begin();
      for (std::size_t l = 0; l < faces.loop_sizes.size(); loop += faces.loop_sizes[l], ++l) {
        if (faces.loop_face[l] != f) continue;
        loop_size_[static_cast<std::size_t>(&*next - s_.half_borders.data())] =
            faces.loop_sizes[l] * 2 + (first_of_face ? 1 : 0);
        first_of_face = false;
        next = std::copy(loop, loop + faces.loop_sizes[l], next);
      }
    }
    return {static_cast<std::uint32_t>(faces.loop_sizes.size()), faces.face_count, faces.closed};
  }

  // Numbers of faces, loops and half-borders: totals, or counts before a patch.
  struct Numbers {
    std::uint32_t face = 0, loop = 0, half_border = 0;
    Numbers& operator+=(const Numbers& more) {
      face += more.face;
      loop += more.loop;
      half_border += more.half_border;
      return *this;
    }
  };

  Numbers numbers_of(const PatchBorders& borders) const {
    if (flat_) return {};
    if (borders.spindle) return {2, 2, borders.free ? 2u : 6u};
    return borders.free ? Numbers{1, 2, 2} : Numbers{1, 1, 4};
  }

  // Numbers the faces in the order of convex, toroidal and concave patches; then each patch lists its own.
  void number_faces() {
    const auto of_convex = [&](std::size_t c) {
      return Numbers{convex_numbers_[c].faces, convex_numbers_[c].loops, index(walk_of_convex(c).size())};
    };
    const auto of_toroidal = [&](std::size_t t) { return numbers_of(placed_.of_patch[t]); };
    const auto of_concave = [&](std::size_t s) {
      return Numbers{concave_numbers_[s].faces, concave_numbers_[s].loops, index(walk_of_concave(s).size())};
    };
    const RowNumbers<Numbers> convex(s_.convex.size(), {}, of_convex);
    const Numbers past_convex{convex.past().face, convex.past().loop, first_of_atom_.back()};
    const RowNumbers<Numbers> toroidal(s_.toroidal.size(), past_convex, of_toroidal);
    const RowNumbers<Numbers> concave(concave_count(), toroidal.past(), of_concave);
    resize_large(s_.faces, concave.past().face);
    resize_large(s_.loops, concave.past().loop);
    convex.for_each([&](std::size_t c, Numbers& next) {
      next.half_border = first_of_atom_[s_.convex[c].atom];
      list_faces(of_convex(c), PatchKind::convex, s_.convex[c], index(c), next);
    });
    toroidal.for_each([&](std::size_t t, Numbers& next) { list_toroidal_faces(index(t), next); });
    concave.for_each([&](std::size_t s, Numbers& next) {
      list_faces(of_concave(s), PatchKind::concave, s_.concave[s], index(s), next);
    });
    for (std::uint32_t c = 0; c < s_.convex.size(); ++c)
      if (!convex_numbers_[c].closed) s_.certificate.open_atoms.push_back(s_.convex[c].atom);
    for (std::uint32_t s = 0; s < concave_count(); ++s)
      if (!concave_numbers_[s].closed) add_open_probe(s);
    for (std::uint32_t s : cusps_.open_probes) add_open_probe(s);
  }

  static std::uint32_t index(std::size_t n) { return static_cast<std::uint32_t>(n); }

  void add_open_probe(std::uint32_t s) {
    for (const ProbeSide& side : probes_.sides_of(s)) s_.certificate.open_atoms.push_back(side.from);
  }

  // Lists the faces of a spherical patch.
  template <typename Patch>
  void list_faces(const Numbers& own, PatchKind kind, Patch& patch, std::uint32_t number, Numbers& next) {
    patch.first_face = next.face;
    patch.face_count = own.face;
    if (own.half_border == 0 && own.face > 0) open_face(kind, number, next);
    const std::uint32_t past = next.half_border + own.half_border;
    while (next.half_border < past) {
      const std::uint32_t size = loop_size_[next.half_border];
      if (size & 1) open_face(kind, number, next);
      close_loop(next.face - 1, size / 2, next);
    }
  }

  std::uint32_t open_face(PatchKind kind, std::uint32_t patch, Numbers& next) {
    Face& face = s_.faces[next.face];
    face.kind = kind;
    face.patch = patch;
    face.first_loop = next.loop;
    return next.face++;
  }

  // Closes a loop of the next `size` half-borders.
  void close_loop(std::uint32_t face, std::uint32_t size, Numbers& next) {
    s_.loops[next.loop++] = {next.half_border, size};
    ++s_.faces[face].loop_count;
    for (const std::uint32_t past = next.half_border + size; next.half_border < past; ++next.half_border) {
      const HalfBorder h = s_.half_borders[next.half_border];
      s_.borders[border_of(h)].face[h & 1] = face;
    }
  }

  void add_loop(std::uint32_t face, std::span<const HalfBorder> walk, Numbers& next) {
    std::ranges::copy(walk, s_.half_borders.begin() + next.half_border);
    close_loop(face, index(walk.size()), next);
  }

  void list_toroidal_faces(std::uint32_t t, Numbers& next) {
    ToroidalPatch& patch = s_.toroidal[t];
    const PatchBorders& b = placed_.of_patch[t];
    patch.first_face = next.face;
    patch.face_count = numbers_of(b).face;
    if (flat_) return;
    const HalfBorder bottom = b.contact(0) * 2, top = b.contact(1) * 2 + 1;
    if (!b.spindle) {
      const std::uint32_t face = open_face(PatchKind::toroidal, t, next);
      if (b.free) {
        add_loop(face, std::array{bottom}, next);
        add_loop(face, std::array{top}, next);
      } else {
        add_loop(face, std::array{bottom, b.edge(1) * 2, top, b.edge(0) * 2 + 1}, next);
      }
      return;
    }
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t face = open_face(PatchKind::toroidal, t, next);
      const HalfBorder contact = side ? top : bottom;
      if (b.free) {
        add_loop(face, std::array{contact}, next);
        s_.faces[face].tip = placed_.axis_vertex[t] + side;
      } else if (side == 0) {
        add_loop(face, std::array{contact, b.half_edge(1, 0) * 2, b.half_edge(0, 0) * 2 + 1}, next);
      } else {
        add_loop(face, std::array{contact, b.half_edge(0, 1) * 2 + 1, b.half_edge(1, 1) * 2}, next);
      }
    }
  }

  // Adds the faces at borders that have no second face.
  void add_open_borders() {
    for (const Border& border : s_.borders) {
      if (border.face[0] != kNone && border.face[1] != kNone) continue;
      for (const std::uint32_t f : border.face)
        if (f != kNone) add_open_face(f);
    }
  }

  void add_open_face(std::uint32_t f) {
    const Face& face = s_.faces[f];
    if (face.kind == PatchKind::convex) s_.certificate.open_atoms.push_back(s_.convex[face.patch].atom);
    if (face.kind == PatchKind::concave) add_open_probe(face.patch);
    if (face.kind == PatchKind::toroidal)
      for (std::uint32_t a : s_.toroidal[face.patch].atom) s_.certificate.open_atoms.push_back(a);
  }

  Surface& s_;
  const FixedProbes& probes_;
  const CuspParts& cusps_;
  const ReducedSurface& rs_;
  const bool
      flat_;  // true for a probe of radius 0: toroidal and concave patches have no area, convex patches meet directly
  PlacedBorders placed_;
  std::vector<std::uint32_t> first_of_atom_;   // first half-border of each atom; one past the last closes the list
  std::vector<std::uint32_t> first_of_probe_;  // first half-border of each probe; one past the last closes the list
  std::vector<std::uint32_t> first_cusp_;      // per probe, into cusp_of_probe_; one past the last closes the list
  std::vector<HalfBorder> cusp_of_probe_;
  std::unique_ptr<std::uint32_t[]> loop_size_;  // per half-border of a spherical patch that begins a loop
  std::vector<PatchNumbers> convex_numbers_;
  std::vector<PatchNumbers> concave_numbers_;
};

}  // namespace

void build_boundary(Surface& surface, const FixedProbes& probes, const CuspParts& cusps, const ReducedSurface& rs) {
  BoundaryBuilder(surface, probes, cusps, rs).run();
}

}  // namespace meniscus
