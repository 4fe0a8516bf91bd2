// SPDX-License-Identifier: BSD-3-Clause
// The devices of the C interface in the words of the library.
#pragma once

#include <cstdint>

#include "core/gpu/device_choice.h"
#include "exporters/bindings/c/guard.h"

namespace meniscus::c_api {

inline void check_device(std::int32_t device) {
  if (device < MENISCUS_CPU || device > MENISCUS_SOFTWARE)
    refuse(MENISCUS_USAGE, "device is {}, none of MENISCUS_CPU, _AUTO, _GPU, _SOFTWARE", device);
}

/// The GL that a device means.
inline DeviceChoice gl_of(std::int32_t device) {
  DeviceChoice choice;
  choice.kind = device == MENISCUS_GPU    ? DeviceChoice::Kind::gpu
                : device == MENISCUS_AUTO ? DeviceChoice::Kind::automatic
                                          : DeviceChoice::Kind::software;
  return choice;
}

}  // namespace meniscus::c_api
