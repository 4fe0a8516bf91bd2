// SPDX-License-Identifier: BSD-3-Clause
// The assemblies that a file describes, as a table.
#pragma once

#include "core/structure/structure.h"

namespace meniscus {

/// On stdout.
void print_assemblies(const Structure& structure);

}  // namespace meniscus
