// SPDX-License-Identifier: BSD-3-Clause
// Paths of molecules in packages of Debian.
#pragma once

#include <filesystem>

#include <gtest/gtest.h>

/// Skips a test whose file is not installed: Debian 13 does not have python3-prody-tests.
#define SKIP_WITHOUT(file) \
  if (!std::filesystem::exists(file)) GTEST_SKIP() << (file) << " is not installed"

namespace meniscus {

inline constexpr const char* kToxin = "/usr/share/pymol/data/demo/1tii.pdb";         ///< pymol-data
inline constexpr const char* kUbiquitin = "/usr/share/freesasa/test-data/1ubq.pdb";  ///< freesasa; with 58 waters

}  // namespace meniscus
