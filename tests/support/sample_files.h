// SPDX-License-Identifier: BSD-3-Clause
// Paths of molecules in packages of Debian.
#pragma once

namespace meniscus {

inline constexpr const char* kToxin = "/usr/share/pymol/data/demo/1tii.pdb";         ///< pymol-data
inline constexpr const char* kUbiquitin = "/usr/share/freesasa/test-data/1ubq.pdb";  ///< freesasa; with 58 waters

}  // namespace meniscus
