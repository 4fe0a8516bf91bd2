// SPDX-License-Identifier: BSD-3-Clause
// Follows cavities from one surface to the next: which cavity is which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// A void that the probe cannot get out of.
struct Cavity {
  double area = 0.0;                 ///< Å²
  double volume = 0.0;               ///< Å³, positive
  std::vector<std::uint32_t> atoms;  ///< Surface::atoms that line it, which a probe in it can touch; ascending
  std::vector<glm::dvec3> probes;    ///< Å, centres of the probes at rest in it: each touches three atoms or more

  /// The mean of the probes at rest.
  glm::dvec3 middle() const;
};

/// The cavities of a solvent-excluded surface, the largest area first, as Surface::components has them. Each has four
/// probes at rest or more: a bounded region outside of balls has no other extreme points. Some of them may be missing
/// here, those of whose patch others leave nothing.
std::vector<Cavity> cavities_of(const Surface& surface);

enum class CavityEvent {
  born,    ///< no cavity before was where it is
  kept,    ///< it was there before
  split,   ///< it is a part of one that goes on elsewhere, too: of `other`
  merged,  ///< it is gone, into `other`
  closed   ///< it is gone: nothing is where it was
};

/// "born", "kept", ...
const char* event_word(CavityEvent event);

/// What became of a cavity.
struct CavityStep {
  std::uint32_t id = 0;  ///< from 1, never used again
  CavityEvent event = CavityEvent::born;
  std::optional<std::uint32_t> other;  ///< the id of the one that it comes from, or went into
  std::size_t cavity = kNone;          ///< among those given; kNone: it is gone
};

/// Follows cavities through frames, whose positions must be comparable: superposed where the molecule drifts.
///
/// Two cavities of neighbouring frames overlap if probes at rest in them do: if such centres are closer than a probe's
/// diameter. (Then the voids overlap; voids that overlap elsewhere only, between their probes at rest, are not found
/// to.) Of those that overlap the pair with most lining atoms in common goes on under one id, then the next, each
/// cavity once; of equals the pair with the nearest probes.
class CavityTracks {
 public:
  /// probe_radius: Å, above 0.
  explicit CavityTracks(double probe_radius) : probe_radius_(probe_radius) {}

  /// The next frame's: a step for each of them, and for each of those before that is gone; by id. Cavity::atoms must
  /// mean the same atoms as before.
  std::vector<CavityStep> follow(const std::vector<Cavity>& cavities);

 private:
  struct Known {
    std::uint32_t id;
    Cavity cavity;
  };
  struct Pair {
    std::size_t before, now;
    std::size_t shared;  ///< lining atoms
    double distance;     ///< Å, of the nearest probes
  };
  std::vector<Pair> overlapping(const std::vector<Cavity>& cavities) const;

  double probe_radius_;
  std::uint32_t next_id_ = 1;
  std::vector<Known> known_;  ///< of the frame before
};

}  // namespace meniscus
