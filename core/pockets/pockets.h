// SPDX-License-Identifier: BSD-3-Clause
// Pockets, tunnels and cavities of a molecule: what a small probe can fill in the solid that a large one rolls over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/usual_probe.h"
#include "core/queries/cavity_tracks.h"
#include "core/queries/distance.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct Surface;

/// Which pockets are looked for. Lengths in Å, volumes in Å³.
struct PocketRequest {
  double probe_radius = kUsualProbe;
  double large_probe_radius = 4.0;  ///< above that of the small one
  double trim = 1.0;                ///< pockets begin so far below the large probe's surface
  double tolerance = 0.1;           ///< how far a mouth may lie outside of where it should be
  double min_volume = 30.0;         ///< smaller ones are left out; a molecule of liquid water has 30 Å³
};

/// What is wrong with it, beginning with the option that it is about; empty if nothing is.
std::string pocket_fault(const PocketRequest& request);

/// One connected part. Volume and areas are exact, in closed form, of a part whose mouths are at most
/// PocketRequest::tolerance too far out.
struct Pocket {
  /// Volume, area, the places of the small probe at rest, and the atoms that line it, of those given.
  Cavity cavity;
  std::vector<double> mouth_areas;  ///< Å², the largest first. None: a cavity; two or more: a tunnel
  double depth = 0.0;  ///< Å, of the deepest place of the small probe at rest below the large one's surface
  Surface surface;     ///< closed; normals point into the pocket
  std::vector<std::uint32_t> atom;  ///< per surface.atoms: of the atoms given; kNone: a large probe

  double mouth_area() const;
  double wall_area() const { return cavity.area - mouth_area(); }
  /// "cavity", "pocket" or "tunnel".
  const char* kind() const;
};

/// The parts, and what they were found with.
struct Pockets {
  PocketRequest request;
  std::vector<Pocket> pockets;  ///< the largest volume first
  double between_volume = 0.0;  ///< Å³, exact: of the large probe's solid, its voids filled, without the small one's
  std::size_t probe_count = 0;  ///< places of the large probe that close the mouths
  /// Of the atoms near the pockets and of balls at places of the large probe: the pockets, however small, are cavities
  /// of it. Without atoms if there are none.
  Surface surface;

  /// Å³ by which the volume of a pocket may be too large, to first order: mouths are at most the tolerance too far out.
  double volume_excess(const Pocket& pocket) const { return pocket.mouth_area() * request.tolerance; }
};

/// Computes a closed surface with listed clip planes: compute_surface_cpu, or on another device.
using ComputeSurface = std::function<Surface(std::span<const Ball> atoms, double probe_radius)>;

/// Let H be the hull of the large probe (hull.h), `trim` taken off all around, and C where the small probe's centre can
/// be so that the probe touches no atom and stays within H. The parts are the connected components of the union of the
/// probes in C: of the solid of the large probe minus that of the small one, what the small probe fills. Films in
/// crevices, where it would reach out of H, are in no part. The two probes are those of Kawabata & Go (Proteins 68,
/// 516, 2007) and of Voss & Gerstein (Nucleic Acids Res. 38, W555, 2010); the trimming is that of Oliveira et al. (BMC
/// Bioinformatics 15, 197, 2014). H is closed by large probes standing where they touch the molecule, as dense as the
/// tolerance asks (hull.h): then the parts are cavities of one solvent-excluded surface, that of the atoms and
/// of those probes, and so have what such cavities have in closed form.
///
/// A mouth counts if it is more than the tolerance can make of none: 2 pi probe_radius tolerance, the cap of a probe
/// that just ends there.
///
/// atoms: Å. Throws RequestError for a request with a fault, what `compute` throws, OpenSurfaceError. Runs on all cores
/// TBB may use; the result does not depend on their number.
Pockets find_pockets(std::span<const Ball> atoms, const PocketRequest& request, const ComputeSurface& compute);

/// The areas of a pocket's mouths, Å², the largest first.
/// pocket: its closed surface; is_probe: one per Surface::atoms, whether it is a large probe. A mouth is a set of large
/// probes whose patches share borders, each patch touching none but large probes; its area is what of the surface is
/// nearer to a contact with them than with an atom (AtomAreas::surface). Left out are mouths in which patches that
/// touch large probes alone have no more than `least` (Å²). Throws OpenSurfaceError.
std::vector<double> mouth_areas(const Surface& pocket, const std::vector<bool>& is_probe, double least);

/// Answers any number of questions about the same pockets, from any number of threads.
class PocketLocator {
 public:
  /// They must stay and not change.
  explicit PocketLocator(const Pockets& pockets);

  /// The place in Pockets::pockets of the one that the point lies in: that has a probe which covers it.
  std::optional<std::size_t> operator()(const glm::dvec3& point) const;

 private:
  double probe_radius_;
  std::optional<SurfaceDistance> anywhere_;  ///< nothing: there are no pockets
  std::vector<SurfaceDistance> each_;
};

}  // namespace meniscus
