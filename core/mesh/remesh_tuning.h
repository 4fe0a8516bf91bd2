// SPDX-License-Identifier: BSD-3-Clause
// The constants of even remeshing: thresholds of quality and length, limits of the effort, and the wanted edge lengths
// and distances from the surface.
#pragma once

#include "core/mesh/surface_walk.h"

namespace meniscus {

/// The constants of remeshing. The quality of a triangle is 4 sqrt(3) area / sum of squared edges: 1 for an equilateral
/// triangle, 0 for a degenerate one. Edges are measured in units of the length wanted at their ends.
struct RemeshTuning {
  // --- Passes over the mesh (mesh_change.h)
  /// Longer edges are split, shorter ones collapsed: either change brings edges nearer to the wanted length (Botsch &
  /// Kobbelt 2004).
  static constexpr double longest_edge = 4.0 / 3.0, shortest_edge = 4.0 / 5.0;
  /// Edges between triangles of at least this quality are not flipped; their smallest angles are some 35 degrees.
  static constexpr double fine_quality = 0.82;
  /// Collapses and moves of vertices make no triangles below this quality, unless one was no better before.
  static constexpr double poor_quality = 0.3;
  /// Scores that differ by less count as equal; otherwise changes would be made back and forth forever.
  static constexpr double score_tolerance = 1e-6;
  /// The largest valence: two vertices with more edges together are not merged, and no flip adds an edge to a vertex
  /// with this many. This prevents stars of long triangles.
  static constexpr std::uint32_t largest_valence = 24;
  /// While a coarse mesh is refined, no vertex is inserted nearer to an existing one than this share of the split edge.
  static constexpr double nearest_new_vertex = 0.2;
  /// A foot that is farther below the midpoint of an edge than this share of its length lies on another sheet.
  static constexpr double deepest_foot = 0.35;
  /// The most passes over a coarse mesh; none follows a pass that changed fewer than one in `few_changes` triangles.
  static constexpr int approach_passes = 12;
  static constexpr std::uint32_t few_changes = 16;
  /// The share of the way to the centroid of its neighbourhood that a vertex moves; with the whole way, vertices would
  /// oscillate about it.
  static constexpr double relaxation = 0.8;
  /// Steps shorter than this share of the wanted edge length are not made: they are not worth the walk.
  static constexpr double shortest_step = 0.01;
  /// Refinement shortens the wanted edges no further than to this share of their first length, because even shorter
  /// edges would not help.
  static constexpr float finest_scale = 0.25f;

  // --- The slope of triangles (mesh_on_surface.h): cosines between their normals and that of the surface at a vertex
  /// The bounds of the smallest cosine that is required. In between it is 1 - cosine_fall (edge / radius of
  /// curvature)²: short edges bend little.
  static constexpr double least_cosine = 0.05, most_cosine = 0.7, cosine_fall = 1.5;
  /// A vertex lies on a crease if it is no farther (Å) from its circle.
  static constexpr double on_crease = 1e-6;

  // --- Local changes where passes left bad triangles (mesh_mender.h)
  /// Triangles of at least this quality are left as they are; isosceles ones have angles of 20 degrees or more.
  static constexpr double good_quality = 0.55;
  /// For triangles below this quality all changes are tried, and the triangles around them may lean.
  static constexpr double sliver_quality = 0.25;
  static constexpr int mending_rounds = 12;
  /// The number of changes that improve triangles that are checked for validity, the best first.
  static constexpr std::size_t checked_candidates = 8;
  /// Vertices of this valence or more are not made. The valences of two vertices to be merged may add up to less than
  /// this plus 4, as a collapse removes 4.
  static constexpr std::uint32_t largest_mended_valence = 16;
  /// The lengths of edges in units of the wanted one: shorter edges are not made and may vanish even where creases end;
  /// longer edges are not made.
  static constexpr double too_short = 0.2, too_long = 2.0;
  /// The places that are tried for a vertex: steps along the surface in several directions, in wanted edge lengths, and
  /// shares of the way to the centroid of its neighbourhood, or on a crease to the midpoint of its neighbours along it.
  static constexpr std::array steps{0.03, 0.1, 0.3};
  static constexpr int directions = 6;
  static constexpr std::array shares{1.0, 0.6, 0.3};
  static constexpr std::array crease_shares{1.0, 0.5, 0.25, -0.25};
  /// The radius around a triangle, in units of its longest edge, within which mending checks for crossings.
  static constexpr double mending_radius = 2.5;

  // --- Wanted edges (EvenSizes)
  /// The number of vertices per Å² times the squared edge length. It is 2 / sqrt(3) = 1.155 for equilateral triangles;
  /// splitting and collapsing leave edges a little shorter.
  static constexpr double vertices_per_square = 1.34;
  /// The fewest vertices of a component, however small it is: the inside of four triangles cannot be recognised.
  static constexpr std::uint32_t fewest_vertices = 12;
  /// The share of the tolerance that the middle of an equilateral triangle with the wanted edges may use up, since
  /// edges of up to 4/3 of that length remain.
  static constexpr double share_of_tolerance = 0.62;

  // --- Base meshes (even_mesh.cpp)
  /// The edge length (Å) from which on remeshing starts from the coarsest mesh.
  static constexpr double long_edge = 1.1;
  /// The edge length (Å) from which on contact faces start as points; edges between such points are about this long.
  static constexpr double long_contracted = 2.5;
  /// The tolerance of the base in units of the result's: `coarser_base` if the base is remeshed, `kept_base` where its
  /// triangles are kept.
  static constexpr double coarser_base = 2.0, kept_base = 0.9;
  /// The most attempts, and the attempt from which on the places where triangles crossed keep the base, which then is
  /// within the tolerance. A base of contracted contact faces is not kept and gets fewer attempts.
  static constexpr int most_attempts = 6, first_frozen = 2, contracted_attempts = 2;
  /// The attempt from which on slivers may remain: where creases crowd, mending them takes the mesh away from points
  /// that it had reached.
  static constexpr int first_unmended = 4;
  /// The factor by which the radii of such places grow with each attempt.
  static constexpr double place_growth = 1.7;

  // --- Limits of the effort (even_mesh.cpp)
  /// The rounds of remeshing, the rounds after each refinement, and the most refinements.
  static constexpr int rounds = 6, refined_rounds = 3, refinements = 12;
  /// The most times that triangles are mended and, where that leaves them too far away, refined.
  static constexpr int mendings = 5;
  /// The number of refinements in a row without progress that ends refining.
  static constexpr int futile_refinements = 2;
  /// Up to this many triangles that are too far away are mended one by one.
  static constexpr std::size_t few_far = 100;
  /// If more than one triangle in this many is too far away, refinement helps, while mending would take minutes.
  static constexpr std::uint32_t most_mended = 20;
  /// The factor by which edges around triangles that are too far away become shorter.
  static constexpr double refinement_factor = 0.7;
  /// With a density: the most refinements of triangles that pass through others. There are none if more than one
  /// triangle in `triangles_per_crossing` does.
  static constexpr int crossing_refinements = 12;
  static constexpr std::uint32_t triangles_per_crossing = 500;
  /// Refining ends when there are more triangles than `most_growth` times the first number plus `growth_allowed`.
  static constexpr std::uint32_t most_growth = 2, growth_allowed = 500;
  /// Where creases of bare balls crowd, folded triangles multiply with each round. With a density, a round that
  /// multiplies the triangles by more than `fastest_growth` is the last one, as is a refinement of crossing triangles
  /// that adds more than `most_growth_each` for each of them. With more than `most_crossings` crossing pairs per
  /// triangle the attempt ends at once.
  static constexpr double fastest_growth = 1.1;
  static constexpr std::size_t most_growth_each = 50, most_crossings = 2;
  /// With a density: the number of triangles that mending may inspect in an attempt, per triangle of the mesh and in
  /// addition. Bare balls need a tenth of it.
  static constexpr std::uint64_t most_work_each = 20'000, least_work = 20'000'000;

  /// If fewer than one triangle in this many changed, crossings are searched for at the changed ones only.
  static constexpr std::uint32_t few_unchecked = 4;

  // --- Distances (mesh_nearness.h)
  /// The factor of the tolerance at measured places, since distances between them are larger.
  static constexpr double margin = 0.97;
  /// The distance, in tolerances, between places along creases that the mesh has to be near.
  static constexpr double crease_step = 0.4;
  /// The share of the tolerance that the fine mesh is made with, whose vertices are checked in the end.
  static constexpr double fine_tolerance_share = 0.3;
  /// The places in a triangle at which its distance is measured, in barycentric coordinates: its centroid, the
  /// midpoints of its edges, and three places nearer to its corners.
  static constexpr std::array<std::array<double, 3>, 7> sample_weights{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                                        {0.5, 0.5, 0.0},
                                                                        {0.0, 0.5, 0.5},
                                                                        {0.5, 0.0, 0.5},
                                                                        {0.6, 0.2, 0.2},
                                                                        {0.2, 0.6, 0.2},
                                                                        {0.2, 0.2, 0.6}}};
};

/// The fineness of an even mesh.
struct EvenMeshOptions {
  /// Above 0: vertices per Å² of the exact area. The result has this density to within some 10 %, below 0.3 to within
  /// 25 %, and at least about 12 vertices per component. 0: the tolerance decides.
  double density = 0.0;
  double tolerance = 0.05;  ///< Å, used without a density: no point of the mesh is farther from the surface
  /// The tolerance (Å) at a point, a smooth function. If set, it replaces `tolerance`, its smallest value.
  std::function<double(const glm::dvec3&)> tolerance_at;
};

/// Returns the edge length (Å) of a mesh with this many vertices per Å²; 0 for a density of 0.
double edge_of_density(double density);

/// The edge lengths and distances that an even mesh should have at each place of a surface.
class EvenSizes {
 public:
  /// Both arguments must outlive this object.
  EvenSizes(const Surface& surface, const EvenMeshOptions& options);

  bool by_density() const { return options_.density > 0.0; }
  /// Returns the tolerance (Å); with a density, about the distance of equilateral triangles from the surface.
  double tolerance() const;
  /// Returns the tolerance (Å) at a point; only for options without a density.
  double tolerance_at(const glm::dvec3& x) const;
  /// Returns the edge length (Å) wanted at a point of the surface.
  double edge_at(const SurfacePoint& point) const;
  /// Returns the edge length (Å) wanted along creases, where spheres of the probe meet, or balls without a probe.
  double crease_edge_at(const glm::dvec3& x) const { return edge_at(x, probe()); }

 private:
  double probe() const;
  double edge_at(const glm::dvec3& x, double radius) const;

  const Surface& surface_;
  const EvenMeshOptions& options_;
  double smallest_ball_;  ///< smallest radius (Å) of a ball: the radius of curvature if the probe radius is 0
  double edge_of_density_;
  /// Per component, with a density: an edge length (Å) short enough for the fewest vertices that a component needs.
  std::vector<double> longest_edge_;
};

}  // namespace meniscus
