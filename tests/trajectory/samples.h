// SPDX-License-Identifier: BSD-3-Clause
// Small trajectory files of each binary format, made from scratch.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace meniscus::test {

struct DcdSample {
  std::endian order = std::endian::little;
  int marker = 4;
  std::int32_t promised = 3, version = 24;
  std::uint32_t atoms = 4, frames = 3;
  std::vector<std::int32_t> free = {};  // numbers from 1; empty: all atoms
  std::vector<double> cell = {};
  bool fourth_axis = false;
  double time_step = 0.5;  // AKMA
};

/// Returns the coordinate that a sample gives an atom: Å in DCD and Amber NetCDF, nm in TRR.
float coordinate(std::uint32_t frame, std::uint32_t atom, int axis);

std::string dcd(const DcdSample& sample);

struct XtcSample {
  std::uint32_t atoms = 12, frames = 3;  ///< atoms: a multiple of 3; up to 9 are not packed
  std::int32_t magic = 1995;
  float precision = 1000.0F;
  std::int32_t small_class = 20;
  std::int32_t spread = 1000;  ///< the first atom of three is up to this many steps from the origin
};

/// Returns the coordinate that the sample gives an atom, in steps of the precision.
std::int32_t xtc_step(const XtcSample& sample, std::uint32_t frame, std::uint32_t atom, int axis);

/// Packs atoms in threes like waters: one in full, two as differences.
std::string xtc(const XtcSample& sample);

struct TrrSample {
  std::uint32_t atoms = 4, frames = 3;
  bool doubles = false;
  std::uint32_t without_positions = 0xffffffff;  ///< this frame has velocities only
};

std::string trr(const TrrSample& sample);

struct AmberSample {
  std::uint32_t atoms = 5, frames = 3;
  char version = 2;  ///< 1, 2 or 5
};

/// Returns a file with boxes of edges 10, 20, 30 and times 0.5, 1.5, ...
std::string amber_netcdf(const AmberSample& sample);

/// Returns the message of the InputError that the action throws, or "no error".
std::string refusal(const std::function<void()>& action);

}  // namespace meniscus::test
