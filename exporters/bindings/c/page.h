// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a page.
#pragma once

#include <string>
#include <utility>

#include "exporters/bindings/c/counted.h"
#include "exporters/bindings/c/include/meniscus/meniscus.h"

struct meniscus_page : meniscus::c_api::Counted {
  explicit meniscus_page(std::string text) : html(std::move(text)) {}
  const std::string html;
};
