// SPDX-License-Identifier: BSD-3-Clause
// Lets clang 14 compile gemmi 0.5 as C++20. The files that use gemmi include it before everything else.
#pragma once

// gemmi has vectors of a type that is incomplete at that point. clang instantiates constexpr members of std::vector at
// once, where gcc waits until they are needed. Therefore these members are not constexpr here. The function that is
// renamed is declared as constexpr elsewhere; only std::fill over std::vector<bool> would need it, which these files do
// not use.
#include <string>

#pragma push_macro("_GLIBCXX20_CONSTEXPR")
#undef _GLIBCXX20_CONSTEXPR
#define _GLIBCXX20_CONSTEXPR
#define __fill_a1 __fill_a1_of_bits
#include <vector>
#undef __fill_a1
#pragma pop_macro("_GLIBCXX20_CONSTEXPR")
