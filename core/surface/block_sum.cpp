// SPDX-License-Identifier: BSD-3-Clause
// Sorts what is at seams by its bits, so that what belongs together lies together.
#include "core/surface/block_sum.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "core/math/union_find.h"
#include "core/surface/block_patches.h"
#include "core/surface/certificate.h"
#include "core/surface/components.h"
#include "core/surface/measure.h"

namespace meniscus {
namespace {

class BlockSum {
 public:
  BlockSum(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
           std::span<const std::uint32_t> block_of, std::span<const BlockPart> parts)
      : p_(probe_radius),
        block_of_(block_of),
        parts_(parts),
        first_piece_(first_pieces(parts)),
        joined_(first_piece_.back()) {
    sums_.atom_surface.resize(atoms.size());
    sums_.atom_accessible.resize(atoms.size());
    for (std::size_t b = 0; b < parts.size(); ++b) add_atoms(blocks[b], parts[b]);
  }

  Surface run() {
    Surface surface;
    surface.probe_radius = p_;
    join_borders();
    add_faces(surface.components);
    sums_.accessible = std::accumulate(sums_.atom_accessible.begin(), sums_.atom_accessible.end(), 0.0);
    finish(surface.components);
    for (const Component& component : surface.components) {
      surface.area += component.area;
      surface.volume += component.volume;
    }
    sort_components(surface.components);
    for (const BlockPart& part : parts_) {
      open_.insert(open_.end(), part.open_atoms.begin(), part.open_atoms.end());
      surface.certificate.exact_within = std::max(surface.certificate.exact_within, part.exact_within);
    }
    std::ranges::sort(open_);
    open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
    surface.certificate.closed = open_.empty();
    surface.certificate.open_atoms = std::move(open_);
    surface.sums = std::make_shared<const SurfaceSums>(std::move(sums_));
    return surface;
  }

 private:
  static std::vector<std::uint32_t> first_pieces(std::span<const BlockPart> parts) {
    std::vector<std::uint32_t> first{0};
    for (const BlockPart& part : parts) first.push_back(first.back() + static_cast<std::uint32_t>(part.euler.size()));
    return first;
  }

  void add_atoms(std::span<const std::uint32_t> own, const BlockPart& part) {
    for (std::size_t n = 0; n < part.atom_surface.size(); ++n) {
      sums_.atom_surface[own[n]] = part.atom_surface[n];
      sums_.atom_accessible[own[n]] = part.atom_accessible[n];
    }
    sums_.counts += part.counts;
  }

  // Those of all blocks in the order of their keys, their pieces numbered through.
  template <typename Row>
  std::vector<Row> gather(std::vector<Row> BlockPart::*rows) const {
    std::vector<Row> all;
    for (std::size_t b = 0; b < parts_.size(); ++b)
      for (Row row : parts_[b].*rows) {
        row.piece += first_piece_[b];
        all.push_back(row);
      }
    std::ranges::sort(all);
    return all;
  }

  // A border is there twice, with a face of one block on its left and of another on its right.
  void join_borders() {
    const std::vector<SeamBorder> borders = gather(&BlockPart::borders);
    for (std::size_t n = 0; n < borders.size();) {
      std::size_t past = n;
      while (past < borders.size() && borders[past].key == borders[n].key) ++past;
      const SeamBorder &one = borders[n], &other = borders[past - 1];
      if (past - n == 2 && (one.atom_and_side & 1) != (other.atom_and_side & 1))
        joined_.unite(one.piece, other.piece);
      else
        for (std::size_t k = n; k < past; ++k) open_.push_back(borders[k].atom_and_side / 2);
      n = past;
    }
  }

  std::uint32_t root_of(std::size_t block, std::uint32_t piece) const {
    return joined_.find(first_piece_[block] + piece);
  }

  // Calls visit(face, representative of its piece) kind after kind, atom after atom.
  template <typename Visit>
  void for_each_face(const Visit& visit) const {
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const auto faces = [kind](const BlockPart& part) -> const std::vector<FaceSum>& { return part.faces[kind]; };
      const auto atom_of = [](const BlockPart&, const FaceSum& face) { return face.atom; };
      for_each_by_atom(block_of_, parts_, faces, atom_of, [&](std::uint32_t b, std::uint32_t n) {
        const FaceSum& face = faces(parts_[b])[n];
        visit(face, root_of(b, face.piece));
      });
    }
  }

  void add_faces(std::vector<Component>& components) {
    component_of_.assign(first_piece_.back(), kNone);
    for_each_face([&](const FaceSum& face, std::uint32_t root) {
      std::uint32_t& component = component_of_[root];
      if (component == kNone) {
        component = static_cast<std::uint32_t>(components.size());
        components.push_back({.euler = 0});
      }
      components[component].area += face.area;
      components[component].volume += face.flux / 3;
    });
  }

  void finish(std::vector<Component>& components) {
    std::vector<Farthest> farthest(components.size());
    for (std::size_t b = 0; b < parts_.size(); ++b)
      for (std::uint32_t piece = 0; piece < parts_[b].euler.size(); ++piece) {
        const std::uint32_t component = component_of_[root_of(b, piece)];
        farthest[component].include(parts_[b].farthest[piece]);
        components[component].euler += parts_[b].euler[piece];
      }
    const std::vector<SeamVertex> vertices = gather(&BlockPart::vertices);
    for (std::size_t n = 0; n < vertices.size(); ++n)
      if (n == 0 || vertices[n].key != vertices[n - 1].key)
        ++components[component_of_[joined_.find(vertices[n].piece)]].euler;
    std::vector<char> bad(components.size());
    for (std::size_t c = 0; c < components.size(); ++c) {
      components[c].kind = side_of(farthest[c], p_);
      bad[c] = !is_sound(components[c], p_);
    }
    if (std::ranges::find(bad, 1) == bad.end()) return;
    for_each_face([&](const FaceSum& face, std::uint32_t root) {
      if (bad[component_of_[root]]) open_.push_back(face.atom);
    });
  }

  double p_;
  std::span<const std::uint32_t> block_of_;
  std::span<const BlockPart> parts_;
  std::vector<std::uint32_t> first_piece_;  // of each block, and one past the last
  mutable UnionFind joined_;
  std::vector<std::uint32_t> component_of_;  // by piece that represents others
  std::vector<std::uint32_t> open_;
  SurfaceSums sums_;
};

}  // namespace

Surface sum_blocks(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
                   std::span<const std::uint32_t> block_of, std::span<const BlockPart> parts) {
  return BlockSum(atoms, probe_radius, blocks, block_of, parts).run();
}

}  // namespace meniscus
