// SPDX-License-Identifier: BSD-3-Clause
// What becomes of memory that one stage or frame frees and the next one asks for again.
#pragma once

namespace meniscus {

/// From here on tables of less than 32 MiB are taken from memory that was freed before, which stays with the process;
/// larger ones go back to the system at once, so that what the process uses at its peak grows by a few per cent only.
/// New memory costs a page fault for each 4 KiB, a tenth of a small surface. Without effect on C libraries that know no
/// such setting.
void keep_freed_memory();

}  // namespace meniscus
