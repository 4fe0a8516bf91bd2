// SPDX-License-Identifier: BSD-3-Clause
// Joins the blocks of a surface: their patches and their sums.
#include "core/surface/blocks.h"

#include <tuple>

#include "core/base/error.h"
#include "core/math/union_find.h"
#include "core/surface/certificate.h"
#include "core/surface/components.h"
#include "core/surface/measure.h"

namespace meniscus {
namespace {

template <typename Row>
std::uint32_t append(std::span<const Row> rows, std::vector<Row>& table) {
  const std::size_t first = table.size();
  if (first + rows.size() >= kNone) throw CapacityError("the surface has too many patches for one picture");
  table.insert(table.end(), rows.begin(), rows.end());
  return static_cast<std::uint32_t>(first);
}

class Taking {
 public:
  Taking(const Surface& surface, std::span<const std::uint32_t> number, std::span<const char> is_own)
      : s_(surface), number_(number), is_own_(is_own), place_(surface.concave.size(), kNone) {}

  BlockPatches run() {
    take_convex();
    if (s_.probe_radius > 0.0) {  // a probe of no size leaves these patches without area
      take_concave();
      take_toroidal();
    }
    return std::move(taken_);
  }

 private:
  std::uint32_t planes(std::uint32_t first, std::uint32_t count) {
    return append(std::span(s_.planes).subspan(first, count), taken_.planes);
  }

  void take_convex() {
    for (ConvexPatch patch : s_.convex) {
      if (!is_own_[patch.atom]) continue;
      patch.atom = number_[patch.atom];
      patch.first_plane = planes(patch.first_plane, patch.plane_count);
      taken_.convex.push_back(patch);
    }
  }

  void take_concave() {
    std::vector<std::uint32_t> own;
    for (std::uint32_t c = 0; c < place_.size(); ++c)
      if (is_own_[first_atom(s_, s_.concave[c])]) own.push_back(c);
    // They are in this order already, except for merged probes.
    std::ranges::stable_sort(own, {}, [this](std::uint32_t c) { return first_atom(s_, s_.concave[c]); });
    for (const std::uint32_t c : own) {
      ConcavePatch patch = s_.concave[c];
      place_[c] = static_cast<std::uint32_t>(taken_.concave.size());
      patch.first_plane = planes(patch.first_plane, patch.plane_count());
      const std::span contacts = std::span(s_.contacts).subspan(patch.first_contact, patch.contact_count);
      patch.first_contact = static_cast<std::uint32_t>(taken_.contacts.size());
      for (const std::uint32_t atom : contacts) taken_.contacts.push_back(number_[atom]);
      patch.first_cut = kNone;
      taken_.concave.push_back(patch);
    }
  }

  void take_toroidal() {
    for (ToroidalPatch patch : s_.toroidal) {
      if (!is_own_[patch.atom[0]]) continue;
      const auto index = static_cast<std::uint32_t>(taken_.toroidal.size());
      for (int end = 0; !patch.free() && end < 2; ++end) {
        const std::uint32_t probe = patch.probe[end];
        if (place_[probe] == kNone) taken_.outside.push_back({index, end, s_.concave[probe].center});
      }
      if (!patch.free()) patch.probe = {place_[patch.probe[0]], place_[patch.probe[1]]};
      patch.atom = {number_[patch.atom[0]], number_[patch.atom[1]]};
      taken_.toroidal.push_back(patch);
    }
  }

  const Surface& s_;
  std::span<const std::uint32_t> number_;
  std::span<const char> is_own_;
  std::vector<std::uint32_t> place_;  // place of each of the surface's probes among the block's own
  BlockPatches taken_;
};

class Joining {
 public:
  Joining(std::span<const std::uint32_t> block_of, std::span<BlockPatches> blocks, Surface& whole)
      : block_of_(block_of), blocks_(blocks), whole_(whole), place_(blocks.size()) {}

  std::vector<std::uint32_t> run() {
    reserve(&BlockPatches::planes, whole_.planes);
    join_convex();
    join_concave();
    for (BlockPatches& block : blocks_) block.planes = {};
    join_toroidal();
    return std::move(open_);
  }

 private:
  template <typename Row>
  void reserve(std::vector<Row> BlockPatches::*rows, std::vector<Row>& table) const {
    std::size_t count = 0;
    for (const BlockPatches& block : blocks_) count += (block.*rows).size();
    table.reserve(count);
  }

  std::uint32_t planes(const BlockPatches& block, std::uint32_t first, std::uint32_t count) {
    return append(std::span<const Plane>(block.planes).subspan(first, count), whole_.planes);
  }

  void join_convex() {
    reserve(&BlockPatches::convex, whole_.convex);
    const auto atom_of = [](const BlockPatches&, const ConvexPatch& patch) { return patch.atom; };
    for_each_by_atom(block_of_, blocks_, &BlockPatches::convex, atom_of, [&](std::uint32_t b, std::uint32_t n) {
      ConvexPatch patch = blocks_[b].convex[n];
      patch.first_plane = planes(blocks_[b], patch.first_plane, patch.plane_count);
      whole_.convex.push_back(patch);
    });
    for (BlockPatches& block : blocks_) block.convex = {};
  }

  void join_concave() {
    reserve(&BlockPatches::concave, whole_.concave);
    reserve(&BlockPatches::contacts, whole_.contacts);
    for (std::size_t b = 0; b < blocks_.size(); ++b) place_[b].resize(blocks_[b].concave.size());
    const auto atom_of = [](const BlockPatches& block, const ConcavePatch& patch) {
      return block.contacts[patch.first_contact];
    };
    for_each_by_atom(block_of_, blocks_, &BlockPatches::concave, atom_of, [&](std::uint32_t b, std::uint32_t n) {
      const BlockPatches& block = blocks_[b];
      ConcavePatch patch = block.concave[n];
      place_[b][n] = append(std::span<const ConcavePatch>(&patch, 1), whole_.concave);
      ConcavePatch& joined = whole_.concave.back();
      joined.first_plane = planes(block, patch.first_plane, patch.plane_count());
      joined.first_contact =
          append(std::span<const std::uint32_t>(block.contacts).subspan(patch.first_contact, patch.contact_count),
                 whole_.contacts);
    });
    for (BlockPatches& block : blocks_) {
      block.concave = {};
      block.contacts = {};
    }
  }

  void join_toroidal() {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (ToroidalPatch& patch : blocks_[b].toroidal)
        for (std::uint32_t& probe : patch.probe)
          if (probe != kNone) probe = place_[b][probe];
    place_ = {};
    find_outside();
    reserve(&BlockPatches::toroidal, whole_.toroidal);
    const auto atom_of = [](const BlockPatches&, const ToroidalPatch& patch) { return patch.atom[0]; };
    for_each_by_atom(block_of_, blocks_, &BlockPatches::toroidal, atom_of, [&](std::uint32_t b, std::uint32_t n) {
      append(std::span<const ToroidalPatch>(&blocks_[b].toroidal[n], 1), whole_.toroidal);
    });
    for (BlockPatches& block : blocks_) block.toroidal = {};
  }

  // Finds the probes that touch atoms of several blocks, by their centres.
  void find_outside() {
    const auto center = [this](std::uint32_t c) {
      const glm::dvec3& x = whole_.concave[c].center;
      return std::tuple(x.x, x.y, x.z);
    };
    std::vector<std::uint32_t> shared;
    for (std::uint32_t c = 0; c < whole_.concave.size(); ++c) {
      const ConcavePatch& patch = whole_.concave[c];
      const std::uint32_t* const contact = &whole_.contacts[patch.first_contact];
      if (std::any_of(contact, contact + patch.contact_count,
                      [&](std::uint32_t a) { return block_of_[a] != block_of_[*contact]; }))
        shared.push_back(c);
    }
    std::ranges::sort(shared, {}, center);
    for (BlockPatches& block : blocks_)
      for (const OutsideEnd& outside : std::exchange(block.outside, {})) {
        ToroidalPatch& patch = block.toroidal[outside.patch];
        const std::tuple wanted(outside.probe.x, outside.probe.y, outside.probe.z);
        const auto found = std::ranges::lower_bound(shared, wanted, {}, center);
        if (found != shared.end() && center(*found) == wanted)
          patch.probe[static_cast<std::size_t>(outside.end)] = *found;
        else
          open_.push_back(patch.atom[0]);
      }
  }

  std::span<const std::uint32_t> block_of_;
  std::span<BlockPatches> blocks_;
  Surface& whole_;
  std::vector<std::vector<std::uint32_t>> place_;  // place of each block's probes in the whole
  std::vector<std::uint32_t> open_;
};

}  // namespace

BlockPatches take_patches(const Surface& surface, std::span<const std::uint32_t> number, std::span<const char> is_own) {
  return Taking(surface, number, is_own).run();
}

std::vector<std::uint32_t> join_patches(std::span<const std::uint32_t> block_of, std::span<BlockPatches> blocks,
                                        Surface& whole) {
  return Joining(block_of, blocks, whole).run();
}

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

  // Returns the rows of all blocks in the order of their keys, with pieces numbered consecutively.
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

  // Each border is there twice, with a face of one block on its left and of another on its right.
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
  std::vector<std::uint32_t> first_piece_;  // first piece of each block; one past the last closes the list
  mutable UnionFind joined_;
  std::vector<std::uint32_t> component_of_;  // component of each piece that represents others
  std::vector<std::uint32_t> open_;
  SurfaceSums sums_;
};

}  // namespace

Surface sum_blocks(std::span<const Ball> atoms, double probe_radius, std::span<const std::vector<std::uint32_t>> blocks,
                   std::span<const std::uint32_t> block_of, std::span<const BlockPart> parts) {
  return BlockSum(atoms, probe_radius, blocks, block_of, parts).run();
}

}  // namespace meniscus
