// SPDX-License-Identifier: BSD-3-Clause
// Included before all else on Windows: removes macros of windows.h, which TBB includes, whose names geometry uses.
#pragma once

#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>

#undef near
#undef far
#undef small
