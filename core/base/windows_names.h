// SPDX-License-Identifier: BSD-3-Clause
// Removes macros of windows.h whose names geometry uses. TBB includes windows.h, so the compiler includes this file
// first.
#pragma once

#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>

#undef near
#undef far
#undef small
