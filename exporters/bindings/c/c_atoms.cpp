// SPDX-License-Identifier: BSD-3-Clause
// Checks the atoms that callers pass, and looks up van der Waals radii by element.
#include "exporters/bindings/c/c_atoms.h"

#include "core/base/text_file.h"
#include "core/structure/element_tables.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {
namespace {

/// The largest number of atoms. An atom has up to a dozen borders, which have indices of 31 bits.
constexpr std::size_t kMostAtoms = std::size_t{1} << 27;

/// The largest atomic number.
constexpr std::int32_t kHeaviest = 118;

/// An array of a caller: rows of `width` floats or doubles.
class Numbers {
 public:
  Numbers(const void* data, std::size_t count, std::size_t width, std::size_t stride, std::int32_t type,
          const char* name)
      : data_(static_cast<const unsigned char*>(data)), single_(type == MENISCUS_FLOAT) {
    if (type != MENISCUS_FLOAT && type != MENISCUS_DOUBLE)
      refuse(MENISCUS_USAGE, "{}_type is {}, neither MENISCUS_DOUBLE nor MENISCUS_FLOAT", name, type);
    stride_ = require_rows(data, {count, width, single_ ? sizeof(float) : sizeof(double), stride}, name);
  }

  double at(std::size_t row, std::size_t column) const {
    const unsigned char* const place = data_ + row * stride_;
    return single_ ? static_cast<double>(reinterpret_cast<const float*>(place)[column])
                   : reinterpret_cast<const double*>(place)[column];
  }

 private:
  const unsigned char* data_;
  std::size_t stride_ = 0;
  bool single_;
};

void check_position(std::size_t atom, std::size_t axis, double value) {
  const char letter = "xyz"[axis];
  if (!std::isfinite(value)) refuse(MENISCUS_INPUT, "{} of atom {} is {}, not a finite number", letter, atom, value);
  if (std::abs(value) > kLargestCoordinate)
    refuse(MENISCUS_INPUT, "{} of atom {} is {} Å, beyond the {} Å that make sense; are these Å?", letter, atom, value,
           kLargestCoordinate);
}

void check_radius(std::size_t atom, double value) {
  if (!std::isfinite(value)) refuse(MENISCUS_INPUT, "the radius of atom {} is {}, not a finite number", atom, value);
  if (value <= 0.0)
    refuse(MENISCUS_INPUT, "the radius of atom {} is {} Å; it has to be above 0, or leave the atom out", atom, value);
  if (value > kLargestRadius)
    refuse(MENISCUS_INPUT, "the radius of atom {} is {} Å, beyond the {} Å that make sense", atom, value,
           kLargestRadius);
}

}  // namespace

std::vector<Ball> read_atoms(const meniscus_atoms* given) {
  const meniscus_atoms atoms = read_struct(given, meniscus_atoms{}, "meniscus_atoms");
  if (atoms.count == 0) refuse(MENISCUS_INPUT, "there are no atoms: meniscus_atoms.count is 0");
  if (atoms.count > kMostAtoms)
    refuse(MENISCUS_CAPACITY, "{} atoms are more than the {} that indices can count", atoms.count, kMostAtoms);
  require_zero(atoms.reserved, "meniscus_atoms.reserved");
  const Numbers positions(atoms.positions, atoms.count, 3, atoms.positions_stride, atoms.positions_type,
                          "meniscus_atoms.positions");
  const Numbers radii(atoms.radii, atoms.equal_radii ? 1 : atoms.count, 1, atoms.radii_stride, atoms.radii_type,
                      "meniscus_atoms.radii");
  std::vector<Ball> balls(atoms.count);
  for (std::size_t n = 0; n < balls.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = positions.at(n, axis);
      check_position(n, axis, value);
      balls[n].center[static_cast<int>(axis)] = value;
    }
    balls[n].radius = radii.at(atoms.equal_radii ? 0 : n, 0);
    check_radius(n, balls[n].radius);
  }
  return balls;
}

Coloring coloring_of(const glm::vec3& color, const float* of_atoms, std::size_t atoms) {
  for (int n = 0; n < 3; ++n) check_range("color", color[n], 0, 1);
  Coloring coloring;
  coloring.atom.assign(atoms, color);
  if (!of_atoms) return coloring;
  require_numbers(of_atoms, atoms, 3, "atom_colors");
  for (std::size_t n = 0; n < 3 * atoms; ++n) {
    const float channel = of_atoms[n];
    if (!(channel >= 0.0f && channel <= 1.0f))
      refuse(MENISCUS_INPUT, "channel {} of the colour of atom {} is {}; it has to be 0 to 1", n % 3, n / 3, channel);
    coloring.atom[n / 3][static_cast<int>(n % 3)] = channel;
  }
  return coloring;
}

}  // namespace meniscus::c_api

meniscus_status meniscus_element_of_symbol(const char* symbol, std::int32_t* element) {
  using namespace meniscus;
  return c_api::guarded([&] {
    c_api::require(symbol, "symbol");
    c_api::require(element, "element");
    *element = element_of_symbol(symbol);
  });
}

meniscus_status meniscus_element_radius(std::int32_t element, double* radius, const char** source) {
  using namespace meniscus;
  return c_api::guarded([&] {
    c_api::require(radius, "radius");
    if (source) c_api::require(source, "source");
    if (element < 0 || element > c_api::kHeaviest)
      c_api::refuse(MENISCUS_INPUT, "there is no element {}; atomic numbers go to {}", element, c_api::kHeaviest);
    const ElementRadius found = bondi_radius(static_cast<std::uint8_t>(element));
    *radius = found.radius;
    if (source) *source = source_name(found.source);
  });
}
