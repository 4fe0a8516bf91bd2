// SPDX-License-Identifier: BSD-3-Clause
// Lets clang 14 compile gemmi 0.5 as C++20: included before everything else in the files that use it.
#pragma once

// gemmi has vectors of a type that is not complete yet. clang looks into constexpr members of std::vector at once,
// where gcc waits until they are needed; so here they are none. The function that gets another name is declared as
// constexpr elsewhere; std::fill over std::vector<bool> would need it, which these files have not.
#include <string>

#pragma push_macro("_GLIBCXX20_CONSTEXPR")
#undef _GLIBCXX20_CONSTEXPR
#define _GLIBCXX20_CONSTEXPR
#define __fill_a1 __fill_a1_of_bits
#include <vector>
#undef __fill_a1
#pragma pop_macro("_GLIBCXX20_CONSTEXPR")
