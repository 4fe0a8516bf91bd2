// SPDX-License-Identifier: BSD-3-Clause
// Elements of atoms that a topology names and weighs.
#pragma once

#include <cstdint>
#include <string>

namespace meniscus {

/// The atomic number by the mass (atomic mass units, within 0.1), which tells calcium from carbon, unless the name says
/// another element of organic residues: where mass was moved from carbon and nitrogen to their hydrogens, NH weighs as
/// much as C. 0: nobody can tell by the mass.
std::uint8_t element_of_mass(const std::string& name, double mass);

}  // namespace meniscus
