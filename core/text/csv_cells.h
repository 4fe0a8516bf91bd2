// SPDX-License-Identifier: BSD-3-Clause
// Lines of comma-separated values, taken apart.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// The cells of a line, without blanks at both ends; quotes around one may hold commas, two of them stand for one.
std::vector<std::string> csv_cells_of(std::string_view line);

}  // namespace meniscus
