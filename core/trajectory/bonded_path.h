// SPDX-License-Identifier: BSD-3-Clause
// A path of bonded atoms from one frame to the next, along which groups rotate and bonds keep their lengths.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

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
  /// The two outer atoms of each angle between two bonds.
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

}  // namespace meniscus
