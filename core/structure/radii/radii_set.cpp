// SPDX-License-Identifier: BSD-3-Clause
// The list of sets.
#include "core/structure/radii/radii_set.h"

namespace meniscus {
namespace {

constexpr const RadiiSet* kSets[] = {&kBondiSet, &kUnitedSet, &kProtorSet};

}  // namespace

std::span<const RadiiSet* const> radii_sets() { return kSets; }

const RadiiSet* find_radii_set(std::string_view name) {
  for (const RadiiSet* set : kSets) {
    if (set->name == name) return set;
  }
  return nullptr;
}

std::string radii_set_names() {
  std::string names;
  for (const RadiiSet* set : kSets) names += std::string(set->name) + ", ";
  return names + "file";
}

}  // namespace meniscus
