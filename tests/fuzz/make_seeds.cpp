// SPDX-License-Identifier: BSD-3-Clause
// Writes the seeds of binary formats from scratch into the folder given.
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "tests/support/binary_cif.h"
#include "tests/trajectory/byte_writer.h"
#include "tests/trajectory/samples.h"

namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int, char** arguments) {
  using namespace meniscus::test;
  const std::filesystem::path folder(arguments[1]);
  write(folder / "dcd/plain.dcd", dcd({}));
  write(folder / "dcd/big_endian.dcd",
        dcd({.order = std::endian::big, .marker = 8, .free = {2, 4}, .cell = {9, 0, 9, 0, 0, 9}}));
  write(folder / "dcd/fourth_axis.dcd", dcd({.version = 36, .cell = {30, 90, 40, 90, 90, 50}, .fourth_axis = true}));
  write(folder / "xtc/plain.xtc", xtc({.atoms = 6, .frames = 2}));
  write(folder / "xtc/packed.xtc", xtc({.frames = 2}));
  write(folder / "xtc/large.xtc", xtc({.frames = 1, .magic = 2023, .spread = 10'000'000}));
  write(folder / "trr/single.trr", trr({.frames = 2}));
  write(folder / "trr/double.trr", trr({.frames = 2, .doubles = true, .without_positions = 0}));
  write(folder / "netcdf/cdf2.nc", amber_netcdf({.frames = 2}));
  write(folder / "bcif/every_encoding.bcif", binary_cif({category("_atom_site", 3, atom_columns())}));
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    ByteWriter restart(order);
    restart.put(std::int32_t{3});
    for (int n = 0; n < 9; ++n) restart.put(1.25 * n - 3.0);
    write(folder / fmt::format("namd_coordinates/{}.coor", order == std::endian::big ? "big" : "little"),
          restart.bytes());
  }
  write(folder / "netcdf/cdf5.nc", amber_netcdf({.frames = 2, .version = 5}));
}
