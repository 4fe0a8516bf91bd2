// SPDX-License-Identifier: BSD-3-Clause
// Joins the tables of properties into one, and finds a property by its key.
#include "core/properties/properties.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "core/properties/tables.h"

namespace meniscus {

namespace {

std::vector<std::span<const Property>>& tables() {
  static std::vector<std::span<const Property>> all{
      molecule_properties(), frame_properties(),      surface_properties(), look_properties(),
      picture_properties(),  annotation_properties(), mesh_properties(),    report_properties()};
  return all;
}

}  // namespace

PropertyTable::PropertyTable(std::span<const Property> table) { tables().push_back(table); }

std::span<const Property* const> properties() {
  static const std::vector<const Property*> all = [] {
    std::vector<const Property*> joined;
    for (const std::span<const Property>& table : tables())
      for (const Property& property : table) joined.push_back(&property);
    return joined;
  }();
  return all;
}

const Property& property_of(std::string_view key) {
  const auto found = std::ranges::find(properties(), key, &Property::key);
  if (found == properties().end()) throw std::logic_error(fmt::format("there is no property {}", key));
  return **found;
}

}  // namespace meniscus
