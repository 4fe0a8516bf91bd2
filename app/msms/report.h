// SPDX-License-Identifier: BSD-3-Clause
// What MSMS says on standard output, line by line, for the programs that parse it.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/msms/arguments.h"
#include "core/surface/reduced_components.h"

namespace meniscus::msms {

/// Which program, as whom it answers, where.
std::string banner();

/// The lines INPUT and PARAM.
std::string input_lines(const Arguments& arguments, std::size_t spheres, double smallest_radius, double largest_radius);

/// One line for each component above number 0, which are those that have files of their own.
std::string component_lines(std::size_t count);

/// Areas of each component, in closed form.
std::string analytic_table(double probe_radius, std::span<const ReducedComponentSize> sizes);

/// Volume and area of each component, and the sum of volumes. MSMS takes them from triangles; these are in closed form.
std::string numeric_table(double probe_radius, std::span<const ReducedComponentSize> sizes);

/// The last two lines. Time since `start`, and of processors since the process began.
std::string ending(std::chrono::steady_clock::time_point start);

}  // namespace meniscus::msms
