// SPDX-License-Identifier: BSD-3-Clause
// Where a NetCDF file of the classic formats keeps its variables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/trajectory/formats/binary_file.h"

namespace meniscus {

/// One array of numbers, big-endian.
struct NetcdfVariable {
  std::vector<std::uint64_t> lengths;  ///< of its dimensions, without that of the records
  bool has_records = false;
  std::uint32_t type = 0;          ///< as the format numbers them: 5 is float, 6 double
  std::uint64_t begin = 0;         ///< offset of its first number
  std::uint64_t record_bytes = 0;  ///< of one record; without records of all
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;  ///< attributes of one number of type float or double
};

struct NetcdfLayout {
  std::uint64_t records = 0;        ///< as the header says
  bool records_are_known = true;    ///< false: the writer left the number open
  std::uint64_t record_stride = 0;  ///< bytes from a number to the same one of the next record
  std::map<std::string, std::string> texts;
  std::map<std::string, NetcdfVariable> variables;
};

/// Reads the header (NetCDF classic format specification: CDF-1, CDF-2 with offsets of 64 bits, CDF-5). Our own because
/// libnetcdf fills what a cut file lacks with zeros, and does not tell where a record lies. Throws InputError: another
/// format, damaged, a header above 4 MiB.
NetcdfLayout read_netcdf_layout(const BinaryFile& file);

}  // namespace meniscus
