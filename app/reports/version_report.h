// SPDX-License-Identifier: BSD-3-Clause
// The version of this program and of its libraries, for bug reports.
#pragma once

#include <string>

namespace meniscus {

/// "meniscus 0.1.0+g2b6bb4a4c1d2"
std::string version_line();

/// That, and lines about compiler, system, libraries as they are loaded, and the GL driver that auto would take. What
/// cannot be found is reported in its line. Reads CUDA_VISIBLE_DEVICES like --device.
std::string version_report();

/// What to cite: the program as BibTeX, and the paper whose method it continues. As CITATION.cff has it.
std::string citation();

}  // namespace meniscus
