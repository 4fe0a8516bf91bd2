// SPDX-License-Identifier: BSD-3-Clause
// The colours of atoms by a scheme.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace meniscus {

struct ColorScheme;
struct Coloring;
struct Structure;

/// One colour an atom of the structure, for a surface that is one object; rules over the scheme, but where that
/// colours by kind of patch.
/// Throws InputError when colours are by a number and no atom has one, when a file's numbers are not as many as there
/// are atoms, and when the categorical map has fewer colours than there are different numbers.
Coloring color_atoms(const Structure& structure, const ColorScheme& scheme);

/// The same for one of several objects. atom: per atom of the object, its index into structure.atoms. object_number:
/// its place in the list of objects, which By::component colours by. Ranges are those of the whole structure. Parts are
/// chains.
Coloring color_object(const Structure& structure, std::span<const std::uint32_t> atom, const ColorScheme& scheme,
                      std::size_t object_number);

}  // namespace meniscus
