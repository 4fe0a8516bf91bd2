// SPDX-License-Identifier: BSD-3-Clause
// Reads DCD trajectories of CHARMM and NAMD, and NAMD's binary files of one frame of coordinates.

#include <cmath>

#include "core/base/binary_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

constexpr std::size_t kHeaderRecord = 84;  // "CORD" and twenty integers
constexpr std::size_t kCellRecord = 6 * sizeof(double);
constexpr double kPicosecondsPerAkma = 4.888821e-2;  // unit of time of CHARMM
constexpr int kFirstCharmmWithShapeMatrix = 25;      // NAMD, VMD and compatible programs write version 24

/// The format of the length markers before and after each Fortran record.
struct Markers {
  std::endian order = std::endian::little;
  std::size_t size = 4;

  std::uint64_t at(const std::byte* bytes) const {
    return size == 4 ? number_at<std::uint32_t>(bytes, order) : number_at<std::uint64_t>(bytes, order);
  }
};

/// Returns the markers of a file by its first record, which has 84 bytes and begins with CORD or VELD.
std::optional<Markers> markers_of(std::string_view start) {
  const auto* bytes = reinterpret_cast<const std::byte*>(start.data());
  for (const std::size_t size : {std::size_t{4}, std::size_t{8}}) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      const Markers markers{order, size};
      if (start.size() < size + 4 || markers.at(bytes) != kHeaderRecord) continue;
      const std::string_view word = start.substr(size, 4);
      if (word == "CORD" || word == "VELD") return markers;
    }
  }
  return std::nullopt;
}

/// True for the edges of 0 or 1 Å by which programs say that there is no box.
bool means_no_box(const std::array<double, 6>& numbers) {
  return std::abs(numbers[0]) <= 1.0 && std::abs(numbers[2]) <= 1.0 && std::abs(numbers[5]) <= 1.0;
}

/// Returns the box from six numbers, in any form that versions of CHARMM and NAMD have written. These are A gamma B
/// beta alpha C with angles in degrees or as cosines, and the symmetric shape matrix of CHARMM as the rows of its lower
/// half.
std::optional<glm::dmat3> cell_of_record(const std::array<double, 6>& numbers, bool written_by_charmm) {
  if (means_no_box(numbers)) return std::nullopt;
  const auto& [n0, n1, n2, n3, n4, n5] = numbers;
  const glm::dmat3 shape(glm::dvec3(n0, n1, n3), glm::dvec3(n1, n2, n4), glm::dvec3(n3, n4, n5));
  const bool right_angles = n1 == 90.0 && n3 == 90.0 && n4 == 90.0;
  const bool positive_definite = n0 > 0.0 && n0 * n2 - n1 * n1 > 0.0 && glm::determinant(shape) > 0.0;
  if (written_by_charmm && positive_definite && !right_angles) return cell_of_vectors(shape);
  const glm::dvec3 edges(n0, n2, n5), angles(n4, n3, n1);
  if (std::abs(n1) <= 1.0 && std::abs(n3) <= 1.0 && std::abs(n4) <= 1.0) return cell_of_cosines(edges, angles);
  if (const auto cell = cell_of_angles(edges, angles)) return cell;
  return positive_definite ? cell_of_vectors(shape) : std::nullopt;
}

class Dcd final : public Trajectory {
 public:
  explicit Dcd(const std::string& path) : Trajectory(path, "DCD"), file_(path) {
    std::uint64_t offset = read_header();
    offset = read_fixed_atoms(read_atom_count(skip_titles(offset)));
    count_frames(offset);
    if (has_fixed_atoms()) read_unchecked(0, first_);
    warn_of_strange_cell();
  }

 private:
  bool has_fixed_atoms() const { return !free_atoms_.empty(); }

  [[noreturn]] void refuse(std::uint64_t offset, const std::string& what) const {
    throw InputError(path_, 0, "{} (byte {})", what, with_thousands(offset));
  }

  /// Reads a record that must have this length, and returns its content. `offset` becomes the offset after it.
  std::vector<std::byte> record(std::uint64_t& offset, std::uint64_t length, const char* what) const {
    std::vector<std::byte> bytes(length + 2 * markers_.size);
    file_.read(offset, bytes);
    check_markers(bytes.data(), length, offset, what);
    offset += bytes.size();
    bytes.resize(length + markers_.size);
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(markers_.size));
    return bytes;
  }

  void check_markers(const std::byte* record, std::uint64_t length, std::uint64_t offset,
                     const std::string& what) const {
    const std::uint64_t before = markers_.at(record), after = markers_.at(record + markers_.size + length);
    if (before == length && after == length) return;
    const std::uint64_t wrong = before == length ? after : before;
    refuse(before == length ? offset + markers_.size + length : offset,
           fmt::format("is damaged: the record with {} should have {} bytes, but a marker says {}", what,
                       with_thousands(length), with_thousands(wrong)));
  }

  template <typename Number>
  Number number(const std::byte* bytes) const {
    return number_at<Number>(bytes, markers_.order);
  }

  std::uint64_t read_header() {
    std::string start(std::min<std::uint64_t>(file_.size(), 16), '\0');
    file_.read(0, std::as_writable_bytes(std::span(start)));
    const auto markers = markers_of(start);
    if (!markers) refuse(0, "is not a DCD file: it does not begin with a record of 84 bytes and CORD");
    markers_ = *markers;
    std::uint64_t offset = 0;
    const std::vector<std::byte> header = record(offset, kHeaderRecord, "the header");
    if (static_cast<char>(header[0]) == 'V') refuse(0, "holds velocities, not positions");
    const auto integer = [&](std::size_t n) { return number<std::int32_t>(header.data() + 4 + 4 * n); };
    const int version = integer(19);  // X-PLOR writes version 0, and the time step in double precision
    promised_frames_ = integer(0);
    first_step_ = integer(1);
    steps_between_ = integer(2);
    fixed_count_ = integer(8);
    time_step_ = version == 0 ? number<double>(header.data() + 40) : number<float>(header.data() + 40);
    has_cell_ = version != 0 && integer(10) != 0;
    has_fourth_axis_ = version != 0 && integer(11) == 1;
    written_by_charmm_ = version >= kFirstCharmmWithShapeMatrix;
    return offset;
  }

  /// Skips the record of titles and returns the offset after it. It has the number of titles and 80 letters for each.
  /// Some versions of MDAnalysis wrote three titles, with markers for two. So where the markers disagree, the number of
  /// titles decides.
  std::uint64_t skip_titles(std::uint64_t offset) const {
    std::vector<std::byte> head(markers_.size + sizeof(std::int32_t));
    file_.read(offset, head);
    const std::uint64_t length = markers_.at(head.data());
    const std::int64_t titles = number<std::int32_t>(head.data() + markers_.size);
    const auto counted = static_cast<std::uint64_t>(sizeof(std::int32_t) + 80 * std::max<std::int64_t>(titles, 0));
    if (length > file_.size()) refuse(offset, "is damaged: its titles are longer than the file");
    std::vector<std::byte> marker(markers_.size);
    for (const std::uint64_t size : {length, counted}) {
      if (offset + size + 2 * markers_.size > file_.size()) continue;
      file_.read(offset + markers_.size + size, marker);
      if (markers_.at(marker.data()) == length) return offset + size + 2 * markers_.size;
    }
    refuse(offset, "is damaged: the markers about its titles disagree");
  }

  std::uint64_t read_atom_count(std::uint64_t offset) {
    const auto count = number<std::int32_t>(record(offset, sizeof(std::int32_t), "the number of atoms").data());
    if (count <= 0) refuse(offset, fmt::format("its header says {} atoms", count));
    if (static_cast<std::uint64_t>(count) > file_.size() / (3 * sizeof(float))) {
      refuse(offset,
             fmt::format("its header says {} atoms, but not one frame of them fits into the {} bytes of the file",
                         with_thousands(static_cast<std::uint64_t>(count)), with_thousands(file_.size())));
    }
    atom_count_ = static_cast<std::size_t>(count);
    return offset;
  }

  /// Reads the list of atoms that are not fixed, if some are. All frames but the first have only these atoms.
  std::uint64_t read_fixed_atoms(std::uint64_t offset) {
    if (fixed_count_ == 0) return offset;
    if (fixed_count_ < 0 || static_cast<std::size_t>(fixed_count_) >= atom_count_)
      refuse(offset, fmt::format("its header says {} fixed atoms of {}", fixed_count_, with_thousands(atom_count_)));
    const std::size_t free = atom_count_ - static_cast<std::size_t>(fixed_count_);
    const std::vector<std::byte> list = record(offset, free * sizeof(std::int32_t), "the atoms that move");
    for (std::size_t n = 0; n < free; ++n) {
      const auto atom = number<std::int32_t>(list.data() + n * sizeof(std::int32_t));
      if (atom < 1 || static_cast<std::size_t>(atom) > atom_count_)
        refuse(offset, fmt::format("its list of moving atoms names atom {} of {}", atom, with_thousands(atom_count_)));
      free_atoms_.push_back(static_cast<std::uint32_t>(atom - 1));
    }
    return offset;
  }

  std::uint64_t frame_bytes(std::uint64_t atoms) const {
    const std::uint64_t axis = atoms * sizeof(float) + 2 * markers_.size;
    return (has_cell_ ? kCellRecord + 2 * markers_.size : 0) + (has_fourth_axis_ ? 4 : 3) * axis;
  }

  /// Computes the number of frames from the size of the file. The number in the header is often wrong after a
  /// simulation was stopped or restarted, or the file was cut.
  void count_frames(std::uint64_t offset) {
    first_frame_ = offset;
    const std::uint64_t first = frame_bytes(atom_count_);
    const std::uint64_t others = has_fixed_atoms() ? frame_bytes(free_atoms_.size()) : first;
    const std::uint64_t rest = file_.size() - offset;
    if (rest < first)
      throw InputError(path_, 0, "holds no complete frame: {} of the {} bytes of the first", with_thousands(rest),
                       with_thousands(first));
    frame_count_ = 1 + (rest - first) / others;
    if ((rest - first) % others != 0) cut_short_ = cut_short_sentence(frame_count_);
    if (promised_frames_ < 0 || static_cast<std::uint64_t>(promised_frames_) != frame_count_) {
      warnings_.emplace_back(fmt::format("its header says {} frames, but it holds {}; these are used", promised_frames_,
                                         with_thousands(frame_count_)));
    }
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    const bool whole = number == 0 || !has_fixed_atoms();
    const std::size_t atoms = whole ? atom_count_ : free_atoms_.size();
    const std::uint64_t first = frame_bytes(atom_count_);
    std::uint64_t offset = number == 0 ? first_frame_ : first_frame_ + first + (number - 1) * frame_bytes(atoms);
    bytes_.resize(frame_bytes(atoms));
    file_.read(offset, bytes_);
    file_.check_unchanged();
    const std::byte* next = bytes_.data();
    if (has_cell_) {
      check_markers(next, kCellRecord, offset, fmt::format("the box of frame {}", number));
      frame.cell = cell_of_record(box_at(next + markers_.size), written_by_charmm_);
      next += kCellRecord + 2 * markers_.size;
      offset += kCellRecord + 2 * markers_.size;
    }
    frame.positions.resize(atom_count_);
    if (!whole) std::copy(first_.positions.begin(), first_.positions.end(), frame.positions.begin());
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t length = atoms * sizeof(float);
      check_markers(next, length, offset, fmt::format("{} of frame {}", "xyz"[axis], number));
      copy_axis(next + markers_.size, axis, whole, frame.positions);
      next += length + 2 * markers_.size;
      offset += length + 2 * markers_.size;
    }
    set_time(number, frame);
  }

  std::array<double, 6> box_at(const std::byte* bytes) const {
    std::array<double, 6> numbers;
    for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = number<double>(bytes + n * sizeof(double));
    return numbers;
  }

  void copy_axis(const std::byte* from, int axis, bool whole, std::vector<glm::dvec3>& to) const {
    if (whole) {
      for (std::size_t n = 0; n < to.size(); ++n) to[n][axis] = number<float>(from + n * sizeof(float));
    } else {
      for (std::size_t n = 0; n < free_atoms_.size(); ++n)
        to[free_atoms_[n]][axis] = number<float>(from + n * sizeof(float));
    }
  }

  /// The time step is a float in units of AKMA, and the factor to picoseconds has as many digits as a float.
  void set_time(std::uint64_t number, Frame& frame) const {
    if (steps_between_ <= 0) return;
    frame.step = first_step_ + static_cast<std::int64_t>(number) * steps_between_;
    const double step = with_fewest_digits(time_step_ * kPicosecondsPerAkma, 2 * kSinglePrecision);
    const double time = static_cast<double>(*frame.step) * step;
    if (time_step_ > 0.0 && std::isfinite(time)) frame.time = time;
  }

  void warn_of_strange_cell() {
    if (!has_cell_) return;
    std::array<std::byte, kCellRecord> record;
    file_.read(first_frame_ + markers_.size, record);
    const std::array<double, 6> box = box_at(record.data());
    if (means_no_box(box) || cell_of_record(box, written_by_charmm_)) return;
    warnings_.emplace_back("the box of its first frame has none of the forms that DCD knows; it is left out");
  }

  BinaryFile file_;
  Markers markers_;
  std::int32_t promised_frames_ = 0, first_step_ = 0, steps_between_ = 0, fixed_count_ = 0;
  double time_step_ = 0.0;  // the unit is that of AKMA
  bool has_cell_ = false, has_fourth_axis_ = false, written_by_charmm_ = false;
  std::vector<std::uint32_t> free_atoms_;  // empty if no atom is fixed
  std::uint64_t first_frame_ = 0;          // offset of the first frame
  Frame first_;                            // the first frame, for the positions of fixed atoms; empty without them
  std::vector<std::byte> bytes_;
};

bool recognizes(std::string_view start) { return markers_of(start).has_value(); }

}  // namespace

const TrajectoryFormat kDcdFormat{
    {"DCD", ".dcd", "trajectories of CHARMM, NAMD, X-PLOR, OpenMM and LAMMPS",
     "CHARMM documentation, dynamc.info; NAMD and VMD source of the dcd plugin, for what others write",
     "positions, boxes (edges with angles or cosines, shape matrix), steps and times; both byte orders, markers of 32 "
     "and "
     "64 bits, fixed atoms, a fourth axis; the size of the file says how many frames there are"},
    recognizes,
    [](const std::string& path, const TrajectoryOptions&) {
      return std::unique_ptr<Trajectory>(std::make_unique<Dcd>(path));
    }};

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
