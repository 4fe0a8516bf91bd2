// SPDX-License-Identifier: BSD-3-Clause
// How much of the surface belongs to each atom, computed beside the pictures and kept.
#pragma once

#include <cstddef>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "core/scene/surface_kind.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Whose areas are asked for.
struct AtomsInView {
  std::size_t frame = 0;
  std::size_t group = 0;  ///< of several that have surfaces of their own
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = 0.0;               ///< Å
  const std::vector<Ball>& balls;          ///< grown by growth_of() the kind
  std::shared_ptr<const Surface> surface;  ///< theirs, complete, if somebody has it already
};

/// Exact areas per frame, kind of surface and probe radius, from the complete surface on the CPU in a thread of its
/// own. One is computed at a time; the latest few are kept.
class ExposedAreas {
 public:
  /// Area of the points that take the atom's colour, Å² (AtomAreas::surface). If it is not known yet it is computed:
  /// with `wait` before this returns, else nothing comes back and a later call finds it.
  /// Throws OpenSurfaceError, CapacityError.
  std::optional<double> of(const AtomsInView& atoms, std::size_t atom, bool wait);
  /// The same if it is known, or cheap because the surface is there; else nothing, and nothing is begun.
  std::optional<double> if_cheap(const AtomsInView& atoms, std::size_t atom);
  /// Whether some are being computed, so that asking again will tell more.
  bool computing() const { return pending_.valid(); }

 private:
  using Key = std::tuple<std::size_t, std::size_t, SurfaceKind, double>;
  using Areas = std::vector<double>;

  void keep();

  std::map<Key, Areas> known_;
  std::vector<Key> order_;  ///< of known_, oldest first
  Key pending_key_{};
  std::future<Areas> pending_;
};

}  // namespace meniscus
