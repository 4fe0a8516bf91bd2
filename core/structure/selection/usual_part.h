// SPDX-License-Identifier: BSD-3-Clause
// Which usual part of a file's atoms has a given number, for whoever has a trajectory of fewer atoms.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace meniscus {

struct Atom;

/// What the atoms of a frame can be if they are not all of the file: "as many as it has without water: choose
/// --trajectory-atoms 'not water'", or that the two do not belong together.
std::string advice_on_count(std::span<const Atom> atoms, std::size_t frame_atoms);

}  // namespace meniscus
