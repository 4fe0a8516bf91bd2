// SPDX-License-Identifier: BSD-3-Clause
// Computes one block after another, keeps what its faces and seams come to, and adds up in the order of the whole.
#include "core/surface/blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/stage_clock.h"
#include "core/math/box.h"
#include "core/math/union_find.h"
#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/surface/atom_areas.h"
#include "core/surface/certificate.h"
#include "core/surface/components.h"
#include "core/surface/compute_surface.h"
#include "core/surface/cusp_tracer.h"
#include "core/surface/measure.h"
#include "core/surface/reduced_surface_engine.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostAtOnce = 400'000;  // atoms whose tables are made together
constexpr std::size_t kMostInBlock = 150'000;
constexpr double kMostHalo = 1.7;  // of the atoms; with more work than that tables of all are made
constexpr double kRounding = 0.1;  // Å for a probe of no size: far above what merged probes move by

// What a face contributes to its component. Blocks number their pieces one after another.
struct FaceSum {
  std::uint32_t atom = 0;  // the lowest that it touches
  std::uint32_t piece = 0;
  double area = 0.0;
  double flux = 0.0;
};

// A border between a face of this block and one of another, seen from this one.
struct SeamBorder {
  std::uint64_t key = 0;
  std::uint32_t piece = 0;
  std::uint32_t atom_and_side = 0;
  auto operator<=>(const SeamBorder&) const = default;
};

// An end of such a border.
struct SeamVertex {
  std::uint64_t key = 0;
  std::uint32_t piece = 0;
  auto operator<=>(const SeamVertex&) const = default;
};

// A hash of the bits of numbers. Two borders that differ have one key by chance once in 2^64 pairs; then three borders
// share it, and the surface counts as open. Words are scrambled as in MurmurHash3 (Appleby 2011).
class Key {
 public:
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const glm::dvec3& x) {
    for (int n = 0; n < 3; ++n) add(x[n]);
  }
  void add(std::uint64_t word) {
    word *= 0xff51afd7ed558ccdu;
    key_ = (key_ ^ word ^ (word >> 32)) * 0xc4ceb9fe1a85ec53u;
    key_ ^= key_ >> 29;
  }
  std::uint64_t value() const { return key_; }

 private:
  std::uint64_t key_ = 0xcbf29ce484222325u;
};

std::uint64_t key_of(const Border& border) {
  Key key;
  key.add(static_cast<std::uint64_t>(border.kind));
  for (const glm::dvec3& x : {border.center, border.axis, border.start}) key.add(x);
  key.add(border.radius);
  key.add(border.sweep);
  return key.value();
}

std::uint64_t key_of(const glm::dvec3& vertex) {
  Key key;
  key.add(vertex);
  return key.value();
}

std::size_t place_of(PatchKind kind) { return static_cast<std::size_t>(kind); }

// What is kept of all blocks.
struct Gathered {
  std::vector<std::array<std::vector<FaceSum>, 3>> faces;  // by block and kind, of rising atoms
  std::vector<Farthest> farthest;                          // by piece
  std::vector<int> euler;                                  // by piece, without the vertices at seams
  std::vector<SeamBorder> borders;
  std::vector<SeamVertex> vertices;
  SurfaceSums sums;
  Certificate certificate;

  std::uint32_t piece_count() const { return static_cast<std::uint32_t>(euler.size()); }
};

// One block, while its tables are there. Faces whose lowest atom is of the block are its own.
class Block {
 public:
  // atoms: its own and its halo, of the whole's `number`s; is_own: by atom of the block.
  Block(std::vector<Ball> atoms, std::span<const std::uint32_t> number, std::vector<char> is_own)
      : atoms_(std::move(atoms)), number_(number), is_own_(std::move(is_own)) {}

  void compute(double probe_radius, const glm::dvec3& origin, StageClock& clock, Gathered& all) {
    {
      const auto stage = clock.stage("reduced surface");
      rs_ = enumerate_reduced_surface(atoms_, probe_radius, nullptr, number_);
    }
    s_ = build_surface(atoms_, probe_radius, rs_, clock, *make_cpu_cusp_tracer(), ClipPlanes::left_out);
    all.certificate.exact_within = std::max(all.certificate.exact_within, s_.certificate.exact_within);
    const bool is_without_faces = s_.faces.empty() && !s_.certificate.open_atoms.empty();
    add_open(s_.certificate.open_atoms, is_without_faces, all);
    if (is_without_faces) return;
    const auto stage = clock.stage("area and volume");
    const ConvexPlanes planes = planes_when_asked(s_, rs_);
    const MeasuredFaces measured = measure_faces(s_, origin, planes);
    add_open(unsound_atoms(s_, measured.doubts, planes), false, all);
    number_pieces();
    add_pieces(planes, all);
    add_faces(measured.flux, all);
    add_borders(all);
    add_atoms(all);
  }

 private:
  std::uint32_t atom_of(const Face& face) const {
    if (face.kind == PatchKind::convex) return s_.convex[face.patch].atom;
    if (face.kind == PatchKind::toroidal) return s_.toroidal[face.patch].atom[0];
    return first_atom(s_, s_.concave[face.patch]);
  }

  bool is_own(std::uint32_t face) const { return face != kNone && s_.faces[face].component < pieces_; }

  void add_open(std::span<const std::uint32_t> atoms, bool of_halo_too, Gathered& all) const {
    for (const std::uint32_t a : atoms)
      if (is_own_[a] || of_halo_too) all.certificate.open_atoms.push_back(number_[a]);
  }

  // Pieces are the block's faces that are connected through one another; all others come behind, as if they were one.
  void number_pieces() {
    std::vector<char> own(s_.faces.size());
    SharedUnionFind joined(s_.faces.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, own.size(), 1024), [&](const auto& range) {
      for (std::size_t f = range.begin(); f != range.end(); ++f) own[f] = is_own_[atom_of(s_.faces[f])];
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s_.borders.size(), 1024), [&](const auto& range) {
      for (std::size_t b = range.begin(); b != range.end(); ++b) {
        const auto& [left, right] = s_.borders[b].face;
        if (left != kNone && right != kNone && own[left] && own[right]) joined.unite(left, right);
      }
    });
    pieces_ = 0;
    for (std::uint32_t f = 0; f < own.size(); ++f) {
      if (!own[f]) continue;
      const std::uint32_t root = joined.find(f);
      s_.faces[f].component = root == f ? pieces_++ : s_.faces[root].component;
    }
    for (std::uint32_t f = 0; f < own.size(); ++f)
      if (!own[f]) s_.faces[f].component = pieces_;
    s_.components.assign(pieces_ + 1, Component{});
  }

  void add_pieces(const ConvexPlanes& planes, Gathered& all) {
    first_piece_ = all.piece_count();
    std::vector<Farthest> farthest = farthest_of_components(s_, planes);
    farthest.pop_back();  // of the others
    all.farthest.insert(all.farthest.end(), farthest.begin(), farthest.end());
    all.euler.resize(all.euler.size() + pieces_, 0);
  }

  std::uint32_t piece_of(std::uint32_t face) const { return first_piece_ + s_.faces[face].component; }

  void add_faces(std::span<const double> flux, Gathered& all) const {
    std::array<std::vector<FaceSum>, 3>& sums = all.faces.emplace_back();
    for (std::uint32_t f = 0; f < s_.faces.size(); ++f) {
      if (!is_own(f)) continue;
      const Face& face = s_.faces[f];
      sums[place_of(face.kind)].push_back({number_[atom_of(face)], piece_of(f), face.area, flux[f]});
      all.euler[piece_of(f)] += 2 - static_cast<int>(face.loop_count);
    }
    for (std::vector<FaceSum>& kind : sums) {
      std::ranges::stable_sort(kind, {}, &FaceSum::atom);  // they are, but for merged probes
      kind.shrink_to_fit();
    }
  }

  // Vertices - borders with ends, as in components.cpp. Who sees a vertex at no seam has all faces around it.
  void add_borders(Gathered& all) const {
    std::vector<std::uint32_t> piece(s_.vertices.size(), kNone);
    std::vector<char> at_seam(s_.vertices.size(), 0);
    for (const Border& border : s_.borders) {
      const bool left = is_own(border.face[0]), right = is_own(border.face[1]);
      if (!left && !right) continue;
      const std::uint32_t own = border.face[left ? 0 : 1];
      if (left != right)
        all.borders.push_back({key_of(border), piece_of(own), number_[atom_of(s_.faces[own])] * 2 + (left ? 0 : 1)});
      if (border.vertex[0] == kNone) continue;
      if (left) --all.euler[piece_of(own)];
      for (const std::uint32_t v : border.vertex) {
        if (piece[v] == kNone) piece[v] = piece_of(own);
        if (left != right) at_seam[v] = 1;
      }
    }
    for (std::size_t v = 0; v < piece.size(); ++v) {
      if (piece[v] == kNone) continue;
      if (at_seam[v])
        all.vertices.push_back({key_of(s_.vertices[v]), piece[v]});
      else
        ++all.euler[piece[v]];
    }
  }

  void add_atoms(Gathered& all) {
    std::vector<std::uint32_t> contradicted;
    const AtomAreas areas = atom_areas(s_, contradicted);
    add_open(contradicted, false, all);
    for (std::size_t a = 0; a < number_.size(); ++a) {
      if (!is_own_[a]) continue;
      all.sums.atom_surface[number_[a]] = areas.surface[a];
      all.sums.atom_accessible[number_[a]] = areas.accessible[a];
    }
    all.sums.counts += counts_of(s_, [&](std::uint32_t a) { return is_own_[a] != 0; });
  }

  std::vector<Ball> atoms_;
  std::span<const std::uint32_t> number_;
  std::vector<char> is_own_;
  ReducedSurface rs_;
  Surface s_;
  std::uint32_t pieces_ = 0;       // of this block
  std::uint32_t first_piece_ = 0;  // of this block, among all
};

// Joins pieces where blocks meet, and adds up faces in the order in which the whole surface has them.
class Sum {
 public:
  Sum(std::span<const Ball> atoms, double probe_radius, std::span<const std::uint32_t> block_of, Gathered& all)
      : atoms_(atoms), p_(probe_radius), block_of_(block_of), all_(all), joined_(all.piece_count()) {}

  Surface run() {
    Surface surface;
    surface.probe_radius = p_;
    join_seams();
    add_faces(surface.components);
    finish(surface.components);
    for (const Component& component : surface.components) {
      surface.area += component.area;
      surface.volume += component.volume;
    }
    sort_components(surface.components);
    std::vector<std::uint32_t>& open = all_.certificate.open_atoms;
    std::ranges::sort(open);
    open.erase(std::unique(open.begin(), open.end()), open.end());
    all_.certificate.closed = open.empty();
    surface.certificate = std::move(all_.certificate);
    surface.sums = std::make_shared<const SurfaceSums>(std::move(all_.sums));
    surface.atoms.assign(atoms_.begin(), atoms_.end());
    return surface;
  }

 private:
  // A border is there twice, with a face of one block on its left and of another on its right.
  void join_seams() {
    std::ranges::sort(all_.borders);
    for (std::size_t n = 0; n < all_.borders.size();) {
      std::size_t past = n;
      while (past < all_.borders.size() && all_.borders[past].key == all_.borders[n].key) ++past;
      const SeamBorder &one = all_.borders[n], &other = all_.borders[past - 1];
      if (past - n == 2 && (one.atom_and_side & 1) != (other.atom_and_side & 1))
        joined_.unite(one.piece, other.piece);
      else
        for (; n < past; ++n) all_.certificate.open_atoms.push_back(all_.borders[n].atom_and_side / 2);
      n = past;
    }
    std::ranges::sort(all_.vertices);
    for (std::size_t n = 0; n < all_.vertices.size(); ++n)
      if (n == 0 || all_.vertices[n].key != all_.vertices[n - 1].key) ++all_.euler[all_.vertices[n].piece];
  }

  // Calls visit(face) kind after kind, atom after atom.
  template <typename Visit>
  void for_each_face(const Visit& visit) const {
    for (std::size_t kind = 0; kind < 3; ++kind) {
      std::vector<std::size_t> next(all_.faces.size(), 0);
      for (std::uint32_t a = 0; a < block_of_.size(); ++a) {
        const std::vector<FaceSum>& faces = all_.faces[block_of_[a]][kind];
        for (std::size_t& n = next[block_of_[a]]; n < faces.size() && faces[n].atom == a; ++n) visit(faces[n], kind);
      }
    }
  }

  void add_faces(std::vector<Component>& components) {
    component_of_.assign(all_.piece_count(), kNone);
    for_each_face([&](const FaceSum& face, std::size_t kind) {
      std::uint32_t& component = component_of_[joined_.find(face.piece)];
      if (component == kNone) {
        component = static_cast<std::uint32_t>(components.size());
        components.push_back({.euler = 0});
      }
      components[component].area += face.area;
      components[component].volume += face.flux / 3;
      if (kind != place_of(PatchKind::convex)) return;
      const double r = atoms_[face.atom].radius, extended = r + p_;
      all_.sums.accessible += face.area * (extended / r) * (extended / r);
    });
  }

  void finish(std::vector<Component>& components) {
    std::vector<Farthest> farthest(components.size());
    for (std::uint32_t piece = 0; piece < all_.piece_count(); ++piece) {
      const std::uint32_t component = component_of_[joined_.find(piece)];
      farthest[component].include(all_.farthest[piece]);
      components[component].euler += all_.euler[piece];
    }
    std::vector<char> bad(components.size());
    for (std::size_t c = 0; c < components.size(); ++c) {
      components[c].kind = side_of(farthest[c], p_);
      bad[c] = !is_sound(components[c], p_);
    }
    if (std::ranges::find(bad, 1) == bad.end()) return;
    for_each_face([&](const FaceSum& face, std::size_t) {
      if (bad[component_of_[joined_.find(face.piece)]]) all_.certificate.open_atoms.push_back(face.atom);
    });
  }

  std::span<const Ball> atoms_;
  double p_;
  std::span<const std::uint32_t> block_of_;
  Gathered& all_;
  mutable UnionFind joined_;
  std::vector<std::uint32_t> component_of_;  // by piece that represents others
};

double largest_radius(std::span<const Ball> atoms) {
  double largest = 0;
  for (const Ball& b : atoms) largest = std::max(largest, b.radius);
  return largest;
}

Box box_of(std::span<const Ball> atoms, std::span<const std::uint32_t> these) {
  Box box;
  for (const std::uint32_t a : these) box.include(atoms[a].center);
  return box;
}

void divide(std::span<const Ball> atoms, std::span<std::uint32_t> these, std::size_t parts,
            std::vector<std::vector<std::uint32_t>>& blocks) {
  if (parts <= 1) {
    blocks.emplace_back(these.begin(), these.end());
    std::ranges::sort(blocks.back());
    return;
  }
  const Box box = box_of(atoms, these);
  const glm::dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t first = parts / 2, middle = these.size() * first / parts;
  std::ranges::nth_element(these, these.begin() + static_cast<std::ptrdiff_t>(middle), {},
                           [&](std::uint32_t a) { return std::pair(atoms[a].center[axis], a); });
  divide(atoms, these.first(middle), first, blocks);
  divide(atoms, these.subspan(middle), parts - first, blocks);
}

}  // namespace

std::vector<std::vector<std::uint32_t>> divide_into_blocks(std::span<const Ball> atoms, std::size_t most) {
  std::vector<std::uint32_t> all(atoms.size());
  for (std::uint32_t a = 0; a < all.size(); ++a) all[a] = a;
  std::vector<std::vector<std::uint32_t>> blocks;
  divide(atoms, all, (atoms.size() + most - 1) / most, blocks);
  return blocks;
}

double halo_reach(std::span<const Ball> atoms, double probe_radius) {
  return 2 * largest_radius(atoms) + 4 * probe_radius + kRounding * (1 + probe_radius);
}

std::vector<std::uint32_t> with_halo(std::span<const Ball> atoms, std::span<const std::uint32_t> block, double reach) {
  const Box box = box_of(atoms, block);
  std::vector<std::uint32_t> larger;
  for (std::uint32_t a = 0; a < atoms.size(); ++a)
    if (box.squared_distance(atoms[a].center) <= reach * reach) larger.push_back(a);
  return larger;
}

Surface attempt_surface_in_blocks(std::span<const Ball> atoms, double probe_radius,
                                  std::span<const std::vector<std::uint32_t>> blocks, double reach, StageClock& clock) {
  const glm::dvec3 origin = middle_of(atoms);
  std::vector<std::uint32_t> block_of(atoms.size());
  for (std::uint32_t n = 0; n < blocks.size(); ++n)
    for (const std::uint32_t a : blocks[n]) block_of[a] = n;
  Gathered all;
  all.sums.atom_surface.resize(atoms.size());
  all.sums.atom_accessible.resize(atoms.size());
  for (std::uint32_t n = 0; n < blocks.size() && all.certificate.open_atoms.empty(); ++n) {
    const std::vector<std::uint32_t> number = with_halo(atoms, blocks[n], reach);
    std::vector<Ball> balls;
    std::vector<char> is_own;
    for (const std::uint32_t a : number) {
      balls.push_back(atoms[a]);
      is_own.push_back(block_of[a] == n);
    }
    Block(std::move(balls), number, std::move(is_own)).compute(probe_radius, origin, clock, all);
  }
  if (!all.certificate.open_atoms.empty()) {
    Surface open;
    open.certificate = std::move(all.certificate);
    return open;
  }
  const auto stage = clock.stage("area and volume");
  return Sum(atoms, probe_radius, block_of, all).run();
}

Surface compute_sums(std::span<const Ball> atoms, double probe_radius, StageClock& clock) {
  if (atoms.size() > kMostAtOnce) {
    const std::vector<std::vector<std::uint32_t>> blocks = divide_into_blocks(atoms, kMostInBlock);
    const double reach = halo_reach(atoms, probe_radius);
    std::size_t computed = 0;
    for (const std::vector<std::uint32_t>& block : blocks) computed += with_halo(atoms, block, reach).size();
    if (static_cast<double>(computed) <= kMostHalo * static_cast<double>(atoms.size())) {
      Surface surface = compute_through_ties(atoms, [&](std::span<const Ball> balls) {
        return attempt_surface_in_blocks(balls, probe_radius, blocks, halo_reach(balls, probe_radius), clock);
      });
      if (surface.certificate.closed) return surface;
    }
  }
  return compute_surface(*make_cpu_engine(), atoms, probe_radius, clock, ClipPlanes::left_out);
}

}  // namespace meniscus
