// SPDX-License-Identifier: BSD-3-Clause
// Comes before all else on Windows, whose header takes names away that geometry uses: TBB includes it.
#pragma once

#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>

#undef near
#undef far
#undef small
