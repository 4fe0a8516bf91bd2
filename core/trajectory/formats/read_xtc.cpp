// SPDX-License-Identifier: BSD-3-Clause
// Reads XTC trajectories of GROMACS: big-endian compressed coordinates in nanometres.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/message.h"
#include "core/base/binary_file.h"
#include "core/trajectory/formats/frame_index.h"
#include "core/trajectory/formats/packed_coordinates.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

constexpr std::int32_t kMagic = 1995, kMagicOfLargeSystems = 2023;
constexpr std::size_t kHeader = 56;  // magic, atoms, step, time, nine numbers of the box, atoms again
// Precision, extent, class, number of bytes (four bytes, or eight in large systems).
constexpr std::size_t kPackedHeader = 32;
constexpr std::size_t kLongestHeader = kHeader + kPackedHeader + 8;
constexpr std::size_t kMostPlainAtoms = 9;  // greatest number of atoms whose coordinates are not compressed

template <typename Number>
Number big_endian(const std::byte* bytes) {
  return number_at<Number>(bytes, std::endian::big);
}

/// The header of a frame.
struct XtcHeader {
  std::size_t atoms = 0;
  std::size_t data_offset = 0;  // bytes from the beginning of the frame
  std::uint64_t data_bytes = 0;
  PackedCoordinates packed;

  std::uint64_t frame_bytes() const { return data_offset + (data_bytes + 3) / 4 * 4; }
};

/// Parses a header. Returns what is wrong, as the predicate of a sentence, or an empty text. If the header ends too
/// early, the sizes are so large that the frame does not fit into the file.
std::string parse(std::span<const std::byte> bytes, XtcHeader& header) {
  header.data_bytes = header.data_offset = kLongestHeader;
  if (bytes.size() < 8) return {};
  const auto magic = big_endian<std::int32_t>(bytes.data());
  if (magic != kMagic && magic != kMagicOfLargeSystems)
    return fmt::format("begins with {}, not with {} or {}", magic, kMagic, kMagicOfLargeSystems);
  const auto atoms = big_endian<std::int32_t>(bytes.data() + 4);
  if (atoms <= 0) return fmt::format("has {} atoms", atoms);
  header.atoms = static_cast<std::size_t>(atoms);
  if (bytes.size() < kHeader) return {};
  if (const auto again = big_endian<std::int32_t>(bytes.data() + 52); again != atoms)
    return fmt::format("says {} atoms first, then {}", atoms, again);
  if (header.atoms <= kMostPlainAtoms) {
    header.data_offset = kHeader;
    header.data_bytes = header.atoms * 3 * sizeof(float);
    return {};
  }
  const bool large = magic == kMagicOfLargeSystems;
  header.data_offset = kHeader + kPackedHeader + (large ? 8 : 4);
  if (bytes.size() < header.data_offset) return {};
  const std::byte* next = bytes.data() + kHeader;
  header.packed.precision = big_endian<float>(next);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.packed.lowest[axis] = big_endian<std::int32_t>(next + 4 + 4 * axis);
    header.packed.highest[axis] = big_endian<std::int32_t>(next + 16 + 4 * axis);
  }
  header.packed.small_class = big_endian<std::int32_t>(next + 28);
  const std::int64_t count = large ? big_endian<std::int64_t>(next + 32) : big_endian<std::int32_t>(next + 32);
  // An atom takes at least two bits: one for its position, and one that tells whether near atoms follow.
  if (count <= 0 || static_cast<std::uint64_t>(count) < header.atoms / 4 || count > std::int64_t{1} << 48)
    return fmt::format("has {} bytes of packed coordinates for {} atoms", count, atoms);
  header.data_bytes = static_cast<std::uint64_t>(count);
  return {};
}

class Xtc final : public Trajectory {
 public:
  Xtc(const std::string& path, const TrajectoryOptions& options) : Trajectory(path, "XTC"), file_(path) {
    time_precision_ = kSinglePrecision;
    index_ = find_frames(file_, options.index_folder, [this](std::uint64_t offset) {
      XtcHeader header;
      std::string fault = read_header(offset, header);
      return FrameExtent{header.frame_bytes(), true, std::move(fault)};
    });
    cut_short_ = index_.cut_short;
    frame_count_ = index_.offsets.size();
    XtcHeader first;
    read_header(index_.offsets.front(), first);
    atom_count_ = first.atoms;
  }

 private:
  std::string read_header(std::uint64_t offset, XtcHeader& header) {
    bytes_.resize(std::min<std::uint64_t>(kLongestHeader, file_.size() - offset));
    file_.read(offset, bytes_);
    return parse(bytes_, header);
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    const std::uint64_t offset = index_.offsets[number];
    XtcHeader header;
    std::string fault = read_header(offset, header);
    if (fault.empty()) {
      bytes_.resize(header.frame_bytes());
      file_.read(offset, bytes_);
      bytes_.resize(bytes_.size() + kPackedPadding);
    }
    file_.check_unchanged();
    if (fault.empty()) fault = unpack_frame(header, frame);
    if (!fault.empty()) {
      throw InputError(path_, 0,
                       message("frame {} at byte {} {}; leave it out by @frames@, or write the file again", number,
                               with_thousands(offset), fault));
    }
  }

  std::string unpack_frame(XtcHeader& header, Frame& frame) const {
    const std::byte* start = bytes_.data();
    frame.step = big_endian<std::int32_t>(start + 8);
    if (const double time = big_endian<float>(start + 12); std::isfinite(time)) frame.time = time;
    glm::dmat3 box;
    for (int n = 0; n < 9; ++n)
      box[n / 3][n % 3] = kAngstromPerNanometre * double{big_endian<float>(start + 16 + 4 * n)};
    frame.cell = cell_of_vectors(box);
    frame.positions.resize(header.atoms);
    const std::byte* data = start + header.data_offset;
    if (header.atoms > kMostPlainAtoms) {
      header.packed.bits = {data, header.data_bytes};
      return unpack(header.packed, frame.positions);
    }
    for (std::size_t n = 0; n < 3 * header.atoms; ++n) {
      frame.positions[n / 3][static_cast<int>(n % 3)] =
          kAngstromPerNanometre * double{big_endian<float>(data + n * sizeof(float))};
    }
    return {};
  }

  BinaryFile file_;
  FrameIndex index_;
  std::vector<std::byte> bytes_;
};

bool recognizes(std::string_view start) {
  if (start.size() < kHeader) return false;
  const auto magic = big_endian<std::int32_t>(reinterpret_cast<const std::byte*>(start.data()));
  return magic == kMagic || magic == kMagicOfLargeSystems;
}

}  // namespace

const TrajectoryFormat kXtcFormat{{"XTC", ".xtc", "packed trajectories of GROMACS, in nanometres",
                                   "GROMACS manual, file formats: xtc; compression by F. van Hoesel (1994)",
                                   "positions, boxes (triclinic too), steps and times; of old files and of those of "
                                   "large systems (2023), beyond 4 GiB; "
                                   "frames are found by walking through the file once"},
                                  recognizes,
                                  [](const std::string& path, const TrajectoryOptions& options) {
                                    return std::unique_ptr<Trajectory>(std::make_unique<Xtc>(path, options));
                                  }};

}  // namespace meniscus
