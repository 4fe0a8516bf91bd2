// SPDX-License-Identifier: BSD-3-Clause
// The last rung: input so tied that its decisions and its positions contradict each other is computed for radii grown
// by a hair, and says so.
#pragma once

#include <span>
#include <vector>

#include "core/surface/primitives.h"

namespace meniscus {

/// How often a surface is computed at most: once as given, then for grown radii, by 0.016 Å in the last. Growth of more
/// than 1e-4 Å is for probes of 50 Å and more that touch dozens of atoms at once: rounding is as much larger as they
/// are.
inline constexpr int kTieAttempts = 15;

/// The largest growth of that attempt, Å: 0 for attempt 0, then from 1e-8 Å upwards, each three times the last.
double tie_growth(int attempt);

/// The balls of an attempt: radii grown by half to all of tie_growth(attempt), by another amount for each index.
std::vector<Ball> grown_balls(std::span<const Ball> balls, int attempt);

/// Decisions are taken for radii that grow by about 1e-9 Å (decision_weights()), positions computed from the given
/// ones. Where many spheres meet in one point, nearly or exactly, what the decisions see as a figure of 1e-9 Å may be
/// turned inside out in the positions; the certificate then refuses it. Radii that truly grow by more than decisions do
/// leave no tie, so decisions and positions are of one and the same figure. Touching still counts as overlapping.
/// compute: balls -> Surface. Returns the first attempt whose certificate holds, with Certificate::grown_by set, else
/// the result of attempt 0.
template <typename Compute>
Surface compute_through_ties(std::span<const Ball> balls, const Compute& compute) {
  Surface surface = compute(balls);
  if (surface.certificate.closed) return surface;
  for (int attempt = 1; attempt < kTieAttempts; ++attempt) {
    surface = {};  // before the next one takes as much memory
    surface = compute(std::span<const Ball>(grown_balls(balls, attempt)));
    if (!surface.certificate.closed) continue;
    surface.certificate.grown_by = tie_growth(attempt);
    surface.certificate.exact_within += tie_growth(attempt);
    return surface;
  }
  surface = {};
  return compute(balls);
}

}  // namespace meniscus
