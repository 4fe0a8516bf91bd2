// SPDX-License-Identifier: BSD-3-Clause
// A path from one structure of a molecule to another, on which it bends like an elastic body.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/rigid_motion.h"
#include "core/structure/structure.h"
#include "core/trajectory/bonded_path.h"

namespace meniscus {

/// The atoms that several structures have in common, and where they are in each.
struct CommonAtoms {
  std::vector<Atom> atoms;                         ///< of the first, in its order; with radii
  std::vector<std::vector<glm::dvec3>> positions;  ///< in each structure, superposed on the first
  std::vector<Superposition> fits;                 ///< of all but the first
  std::vector<std::uint32_t> fitted;               ///< those of the atoms by which all are superposed; at least three
};

/// Atoms correspond by sequence (corresponding_atoms). superposed: those of them that are brought together, per atom of
/// each structure. Throws InputError for a structure that has no chain in common with the first.
CommonAtoms common_atoms(std::span<const Structure> structures, std::span<const std::vector<bool>> superposed);

/// Between two stops everything near an atom turns with it, evenly about one axis, so that domains move as bodies (as
/// rigid as possible: M. Alexa, D. Cohen-Or & D. Levin, Proc. SIGGRAPH 2000, 157), on the network of atoms that are
/// near each other at both ends (as in M. K. Kim, R. L. Jernigan & G. S. Chirikjian, Biophys. J. 83, 1620, 2002). Then
/// groups along bonds turn, bonds and angles are held, and atoms that come too near are moved apart: nearer than at
/// both ends and nearer than 0.8 times the sum of their radii.
class Morph {
 public:
  explicit Morph(CommonAtoms common);

  const std::vector<Atom>& atoms() const { return common_.atoms; }
  std::size_t stops() const { return common_.positions.size(); }
  const std::vector<glm::dvec3>& at(std::size_t stop) const { return common_.positions[stop]; }
  /// The models from a stop to before the next one, `steps` of them; the first is the stop itself.
  std::vector<std::vector<glm::dvec3>> way(std::size_t stop, std::size_t steps) const;

  /// By how much two atoms of a model are nearer than they may be, Å; 0: none are. stop: where its way begins.
  double overlap(std::size_t stop, const std::vector<glm::dvec3>& positions) const;

  /// The bonds that are held.
  std::span<const Bond> bonds() const { return bonds_.bonds(); }

 private:
  std::vector<Bond> near_pairs(std::size_t stop) const;
  std::vector<glm::dvec3> between(std::size_t stop, double share) const;
  void hold(std::size_t stop, double share, std::vector<glm::dvec3>& positions) const;
  std::vector<Distance> too_near(std::size_t stop, const std::vector<glm::dvec3>& positions) const;

  CommonAtoms common_;
  BondNetwork bonds_;
  std::vector<Bond> related_;            ///< along three bonds at most, ascending: these may be near
  std::vector<BondNetwork> networks_;    ///< per way from stop to stop, of atoms near each other
  std::vector<BondedPath> body_, path_;  ///< likewise
};

}  // namespace meniscus
