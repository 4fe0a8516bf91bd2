// SPDX-License-Identifier: BSD-3-Clause
// Reads TRR trajectories of GROMACS: big-endian positions in nanometres, in single or double precision.

#include "core/base/binary_file.h"
#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

constexpr std::int32_t kMagic = 1993;
constexpr std::size_t kTag = 12;       // magic, then the length of the title with and without its end
constexpr std::size_t kIntegers = 13;  // ten sizes, atoms, step, one more; time and lambda follow
constexpr std::int32_t kLongestTitle = 80;

template <typename Number>
Number big_endian(const std::byte* bytes) {
  return number_at<Number>(bytes, std::endian::big);
}

struct TrrHeader {
  bool is_double = false;
  std::size_t atoms = 0;
  std::int32_t step = 0;
  std::uint64_t title_bytes = 0, header_bytes = 0;
  // The sizes of the box, of the data between box and positions, and of the positions.
  std::uint64_t box_bytes = 0, between_bytes = 0, position_bytes = 0;
  std::uint64_t rest_bytes = 0;  // bytes of velocities and forces

  std::uint64_t time_offset() const { return kTag + title_bytes + 4 * kIntegers; }
  std::uint64_t position_offset() const { return header_bytes + box_bytes + between_bytes; }
  std::uint64_t frame_bytes() const { return position_offset() + position_bytes + rest_bytes; }
};

/// Returns the bytes of one number, which follow from the sizes of the parts of a frame. Returns 0 if the sizes fit
/// neither precision.
std::size_t bytes_of_number(const std::array<std::int64_t, kIntegers>& sizes, std::int64_t atoms) {
  for (const std::int64_t width : {sizeof(float), sizeof(double)}) {
    const std::int64_t box = 9 * width, vectors = 3 * atoms * width;
    const auto fits = [](std::int64_t size, std::int64_t expected) { return size == 0 || size == expected; };
    if (fits(sizes[2], box) && fits(sizes[3], box) && fits(sizes[4], box) && fits(sizes[7], vectors) &&
        fits(sizes[8], vectors) && fits(sizes[9], vectors) && (sizes[2] | sizes[7] | sizes[8] | sizes[9]) != 0)
      return static_cast<std::size_t>(width);
  }
  return 0;
}

/// Parses a header. Returns what is wrong, as the predicate of a sentence, or an empty text. A header that ends too
/// early gets a size beyond any file.
std::string parse(std::span<const std::byte> bytes, TrrHeader& header) {
  header.header_bytes = std::uint64_t{1} << 62;
  if (bytes.size() < 4) return {};
  if (const auto magic = big_endian<std::int32_t>(bytes.data()); magic != kMagic)
    return fmt::format("begins with {}, not with {}", magic, kMagic);
  if (bytes.size() < kTag) return {};
  // GROMACS writes the title "GMX_trn_file"; cpptraj wrote its own name before 2016. It is padded to a multiple of four
  // letters.
  const auto letters = big_endian<std::int32_t>(bytes.data() + 8);
  if (letters < 0 || letters > kLongestTitle || big_endian<std::int32_t>(bytes.data() + 4) != letters + 1)
    return fmt::format("has a title of {} letters", letters);
  header.title_bytes = (static_cast<std::uint64_t>(letters) + 3) / 4 * 4;
  if (bytes.size() < header.time_offset()) return {};
  std::array<std::int64_t, kIntegers> numbers;
  for (std::size_t n = 0; n < kIntegers; ++n)
    numbers[n] = big_endian<std::int32_t>(bytes.data() + kTag + header.title_bytes + 4 * n);
  const std::int64_t atoms = numbers[10];
  if (atoms <= 0) return fmt::format("has {} atoms", atoms);
  if (std::any_of(numbers.begin(), numbers.begin() + 10, [](std::int64_t size) { return size < 0; }))
    return "has a part of negative size";
  const std::size_t width = bytes_of_number(numbers, atoms);
  if (width == 0) return fmt::format("has parts whose sizes do not belong to {} atoms", atoms);
  const auto size = [&](std::size_t n) { return static_cast<std::uint64_t>(numbers[n]); };
  header.is_double = width == sizeof(double);
  header.atoms = static_cast<std::size_t>(atoms);
  header.step = static_cast<std::int32_t>(numbers[11]);
  header.header_bytes = header.time_offset() + 2 * width;
  header.box_bytes = size(2);
  header.between_bytes = size(3) + size(4);
  header.position_bytes = size(7);
  // The two sizes before and the two after the pressure belong to run input files. Otherwise they are zero.
  header.rest_bytes = size(8) + size(9);
  if (numbers[0] != 0 || numbers[1] != 0 || numbers[5] != 0 || numbers[6] != 0)
    return "holds parts of a run input file";
  return {};
}

class Trr final : public Trajectory {
 public:
  Trr(const std::string& path, const TrajectoryOptions& options) : Trajectory(path, "TRR"), file_(path) {
    index_ = find_frames(file_, options.index_folder, [this](std::uint64_t offset) {
      TrrHeader header;
      std::string fault = read_header(offset, header);
      return FrameExtent{header.frame_bytes(), header.position_bytes > 0, std::move(fault)};
    });
    cut_short_ = index_.cut_short;
    frame_count_ = index_.offsets.size();
    TrrHeader first;
    read_header(index_.offsets.front(), first);
    atom_count_ = first.atoms;
  }

 private:
  std::string read_header(std::uint64_t offset, TrrHeader& header) {
    bytes_.resize(std::min<std::uint64_t>(kTag + kLongestTitle + 4 * kIntegers, file_.size() - offset));
    file_.read(offset, bytes_);
    return parse(bytes_, header);
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    const std::uint64_t offset = index_.offsets[number];
    TrrHeader header;
    std::string fault = read_header(offset, header);
    if (fault.empty() && header.position_bytes == 0) fault = "holds no positions any more";
    if (fault.empty()) {
      bytes_.resize(header.position_offset() + header.position_bytes);
      file_.read(offset, bytes_);
    }
    file_.check_unchanged();
    if (!fault.empty())
      throw InputError(path_, 0,
                       message("frame {} at byte {} {}; leave it out by @frames@, or write the file again", number,
                               with_thousands(offset), fault));
    time_precision_ = header.is_double ? kDoublePrecision : kSinglePrecision;
    header.is_double ? copy<double>(header, frame) : copy<float>(header, frame);
  }

  template <typename Number>
  void copy(const TrrHeader& header, Frame& frame) const {
    const auto nanometres = [&](std::uint64_t place) {
      return kAngstromPerNanometre * double{big_endian<Number>(bytes_.data() + place)};
    };
    frame.step = header.step;
    if (const double time = big_endian<Number>(bytes_.data() + header.time_offset()); std::isfinite(time))
      frame.time = time;
    if (header.box_bytes > 0) {
      glm::dmat3 box;
      for (std::size_t n = 0; n < 9; ++n)
        box[static_cast<int>(n / 3)][static_cast<int>(n % 3)] = nanometres(header.header_bytes + n * sizeof(Number));
      frame.cell = cell_of_vectors(box);
    }
    frame.positions.resize(header.atoms);
    std::uint64_t place = header.position_offset();
    for (glm::dvec3& position : frame.positions) {
      for (int axis = 0; axis < 3; ++axis, place += sizeof(Number)) position[axis] = nanometres(place);
    }
  }

  BinaryFile file_;
  FrameIndex index_;
  std::vector<std::byte> bytes_;
};

bool recognizes(std::string_view start) {
  return start.size() >= kTag && big_endian<std::int32_t>(reinterpret_cast<const std::byte*>(start.data())) == kMagic;
}

}  // namespace

const TrajectoryFormat kTrrFormat{
    {"TRR", ".trr", "full-precision trajectories of GROMACS, in nanometres", "GROMACS manual, file formats: trr",
     "positions in single or double precision, boxes, steps and times; frames without positions are passed over, "
     "velocities "
     "and forces ignored"},
    recognizes,
    [](const std::string& path, const TrajectoryOptions& options) {
      return std::unique_ptr<Trajectory>(std::make_unique<Trr>(path, options));
    }};

}  // namespace meniscus
