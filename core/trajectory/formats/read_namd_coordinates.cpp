// SPDX-License-Identifier: BSD-3-Clause
// Reads coordinate files of NAMD, which have the number of atoms and then their positions in double precision.
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/binary_file.h"
#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

constexpr std::size_t kCount = sizeof(std::int32_t), kPosition = 3 * sizeof(double);

/// Returns the byte order in which a file begins like one of NAMD: the count fits its size, and the numbers are
/// coordinates. A number other than 0 with an absolute value below 1e-30 is no coordinate.
std::optional<std::endian> order_of(std::string_view start) {
  const auto* bytes = reinterpret_cast<const std::byte*>(start.data());
  if (start.size() < kCount + kPosition) return std::nullopt;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::uint64_t size = kCount + kPosition * number_at<std::uint32_t>(bytes, order);
    bool fits = start.size() < kTrajectoryStart ? size == start.size() : size > start.size();
    for (std::size_t at = kCount; fits && at + sizeof(double) <= start.size(); at += sizeof(double)) {
      const double number = std::abs(number_at<double>(bytes + at, order));
      fits = number == 0.0 || (number >= 1e-30 && number <= kLargestCoordinate);
    }
    if (fits) return order;
  }
  return std::nullopt;
}

class NamdCoordinates final : public Trajectory {
 public:
  NamdCoordinates(const std::string& path, std::endian order)
      : Trajectory(path, "NAMD coordinates"), file_(path), order_(order) {
    std::array<std::byte, kCount> count;
    file_.read(0, count);
    atom_count_ = number_at<std::uint32_t>(count.data(), order);
    frame_count_ = 1;
    if (path.ends_with(".vel")) throw InputError(path, 0, "holds velocities by its name, not positions");
  }

 private:
  void read_unchecked(std::uint64_t, Frame& frame) override {
    std::vector<std::byte> bytes(kPosition * atom_count_);
    file_.read(kCount, bytes);
    file_.check_unchanged();
    frame.positions.resize(atom_count_);
    for (std::size_t n = 0; n < 3 * atom_count_; ++n)
      frame.positions[n / 3][static_cast<int>(n % 3)] = number_at<double>(bytes.data() + n * sizeof(double), order_);
  }

  BinaryFile file_;
  std::endian order_;
};

/// Opens a file. NAMD writes PDB under the same name if its option binaryOutput is off.
std::unique_ptr<Trajectory> open(const std::string& path, const TrajectoryOptions& options) {
  const BinaryFile file(path);
  std::string start(std::min<std::uint64_t>(file.size(), kTrajectoryStart), '\0');
  file.read(0, std::as_writable_bytes(std::span(start)));
  if (const auto order = order_of(start)) return std::make_unique<NamdCoordinates>(path, *order);
  if (start.find('\0') == std::string::npos) return kModelsFormat.open(path, options);
  throw InputError(path, 0,
                   "is not a coordinate file of NAMD, a number of atoms and as many positions; is it cut short?");
}

}  // namespace

const TrajectoryFormat kNamdCoordinatesFormat{
    {"NAMD coordinates", ".coor", "coordinates of one moment as NAMD writes them",
     "NAMD User's Guide, NAMD binary files",
     "positions, of both byte orders; where the file is text, the PDB that it is"},
    [](std::string_view start) { return order_of(start).has_value(); },
    open};

}  // namespace meniscus
