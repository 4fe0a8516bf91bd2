// SPDX-License-Identifier: BSD-3-Clause
// Reads XTC trajectories of GROMACS, whose coordinates are packed as small integers.

#include "core/base/binary_file.h"
#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// A compressed frame (GROMACS manual, file formats: xtc; after F. van Hoesel, 1994).
struct PackedCoordinates {
  float precision = 0.0F;                    ///< steps per nanometre
  std::array<std::int32_t, 3> lowest = {};   ///< least coordinates of all atoms, in steps
  std::array<std::int32_t, 3> highest = {};  ///< greatest coordinates of all atoms, in steps
  std::int32_t small_class = 0;              ///< index into the format's table of sizes of small differences
  /// Compressed positions; kPackedPadding readable bytes must follow, which do not belong to them.
  std::span<const std::byte> bits = {};
};

/// Bytes that must be readable after the end of PackedCoordinates::bits.
constexpr std::size_t kPackedPadding = 32;

__extension__ using Wide = unsigned __int128;

/// The ranges of small differences by class. They grow by the cube root of 2, so that the class is the number of bits
/// of three numbers together. The values are those of the format, including irregular ones. Classes begin at 9.
constexpr std::array<std::uint32_t, 73> kSmallSizes{
    0,       0,       0,       0,       0,        0,        0,       0,       0,       8,       10,
    12,      16,      20,      25,      32,       40,       50,      64,      80,      101,     128,
    161,     203,     256,     322,     406,      512,      645,     812,     1024,    1290,    1625,
    2048,    2580,    3250,    4096,    5060,     6501,     8192,    10321,   13003,   16384,   20642,
    26007,   32768,   41285,   52015,   65536,    82570,    104031,  131072,  165140,  208063,  262144,
    330280,  416127,  524287,  660561,  832255,   1048576,  1321122, 1664510, 2097152, 2642245, 3329021,
    4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216};
constexpr std::int32_t kFirstClass = 9;
constexpr std::uint32_t kLargestJointSize = 0xffffff;  // with a larger range the three numbers follow each other

constexpr std::size_t kMostBytesLeft = 8;  // usually none are left; a writer might fill up a word

using Steps = std::array<std::int64_t, 3>;
using Sizes = std::array<std::uint32_t, 3>;

int bit_width(Wide number) {
  const auto high = static_cast<std::uint64_t>(number >> 64);
  return high ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(number));
}

/// Reads bits from a stream, from the highest bit of each byte to the lowest. After the end it reads kPackedPadding
/// bytes of padding. overrun() must be checked before more than these are read.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bits) : bytes_(bits.data()), end_(bits.size() * 8) {}

  bool overrun() const { return next_ > end_; }
  std::size_t bytes_left() const { return overrun() ? 0 : (end_ - next_) / 8; }

  /// Reads at most 56 bits as a number.
  std::uint64_t take(int count) {
    if (count == 0) return 0;
    std::uint64_t word;
    std::memcpy(&word, bytes_ + (next_ >> 3), sizeof word);
    if constexpr (std::endian::native == std::endian::little) word = __builtin_bswap64(word);
    const std::uint64_t bits = word << (next_ & 7) >> (64 - count);
    next_ += static_cast<std::size_t>(count);
    return bits;
  }

  /// Reads three numbers below `sizes` that were combined as (x·size_y + y)·size_z + z into `count` bits. Whole bytes
  /// come first, beginning with the lowest, and then the remaining highest bits.
  Steps take_joint(int count, const Sizes& sizes) {
    return count <= 56 ? split(take_reversed(count), sizes) : split(take_wide(count), sizes);
  }

 private:
  std::uint64_t take_reversed(int count) {
    const std::uint64_t bits = take(count);
    const int left = count & 7, whole = count - left;
    if (whole == 0) return bits;
    const std::uint64_t bytes = __builtin_bswap64(bits >> left << (64 - whole));
    return bytes | (bits & ((std::uint64_t{1} << left) - 1)) << whole;
  }

  Wide take_wide(int count) {
    Wide number = 0;
    for (int shift = 0; count > 0; shift += 8, count -= 8) number |= Wide{take(count < 8 ? count : 8)} << shift;
    return number;
  }

  template <typename Number>
  static Steps split(Number number, const Sizes& sizes) {
    const Number upper = number / sizes[2], top = upper / sizes[1];
    return {static_cast<std::int64_t>(top), static_cast<std::int64_t>(upper - top * sizes[1]),
            static_cast<std::int64_t>(number - upper * sizes[2])};
  }

  const std::byte* bytes_;
  std::size_t end_, next_ = 0;
};

/// Reads full positions, and small differences of one class.
class StepReader {
 public:
  explicit StepReader(const PackedCoordinates& packed) : bits_(packed.bits), packed_(packed) {
    bool is_joint = true;
    Wide product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sizes_[axis] =
          static_cast<std::uint32_t>(packed.highest[axis]) - static_cast<std::uint32_t>(packed.lowest[axis]) + 1;
      widths_[axis] = std::bit_width(sizes_[axis]);
      is_joint = is_joint && sizes_[axis] <= kLargestJointSize;
      product *= sizes_[axis];
    }
    if (is_joint) joint_width_ = bit_width(product);
    set_small_class(packed.small_class);
  }

  BitReader& bits() { return bits_; }
  std::int32_t small_class() const { return small_class_; }
  bool small_class_is_known() const { return small_size_ != 0; }

  void set_small_class(std::int32_t number) {
    small_class_ = number;
    const bool known = number >= kFirstClass && number < static_cast<std::int32_t>(kSmallSizes.size());
    small_size_ = known ? kSmallSizes[static_cast<std::size_t>(number)] : 0;
  }

  Steps take_full() {
    Steps steps;
    if (joint_width_ > 0) {
      steps = bits_.take_joint(joint_width_, sizes_);
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis) steps[axis] = static_cast<std::int64_t>(bits_.take(widths_[axis]));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) steps[axis] += packed_.lowest[axis];
    return steps;
  }

  Steps take_near(const Steps& before) {
    Steps steps = bits_.take_joint(small_class_, {small_size_, small_size_, small_size_});
    for (std::size_t axis = 0; axis < 3; ++axis) steps[axis] += before[axis] - small_size_ / 2;
    return steps;
  }

 private:
  BitReader bits_;
  const PackedCoordinates& packed_;
  Sizes sizes_{};
  std::array<int, 3> widths_{};
  int joint_width_ = 0;  // bits of the three numbers combined; 0 if they follow each other
  std::int32_t small_class_ = 0;
  std::uint32_t small_size_ = 0;
};

std::string fault_of(const PackedCoordinates& packed) {
  if (!(packed.precision > 0.0F) || !std::isfinite(packed.precision))
    return fmt::format("has the precision {}", packed.precision);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t range = std::int64_t{packed.highest[axis]} - packed.lowest[axis];
    if (range < 0 || range >= std::int64_t{0xffffffff}) {
      return fmt::format("has coordinates {} from {} to {}", "xyz"[axis], packed.lowest[axis], packed.highest[axis]);
    }
  }
  if (packed.small_class < 0 || packed.small_class > static_cast<std::int32_t>(kSmallSizes.size()))
    return fmt::format("has the class {} of small differences, which the format does not know", packed.small_class);
  return {};
}

/// Unpacks as many positions (Å) as the span has. Returns what is wrong with the frame, as the predicate of a sentence;
/// empty if it is valid.
std::string unpack(const PackedCoordinates& packed, std::span<glm::dvec3> positions) {
  if (std::string fault = fault_of(packed); !fault.empty()) return fault;
  StepReader steps(packed);
  const double precision = packed.precision;
  bool is_inside = true;  // true while all atoms are within the extent of the header; damaged atoms are not
  const auto place = [&](std::size_t n, const Steps& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_inside = is_inside && at[axis] >= packed.lowest[axis] && at[axis] <= packed.highest[axis];
      // The product is exact, so that the quotient is the double nearest to the decimal number that was packed.
      positions[n][static_cast<int>(axis)] = 10.0 * static_cast<double>(at[axis]) / precision;
    }
  };
  std::size_t run = 0;  // number of near atoms that follow; unchanged until another number is read
  for (std::size_t n = 0; n < positions.size();) {
    const Steps full = steps.take_full();
    std::int32_t class_change = 0;
    if (steps.bits().take(1)) {
      const std::uint64_t code = steps.bits().take(5);
      run = code / 3;
      class_change = static_cast<std::int32_t>(code % 3) - 1;
    }
    if (steps.bits().overrun()) return fmt::format("has too few bits: they end at atom {}", n + 1);
    if (run == 0) {
      place(n++, full);
    } else {
      if (run >= positions.size() - n) return fmt::format("is damaged at atom {}: too many atoms follow", n + 1);
      if (!steps.small_class_is_known())
        return fmt::format("is damaged at atom {}: class {} of differences", n + 1, steps.small_class());
      // The first near atom comes before the full one, because the oxygen of a water is near to both hydrogens.
      Steps near = full;
      for (std::size_t k = 0; k < run; ++k) {
        near = steps.take_near(near);
        place(n++, near);
        if (k == 0) place(n++, full);
        if (steps.bits().overrun()) return fmt::format("has too few bits: they end at atom {}", n);
      }
    }
    if (!is_inside) return fmt::format("is damaged: atom {} lies outside of the extent that the frame names", n);
    if (class_change != 0) steps.set_small_class(steps.small_class() + class_change);
  }
  if (steps.bits().bytes_left() > kMostBytesLeft)
    return fmt::format("is damaged: {} bytes are left after its last atom", steps.bits().bytes_left());
  return {};
}

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
    if (!fault.empty())
      throw InputError(path_, 0,
                       message("frame {} at byte {} {}; leave it out by @frames@, or write the file again", number,
                               with_thousands(offset), fault));
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
