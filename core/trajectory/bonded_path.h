// SPDX-License-Identifier: BSD-3-Clause
// The way of bonded atoms from one frame to the next, on which groups turn and bonds keep their lengths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "core/structure/structure.h"

namespace meniscus {

/// Which atoms are bonded to which, and which are neighbours of the same one.
class BondNetwork {
 public:
  /// atoms: how many there are. Bonds with both ends in `held` count.
  BondNetwork(std::size_t atoms, std::span<const Bond> bonds, std::span<const std::uint32_t> held);

  std::span<const Bond> bonds() const { return bonds_; }
  /// Of each angle between two bonds both outer atoms.
  std::span<const Bond> angles() const { return angles_; }
  std::size_t atoms() const { return begin_.size() - 1; }
  std::span<const std::uint32_t> neighbors(std::uint32_t atom) const {
    return std::span(neighbor_).subspan(begin_[atom], begin_[atom + 1] - begin_[atom]);
  }

 private:
  std::vector<Bond> bonds_, angles_;
  std::vector<std::size_t> begin_;  ///< per atom, of its neighbours, and the end
  std::vector<std::uint32_t> neighbor_;
};

/// On straight lines or curves from frame to frame atoms that turn, such as those of a methyl group, take short cuts.
/// Here each atom turns together with its neighbours, evenly about one axis (as rigid as possible: M. Alexa, D.
/// Cohen-Or & D. Levin, Proc. SIGGRAPH 2000, 157), and atoms are moved from the curve so that their bonds are as these
/// turns want them. At last bonds and angles are held to what lies between their lengths at both ends (SHAKE: J.-P.
/// Ryckaert, G. Ciccotti & H. J. C. Berendsen, J. Comput. Phys. 23, 327, 1977).
class BondedPath {
 public:
  /// Positions of all atoms in both frames, Å. The network must stay.
  BondedPath(const BondNetwork& network, std::vector<glm::dvec3> from, std::vector<glm::dvec3> to);

  /// Corrects positions on a curve, at this share of the way in (0, 1). Afterwards bonds are within 0.01 Å of their
  /// lengths wherever 300 rounds suffice.
  void correct(double share, std::vector<glm::dvec3>& positions) const;

 private:
  void turn_groups(double share, std::vector<glm::dvec3>& positions) const;
  void hold_lengths(double share, std::vector<glm::dvec3>& positions) const;

  const BondNetwork& network_;
  std::vector<glm::dvec3> from_, to_;
  std::vector<glm::dquat> turns_;  ///< per atom, of it and its neighbours
};

}  // namespace meniscus
