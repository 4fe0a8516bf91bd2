// SPDX-License-Identifier: BSD-3-Clause
// What the module that reads H5MD gives to the program.
#pragma once

#include <memory>
#include <string>

namespace meniscus {

class Trajectory;

/// Opens a file. Throws InputError.
using OpenH5md = std::unique_ptr<Trajectory>(const std::string& path);

}  // namespace meniscus
