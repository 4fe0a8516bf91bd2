// SPDX-License-Identifier: BSD-3-Clause
// Computes the blocks of a surface one by one and keeps of each what the whole needs.
#include "core/surface/blocks.h"

#include <bit>
#include <unordered_map>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/progress.h"
#include "core/math/box.h"
#include "core/math/union_find.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/certificate.h"
#include "core/surface/compute_surface.h"
#include "core/surface/convex_planes.h"
#include "core/surface/cusp_tracer.h"
#include "core/surface/measure.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostAtOnce = 400'000;  // atoms whose tables are made together
constexpr std::size_t kMostInBlock = 150'000;
constexpr double kMostHalo = 1.7;        // greatest number of atoms of all blocks with halos, in units of all atoms
constexpr double kHaloRoom = 0.1;        // Å, for a probe of radius 0: far more than merged probes move or radii grow
constexpr std::size_t kMostOpen = 1000;  // greatest number of open atoms in one attempt

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

// Computes all blocks, and again those in which radii have to grow.
class BlockRun {
 public:
  BlockRun(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
           double reach, ClipPlanes planes, StageClock& clock)
      : given_(atoms),
        atoms_(atoms.begin(), atoms.end()),
        p_(probe_radius),
        blocks_(blocks),
        reach_(reach),
        clock_(clock),
        origin_(middle_of(atoms)),
        block_of_(atoms.size()),
        parts_(blocks.size()),
        patches_(planes == ClipPlanes::listed ? blocks.size() : 0),
        is_due_(blocks.size(), 1) {
    for (std::uint32_t b = 0; b < blocks.size(); ++b)
      for (const std::uint32_t a : blocks[b]) block_of_[a] = b;
  }

  Surface run(int attempts) {
    for (;;) {
      Surface surface = compute();
      const bool closed = surface.certificate.closed;
      if (closed) surface.atoms = std::move(atoms_);
      surface.certificate.grown_by = tie_growth(most_attempt_);
      surface.certificate.exact_within += tie_growth(most_attempt_);
      if (closed || !grow_around(surface.certificate.open_atoms, attempts)) return surface;
    }
  }

 private:
  Surface compute() {
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      if (!is_due_[b]) continue;
      parts_[b] = compute(b);
      is_due_[b] = 0;
      if (parts_[b].open_atoms.empty()) continue;
      Surface open;
      open.certificate.open_atoms = parts_[b].open_atoms;
      return open;
    }
    const auto stage = clock_.stage("area and volume");
    Surface surface = sum_blocks(atoms_, p_, blocks_, block_of_, parts_);
    if (patches_.empty() || !surface.certificate.closed) return surface;
    parts_.assign(blocks_.size(), {});  // joining needs the memory
    is_due_.assign(blocks_.size(), 1);
    surface.certificate.open_atoms = join_patches(block_of_, patches_, surface);
    surface.certificate.closed = surface.certificate.open_atoms.empty();
    return surface;
  }

  BlockPart compute(std::uint32_t b) { return compute(blocks_[b], patches_.empty() ? nullptr : &patches_[b], clock_); }

  // `own` is in ascending order.
  BlockPart compute(std::span<const std::uint32_t> own, BlockPatches* patches, StageClock& clock) const {
    const std::vector<std::uint32_t> number = with_halo(given_, own, reach_);
    std::vector<Ball> balls;
    std::vector<char> is_own;
    for (const std::uint32_t a : number) {
      balls.push_back(atoms_[a]);
      is_own.push_back(std::ranges::binary_search(own, a));
    }
    return compute_block(std::move(balls), number, std::move(is_own), p_, origin_, patches, clock);
  }

  // Grows the radii of all atoms near open ones. Returns false if the radii have grown as often as they may, or if too
  // many atoms are open for a tie.
  bool grow_around(std::span<const std::uint32_t> open, int attempts) {
    if (open.size() > kMostOpen) return false;
    std::vector<std::uint32_t> grown;
    int attempt = 0;
    for (std::uint32_t a = 0; a < given_.size(); ++a) {
      const bool is_near = std::ranges::any_of(open, [&](std::uint32_t o) {
        const glm::dvec3 d = given_[o].center - given_[a].center;
        return glm::dot(d, d) <= reach_ * reach_;
      });
      if (!is_near) continue;
      grown.push_back(a);
      if (const auto known = attempt_of_.find(a); known != attempt_of_.end())
        attempt = std::max(attempt, known->second);
    }
    if (++attempt >= attempts) return false;
    attempt = first_that_closes(grown, attempt, attempts);
    most_attempt_ = std::max(most_attempt_, attempt);
    grow(grown, attempt);
    for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
      const Box box = box_of(given_, blocks_[b]);
      const auto is_in = [&](std::uint32_t a) { return box.squared_distance(given_[a].center) <= reach_ * reach_; };
      if (std::ranges::any_of(grown, is_in)) is_due_[b] = 1;
    }
    return true;
  }

  void grow(std::span<const std::uint32_t> these, int attempt) {
    for (const std::uint32_t a : these) {
      attempt_of_[a] = attempt;
      atoms_[a].radius = grown_radius(given_[a].radius, a, attempt);
    }
  }

  // Returns the first attempt that closes a block of these atoms alone, so that large blocks are computed again only
  // once. Returns `first` if none closes it.
  int first_that_closes(std::span<const std::uint32_t> these, int first, int attempts) {
    StageClock unused;
    for (int attempt = first; attempt < attempts; ++attempt) {
      grow(these, attempt);
      if (compute(these, nullptr, unused).open_atoms.empty()) return attempt;
    }
    return first;
  }

  std::span<const Ball> given_;
  std::vector<Ball> atoms_;  // some have grown radii
  double p_;
  std::span<const std::vector<std::uint32_t>> blocks_;
  double reach_;
  StageClock& clock_;
  glm::dvec3 origin_;
  std::vector<std::uint32_t> block_of_;
  std::vector<BlockPart> parts_;
  std::vector<BlockPatches> patches_;  // one for each block, if they are requested
  std::vector<char> is_due_;
  std::unordered_map<std::uint32_t, int> attempt_of_;  // attempts of atoms with grown radii
  int most_attempt_ = 0;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> divide_into_blocks(std::span<const Ball> atoms, std::size_t most) {
  std::vector<std::uint32_t> all(atoms.size());
  for (std::uint32_t a = 0; a < all.size(); ++a) all[a] = a;
  std::vector<std::vector<std::uint32_t>> blocks;
  divide(atoms, all, (atoms.size() + most - 1) / most, blocks);
  return blocks;
}

double halo_reach(std::span<const Ball> atoms, double probe_radius) {
  return 2 * largest_radius(atoms) + 4 * probe_radius + kHaloRoom * (1 + probe_radius);
}

std::vector<std::uint32_t> with_halo(std::span<const Ball> atoms, std::span<const std::uint32_t> block, double reach) {
  const Box box = box_of(atoms, block);
  std::vector<std::uint32_t> larger;
  for (std::uint32_t a = 0; a < atoms.size(); ++a)
    if (box.squared_distance(atoms[a].center) <= reach * reach) larger.push_back(a);
  return larger;
}

Surface surface_in_blocks(std::span<const Ball> atoms, double probe_radius,
                          std::span<const std::vector<std::uint32_t>> blocks, double reach, ClipPlanes planes,
                          StageClock& clock, int attempts) {
  return BlockRun(atoms, probe_radius, blocks, reach, planes, clock).run(attempts);
}

Surface compute_without_borders(std::span<const Ball> atoms, double probe_radius, ClipPlanes planes,
                                StageClock& clock) {
  if (atoms.size() > kMostAtOnce) {
    const std::vector<std::vector<std::uint32_t>> blocks = divide_into_blocks(atoms, kMostInBlock);
    const double reach = halo_reach(atoms, probe_radius);
    std::size_t computed = 0;
    for (const std::vector<std::uint32_t>& block : blocks) computed += with_halo(atoms, block, reach).size();
    if (static_cast<double>(computed) <= kMostHalo * static_cast<double>(atoms.size()))
      return surface_in_blocks(atoms, probe_radius, blocks, reach, planes, clock);
  }
  return compute_surface(*make_cpu_engine(), atoms, probe_radius, clock, planes);
}

namespace {

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

// One block while its tables exist. A face is the block's own if its lowest atom belongs to the block.
class Block {
 public:
  // atoms: the block's own atoms and its halo; number: their numbers in the whole; is_own: 1 for each own atom.
  Block(std::vector<Ball> atoms, std::span<const std::uint32_t> number, std::vector<char> is_own)
      : atoms_(std::move(atoms)), number_(number), is_own_(std::move(is_own)) {}

  BlockPart compute(double probe_radius, const glm::dvec3& origin, BlockPatches* patches, StageClock& clock) {
    {
      const auto stage = clock.stage("reduced surface");
      rs_ = enumerate_reduced_surface(atoms_, probe_radius, nullptr, number_);
    }
    const ClipPlanes clip_planes = patches ? ClipPlanes::listed : ClipPlanes::left_out;
    s_ = build_surface(atoms_, probe_radius, rs_, clock, *make_cpu_cusp_tracer(), clip_planes);
    part_.exact_within = s_.certificate.exact_within;
    const bool is_without_faces = s_.faces.empty() && !s_.certificate.open_atoms.empty();
    add_open(s_.certificate.open_atoms, is_without_faces);
    if (is_without_faces) return std::move(part_);
    const auto stage = clock.stage("area and volume");
    const std::unique_ptr<ConvexPlanes> found = planes_for(clip_planes, s_, rs_);
    const ConvexPlanes& planes = *found;
    const MeasuredFaces measured = measure_faces(s_, origin, planes);
    add_open(unsound_atoms(s_, measured.doubts, planes), false);
    number_pieces();
    part_.farthest = farthest_of_components(s_, planes);
    part_.farthest.pop_back();  // the last one is that of all other faces
    part_.euler.resize(pieces_, 0);
    add_faces(measured.flux);
    add_borders();
    add_atoms();
    if (patches) *patches = take_patches(s_, number_, is_own_);
    return std::move(part_);
  }

 private:
  std::uint32_t atom_of(const Face& face) const {
    if (face.kind == PatchKind::convex) return s_.convex[face.patch].atom;
    if (face.kind == PatchKind::toroidal) return s_.toroidal[face.patch].atom[0];
    return first_atom(s_, s_.concave[face.patch]);
  }

  bool is_own(std::uint32_t face) const { return face != kNone && s_.faces[face].component < pieces_; }

  void add_open(std::span<const std::uint32_t> atoms, bool of_halo_too) {
    for (const std::uint32_t a : atoms)
      if (is_own_[a] || of_halo_too) part_.open_atoms.push_back(number_[a]);
  }

  // Pieces are connected sets of the block's own faces. All other faces count as one piece, the last.
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

  std::uint32_t piece_of(std::uint32_t face) const { return s_.faces[face].component; }

  void add_faces(std::span<const double> flux) {
    std::array<std::vector<FaceSum>, 3>& sums = part_.faces;
    for (std::uint32_t f = 0; f < s_.faces.size(); ++f) {
      if (!is_own(f)) continue;
      const Face& face = s_.faces[f];
      sums[place_of(face.kind)].push_back({number_[atom_of(face)], piece_of(f), face.area, flux[f]});
      part_.euler[piece_of(f)] += 2 - static_cast<int>(face.loop_count);
    }
    for (std::vector<FaceSum>& kind : sums) {
      std::ranges::stable_sort(kind, {}, &FaceSum::atom);  // they are sorted already, except for merged probes
      kind.shrink_to_fit();
    }
  }

  // Counts vertices - borders with ends, as in components.cpp. A vertex at no seam has all its faces in this block.
  void add_borders() {
    std::vector<std::uint32_t> piece(s_.vertices.size(), kNone);
    std::vector<char> at_seam(s_.vertices.size(), 0);
    for (const Border& border : s_.borders) {
      const bool left = is_own(border.face[0]), right = is_own(border.face[1]);
      if (!left && !right) continue;
      const std::uint32_t own = border.face[left ? 0 : 1];
      if (left != right)
        part_.borders.push_back({key_of(border), piece_of(own), number_[atom_of(s_.faces[own])] * 2 + (left ? 0 : 1)});
      if (border.vertex[0] == kNone) continue;
      if (left) --part_.euler[piece_of(own)];
      for (const std::uint32_t v : border.vertex) {
        if (piece[v] == kNone) piece[v] = piece_of(own);
        if (left != right) at_seam[v] = 1;
      }
    }
    for (std::size_t v = 0; v < piece.size(); ++v) {
      if (piece[v] == kNone) continue;
      if (at_seam[v])
        part_.vertices.push_back({key_of(s_.vertices[v]), piece[v]});
      else
        ++part_.euler[piece[v]];
    }
  }

  void add_atoms() {
    std::vector<std::uint32_t> contradicted;
    const AtomAreas areas = atom_areas(s_, contradicted);
    add_open(contradicted, false);
    for (std::size_t a = 0; a < number_.size(); ++a) {
      if (!is_own_[a]) continue;
      part_.atom_surface.push_back(areas.surface[a]);
      part_.atom_accessible.push_back(areas.accessible[a]);
    }
    part_.counts = counts_of(s_, [&](std::uint32_t a) { return is_own_[a] != 0; });
  }

  std::vector<Ball> atoms_;
  std::span<const std::uint32_t> number_;
  std::vector<char> is_own_;
  ReducedSurface rs_;
  Surface s_;
  std::uint32_t pieces_ = 0;
  BlockPart part_;
};

}  // namespace

BlockPart compute_block(std::vector<Ball> atoms, std::span<const std::uint32_t> numbers, std::vector<char> is_own,
                        double probe_radius, const glm::dvec3& origin, BlockPatches* patches, StageClock& clock) {
  return Block(std::move(atoms), numbers, std::move(is_own)).compute(probe_radius, origin, patches, clock);
}

}  // namespace meniscus
