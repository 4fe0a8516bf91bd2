// SPDX-License-Identifier: BSD-3-Clause
// Which sources the program was built from: one small file that changes with every commit, so that no other does.
#pragma once

namespace meniscus {

/// "0.1.0+g2b6bb4a4c1d2": the version and the commit; "....dirty.5f0c..." and a checksum if files differ from it;
/// "0.1.0+s77b1..." and a checksum of all sources where no repository tells. Programs with the same text are made of
/// the same sources.
const char* build_version();

/// "2026-11-22": when the commit was made; without a repository, when CHANGELOG.md was last changed.
const char* build_date();

}  // namespace meniscus
