// SPDX-License-Identifier: BSD-3-Clause
// Half-edges: every change leaves a closed mesh of the same topology, and bad changes are seen before.
#include "core/mesh/half_edges.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace meniscus::testing {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

const std::vector<Triangle>& tetrahedron() {
  static const std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return triangles;
}
/// Returns an octahedron with tips 0 and 5.
const std::vector<Triangle>& octahedron() {
  static const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1},
                                               {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
  return triangles;
}

void expect_linked(const HalfEdges& links) {
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (!links.is_alive(half)) continue;
    const std::uint32_t twin = links.twin(half);
    EXPECT_EQ(links.twin(twin), half);
    EXPECT_EQ(links.from(twin), links.to(half));
    EXPECT_EQ(links.to(twin), links.from(half));
    EXPECT_EQ(links.crease(twin), links.crease(half));
    EXPECT_NE(links.between(links.from(half), links.to(half)), kNone);
  }
}

TEST(HalfEdges, AreClosedWithANewVertexInATriangle) {
  HalfEdges links(tetrahedron(), 4);
  links.set_crease(4, 6);
  EXPECT_EQ(links.poke(1), 4u);
  EXPECT_EQ(links.triangle_count(), 6u);
  EXPECT_EQ(links.valence(4), 3u);
  for (const std::uint32_t v : {0u, 1u, 3u}) EXPECT_EQ(links.valence(v), 4u);
  expect_linked(links);
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    const bool creased = std::minmax(links.from(half), links.to(half)) == std::minmax(1u, 3u);
    EXPECT_EQ(links.crease(half), creased ? 6u : kNone);
  }
}

TEST(HalfEdges, UnpokeTakesAPokeBack) {
  HalfEdges links(octahedron(), 6);
  links.set_crease(links.between(2, 3), 6);
  const std::uint32_t m = links.poke(links.between(2, 3) / 3);
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (links.opposite(half) != m) continue;
    HalfEdges copy = links;
    const Triangle old = copy.corners(half / 3);
    copy.unpoke(half);
    EXPECT_FALSE(copy.is_vertex_alive(m));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(old[k] == m || copy.corners(half / 3)[k] == old[k]) << k;
    expect_linked(copy);
    copy.compact();
    EXPECT_EQ(copy.triangle_count(), 8u);
    for (std::uint32_t v = 0; v < 6; ++v) EXPECT_EQ(copy.valence(v), 4u);
    EXPECT_EQ(copy.crease(copy.between(3, 2)), 6u);
  }
}

TEST(HalfEdges, NoEdgeOfATetrahedronMayVanishOrFlip) {
  const HalfEdges links(tetrahedron(), 4);
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    EXPECT_FALSE(links.can_collapse(half));
    EXPECT_FALSE(links.can_flip(half));
  }
}

TEST(HalfEdges, CollapseLeavesAClosedMesh) {
  HalfEdges links(octahedron(), 6);
  const std::uint32_t half = links.between(0, 1);
  ASSERT_TRUE(links.can_collapse(half));
  EXPECT_EQ(common_neighbors(links, 0, 1).common, 2u);
  EXPECT_EQ(common_neighbors(links, 0, 1).sum, 8u);
  links.collapse(half);
  EXPECT_FALSE(links.is_vertex_alive(0));
  expect_linked(links);
  EXPECT_EQ(links.compact(), (std::vector<std::uint32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(links.triangle_count(), 6u);
  expect_linked(links);
}

// Without an edge round the waist of a double pyramid with three sides, the mesh would be pinched there.
TEST(HalfEdges, AThirdCommonNeighbourKeepsAnEdge) {
  const HalfEdges links(std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {4, 2, 1}, {4, 3, 2}, {4, 1, 3}}, 5);
  EXPECT_FALSE(links.can_collapse(links.between(1, 2)));
  EXPECT_TRUE(links.can_collapse(links.between(0, 1)));
}

TEST(HalfEdges, FlipLeavesAClosedMesh) {
  HalfEdges links(octahedron(), 6);
  const std::uint32_t half = links.between(1, 2);
  ASSERT_TRUE(links.can_flip(half));
  links.flip(half);
  expect_linked(links);
  EXPECT_NE(links.between(0, 5), kNone);
  EXPECT_EQ(links.between(1, 2), kNone);
  EXPECT_EQ(links.valence(0), 5u);
  EXPECT_EQ(links.valence(1), 3u);
}

TEST(HalfEdges, PutFirstTurnsATriangle) {
  for (const std::uint32_t k : {0u, 1u, 2u}) {
    HalfEdges links(octahedron(), 6);
    links.set_crease(3 + k, 9);
    const Triangle old = links.corners(1);
    links.put_first(3 + k);
    EXPECT_EQ(links.corners(1), (Triangle{old[k], old[(k + 1) % 3], old[(k + 2) % 3]}));
    EXPECT_EQ(links.crease(3), 9u);
    expect_linked(links);
    for (std::uint32_t v = 0; v < 6; ++v) EXPECT_EQ(links.valence(v), 4u);
  }
}

TEST(HalfEdges, RefuseWhatIsNotClosed) {
  EXPECT_THROW(HalfEdges(std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}, 4), OpenSurfaceError);
  std::vector<Triangle> two = tetrahedron();  // Two tetrahedra have an edge in common.
  two.insert(two.end(), {{0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {4, 0, 5}});
  EXPECT_THROW(HalfEdges(two, 6), OpenSurfaceError);
}

TEST(HalfEdges, OfAPartAreLinkedAroundWholeVertices) {
  std::vector<Triangle> part(octahedron().begin(), octahedron().begin() + 4);  // The part lies around vertex 0.
  const HalfEdges links = HalfEdges::of_part(part, CornerLists(part, 6));
  EXPECT_EQ(links.valence(0), 4u);
  EXPECT_EQ(links.twin(1), kNone);  // from 1 to 2
  EXPECT_EQ(links.between(0, 3), 6u);
}

}  // namespace
}  // namespace meniscus::testing
