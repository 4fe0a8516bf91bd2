// SPDX-License-Identifier: BSD-3-Clause
// What is behind the handle of a molecule.
#pragma once

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// Refuses what is no such handle.
const Structure& structure_of(const meniscus_structure* structure);

}  // namespace meniscus::c_api
