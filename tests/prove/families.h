// SPDX-License-Identifier: BSD-3-Clause
// Families of balls made to tie: an endless, seeded list of the inputs on which surfaces go wrong first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/surface/primitives.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {

/// One input, and its distance from the tie that it was made for.
struct FamilyCase {
  std::string family;
  Balls balls;                ///< Å
  double probe_radius = 0.0;  ///< Å
  double jitter = 0.0;        ///< Å by which each centre was moved; 0: exact up to rounding
};

/// Returns the names of the families in the order of cases.
const std::vector<std::string>& family_names();

/// Returns the n-th case of a family: exact, or jittered by 1e-12 to 1e-3 Å; turned and reordered, or unchanged. The
/// same n is the same case on every machine.
FamilyCase family_case(const std::string& family, std::uint32_t n);

/// A shortened input that once failed or was refused.
struct CorpusCase {
  Balls balls;
  double probe_radius = 0.0;
};

/// Reads a file of tests/corpus: a line `# probe P: what went wrong`, then `x y z radius` in Å.
CorpusCase read_corpus(const std::string& path);

}  // namespace meniscus::testing
