// SPDX-License-Identifier: BSD-3-Clause
// A vector as callers see it.
#pragma once

#include <vector>

#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

template <typename Row>
meniscus_array table_of(const std::vector<Row>& rows) {
  return {rows.data(), rows.size(), sizeof(Row)};
}

}  // namespace meniscus::c_api
