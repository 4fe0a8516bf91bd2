// SPDX-License-Identifier: BSD-3-Clause
// Reads H5MD and the HDF5 files of MDTraj by the HDF5 library. It is compiled as a module of its own, which
// trajectory_formats.cpp loads.
#include "core/trajectory/formats/trajectory_formats.h"

#include <hdf5.h>

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/structure/structure.h"
#include "core/base/binary_file.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// An open object of the library, which is closed by the function for its kind.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// A data set of numbers and the lengths of its dimensions.
struct Table {
  Handle set;
  std::vector<hsize_t> lengths;
};

/// Keeps the library from printing messages about missing objects while it lives.
class ErrorSilencer {
 public:
  ErrorSilencer() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~ErrorSilencer() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  ErrorSilencer(const ErrorSilencer&) = delete;
  ErrorSilencer& operator=(const ErrorSilencer&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Prevents the library from cleaning up at the end of the process. Otherwise it looks for the objects of damaged files
/// that it lost, and prints that it found no end of them. All handles have been closed by then.
void disable_exit_cleanup() { [[maybe_unused]] static const herr_t status = H5dont_atexit(); }

bool has(hid_t place, const std::string& path) {
  // The library requires that every step of a path is checked on its own.
  for (std::size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
    if (H5Lexists(place, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(place, path.c_str(), H5P_DEFAULT) > 0;
}

/// True if the numbers are in other files that this file names. Reading a file must not make the program read others.
bool is_stored_elsewhere(hid_t set) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  return H5Pget_external_count(creation) != 0 || H5Pget_layout(creation) == H5D_VIRTUAL;
}

/// True if a value is a number of a size that processors have. For a damaged size the library might use all memory.
bool is_number(const Handle& type) {
  const H5T_class_t kind = H5Tget_class(type);
  const std::size_t size = H5Tget_size(type);
  return (kind == H5T_INTEGER || kind == H5T_FLOAT) && size >= 1 && size <= sizeof(long double);
}

/// True if numbers have the precision of a float, or less.
bool is_single(const Table& table) {
  if (!table.set) return false;
  const Handle type(H5Dget_type(table.set), H5Tclose);
  return H5Tget_class(type) == H5T_FLOAT && H5Tget_size(type) <= sizeof(float);
}

/// Opens the table at a path. The result is empty if there is none, or if it does not contain numbers that are stored
/// in this file.
Table table(hid_t place, const std::string& path) {
  Table result;
  if (!has(place, path)) return result;
  result.set = Handle(H5Dopen2(place, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!result.set || is_stored_elsewhere(result.set)) return {};
  if (!is_number(Handle(H5Dget_type(result.set), H5Tclose))) return {};
  const Handle space(H5Dget_space(result.set), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions > 0) {
    result.lengths.resize(static_cast<std::size_t>(dimensions));
    H5Sget_simple_extent_dims(space, result.lengths.data(), nullptr);
  }
  return result;
}

/// Returns the text of an attribute; empty if there is none, or if it is longer than 1000 bytes.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (!type || H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return {};
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute, type, &text) < 0 || !text) return {};
    std::string result(text);
    H5free_memory(text);
    return result;
  }
  const std::size_t size = H5Tget_size(type);
  if (size == 0 || size > 1000) return {};
  std::string text(size, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return {};
  return text.substr(0, text.find('\0'));
}

/// Returns the unit of length of a table in Å.
double length_unit(const Table& values, const std::string& path, std::vector<Warning>& warnings) {
  const std::string unit = text_attribute(values.set, "unit");
  if (unit == "nm") return kAngstromPerNanometre;
  if (unit == "pm") return 0.01;
  if (unit == "m") return 1e10;
  if (!unit.empty() && unit != "Angstrom" && unit != "angstrom" && unit != "A" && unit != "\u00c5")
    throw InputError(path, 0, "its positions are in {}; Angstrom, nm, pm and m are understood", in_quotes(unit));
  if (unit.empty()) warnings.emplace_back("it names no unit of length; its numbers are taken to be Å");
  return 1.0;
}

/// Returns the unit of time of a table in ps. 0 means that it is unknown, so that frames have no times.
double time_unit(const Table& times) {
  const std::string unit = times.set ? text_attribute(times.set, "unit") : std::string();
  if (unit == "fs") return 1e-3;
  if (unit == "ns") return 1e3;
  if (unit == "us") return 1e6;
  if (unit == "s") return 1e12;
  return unit.empty() || unit == "ps" ? 1.0 : 0.0;
}

class H5md final : public Trajectory {
 public:
  explicit H5md(const std::string& path) : Trajectory(path, "H5MD"), bytes_(path) {
    disable_exit_cleanup();  // must be the first call of the library
    const ErrorSilencer quiet;
    H5Lunregister(H5L_TYPE_EXTERNAL);  // disables links to other files; it does no harm if they were disabled before
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access, false, true);  // several readers of one file must not wait for each other
    H5Pset_sieve_buf_size(access, 0);  // after a failed read the library would take zeros in this buffer for data
    file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
    if (!file_) throw InputError(path, 0, "is damaged or cut short: the HDF5 library cannot open it");
    if (!has(file_, "particles") && text_attribute(file_, "conventions").find("Pande") != std::string::npos)
      open_mdtraj();
    else
      open_particles();
    if (is_single(time_)) time_precision_ = kSinglePrecision;
    const std::vector<hsize_t>& lengths = position_.lengths;
    if (lengths.size() != 3 || lengths[2] != 3 || lengths[1] == 0)
      throw InputError(path, 0, "{} is not x, y and z of atoms of frames", escaped(name_));
    if (lengths[0] == 0) throw InputError(path, 0, "holds no frames");
    frame_count_ = lengths[0];
    atom_count_ = lengths[1];
    check_plausible_size();
  }

 private:
  static herr_t collect(hid_t, const char* name, const H5L_info_t*, void* names) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  }

  void open_particles() {
    choose_group();
    position_ = table(group_, "position/value");
    if (position_.set) unit_ = length_unit(position_, path_, warnings_);
    name_ += "/position/value";
    time_ = table(group_, "position/time");
    time_unit_ = time_unit(time_);
    step_ = table(group_, "position/step");
    box_ = table(group_, "box/edges/value");
    if (!box_.set) box_ = table(group_, "box/edges");
  }

  /// Opens a file by MDTraj's own convention ("HDF5 format specification" of its manual). Units are nm, ps and degrees,
  /// which the attribute `units` repeats.
  void open_mdtraj() {
    format_ = "HDF5 of MDTraj";
    name_ = "coordinates";
    position_ = table(file_, name_);
    time_ = table(file_, "time");
    lengths_ = table(file_, "cell_lengths");
    angles_ = table(file_, "cell_angles");
    require_unit(position_, "nanometers");
    require_unit(time_, "picoseconds");
    require_unit(lengths_, "nanometers");
    require_unit(angles_, "degrees");
    unit_ = kAngstromPerNanometre;
  }

  void require_unit(const Table& values, const std::string& unit) const {
    const std::string found = values.set ? text_attribute(values.set, "units") : std::string();
    if (!found.empty() && found != unit)
      throw InputError(path_, 0, "names {} as a unit where MDTraj writes {}", in_quotes(found), unit);
  }

  /// Chooses the first group of particles with positions, in alphabetical order.
  void choose_group() {
    std::vector<std::string> names;
    if (!has(file_, "particles"))
      throw InputError(path_, 0, "is HDF5, but neither H5MD nor of MDTraj: it has no group 'particles'");
    const Handle particles(H5Gopen2(file_, "particles", H5P_DEFAULT), H5Gclose);
    H5Literate(particles, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
    std::erase_if(names, [&](const std::string& name) { return !has(particles, name + "/position/value"); });
    if (names.empty()) throw InputError(path_, 0, "is H5MD without positions that change with time");
    name_ = "particles/" + names.front();
    group_ = Handle(H5Gopen2(particles, names.front().c_str(), H5P_DEFAULT), H5Gclose);
    if (names.size() > 1) {
      warnings_.emplace_back(fmt::format("it has {} groups of particles; the positions of {} are used", names.size(),
                                         in_quotes(names.front())));
    }
  }

  /// Throws InputError if the file is too small for its atoms and frames. Compression of positions never reaches a
  /// factor of a thousand, and a damaged header would exhaust the memory. Frames that were never written take no space,
  /// and would be read as zeros.
  void check_plausible_size() const {
    const double frame = static_cast<double>(atom_count_) * 3 * sizeof(float),
                 size = static_cast<double>(bytes_.size());
    if (frame > 1000.0 * size || frame * static_cast<double>(frame_count_) > 10'000.0 * size)
      throw InputError(path_, 0, "says {} atoms in {} frames, far more than its {} bytes can hold",
                       with_thousands(atom_count_), with_thousands(frame_count_), with_thousands(bytes_.size()));
  }

  /// Reads the part of a table that belongs to one frame. The first dimension counts frames. False if that fails.
  bool read_frame_of(const Table& from, std::uint64_t number, hid_t type, void* numbers) const {
    const Handle space(H5Dget_space(from.set), H5Sclose);
    std::vector<hsize_t> start(from.lengths.size(), 0), count = from.lengths;
    start[0] = number;
    count[0] = 1;
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0) return false;
    const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
    return H5Dread(from.set, type, memory, space, H5P_DEFAULT, numbers) >= 0;
  }

  /// Returns the number of a frame from a table with one number per frame. A table with a single number has the
  /// increment from frame to frame.
  template <typename Number>
  std::optional<Number> number_of(const Table& from, std::uint64_t frame, hid_t type) const {
    Number number{};
    if (!from.set) return std::nullopt;
    if (from.lengths.size() == 1 && frame < from.lengths[0])
      return read_frame_of(from, frame, type, &number) ? std::optional(number) : std::nullopt;
    if (!from.lengths.empty() || H5Dread(from.set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &number) < 0)
      return std::nullopt;
    Number offset{};
    if (H5Aexists(from.set, "offset") > 0) {
      const Handle attribute(H5Aopen(from.set, "offset", H5P_DEFAULT), H5Aclose);
      const Handle space(H5Aget_space(attribute), H5Sclose);
      if (!is_number(Handle(H5Aget_type(attribute), H5Tclose))) return std::nullopt;
      if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(attribute, type, &offset) < 0) return std::nullopt;
    }
    return sum_of(offset, number, frame);
  }

  /// Returns offset + number * frame, or nothing if an integer overflows.
  static std::optional<double> sum_of(double offset, double number, std::uint64_t frame) {
    return offset + number * static_cast<double>(frame);
  }
  static std::optional<std::int64_t> sum_of(std::int64_t offset, std::int64_t number, std::uint64_t frame) {
    std::int64_t sum = 0;
    if (__builtin_mul_overflow(number, frame, &sum) || __builtin_add_overflow(sum, offset, &sum)) return std::nullopt;
    return sum;
  }

  /// Returns three numbers of a frame from a table, or nothing.
  std::optional<glm::dvec3> three_of(const Table& from, std::uint64_t frame) const {
    glm::dvec3 numbers(0.0);
    if (!from.set || from.lengths != std::vector<hsize_t>{frame_count_, 3}) return std::nullopt;
    return read_frame_of(from, frame, H5T_NATIVE_DOUBLE, &numbers.x) ? std::optional(numbers) : std::nullopt;
  }

  std::optional<glm::dmat3> cell_at(std::uint64_t frame) const {
    const std::optional<glm::dvec3> sides = three_of(lengths_, frame), angles = three_of(angles_, frame);
    if (sides && angles) return cell_of_angles(unit_ * *sides, *angles);
    if (!box_.set) return std::nullopt;
    std::array<double, 9> numbers{};
    const std::vector<hsize_t>& lengths = box_.lengths;
    const bool fixed = lengths == std::vector<hsize_t>{3} || lengths == std::vector<hsize_t>{3, 3};
    const bool edges = lengths.size() == 2 && lengths[0] == frame_count_ && lengths[1] == 3;
    const bool vectors = lengths.size() == 3 && lengths[0] == frame_count_ && lengths[1] == 3 && lengths[2] == 3;
    if (edges || vectors) {
      if (!read_frame_of(box_, frame, H5T_NATIVE_DOUBLE, numbers.data())) return std::nullopt;
    } else if (!fixed || H5Dread(box_.set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
      return std::nullopt;
    }
    glm::dmat3 cell(0.0);
    for (int n = 0; n < 9; ++n) cell[n / 3][n % 3] = unit_ * numbers[static_cast<std::size_t>(n)];
    if (edges || lengths.size() == 1)
      cell = glm::dmat3(unit_ * numbers[0], 0.0, 0.0, 0.0, unit_ * numbers[1], 0.0, 0.0, 0.0, unit_ * numbers[2]);
    return cell_of_vectors(cell);
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    const ErrorSilencer quiet;
    numbers_.resize(3 * atom_count_);
    const bool good = read_frame_of(position_, number, H5T_NATIVE_DOUBLE, numbers_.data());
    bytes_.check_unchanged();
    if (!good) throw InputError(path_, 0, "frame {} is damaged: the HDF5 library cannot read its positions", number);
    frame.positions.resize(atom_count_);
    for (std::size_t n = 0; n < atom_count_; ++n)
      frame.positions[n] = unit_ * glm::dvec3(numbers_[3 * n], numbers_[3 * n + 1], numbers_[3 * n + 2]);
    frame.cell = cell_at(number);
    frame.step = number_of<std::int64_t>(step_, number, H5T_NATIVE_INT64);
    const auto time = number_of<double>(time_, number, H5T_NATIVE_DOUBLE);
    if (time && time_unit_ > 0.0 && std::isfinite(time_unit_ * *time)) frame.time = time_unit_ * *time;
  }

  BinaryFile bytes_;  // detects changes of the file
  Handle file_, group_;
  std::string name_;
  Table position_, time_, step_, box_;
  Table lengths_, angles_;  ///< lengths and angles of the box in files of MDTraj
  double unit_ = 1.0, time_unit_ = 1.0;
  std::vector<double> numbers_;
};

std::unique_ptr<Trajectory> open_h5md(const std::string& path) { return std::make_unique<H5md>(path); }

}  // namespace
}  // namespace meniscus

// Returns null for a program of another version, or with another layout of Frame.
extern "C" __attribute__((visibility("default"))) meniscus::OpenH5md* meniscus_open_h5md(const char* version,
                                                                                         std::size_t frame_size) {
  return version == std::string_view(MENISCUS_VERSION) && frame_size == sizeof(meniscus::Frame) ? meniscus::open_h5md
                                                                                                : nullptr;
}
