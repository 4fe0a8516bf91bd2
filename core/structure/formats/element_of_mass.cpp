// SPDX-License-Identifier: BSD-3-Clause
// Compares masses with standard atomic weights.
#include "core/structure/formats/element_of_mass.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include <gemmi/elem.hpp>

namespace meniscus {
namespace {

constexpr std::string_view kOrganic = "HCNOPS";

/// The element whose weight this is, within 0.1; 0 if there is none.
int nearest_weight(double mass) {
  int best = 0;
  double least = 0.1;
  for (int number = 1; number < 119; ++number) {
    const double distance = std::abs(gemmi::Element(number).weight() - mass);
    if (distance < least) {
      least = distance;
      best = number;
    }
  }
  return best;
}

}  // namespace

std::uint8_t element_of_mass(const std::string& name, double mass) {
  const int by_mass = nearest_weight(mass);
  const std::size_t letter = std::min(name.find_first_not_of("0123456789"), name.size());
  const char first =
      letter < name.size() ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[letter]))) : ' ';
  const bool named_organic = kOrganic.find(first) != std::string_view::npos;
  const gemmi::Element heavy_or_light(by_mass);
  const bool moved_mass = named_organic &&
                          (by_mass == 2 || kOrganic.find(heavy_or_light.name()) != std::string_view::npos) &&
                          heavy_or_light.name()[0] != first;
  return static_cast<std::uint8_t>(moved_mass ? 0 : by_mass);
}

}  // namespace meniscus
