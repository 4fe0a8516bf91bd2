// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a well-formed file is plausible, and collects many cases of one kind into one warning.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

struct Structure;
struct Warning;

/// Adds a warning for atoms at exactly the position of another atom. It names both atoms of each pair.
void warn_of_coincident_atoms(Structure& structure);

/// Adds a warning if the median distance to the nearest atom of the same model and alternate location is below 0.5 Å,
/// as in a file in nanometres. The median is over at most 64 atoms, evenly spread over the file.
void warn_of_wrong_unit(Structure& structure);

/// Adds a warning if atoms overlap with atoms of other models (median distance to the nearest below 1.5 Å), as in NMR
/// ensembles. Parts of an assembly that are stored as models do not overlap.
void warn_of_overlaid_models(Structure& structure);

/// Collects the cases of one kind of warning.
class WarningCollector {
 public:
  /// Adds a case: an atom in this line of the file with the text that is wrong, or a description of both.
  void add(std::size_t line, std::string_view text);
  void add(std::string words) { cases_.push_back(std::move(words)); }
  /// Appends the warning "12 atoms have <what> (first: line 3, 'text')" with a detail for each case. Nothing is
  /// appended if there are no cases.
  void warn(std::vector<Warning>& warnings, const char* what);

 private:
  std::vector<std::string> cases_;
};

}  // namespace meniscus
