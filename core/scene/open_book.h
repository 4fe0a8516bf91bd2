// SPDX-License-Identifier: BSD-3-Clause
// The interface of two groups of atoms, opened like a book: both sides face the viewer, next to each other.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

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

/// Of each atom of the structure, how much less of its sphere the centre of the probe can reach in the presence of all
/// than in that of its own group, Å²: the solvent-accessible area that is buried (B. Lee and F. M. Richards, J. Mol.
/// Biol. 55, 379 (1971)); the area of the surface itself where that is not one of a probe. Groups: every atom in one of
/// them. Throws what surface_objects throws.
std::vector<double> buried_areas(const Structure& structure, std::span<const AtomGroup> groups,
                                 SurfaceComputer& computer, SurfaceKind kind);

/// The two groups; atoms in neither are in none. Throws InputError for a group without atoms or an atom in both.
std::vector<AtomGroup> interface_groups(const Structure& structure, const InterfaceRequest& interface);

/// Where the two groups go: each is turned about one point and moved to its side.
struct OpenPages {
  glm::dvec3 middle{0.0};  ///< Å
  std::array<glm::dmat3, 2> turn{glm::dmat3(1.0), glm::dmat3(1.0)};
  std::array<double, 2> step{};  ///< Å along x, behind the turn
};

/// Seen against +z the buried atoms of either group face the viewer, the plane that fits them best is the page, its
/// longest axis upright; the left group is at the left, with a gap. buried: of each atom. Throws InputError where
/// nothing is buried.
OpenPages open_pages(const Structure& structure, std::span<const AtomGroup> groups, std::span<const double> buried);

/// Moves both groups there.
void open_book(Structure& structure, std::span<const AtomGroup> groups, const OpenPages& pages);

}  // namespace meniscus
