// SPDX-License-Identifier: BSD-3-Clause
// Van der Waals radii by element.
#include "core/structure/element_tables.h"
#include "exporters/bindings/c/caller_memory.h"

namespace {

constexpr std::int32_t kHeaviest = 118;

}  // namespace

meniscus_status meniscus_element_of_symbol(const char* symbol, std::int32_t* element) {
  using namespace meniscus;
  return c_api::guarded([&] {
    c_api::require(symbol, "symbol");
    c_api::require(element, "element");
    *element = element_of_symbol(symbol);
  });
}

meniscus_status meniscus_element_radius(std::int32_t element, double* radius, const char** source) {
  using namespace meniscus;
  return c_api::guarded([&] {
    c_api::require(radius, "radius");
    if (source) c_api::require(source, "source");
    if (element < 0 || element > kHeaviest)
      c_api::refuse(MENISCUS_INPUT, "there is no element {}; atomic numbers go to {}", element, kHeaviest);
    const ElementRadius found = bondi_radius(static_cast<std::uint8_t>(element));
    *radius = found.radius;
    if (source) *source = source_name(found.source);
  });
}
