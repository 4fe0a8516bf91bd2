// SPDX-License-Identifier: BSD-3-Clause
// Reads the values behind the words of a selection: patterns, elements, numbers and ranges of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/structure/selection/selection_lexer.h"
#include "core/structure/selection/selection_steps.h"

namespace meniscus {

/// One value of a list, with its place for messages.
struct SelectionValue {
  std::string text;
  std::size_t position = 0;
  bool quoted = false;
};

/// "CA+CB" is two values; "NA+" is one, since nothing follows the sign. Quoted values stay whole.
std::vector<SelectionValue> split_at_plus(const Token& token);

/// These throw SelectionError pointing into `text`.
std::vector<TextPattern> read_patterns(const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_elements(std::string_view text, const std::vector<SelectionValue>& values);
std::vector<std::array<ResidueTest::Id, 2>> read_residue_ranges(std::string_view text,
                                                                const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_number_ranges(std::string_view text, const std::vector<SelectionValue>& values,
                                                      bool whole);
double read_number(std::string_view text, const SelectionValue& value, bool whole);

}  // namespace meniscus
