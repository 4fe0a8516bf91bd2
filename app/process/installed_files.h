// SPDX-License-Identifier: BSD-3-Clause
// Files that come with the program, wherever it was installed.
#pragma once

#include <filesystem>

namespace meniscus {

/// The folder of the Blender add-on and of its driver, render_mns.py: share/meniscus/addon beside bin/, or within the
/// folder where the program was built. Where neither is there, what ought to be.
std::filesystem::path addon_folder();

}  // namespace meniscus
