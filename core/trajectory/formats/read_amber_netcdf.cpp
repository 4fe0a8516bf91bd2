// SPDX-License-Identifier: BSD-3-Clause
// Reads trajectories and restart files of Amber in NetCDF. Their headers are parsed here, too.

#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/binary_file.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// A variable of NetCDF: an array of big-endian numbers.
struct NetcdfVariable {
  std::vector<std::uint64_t> lengths;  ///< lengths of its dimensions, without the dimension of records
  bool has_records = false;
  std::uint32_t type = 0;          ///< type code of the format: 5 is float, 6 double
  std::uint64_t begin = 0;         ///< offset of its first number
  std::uint64_t record_bytes = 0;  ///< bytes of one record, or of the whole variable if it has no records
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;  ///< attributes with one number of type float or double
};

/// The variables of a NetCDF file and how its records are stored.
struct NetcdfLayout {
  std::uint64_t records = 0;        ///< number of records according to the header
  bool records_are_known = true;    ///< false: the writer left the number open
  std::uint64_t record_stride = 0;  ///< bytes from a number to the same number of the next record
  std::map<std::string, std::string> texts;
  std::map<std::string, NetcdfVariable> variables;
};

constexpr std::uint64_t kLongestHeader = std::uint64_t{4} << 20;
constexpr std::uint32_t kDimensions = 10, kVariables = 11, kAttributes = 12;
constexpr std::uint32_t kText = 2, kFloat = 5, kDouble = 6;
constexpr std::array<std::uint64_t, 12> kTypeBytes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
constexpr std::uint64_t kLargestVariable = std::uint64_t{1} << 50;

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

class HeaderReader {
 public:
  explicit HeaderReader(const BinaryFile& file) : file_(file), bytes_(std::min(file.size(), kLongestHeader)) {
    file.read(0, bytes_);
  }

  NetcdfLayout run() {
    const std::string magic = text_of(4);
    if (magic == "\x89HDF") refuse("is NetCDF-4; convert it to the classic format: nccopy -k nc6 OLD NEW");
    if (!magic.starts_with("CDF") || (magic[3] != 1 && magic[3] != 2 && magic[3] != 5))
      refuse("does not begin like a NetCDF file of the classic formats");
    version_ = magic[3];
    NetcdfLayout layout;
    layout.records = count();
    layout.records_are_known = layout.records != (version_ == 5 ? ~std::uint64_t{0} : 0xffffffff);
    read_dimensions();
    std::map<std::string, double> ignored;
    read_attributes(layout.texts, ignored);
    read_variables(layout);
    return layout;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(file_.path(), 0, "{} (byte {})", what, with_thousands(next_));
  }

  const std::byte* take(std::uint64_t count) {
    if (count > bytes_.size() - next_) refuse("is damaged or cut short: its NetCDF header does not end");
    next_ += count;
    return bytes_.data() + next_ - count;
  }

  std::uint32_t word() { return number_at<std::uint32_t>(take(4), std::endian::big); }
  std::uint64_t wide() { return number_at<std::uint64_t>(take(8), std::endian::big); }
  std::uint64_t count() { return version_ == 5 ? wide() : word(); }

  /// Reads the tag and the length of a list, and returns the length. Each entry takes at least 8 bytes.
  std::uint64_t list(std::uint32_t expected_tag) {
    const std::uint32_t tag = word();
    const std::uint64_t entries = count();
    if (tag == 0 && entries == 0) return 0;
    if (tag != expected_tag) refuse(fmt::format("is damaged: a list in its NetCDF header begins with {}", tag));
    if (entries > (bytes_.size() - next_) / 8)
      refuse(fmt::format("is damaged: its NetCDF header announces {} entries", with_thousands(entries)));
    return entries;
  }

  std::string text_of(std::uint64_t length) {
    const auto* text = reinterpret_cast<const char*>(take(length));
    return {text, static_cast<std::size_t>(length)};
  }

  std::string name() {
    const std::uint64_t length = count();
    std::string text = text_of(length);
    take(padded(length) - length);
    return text;
  }

  std::uint64_t type_bytes(std::uint32_t type) const {
    if (type == 0 || type >= kTypeBytes.size()) refuse(fmt::format("is damaged: NetCDF has no type {}", type));
    return kTypeBytes[type];
  }

  void read_dimensions() {
    for (std::uint64_t left = list(kDimensions); left > 0; --left) {
      name();
      lengths_.push_back(count());
    }
  }

  void read_attributes(std::map<std::string, std::string>& texts, std::map<std::string, double>& numbers) {
    for (std::uint64_t left = list(kAttributes); left > 0; --left) {
      const std::string key = name();
      const std::uint32_t type = word();
      const std::uint64_t size = type_bytes(type), entries = count();
      if (entries > bytes_.size()) refuse("is damaged: an attribute of its NetCDF header is too long");
      const std::byte* value = take(padded(entries * size));
      if (type == kText)
        texts[key] = std::string(reinterpret_cast<const char*>(value), static_cast<std::size_t>(entries));
      if (entries != 1) continue;
      if (type == kFloat) numbers[key] = number_at<float>(value, std::endian::big);
      if (type == kDouble) numbers[key] = number_at<double>(value, std::endian::big);
    }
  }

  void read_variables(NetcdfLayout& layout) {
    std::uint64_t record_variables = 0, unpadded = 0;
    for (std::uint64_t left = list(kVariables); left > 0; --left) {
      const std::string key = name();
      const NetcdfVariable variable = read_variable();
      if (variable.has_records) {
        ++record_variables;
        unpadded = variable.record_bytes;
        layout.record_stride += padded(variable.record_bytes);
        if (layout.record_stride > kLargestVariable) refuse("is damaged: a record is larger than any disk");
      }
      layout.variables[key] = variable;
    }
    if (record_variables == 1) layout.record_stride = unpadded;  // special case of the format
  }

  NetcdfVariable read_variable() {
    NetcdfVariable variable;
    const std::uint64_t dimensions = count();
    if (dimensions > 1024) refuse(fmt::format("is damaged: a variable of {} dimensions", with_thousands(dimensions)));
    for (std::uint64_t n = 0; n < dimensions; ++n) {
      const std::uint64_t id = count();
      if (id >= lengths_.size()) refuse(fmt::format("is damaged: its NetCDF header has no dimension {}", id));
      if (n == 0 && lengths_[id] == 0) {
        variable.has_records = true;
      } else {
        variable.lengths.push_back(lengths_[id]);
      }
    }
    read_attributes(variable.texts, variable.numbers);
    variable.type = word();
    variable.record_bytes = type_bytes(variable.type);
    for (const std::uint64_t length : variable.lengths) {
      if (length > kLargestVariable / variable.record_bytes) refuse("is damaged: a variable is larger than any disk");
      variable.record_bytes *= length;
      if (length == 0) break;
    }
    count();  // the size of the variable, which follows from its dimensions
    variable.begin = version_ == 1 ? word() : wide();
    return variable;
  }

  const BinaryFile& file_;
  std::vector<std::byte> bytes_;
  std::uint64_t next_ = 0;
  int version_ = 1;
  std::vector<std::uint64_t> lengths_;
};

/// Reads the header of a file (NetCDF classic format specification: CDF-1, CDF-2 with offsets of 64 bits, CDF-5).
/// libnetcdf is not used, because it fills missing parts of a file that is cut short with zeros, and it does not give
/// the offsets of records. Throws InputError for another format, a damaged header, or a header above 4 MiB.
NetcdfLayout read_netcdf_layout(const BinaryFile& file) { return HeaderReader(file).run(); }

/// A variable with the same number of values for each frame.
struct PerFrame {
  /// Bytes from frame to frame; `count` is the number of values of a frame.
  std::uint64_t begin = 0, stride = 0, count = 0;
  std::uint64_t bytes = 0;  ///< bytes of the values of a frame
  bool is_double = false;
  double scale = 1.0;
};

class AmberNetcdf final : public Trajectory {
 public:
  explicit AmberNetcdf(const std::string& path) : Trajectory(path, "Amber NetCDF"), file_(path) {
    const NetcdfLayout layout = read_netcdf_layout(file_);
    const auto convention = layout.texts.find("Conventions");
    if (convention == layout.texts.end() || convention->second.find("AMBER") == std::string::npos)
      throw InputError(path, 0, "is NetCDF, but not by the convention of Amber ({}); only that is read",
                       convention == layout.texts.end() ? "it names none" : in_quotes(convention->second));
    find_coordinates(layout);
    time_ = find(layout, "time", 1);
    if (time_ && !time_->is_double) time_precision_ = kSinglePrecision;
    edges_ = find(layout, "cell_lengths", 3);
    angles_ = find(layout, "cell_angles", 3);
    count_frames(layout);
  }

 private:
  void find_coordinates(const NetcdfLayout& layout) {
    const auto found = layout.variables.find("coordinates");
    if (found == layout.variables.end()) throw InputError(path_, 0, "holds no variable 'coordinates'");
    const NetcdfVariable& variable = found->second;
    const std::vector<std::uint64_t>& lengths = variable.lengths;
    // A restart file has one frame, without a dimension of frames. Some writers fix the length of that dimension.
    is_single_ = !variable.has_records && lengths.size() == 2;
    if (!variable.has_records && lengths.size() == 3) fixed_frames_ = lengths[0];
    const bool shaped = lengths.size() == (variable.has_records || is_single_ ? 2U : 3U);
    if (!shaped || lengths.back() != 3 || lengths[lengths.size() - 2] == 0)
      throw InputError(path_, 0, "its 'coordinates' are not x, y and z of atoms of frames");
    atom_count_ = lengths[lengths.size() - 2];
    coordinates_ = *find(layout, "coordinates", 3 * atom_count_);
    const auto unit = variable.texts.find("units");
    if (unit != variable.texts.end() && unit->second.starts_with("nano")) coordinates_.scale *= 10.0;
  }

  /// Returns the variable of this name, which must have `count` numbers per frame; nothing if there is none.
  std::optional<PerFrame> find(const NetcdfLayout& layout, const std::string& name, std::uint64_t count) const {
    const auto found = layout.variables.find(name);
    if (found == layout.variables.end()) return std::nullopt;
    const NetcdfVariable& variable = found->second;
    const std::uint64_t width = variable.type == kDouble ? sizeof(double) : sizeof(float);
    const std::uint64_t frames = variable.has_records || is_single_ ? 1 : fixed_frames_;
    if ((variable.type != kFloat && variable.type != kDouble) || variable.record_bytes != frames * count * width) {
      throw InputError(path_, 0, "its variable '{}' should hold {} floating-point numbers per frame", name, count);
    }
    const auto scale = variable.numbers.find("scale_factor");
    return PerFrame{
        variable.begin,           variable.has_records ? layout.record_stride : count * width, count, count * width,
        variable.type == kDouble, scale == variable.numbers.end() ? 1.0 : scale->second};
  }

  /// Returns the number of frames that are complete in every variable, at most `most`.
  std::uint64_t frames_by_size(std::uint64_t most) const {
    for (const std::optional<PerFrame>& part : {std::optional(coordinates_), time_, edges_, angles_}) {
      if (!part) continue;
      const std::uint64_t end = part->begin + part->bytes;
      most = std::min(most, file_.size() < end || end < part->begin ? 0 : 1 + (file_.size() - end) / part->stride);
    }
    return most;
  }

  void count_frames(const NetcdfLayout& layout) {
    constexpr std::uint64_t kMany = std::uint64_t{1} << 60;
    const bool records = !is_single_ && fixed_frames_ == 0;
    const std::uint64_t promised = is_single_ ? 1 : !records ? fixed_frames_ : layout.records;
    const bool known = !records || layout.records_are_known;
    const std::uint64_t present = frames_by_size(records ? kMany : promised);
    frame_count_ = known ? std::min(promised, present) : present;
    if (frame_count_ == 0)
      throw InputError(path_, 0,
                       present == 0 ? "holds no complete frame; is it cut short?" : "its header says 0 frames");
    if (known && present < promised) cut_short_ = cut_short_sentence(frame_count_);
    if (known && present > promised) {
      warnings_.emplace_back(
          fmt::format("its header says {} frames, but there are bytes for {}; the others are left out",
                      with_thousands(promised), with_thousands(present)));
    }
  }

  double number_of(const PerFrame& part, std::uint64_t n) const {
    const std::byte* at = bytes_.data() + n * (part.is_double ? sizeof(double) : sizeof(float));
    return part.scale *
           (part.is_double ? number_at<double>(at, std::endian::big) : number_at<float>(at, std::endian::big));
  }

  /// Reads the numbers of a frame into bytes_. Returns `part`.
  const PerFrame& load(const PerFrame& part, std::uint64_t frame) {
    bytes_.resize(part.bytes);
    file_.read(part.begin + frame * part.stride, bytes_);
    return part;
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    if (time_) {
      const double time = number_of(load(*time_, number), 0);
      if (std::isfinite(time)) frame.time = time;
    }
    if (edges_ && angles_) {
      glm::dvec3 edges, angles;
      load(*edges_, number);
      for (int n = 0; n < 3; ++n) edges[n] = number_of(*edges_, static_cast<std::uint64_t>(n));
      load(*angles_, number);
      for (int n = 0; n < 3; ++n) angles[n] = number_of(*angles_, static_cast<std::uint64_t>(n));
      frame.cell = cell_of_angles(edges, angles);
    }
    load(coordinates_, number);
    file_.check_unchanged();
    frame.positions.resize(atom_count_);
    for (std::size_t n = 0; n < 3 * atom_count_; ++n)
      frame.positions[n / 3][static_cast<int>(n % 3)] = number_of(coordinates_, n);
  }

  BinaryFile file_;
  bool is_single_ = false;
  std::uint64_t fixed_frames_ = 0;  // 0 if frames are records
  PerFrame coordinates_;
  std::optional<PerFrame> time_, edges_, angles_;
  std::vector<std::byte> bytes_;
};

/// NetCDF-4 is recognized, too, so that the error of the reader can name it.
bool recognizes(std::string_view start) {
  if (start.starts_with("\x89HDF")) return true;
  return start.size() > 3 && start.starts_with("CDF") && (start[3] == 1 || start[3] == 2 || start[3] == 5);
}

}  // namespace

const TrajectoryFormat kAmberNetcdfFormat{
    {"Amber NetCDF", ".nc .ncdf .ncrst", "trajectories and restart files of Amber",
     "Amber NetCDF trajectory/restart convention 1.0; NetCDF classic format specification",
     "positions, boxes and times, of NetCDF's classic formats (CDF-1, CDF-2, CDF-5); velocities and forces are "
     "ignored"},
    recognizes,
    [](const std::string& path, const TrajectoryOptions&) {
      return std::unique_ptr<Trajectory>(std::make_unique<AmberNetcdf>(path));
    }};

}  // namespace meniscus
