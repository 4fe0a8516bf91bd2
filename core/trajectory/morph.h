// SPDX-License-Identifier: BSD-3-Clause
// A path between structures of a molecule, along which it deforms like an elastic body, and a path of bonded atoms from
// one frame to the next.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "core/math/rigid_motion.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The bonds between atoms, and the neighbours of each atom.
class BondNetwork {
 public:
  /// Makes the network of the bonds that have both ends in `constrained`. atoms: number of atoms.
  BondNetwork(std::size_t atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> constrained);
  /// Makes a network of any pairs of atoms that are near each other. It has no angles and no corners.
  BondNetwork(std::size_t atoms, std::vector<Bond> pairs);

  std::span<const Bond> bonds() const { return bonds_; }
  /// Returns the two outer atoms of each angle between two bonds.
  std::span<const Bond> angles() const { return angles_; }
  /// An atom and three of its neighbours, whose handedness has to stay.
  using Corner = std::array<std::uint32_t, 4>;
  std::span<const Corner> corners() const { return corners_; }
  std::size_t atoms() const { return begin_.size() - 1; }
  std::span<const std::uint32_t> neighbors(std::uint32_t atom) const {
    return std::span(neighbor_).subspan(begin_[atom], begin_[atom + 1] - begin_[atom]);
  }

 private:
  void list_neighbors(std::size_t atoms);

  std::vector<Bond> bonds_, angles_;
  std::vector<Corner> corners_;
  /// Index: atom; value: its first neighbour in neighbor_; one entry after the last atom closes the list.
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> neighbor_;
};

/// Two atoms and the distance that they should have, Å.
struct Distance {
  std::uint32_t a, b;
  double target;
};

/// The path of atoms between two frames, corrected for rotating groups. On straight lines or curves from frame to
/// frame, atoms of groups that rotate, such as a methyl group, take short cuts. Therefore each atom rotates together
/// with its neighbours, uniformly about one axis (as rigid as possible: M. Alexa, D. Cohen-Or & D. Levin, Proc.
/// SIGGRAPH 2000, 157), and atoms are moved from the curve so that their bonds follow these rotations. Finally bonds
/// and angles are constrained to lengths interpolated between both frames (SHAKE: J.-P. Ryckaert, G. Ciccotti & H. J.
/// C. Berendsen, J. Comput. Phys. 23, 327, 1977).
class BondedPath {
 public:
  /// Begins a path between the positions (Å) of all atoms in two frames. The network must outlive this object.
  BondedPath(const BondNetwork& network, std::vector<glm::dvec3> from, std::vector<glm::dvec3> to);

  /// Corrects the positions on a curve at this share of the way, in (0, 1). Afterwards bonds are within 0.01 Å of their
  /// lengths, unless 300 rounds do not suffice.
  void correct(double share, std::vector<glm::dvec3>& positions) const;

  /// Moves atoms so that the vectors between neighbours change from the vectors in `instead_of` to the vectors in the
  /// rotating groups. move_weight: weight of the squared moves relative to the squared errors of the vectors. rounds:
  /// number of Gauss-Seidel iterations.
  void rotate_groups(double share, const std::vector<glm::dvec3>& instead_of, double move_weight, int rounds,
                     std::vector<glm::dvec3>& positions) const;
  /// Moves atoms until bonds, angles and volumes of corners have their interpolated values, and until the pairs in
  /// `minimum_distances` have at least their distances.
  void constrain_lengths(double share, std::span<const Distance> minimum_distances,
                         std::vector<glm::dvec3>& positions) const;

  /// Returns the positions (Å) of all atoms on straight lines between both frames.
  std::vector<glm::dvec3> interpolate(double share) const;

 private:
  void choose_directions();

  const BondNetwork& network_;
  std::vector<glm::dvec3> from_, to_;
  std::vector<glm::dquat> rotations_;  ///< rotation of each atom with its neighbours
};

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
  /// if none overlap. stop: the stop at which the path of the model begins.
  double overlap(std::size_t stop, const std::vector<glm::dvec3>& positions) const;

  /// Returns the bonds whose lengths are constrained.
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
