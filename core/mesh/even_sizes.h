// SPDX-License-Identifier: BSD-3-Clause
// The wanted edge lengths of an even mesh, its distance from the surface, and the numbers that these depend on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/surface_walk.h"

namespace meniscus {

/// How fine an even mesh is.
struct EvenMeshOptions {
  /// > 0: vertices per Å² of the exact area, to some 10 %, below 0.3 to 25 %, about 12 per component at least; 0: by
  /// tolerance
  double density = 0.0;
  double tolerance = 0.05;  ///< Å; without a density. No point of the mesh is farther from the surface
  /// Of tolerances that depend on the place (Å at a point, smooth): used instead of `tolerance`, which is their
  /// smallest.
  std::function<double(const glm::dvec3&)> tolerance_at;
};

/// The edge length (Å) of so many vertices per Å²; 0 of none.
double edge_of_density(double density);

class EvenSizes {
 public:
  /// Both have to live as long.
  EvenSizes(const Surface& surface, const EvenMeshOptions& options);

  bool by_density() const { return options_.density > 0.0; }
  /// Å; with a density about that of equilateral triangles.
  double tolerance() const;
  /// Å; without a density.
  double tolerance_at(const glm::dvec3& x) const;
  /// The edge length (Å) wanted at a point of the surface.
  double edge_at(const SurfacePoint& point) const;
  /// The same along creases, where spheres of the probe meet, or balls if it has no size.
  double crease_edge_at(const glm::dvec3& x) const { return edge_at(x, probe()); }

 private:
  double probe() const;
  double edge_at(const glm::dvec3& x, double radius) const;

  const Surface& surface_;
  const EvenMeshOptions& options_;
  double smallest_ball_;  ///< Å: of curvature where the probe has no size
  double edge_of_density_;
  std::vector<double> longest_edge_;  ///< Å; per component, with a density: as few vertices as it needs
};

/// The quality of a triangle is 4 sqrt(3) area / sum of squared edges: 1 for an equilateral one, 0 for none.
/// Edges are measured in lengths wanted at their ends.
struct RemeshTuning {
  // --- Which edges passes over the mesh change (remesher.h)
  /// Longer ones are split, shorter ones collapsed: either makes edges nearer to it (Botsch & Kobbelt 2004).
  static constexpr double longest_edge = 4.0 / 3.0, shortest_edge = 4.0 / 5.0;
  /// Edges between triangles as good as that are not flipped: their smallest angles are some 35 degrees.
  static constexpr double fine_quality = 0.82;
  /// Collapses and moves of vertices make no worse triangles than that.
  static constexpr double poor_quality = 0.3;
  /// Scores that differ less are the same, or changes would be made back and forth for ever.
  static constexpr double better = 1e-6;
  /// No collapse of two vertices with more edges together, no flip to one with as many: stars of long triangles.
  static constexpr std::uint32_t most_edges = 24;
  /// While a coarse mesh is refined, a vertex that would come nearer than this share of the edge to one that is there
  /// is no made.
  static constexpr double nearest_new_vertex = 0.2;
  /// A foot farther below the middle of an edge than this share of its length is on another sheet.
  static constexpr double deepest_foot = 0.35;
  /// Passes over a coarse mesh: at most so many, and none after one that changed fewer than one in so many triangles.
  static constexpr int approaches = 12;
  static constexpr std::uint32_t few_changes = 16;
  /// How far a vertex goes towards the middle of its neighbours: all the way vertices would swing about it.
  static constexpr double relaxation = 0.8;
  /// Steps shorter than this change nothing worth the walk.
  static constexpr double shortest_step = 0.01;
  /// Edges that are asked to be shorter than this share of what they were at first would not help either.
  static constexpr float finest_scale = 0.25f;

  // --- How much triangles may lean (mesh_on_surface.h): cosines between their normal and the surface's at a vertex
  /// The least and the most asked for. In between it is 1 - cosine_fall (edge / radius of curvature)²: short edges bend
  /// little.
  static constexpr double least_cosine = 0.05, most_cosine = 0.7, cosine_fall = 1.5;
  /// A vertex is on a crease if it is no farther (Å) from its circle.
  static constexpr double on_crease = 1e-6;

  // --- Single changes where passes left bad triangles (mesh_mender.h)
  /// Triangles are left as they are from that quality on: if isosceles, their smallest angles are 20 degrees or more.
  static constexpr double good_quality = 0.55;
  /// Of worse triangles all changes are tried, and those around them may lean.
  static constexpr double sliver_quality = 0.25;
  static constexpr int mending_rounds = 12;
  /// Of the changes that make triangles better, so many are asked whether they are allowed, the best first.
  static constexpr std::size_t tries = 8;
  /// Vertices of more edges are not made; after a collapse a vertex may have 4 more less those that vanish.
  static constexpr std::uint32_t most_mended_edges = 16;
  /// Edges shorter than that are not made, and those where creases end may vanish; longer ones are not made.
  static constexpr double too_short = 0.2, too_long = 2.0;
  /// Where a vertex may go: steps along the surface in so many directions, and shares of the way to the middle of its
  /// neighbours, on a crease of those along it.
  static constexpr std::array steps{0.03, 0.1, 0.3};
  static constexpr int directions = 6;
  static constexpr std::array shares{1.0, 0.6, 0.3};
  static constexpr std::array crease_shares{1.0, 0.5, 0.25, -0.25};
  /// Triangles within this many of their longest edges may come to lie in the way.
  static constexpr double mending_reach = 2.5;

  // --- Which edges are wanted (even_sizes.h)
  /// Vertices per Å², times edge length squared. Equilateral triangles have 2 / sqrt(3) = 1.155; splitting and
  /// collapsing leave edges a little shorter.
  static constexpr double vertices_per_square = 1.34;
  /// What closes in itself has at least so many vertices, however small it is: of a cavity of four triangles nobody
  /// knows which side is its inner one.
  static constexpr std::uint32_t fewest_vertices = 12;
  /// The share of the tolerance that the middle of an equilateral triangle with the edges wanted may take up: edges up
  /// to 4/3 of that length stay.
  static constexpr double share_of_tolerance = 0.62;

  // --- What begins (even_mesh.cpp)
  /// Edges (Å) from which on the base has the fewest triangles that there are.
  static constexpr double long_edge = 1.1;
  /// Edges (Å) from which on contact faces begin as points: as long as those between such points.
  static constexpr double long_contracted = 2.5;
  /// The base's tolerance, in those of the result: it is remeshed. Where it is kept to, the second.
  static constexpr double coarser_base = 2.0, kept_base = 0.9;
  /// How often all begins again, with an eye on the places where triangles crossed, and from which attempt on these
  /// keep to the base, which is as near as promised then; contact faces that are points are not a base to keep to.
  static constexpr int attempts = 6, first_frozen = 2, contracted_attempts = 2;
  /// The attempt from which on slivers may stay: where creases crowd, mending them takes the mesh away from points that
  /// it reached.
  static constexpr int first_unmended = 4;
  /// How these places grow with each attempt.
  static constexpr double wider = 1.7;

  // --- How long it is worked on (even_mesh.cpp)
  /// Rounds of remeshing; after triangles were made smaller somewhere; and how often that is done.
  static constexpr int rounds = 6, refined_rounds = 3, refinements = 12;
  /// How often triangles are mended and, where that leaves them too far away, made smaller.
  static constexpr int mendings = 5;
  /// Refinements in a row that help nowhere are the last ones.
  static constexpr int idle_refinements = 2;
  /// So few triangles that are too far away are mended one by one.
  static constexpr std::size_t few_far = 100;
  /// Where more than one in so many are, smaller triangles help; mending takes minutes.
  static constexpr std::uint32_t most_mended = 20;
  /// Edges around those that are too far away become shorter by this factor.
  static constexpr double finer = 0.7;
  /// How often triangles that pass through others become smaller, with a density; not if more than one in so many do.
  static constexpr int partings = 12;
  static constexpr std::uint32_t most_parted = 500;
  /// Refinements that make more triangles than these lead nowhere.
  static constexpr std::uint32_t most_growth = 2, growth_allowed = 500;
  /// Where creases of bare balls crowd, folded triangles make more of their kind with each round. With a density, a
  /// round that makes more triangles than that is the last one, and so is a parting that makes more of each; with more
  /// pairs that cross per triangle than that all begins again at once.
  static constexpr double fastest_growth = 1.1;
  static constexpr std::size_t most_growth_each = 50, most_crossings = 2;
  /// With a density, what mending may look at in an attempt, per triangle and at least; bare balls need a tenth of it.
  static constexpr std::uint64_t most_work_each = 20'000, least_work = 20'000'000;

  /// Where fewer than one triangle in so many changed, crossings are searched for at these alone.
  static constexpr std::uint32_t few_unchecked = 4;

  // --- What is measured (mesh_nearness.h)
  /// What is measured at places is less than what is between them.
  static constexpr double margin = 0.97;
  /// Tolerances between places along creases that the mesh has to be near.
  static constexpr double crease_step = 0.4;
  /// Of the tolerance, that of the mesh whose vertices are looked at in the end.
  static constexpr double share_of_fine = 0.3;
  /// Places in a triangle at which its distance is measured: its middle, those of its edges, and nearer to its corners.
  static constexpr std::array<std::array<double, 3>, 7> places{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                                {0.5, 0.5, 0.0},
                                                                {0.0, 0.5, 0.5},
                                                                {0.5, 0.0, 0.5},
                                                                {0.6, 0.2, 0.2},
                                                                {0.2, 0.6, 0.2},
                                                                {0.2, 0.2, 0.6}}};
};

}  // namespace meniscus
