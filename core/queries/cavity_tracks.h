// SPDX-License-Identifier: BSD-3-Clause
// Follows cavities from one surface to the next and identifies each of them.
#pragma once

#include <optional>

#include "core/surface/primitives.h"

namespace meniscus {

/// A void that the probe cannot leave.
struct Cavity {
  double area = 0.0;    ///< Å²
  double volume = 0.0;  ///< Å³, positive
  /// Indices into Surface::atoms of the atoms that a probe in the cavity can touch; ascending.
  std::vector<std::uint32_t> atoms;
  /// Centres (Å) of probes at rest in the cavity. A probe at rest touches three atoms or more.
  std::vector<glm::dvec3> probes;

  /// Returns the mean (Å) of the probes at rest.
  glm::dvec3 middle() const;
};

/// Returns the cavities of a solvent-excluded surface, the largest area first, as Surface::components has them. Each
/// cavity has at least four probes at rest, because a bounded region outside of balls has no other extreme points. Some
/// of them may be missing here: those with a patch of which others leave nothing.
std::vector<Cavity> cavities_of(const Surface& surface);

enum class CavityEvent {
  born,    ///< no earlier cavity was at its place
  kept,    ///< it was there before
  split,   ///< it is a part of cavity `other`, which continues elsewhere, too
  merged,  ///< it is gone, and has become a part of `other`
  closed   ///< it is gone, and no cavity is at its place
};

/// Returns the word for an event: "born", "kept", ...
const char* event_word(CavityEvent event);

/// The history of a cavity from one frame to the next.
struct CavityStep {
  std::uint32_t id = 0;  ///< counts from 1 and is never reused
  CavityEvent event = CavityEvent::born;
  std::optional<std::uint32_t> other;  ///< the id of the cavity that it comes from or went into
  std::size_t cavity = kNone;          ///< its index among the cavities of the frame; kNone: it is gone
};

/// Follows cavities through frames with comparable positions: superposed ones if the molecule drifts.
///
/// Two cavities of successive frames overlap if probes at rest in them do, which means that such centres are closer
/// than a probe's diameter. (The voids then overlap; voids that overlap only between their probes at rest are not
/// recognised.) Of the overlapping pairs, the one with the most lining atoms in common continues under one id, then the
/// next one, each cavity at most once; of equal pairs the one with the nearest probes comes first.
class CavityTracks {
 public:
  /// `probe_radius` is in Å, above 0.
  explicit CavityTracks(double probe_radius) : probe_radius_(probe_radius) {}

  /// Takes the cavities of the next frame. Returns a step for each of them, and for each cavity of the frame before
  /// that is gone, in the order of ids. Cavity::atoms must mean the same atoms in all frames.
  std::vector<CavityStep> follow(const std::vector<Cavity>& cavities);

 private:
  struct Known {
    std::uint32_t id;
    Cavity cavity;
  };
  struct Pair {
    std::size_t before, now;
    std::size_t shared;  ///< number of lining atoms in common
    double distance;     ///< Å, between the nearest probes
  };
  std::vector<Pair> overlapping(const std::vector<Cavity>& cavities) const;

  double probe_radius_;
  std::uint32_t next_id_ = 1;
  std::vector<Known> known_;  ///< the cavities of the frame before
};

}  // namespace meniscus
