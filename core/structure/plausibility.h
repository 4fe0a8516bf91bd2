// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a well-formed file is plausible, and gives one warning for many cases of one kind.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

struct Structure;
struct Warning;

/// Warns of atoms at exactly the place of another, each with both names.
void warn_of_coincident_atoms(Structure& structure);

/// Warns where the median distance to the nearest atom of the same model and alternate location is below half an
/// ångström, as in a file in nanometres. The median is that of at most 64 atoms, evenly spread.
void warn_of_wrong_unit(Structure& structure);

/// Warns where atoms lie on those of other models (median distance to the nearest below 1.5 Å), as in the ensembles of
/// NMR; the parts of an assembly that are models do not.
void warn_of_overlaid_models(Structure& structure);

class WarningCollector {
 public:
  /// One more case: an atom in this line of the file and the text that is odd about it, or words for the two.
  void add(std::size_t line, std::string_view text);
  void add(std::string words) { cases_.push_back(std::move(words)); }
  /// Appends nothing without cases; else "12 atoms have <what> (first: line 3, 'text')" with a detail for each.
  void warn(std::vector<Warning>& warnings, const char* what);

 private:
  std::vector<std::string> cases_;
};

}  // namespace meniscus
