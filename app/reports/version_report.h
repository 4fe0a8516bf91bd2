// SPDX-License-Identifier: BSD-3-Clause
// Reports the version of this program and of its libraries, for bug reports.
#pragma once

#include <string>

namespace meniscus {

/// Returns a line such as "meniscus 0.1.0+g2b6bb4a4c1d2".
std::string version_line();

/// Returns that line, and lines about compiler, system, libraries as they are loaded, and the GL driver that `auto`
/// would choose. Anything that cannot be found is reported in its line. Reads CUDA_VISIBLE_DEVICES like --device.
std::string version_report();

/// Returns what to cite: the program as BibTeX, and the paper of its method, as in CITATION.cff.
std::string citation();

}  // namespace meniscus
