// SPDX-License-Identifier: BSD-3-Clause
// The clip planes that leave exactly a patch of its sphere, and planes that separate the faces of a patch.
#pragma once

#include <mutex>
#include <optional>

#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/convex_planes.h"
#include "core/surface/cusps.h"
#include "core/surface/fixed_probes.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Fills in surface.concave, contacts, cuts and their planes. The planes of a patch are the sides of its spherical
/// polygon, then the bisectors towards every probe that reaches into it. `probes` are all fixed probes of the surface,
/// and `cusps` says which of them cut each other. surface.atoms must be filled in; the tables must be empty.
void list_concave_patches(Surface& surface, const FixedProbes& probes, const CuspParts& cusps);

/// Finds the planes of convex patches: the planes of the contact circles that border the patch, and further ones if
/// these leave more of the sphere than the patch.
class ConvexTrimmer {
 public:
  /// Keeps references: surface and reduced surface must outlive the trimmer. The surface has atoms and convex patches.
  ConvexTrimmer(const Surface& surface, const ReducedSurface& rs);
  ~ConvexTrimmer();

  /// Returns the planes of one convex patch: all, or at least the planes of the circles that border it (PlaneChoice).
  /// Several threads may call this and the next function at once.
  std::vector<Plane> planes_of(std::uint32_t convex, PlaneChoice choice) const;

  /// True if the planes cut off the point of the patch's sphere in this direction (a unit vector) from its centre.
  bool cuts_off(std::uint32_t convex, const glm::dvec3& direction) const;

  /// Appends the planes of all convex patches to `surface`, which must be the surface that the trimmer was made for.
  void list_all(Surface& surface) const;

 private:
  class Search;
  std::unique_ptr<const Search> search_;
};

/// Clip planes found on request, by a trimmer that the first request makes. Several threads may use it at once.
class PlanesOnDemand final : public ConvexPlanes {
 public:
  /// Keeps references: surface and reduced surface must outlive this object.
  PlanesOnDemand(const Surface& surface, const ReducedSurface& rs) : s_(surface), rs_(rs) {}

  std::vector<Plane> of(std::uint32_t convex, PlaneChoice choice) const override {
    return trimmer().planes_of(convex, choice);
  }
  bool cut_off(std::uint32_t convex, const glm::dvec3& direction) const override {
    return trimmer().cuts_off(convex, direction);
  }

 private:
  const ConvexTrimmer& trimmer() const {
    std::call_once(made_, [&] { trimmer_.emplace(s_, rs_); });
    return *trimmer_;
  }

  const Surface& s_;
  const ReducedSurface& rs_;
  mutable std::once_flag made_;
  mutable std::optional<ConvexTrimmer> trimmer_;
};

/// Appends the planes of all convex patches to the surface, by a trimmer that exists for this call only.
void trim_convex_patches(Surface& surface, const ReducedSurface& rs);

/// Some faces of one patch, and planes that have these faces inside and the patch's other faces outside.
struct PartedFaces {
  std::vector<std::uint32_t> faces;
  std::vector<Plane> planes;
};

/// Separates the faces `kept` of a spherical patch from its faces `dropped`, both indices into surface.faces. Returns
/// one entry for all kept faces if planes separate them together, else one entry for each. Throws Error if no plane
/// separates two faces.
std::vector<PartedFaces> part_faces(const Surface& surface, std::span<const std::uint32_t> kept,
                                    std::span<const std::uint32_t> dropped);

/// Returns the plane with the largest margin that has all borders of the faces `inside` strictly inside and all borders
/// of `outside` strictly outside; nothing if their convex hulls meet. The plane then separates the faces as well: faces
/// of one sphere that have no point in common lie on the same sides of it as their borders.
std::optional<Plane> plane_between(const Surface& surface, std::span<const std::uint32_t> inside,
                                   std::span<const std::uint32_t> outside);

}  // namespace meniscus
