// SPDX-License-Identifier: BSD-3-Clause
// Triangles of one face, bounded by the samples of its borders.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/mesh/border_samples.h"
#include "core/mesh/face_domain.h"
#include "core/mesh/sphere_lattice.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// A piece of border between two samples, or of a seam (border kNone) that opens a ring-shaped face.
struct Segment {
  std::uint32_t border = kNone;
  std::uint32_t index = 0;
};

/// What has to be triangulated: the rim and points that may be used inside it.
struct FaceOutline {
  std::unique_ptr<FaceDomain> domain;
  std::vector<FacePoint> points;          ///< of the rim
  std::vector<BorderPoint> names;         ///< of the rim points; on a seam border kSeam, both sides alike
  std::vector<std::array<int, 2>> edges;  ///< directed, the face on their left
  std::vector<Segment> segments;          ///< what each edge is part of
  std::vector<FacePoint> interior;
  std::size_t loop_count = 0;
};
inline constexpr std::uint32_t kSeam = kNone - 1;

/// Triangles over rim points (first) and interior points (after them).
struct FaceMesh {
  std::unique_ptr<FaceDomain> domain;
  std::vector<BorderPoint> rim;
  std::vector<std::array<int, 2>> rim_edges;
  std::vector<FacePoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> atom;                    ///< per triangle
  std::vector<std::array<std::uint32_t, 2>> bridges;  ///< inner edges between two rim points
  std::vector<Segment> too_coarse;                    ///< not empty: no triangles; split these segments and try again
};

/// The outline of a sphere face with at least one loop. The lattice gives the inner points, `edge` Å apart.
FaceOutline sphere_outline(const Surface& surface, const Face& face, const BorderSamples& samples,
                           const SphereLattice& lattice, double edge);

/// The outline of any piece of a torus. `piece`: which half of a spindle.
FaceOutline torus_outline(const Surface& surface, const Face& face, const BorderSamples& samples, const EdgeRule& rule);

/// Triangulates an outline within the tolerance (Å).
FaceMesh fill_outline(FaceOutline outline, double tolerance);

/// Last resort for rims that meet themselves within rounding: a fan about the middle. One loop only.
FaceMesh fan_outline(FaceOutline outline);

/// A whole sphere.
FaceMesh whole_sphere(const Surface& surface, const Face& face, const SphereLattice& lattice);

/// Splits inner edges until no two of them, nor one and the rim, join the same two named points: the two sides of a
/// seam are one line of vertices in the end.
void part_doubled_edges(FaceMesh& mesh);

/// Splits an inner edge in two, if the mesh still has it; the new vertex lies on the exact surface.
void split_edge(FaceMesh& mesh, std::uint32_t a, std::uint32_t b);

/// Gives each triangle its atom; with `split`, first cuts triangles along the lines where the nearest contact changes.
void color_face(const Surface& surface, const Face& face, FaceMesh& mesh, bool split);

}  // namespace meniscus
