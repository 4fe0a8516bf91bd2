// SPDX-License-Identifier: BSD-3-Clause
// Computes a block, numbers the pieces of its own faces, and names borders and vertices at its seams by their bits.
#include "core/surface/block_part.h"

#include <algorithm>
#include <bit>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/stage_clock.h"
#include "core/math/union_find.h"
#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/surface/atom_areas.h"
#include "core/surface/block_patches.h"
#include "core/surface/certificate.h"
#include "core/surface/compute_surface.h"
#include "core/surface/convex_planes.h"
#include "core/surface/cusp_tracer.h"
#include "core/surface/measure.h"

namespace meniscus {
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

// One block, while its tables are there. Faces whose lowest atom is of the block are its own.
class Block {
 public:
  // atoms: its own and its halo, of the whole's `number`s; is_own: by atom of the block.
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
    part_.farthest.pop_back();  // of what is not the block's own
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
      std::ranges::stable_sort(kind, {}, &FaceSum::atom);  // they are, but for merged probes
      kind.shrink_to_fit();
    }
  }

  // Vertices - borders with ends, as in components.cpp. Who sees a vertex at no seam has all faces around it.
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
