// SPDX-License-Identifier: BSD-3-Clause
// The tables of properties, one for each subject.
#pragma once

#include <span>

#include "core/properties/property.h"

namespace meniscus {

std::span<const Property> molecule_properties();
std::span<const Property> frame_properties();
std::span<const Property> surface_properties();
std::span<const Property> look_properties();
std::span<const Property> picture_properties();
std::span<const Property> annotation_properties();
std::span<const Property> mesh_properties();
std::span<const Property> report_properties();

}  // namespace meniscus
