// SPDX-License-Identifier: BSD-3-Clause
// The interface of two groups of atoms, opened like a book: both sides face the viewer, next to each other.
#pragma once

#include "core/scene/surface_computer.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Two groups of atoms, the left page and the right one.
struct InterfaceRequest {
  Selection left, right;
};

/// Reads "A:B" or "A,C:B" (chains), or "EXPR:EXPR". Throws RequestError, SelectionError.
InterfaceRequest parse_interface(std::string_view text);

/// Returns, per atom of the structure, by how much the other groups reduce the area of its sphere that the centre of
/// the probe can reach, Å². This is the solvent-accessible area that is buried (B. Lee and F. M. Richards, J. Mol.
/// Biol. 55, 379 (1971)); for a surface without a probe, the area of the surface itself. groups: must have every atom
/// once. Throws OpenSurfaceError, CapacityError or GpuError if a surface cannot be computed, and Error if no part of it
/// is left.
std::vector<double> buried_areas(const Structure& structure, std::span<const AtomGroup> groups,
                                 SurfaceComputer& computer, SurfaceKind kind);

/// Returns the two groups; atoms that neither side selects are left out. Throws InputError for a group without atoms or
/// an atom in both.
std::vector<AtomGroup> interface_groups(const Structure& structure, const InterfaceRequest& interface);

/// The motions of the two groups: each is turned about one point and then moved to its side.
struct OpenPages {
  glm::dvec3 middle{0.0};  ///< the point of both turns, Å
  std::array<glm::dmat3, 2> turn{glm::dmat3(1.0), glm::dmat3(1.0)};
  std::array<double, 2> step{};  ///< Å along x, applied after the turn
};

/// Returns the motions after which the buried atoms of both groups, seen against +z, face the viewer. The page is the
/// plane that fits them best, with its longest axis upright; the left group is on the left, with a gap between. buried:
/// per atom. Throws InputError if nothing is buried.
OpenPages open_pages(const Structure& structure, std::span<const AtomGroup> groups, std::span<const double> buried);

/// Applies the motions to both groups.
void open_book(Structure& structure, std::span<const AtomGroup> groups, const OpenPages& pages);

}  // namespace meniscus
