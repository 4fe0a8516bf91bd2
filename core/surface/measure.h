// SPDX-License-Identifier: BSD-3-Clause
// Area and enclosed volume in closed form.
#pragma once

#include "core/surface/primitives.h"

namespace meniscus {

/// Fills in Face::area, Component::{area, volume, kind}, Surface::{area, volume}, and sorts the components: outer ones
/// first, then cavities, each by falling area. Areas by Gauss-Bonnet, volumes by the divergence theorem; both are
/// sums of closed forms over borders, so the error is rounding only.
void measure_surface(Surface& surface);

}  // namespace meniscus
