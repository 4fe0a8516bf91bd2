// SPDX-License-Identifier: BSD-3-Clause
// Finds pockets, tunnels and cavities of a molecule: spaces that a small probe fills in the solid below a large one.
#pragma once

#include <string>

#include "core/base/constants.h"
#include "core/math/box.h"
#include "core/queries/cavity_tracks.h"
#include "core/queries/distance.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// The pockets that are searched for. Lengths are in Å, volumes in Å³.
struct PocketRequest {
  double probe_radius = kUsualProbe;
  double large_probe_radius = 4.0;  ///< above that of the small probe
  double trim = 1.0;                ///< depth below the large probe's surface at which pockets begin
  double tolerance = 0.1;           ///< greatest distance of a mouth outwards from its ideal place
  double min_volume = 30.0;         ///< smaller pockets are left out; a molecule of liquid water has 30 Å³
};

/// Returns what is wrong with a request, beginning with the option that it is about; empty if nothing is.
std::string pocket_fault(const PocketRequest& request);

/// One connected pocket. Its volume and areas are exact, in closed form, for mouths that lie at most
/// PocketRequest::tolerance too far out.
struct Pocket {
  /// Volume, area, the places of the small probe at rest, and the indices of the given atoms that line the pocket.
  Cavity cavity;
  std::vector<double> mouth_areas;  ///< Å², the largest first. None: a cavity; two or more: a tunnel
  double depth = 0.0;               ///< Å; deepest place of the small probe at rest, below the large probe's surface
  Surface surface;                  ///< closed; normals point into the pocket
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: index of the given atom; kNone: a large probe

  double mouth_area() const;
  double wall_area() const { return cavity.area - mouth_area(); }
  /// Returns "cavity", "pocket" or "tunnel".
  const char* kind() const;
};

/// The pockets, and the request that they were found with.
struct Pockets {
  PocketRequest request;
  std::vector<Pocket> pockets;  ///< the largest volume first
  double between_volume = 0.0;  ///< Å³, exact: the large probe's solid with filled voids, minus the small probe's solid
  std::size_t probe_count = 0;  ///< number of large probes that close the mouths
  /// The surface of the atoms near the pockets and of large probes as balls. The pockets, and smaller ones that were
  /// left out, are cavities of it. It has no atoms if there are no pockets.
  Surface surface;

  /// Returns by how much (Å³) the volume of a pocket may be too large, to first order: mouths are at most the tolerance
  /// too far out.
  double volume_excess(const Pocket& pocket) const { return pocket.mouth_area() * request.tolerance; }
};

/// Computes a closed surface with listed clip planes: compute_surface_cpu(), or the same on another device.
using ComputeSurface = std::function<Surface(std::span<const Ball> atoms, double probe_radius)>;

/// Finds the pockets of a molecule.
///
/// Let H be the Hull of the large probe with `trim` taken off all around, and C the set of places where the small
/// probe's centre can be so that the probe touches no atom and stays within H. The pockets are the connected components
/// of the union of the probes in C: the part of the large probe's solid minus the small probe's that the small probe
/// fills. Thin films in crevices belong to no pocket, because the small probe would extend out of H there. Kawabata &
/// Go (Proteins 68, 516, 2007) and Voss & Gerstein (Nucleic Acids Res. 38, W555, 2010) use the same two probes;
/// Oliveira et al. (BMC Bioinformatics 15, 197, 2014) trim in the same way. H is closed by large probes at places where
/// they touch the molecule, as densely as the tolerance requires (probe_places()). The pockets are then cavities of one
/// solvent-excluded surface, that of the atoms and of these probes, and have all properties of cavities in closed form.
///
/// A mouth counts if it is larger than the tolerance alone can make it: 2 pi probe_radius tolerance, the cap of a probe
/// that just ends there.
///
/// `atoms` are in Å. Throws RequestError for an invalid request, what `compute` throws, and OpenSurfaceError. Runs on
/// all cores that TBB may use; the result does not depend on their number.
Pockets find_pockets(std::span<const Ball> atoms, const PocketRequest& request, const ComputeSurface& compute);

/// Returns the areas (Å²) of a pocket's mouths, the largest first. `pocket` is its closed surface; `is_probe` is true
/// for each of Surface::atoms that is a large probe. A mouth is a set of large probes connected by patches that share
/// borders and touch nothing but large probes. Its area is the part of the surface that is nearer to a contact with
/// these probes than with an atom (AtomAreas::surface). Mouths in which the patches that touch only large probes have
/// at most `least` Å² are left out. Throws OpenSurfaceError.
std::vector<double> mouth_areas(const Surface& pocket, const std::vector<bool>& is_probe, double least);

/// Finds the pocket that a point lies in; any number of threads may call it.
class PocketLocator {
 public:
  /// `pockets` must outlive this object and not change.
  explicit PocketLocator(const Pockets& pockets);

  /// Returns the index into Pockets::pockets of the pocket whose probes cover the point (Å), if any.
  std::optional<std::size_t> operator()(const glm::dvec3& point) const;

 private:
  double probe_radius_;
  std::optional<SurfaceDistance> anywhere_;  ///< nothing if there are no pockets
  std::vector<SurfaceDistance> each_;
};

/// The solid of a solvent-excluded surface with its cavities filled. A larger probe has a larger hull, because a ball
/// is a union of smaller ones. Probes that overlap one outside count as outside, although a door between the two may be
/// too narrow for them.
class Hull {
 public:
  /// `surface` is closed, with at least one atom, a probe radius above 0, and listed clip planes.
  explicit Hull(Surface surface);
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  double volume() const { return volume_; }  ///< Å³, exact
  /// True if some cavities were filled.
  bool has_cavities() const { return part_.has_value(); }
  /// Returns the surface of the hull; its atoms are those that a probe outside of cavities touches.
  const Surface& surface() const { return part_ ? *part_ : whole_; }

  /// Returns the distance (Å) from the point to the nearest place of the centre of a probe that is in no cavity; 0 at
  /// such a place. Points of the hull are those with a distance of at least the probe's radius; the excess is their
  /// depth.
  double to_probe(const glm::dvec3& point) const;

 private:
  Surface whole_;
  SurfaceDistance anywhere_;
  std::optional<Surface> part_;  ///< the surface without cavities, if there are any
  std::optional<SurfaceDistance> outside_;
  double volume_ = 0.0;
};

/// True if places of the probe's centre within `reach` (Å) of a point may be needed.
using NearWanted = std::function<bool(const glm::dvec3& point, double reach)>;

/// The largest distances (Å) between places along an arc, and on the sphere of an atom of a given radius. On a sphere
/// no point is farther from the nearest place than 0.77 of that distance (spiral_direction()).
struct PlaceSteps {
  double on_arcs;
  std::function<double(double atom_radius)> on_sphere;
};

/// Returns every fixed probe, and places along arcs and on faces of the SAS, in the order of the surface's patches.
/// Each of them touches its atoms exactly. Left out are places that are not `wanted`, and all but the first of places
/// closer than kSamePlace. `bounds` encloses all wanted places.
std::vector<glm::dvec3> probe_places(const Surface& surface, const PlaceSteps& steps, const Box& bounds,
                                     const NearWanted& wanted);

inline constexpr double kSamePlace = 1e-3;  ///< Å

/// Cubes that together hold every place where a probe touches no ball and is at least `clearance` from the large
/// probe's centre. Larger cubes are halved down to half an Ångström, unless all of a cube is such a place. This works
/// because both distances change by no more than the length of a step.
class ProbeCells {
 public:
  /// Computes the cells of the small probe. atoms: the atoms of `hull`; probe_radius: radius of the small probe, Å;
  /// clearance: smallest value of Hull::to_probe() at the probe's centre, Å. Runs on all cores that TBB may use; the
  /// cells do not depend on their number.
  ProbeCells(std::span<const Ball> atoms, double probe_radius, const Hull& hull, double clearance);

  std::size_t count() const { return boxes_.size(); }
  /// Returns the box around all cells, extended by `reach` (Å) on each side. There must be a cell.
  Box bounds(double reach) const;
  /// True if some cell is no farther than `reach` (Å) from the point; with 0, if one holds the point.
  bool within(const glm::dvec3& point, double reach) const;

 private:
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace meniscus
