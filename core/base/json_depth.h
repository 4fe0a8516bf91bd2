// SPDX-License-Identifier: BSD-3-Clause
// How deep JSON from elsewhere may be nested before it is parsed.
#pragma once

#include <string_view>

namespace meniscus {

/// Nothing of ours is nested as deep. JSON values are copied, compared and written by recursion, so that a file of
/// brackets alone would exhaust the stack.
inline constexpr int kDeepestJson = 64;

/// Do arrays and objects stand in each other more than kDeepestJson levels deep? The text need not be JSON.
bool is_nested_too_deep(std::string_view json);

}  // namespace meniscus
