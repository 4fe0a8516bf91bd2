// SPDX-License-Identifier: BSD-3-Clause
// Lets clang 14 compile gemmi 0.5 as C++20. The files that use gemmi include it before everything else.
#pragma once

// gemmi declares vectors of a type before the type is complete. clang instantiates constexpr members of std::vector at
// their declaration, where gcc waits until they are needed. Therefore the members of std::vector are not constexpr in
// this include. libstdc++ has declared __fill_a1(), which std::vector<bool> uses in std::fill, as constexpr already in
// another header, so a second declaration without constexpr would be an error; the new name avoids it. The renamed
// function has no callers in the files that use gemmi.
#include <string>

#pragma push_macro("_GLIBCXX20_CONSTEXPR")
#undef _GLIBCXX20_CONSTEXPR
#define _GLIBCXX20_CONSTEXPR
#define __fill_a1 __fill_a1_of_bits
#include <vector>
#undef __fill_a1
#pragma pop_macro("_GLIBCXX20_CONSTEXPR")
