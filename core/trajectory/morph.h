// SPDX-License-Identifier: BSD-3-Clause
// A path between structures of a molecule, along which it deforms like an elastic body.
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

/// The atoms that several structures have in common, and their positions in each of them.
struct CommonAtoms {
  std::vector<Atom> atoms;                         ///< atoms of the first structure, in its order, with radii
  std::vector<std::vector<glm::dvec3>> positions;  ///< Å, for each structure, superposed on the first
  std::vector<Superposition> fits;                 ///< superposition of each structure but the first
  std::vector<std::uint32_t> fitted;               ///< places of the atoms by which all are superposed, at least three
};

/// Finds the common atoms of structures by sequence (corresponding_atoms) and superposes the structures. superposed:
/// for each structure and each of its atoms, true if it takes part in the superposition. Throws InputError for a
/// structure that has no chain in common with the first.
CommonAtoms common_atoms(std::span<const Structure> structures, std::span<const std::vector<bool>> superposed);

/// A path through a sequence of structures, the stops. Between two stops the neighbourhood of each atom rotates with
/// it, uniformly about one axis, so that domains move as bodies (as rigid as possible: M. Alexa, D. Cohen-Or & D.
/// Levin, Proc. SIGGRAPH 2000, 157). The neighbourhood is the network of atoms that are near each other at both stops
/// (as in M. K. Kim, R. L. Jernigan & G. S. Chirikjian, Biophys. J. 83, 1620, 2002). Then groups rotate about bonds,
/// and bonds and angles are constrained. Atoms are moved apart if they are nearer than at both stops and nearer than
/// 0.8 times the sum of their radii.
class Morph {
 public:
  explicit Morph(CommonAtoms common);

  const std::vector<Atom>& atoms() const { return common_.atoms; }
  std::size_t stops() const { return common_.positions.size(); }
  const std::vector<glm::dvec3>& at(std::size_t stop) const { return common_.positions[stop]; }
  /// Returns the positions (Å) of `steps` models from a stop to before the next one. The first is the stop itself.
  std::vector<std::vector<glm::dvec3>> models(std::size_t stop, std::size_t steps) const;

  /// Returns the greatest overlap of two atoms of a model, Å: by how much they are nearer than they may be. Returns 0
  /// if none overlap. stop: where the path of the model begins.
  double overlap(std::size_t stop, const std::vector<glm::dvec3>& positions) const;

  /// The bonds whose lengths are constrained.
  std::span<const Bond> bonds() const { return bonds_.bonds(); }

 private:
  std::vector<Bond> near_pairs(std::size_t stop) const;
  std::vector<glm::dvec3> smooth_model(std::size_t stop, double share) const;
  void constrain(std::size_t stop, double share, std::vector<glm::dvec3>& positions) const;
  std::vector<Distance> find_contacts(std::size_t stop, const std::vector<glm::dvec3>& positions) const;

  CommonAtoms common_;
  BondNetwork bonds_;
  std::vector<Bond> bonded_pairs_;  ///< pairs that at most three bonds connect, ascending; these may be near each other
  std::vector<BondNetwork> networks_;    ///< for each path between two stops the network of atoms near each other
  std::vector<BondedPath> body_, path_;  ///< for each path between two stops
};

}  // namespace meniscus
