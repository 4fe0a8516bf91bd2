// SPDX-License-Identifier: BSD-3-Clause
// What is behind the handle of a molecule.
#pragma once

#include "core/structure/structure.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

const Structure& structure_of(const meniscus_structure& handle);

}  // namespace meniscus::c_api
