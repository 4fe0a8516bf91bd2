// SPDX-License-Identifier: BSD-3-Clause
// Writes the tree of a level set: a root, nodes of 32 x 32 x 32 nodes, nodes of 16 x 16 x 16 blocks, blocks of voxels.
#include "exporters/vdb/vdb_file.h"

#include <bitset>
#include <limits>
#include <map>

#include <glm/common.hpp>

#include "core/base/version.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

using Block = DistanceBand::Block;

constexpr std::int64_t kMagic = 0x56444220;
constexpr std::uint32_t kFileVersion = 224, kLibraryMajor = 10, kLibraryMinor = 0;
constexpr std::uint32_t kActiveMask = 2;      // compression that stores the values of active voxels only
constexpr std::int8_t kSelectBackground = 3;  // a mask selects the background or its negative for inactive voxels
constexpr std::string_view kIdentity = "00000000-0000-0000-0000-000000000000", kGrid = "surface";
constexpr int kBlockBits = 3, kLowerBits = 4, kUpperBits = 5;  // log2 of the edges of blocks and nodes, in children
constexpr int kLowerEdge = 1 << (kBlockBits + kLowerBits), kUpperEdge = kLowerEdge << kUpperBits;  // voxels

template <std::size_t N>
void put_mask(BinaryRows& rows, const std::bitset<N>& mask) {
  for (std::size_t word = 0; word < N; word += 64) {
    std::uint64_t bits = 0;
    for (std::size_t n = 0; n < 64; ++n) bits |= std::uint64_t{mask[word + n]} << n;
    rows.put(bits);
  }
}

void put_name(BinaryRows& rows, std::string_view text) {
  rows.put(static_cast<std::uint32_t>(text.size()));
  rows.put_text(text);
}

/// A node of 2^bits children along each axis. A place without a child is a tile, which has the negative background if
/// it is in `inside`, and the background otherwise.
template <int bits, class Child>
struct Node {
  static constexpr std::size_t kCount = std::size_t{1} << (3 * bits);
  std::map<std::uint32_t, Child> children;
  std::bitset<kCount> inside;

  void put_values(BinaryRows& rows) const {
    std::bitset<kCount> has_child;
    for (const auto& [place, child] : children) has_child.set(place);
    put_mask(rows, has_child);
    put_mask(rows, std::bitset<kCount>());
    rows.put(kSelectBackground);
    put_mask(rows, ~inside);
  }
};
using Lower = Node<kLowerBits, const Block*>;
using Upper = Node<kUpperBits, Lower>;

/// Returns the place of a voxel's child in a node of 2^bits children per axis. edge: a child's edge in voxels.
std::uint32_t place_in_node(const glm::ivec3& voxel, int edge, int bits) {
  std::uint32_t place = 0;
  for (int k = 0; k < 3; ++k)
    place = place << bits |
            ((static_cast<std::uint32_t>(voxel[k]) / static_cast<std::uint32_t>(edge)) & ((1U << bits) - 1U));
  return place;
}

/// The tree of a level set. It refers to the band, which must outlive it.
class Tree {
 public:
  explicit Tree(const DistanceBand& band) : band_(band) {
    for (const Block& block : band.blocks)
      lower(block.origin).children.emplace(place_in_node(block.origin, DistanceBand::kEdge, kLowerBits), &block);
    for (const DistanceBand::Inside& cube : band.inside) fill(cube);
  }

  /// Writes the structure of the tree: children of all levels in the order of their places, which OpenVDB expects.
  void put_topology(BinaryRows& rows, float background) const {
    rows.put(std::int32_t{1});  // number of buffers per block
    rows.put(background);
    rows.put(std::uint32_t{0});  // number of tiles of the root
    rows.put(static_cast<std::uint32_t>(uppers_.size()));
    for (const auto& [origin, upper] : uppers_) {
      rows.put(origin);
      upper.put_values(rows);
      for (const auto& [place, lower] : upper.children) {
        lower.put_values(rows);
        for (const auto& [at, block] : lower.children) put_mask(rows, active(*block));
      }
    }
  }

  template <class Visit>
  void each_block(const Visit& visit) const {
    for (const auto& [origin, upper] : uppers_)
      for (const auto& [place, lower] : upper.children)
        for (const auto& [at, block] : lower.children) visit(*block);
  }

  /// Returns the mask of the voxels of a block that are within the band.
  std::bitset<512> active(const Block& block) const {
    std::bitset<512> mask;
    for (std::size_t n = 0; n < mask.size(); ++n) mask[n] = std::abs(block.distances[n]) < band_.reach;
    return mask;
  }

 private:
  Upper& upper(const glm::ivec3& voxel) {
    std::array<std::int32_t, 3> origin{};
    for (int k = 0; k < 3; ++k) origin[k] = voxel[k] & ~(kUpperEdge - 1);
    return uppers_[origin];
  }
  Lower& lower(const glm::ivec3& voxel) { return upper(voxel).children[place_in_node(voxel, kLowerEdge, kUpperBits)]; }

  /// Marks a cube inside the surface as tiles of the smallest nodes whose children it fills.
  void fill(const DistanceBand::Inside& cube) {
    const int edge = cube.size >= kLowerEdge ? kLowerEdge : DistanceBand::kEdge;
    for (int x = 0; x < cube.size; x += edge)
      for (int y = 0; y < cube.size; y += edge)
        for (int z = 0; z < cube.size; z += edge) {
          const glm::ivec3 at = cube.origin + glm::ivec3(x, y, z);
          if (edge == kLowerEdge)
            upper(at).inside.set(place_in_node(at, edge, kUpperBits));
          else
            lower(at).inside.set(place_in_node(at, edge, kLowerBits));
        }
  }

  const DistanceBand& band_;
  std::map<std::array<std::int32_t, 3>, Upper> uppers_;
};

/// The metadata of a file or a grid: names, types and values.
class MetaData {
 public:
  void add(std::string_view name, std::string_view text) { add(name, "string", std::span<const char>(text)); }
  template <class T>
  void add(std::string_view name, std::string_view type, std::span<const T> values) {
    ++count_;
    put_name(rows_, name);
    put_name(rows_, type);
    rows_.put(static_cast<std::uint32_t>(values.size_bytes()));
    rows_.put_all(values);
  }
  void put_into(BinaryRows& rows) const {
    rows.put(count_);
    rows.put_all(rows_.bytes());
  }

 private:
  std::uint32_t count_ = 0;
  BinaryRows rows_;
};

MetaData grid_data(const Tree& tree, const std::string& about) {
  std::int64_t count = 0;
  glm::ivec3 low(std::numeric_limits<int>::max()), high(std::numeric_limits<int>::min());
  tree.each_block([&](const Block& block) {
    const std::bitset<512> active = tree.active(block);
    count += static_cast<std::int64_t>(active.count());
    for (int n = 0; n < 512; ++n) {
      if (!active[n]) continue;
      const glm::ivec3 at = block.origin + glm::ivec3(n >> 6, n >> 3 & 7, n & 7);
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
  });
  MetaData data;
  data.add("name", kGrid);
  data.add("class", "level set");
  data.add("description", about);
  data.add("file_voxel_count", "int64", std::span<const std::int64_t>(&count, 1));
  data.add("file_bbox_min", "vec3i", std::span<const glm::ivec3>(&low, 1));
  data.add("file_bbox_max", "vec3i", std::span<const glm::ivec3>(&high, 1));
  return data;
}

void put_transform(BinaryRows& rows, double voxel) {
  put_name(rows, "UniformScaleMap");
  for (const double value : {voxel, voxel, 1.0 / voxel, 1.0 / (voxel * voxel), 0.5 / voxel})
    rows.put(std::array<double, 3>{value, value, value});
}

}  // namespace

void write_vdb(OutputFile& file, const DistanceBand& band, const VdbFile& about) {
  const Tree tree(band);
  const auto scale = static_cast<float>(about.scale);
  BinaryRows head, grid;
  head.put(kMagic);
  for (const std::uint32_t word : {kFileVersion, kLibraryMajor, kLibraryMinor}) head.put(word);
  head.put(std::int8_t{1});  // the offsets of grids follow
  head.put_text(kIdentity);
  MetaData data;
  data.add("creator", "Meniscus " MENISCUS_VERSION);
  data.put_into(head);
  head.put(std::int32_t{1});  // number of grids
  put_name(head, kGrid);
  put_name(head, "Tree_float_5_4_3");
  put_name(head, "");  // name of a grid with the same tree; there is none

  grid.put(kActiveMask);
  grid_data(tree, about.about).put_into(grid);
  put_transform(grid, band.voxel * about.scale);
  tree.put_topology(grid, scale * band.reach);

  std::uint64_t values = 0;
  tree.each_block([&](const Block& block) { values += 129 + sizeof(float) * tree.active(block).count(); });
  const std::uint64_t grid_at = head.size() + 3 * sizeof(std::uint64_t), values_at = grid_at + grid.size();
  for (const std::uint64_t place : {grid_at, values_at, values_at + values}) head.put(place);
  file.write(head.bytes());
  file.write(grid.bytes());

  tree.each_block([&](const Block& block) {
    const std::bitset<512> active = tree.active(block);
    std::bitset<512> outside;
    for (std::size_t n = 0; n < outside.size(); ++n) outside[n] = block.distances[n] > 0.0F;
    BinaryRows rows;
    put_mask(rows, active);
    rows.put(kSelectBackground);
    put_mask(rows, outside);
    for (std::size_t n = 0; n < active.size(); ++n)
      if (active[n]) rows.put(scale * block.distances[n]);
    file.write(rows.bytes());
  });
}

}  // namespace meniscus
