// SPDX-License-Identifier: BSD-3-Clause
// Computes the colours of atoms by a scheme.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace meniscus {

struct ColorScheme;
struct Coloring;
struct Structure;

/// Returns one colour per atom of the structure, for a surface that is one object. Rules override the scheme, except
/// where it colours by kind of patch. Throws InputError if colours are by a number and no atom has one, if a file has a
/// different number of numbers than there are atoms, and if the categorical map has fewer colours than there are
/// different numbers.
Coloring color_atoms(const Structure& structure, const ColorScheme& scheme);

/// Returns the colours of one of several objects. atom: per atom of the object, its index into structure.atoms.
/// object_number: its index in the list of objects, by which By::component colours. Ranges are those of the whole
/// structure. Parts are chains.
Coloring color_object(const Structure& structure, std::span<const std::uint32_t> atom, const ColorScheme& scheme,
                      std::size_t object_number);

}  // namespace meniscus
