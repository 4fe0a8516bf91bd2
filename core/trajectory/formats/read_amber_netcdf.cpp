// SPDX-License-Identifier: BSD-3-Clause
// Reads trajectories and restart files of Amber in NetCDF.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/formats/binary_file.h"
#include "core/trajectory/formats/cell.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/formats/netcdf_layout.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kFloat = 5, kDouble = 6;

/// A variable with a value for each frame.
struct PerFrame {
  std::uint64_t begin = 0, stride = 0, count = 0;  ///< count: numbers of a frame
  std::uint64_t bytes = 0;                         ///< of a frame
  bool doubles = false;
  double scale = 1.0;
};

class AmberNetcdf final : public Trajectory {
 public:
  explicit AmberNetcdf(const std::string& path) : Trajectory(path, "Amber NetCDF"), file_(path) {
    const NetcdfLayout layout = read_netcdf_layout(file_);
    const auto convention = layout.texts.find("Conventions");
    if (convention == layout.texts.end() || convention->second.find("AMBER") == std::string::npos) {
      throw InputError(path, 0,
                       fmt::format("is NetCDF, but not by the convention of Amber ({}); only that is read",
                                   convention == layout.texts.end() ? "it names none" : in_quotes(convention->second)));
    }
    find_coordinates(layout);
    time_ = find(layout, "time", 1);
    if (time_ && !time_->doubles) time_precision_ = kSinglePrecision;
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
    // A restart file has one frame, without a dimension for it; some writers give frames a fixed number.
    single_ = !variable.has_records && lengths.size() == 2;
    if (!variable.has_records && lengths.size() == 3) fixed_frames_ = lengths[0];
    const bool shaped = lengths.size() == (variable.has_records || single_ ? 2U : 3U);
    if (!shaped || lengths.back() != 3 || lengths[lengths.size() - 2] == 0)
      throw InputError(path_, 0, "its 'coordinates' are not x, y and z of atoms of frames");
    atom_count_ = lengths[lengths.size() - 2];
    coordinates_ = *find(layout, "coordinates", 3 * atom_count_);
    const auto unit = variable.texts.find("units");
    if (unit != variable.texts.end() && unit->second.starts_with("nano")) coordinates_.scale *= 10.0;
  }

  /// The variable of this name, which has `count` numbers a frame; nothing if it is not there.
  std::optional<PerFrame> find(const NetcdfLayout& layout, const std::string& name, std::uint64_t count) const {
    const auto found = layout.variables.find(name);
    if (found == layout.variables.end()) return std::nullopt;
    const NetcdfVariable& variable = found->second;
    const std::uint64_t width = variable.type == kDouble ? sizeof(double) : sizeof(float);
    const std::uint64_t frames = variable.has_records || single_ ? 1 : fixed_frames_;
    if ((variable.type != kFloat && variable.type != kDouble) || variable.record_bytes != frames * count * width) {
      throw InputError(path_, 0,
                       fmt::format("its variable '{}' should hold {} floating-point numbers a frame", name, count));
    }
    const auto scale = variable.numbers.find("scale_factor");
    return PerFrame{
        variable.begin,           variable.has_records ? layout.record_stride : count * width, count, count * width,
        variable.type == kDouble, scale == variable.numbers.end() ? 1.0 : scale->second};
  }

  /// Frames that are whole in every variable used.
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
    const bool records = !single_ && fixed_frames_ == 0;
    const std::uint64_t promised = single_ ? 1 : !records ? fixed_frames_ : layout.records;
    const bool known = !records || layout.records_are_known;
    const std::uint64_t present = frames_by_size(records ? kMany : promised);
    frame_count_ = known ? std::min(promised, present) : present;
    if (frame_count_ == 0) {
      throw InputError(path_, 0,
                       present == 0 ? "holds not one whole frame; is it cut short?" : "its header says 0 frames");
    }
    if (known && present < promised) cut_short_ = cut_short_sentence(frame_count_);
    if (known && present > promised) {
      warnings_.emplace_back(
          fmt::format("its header says {} frames, but there are bytes for {}; the others are left out",
                      with_thousands(promised), with_thousands(present)));
    }
  }

  double number_of(const PerFrame& part, std::uint64_t n) const {
    const std::byte* at = bytes_.data() + n * (part.doubles ? sizeof(double) : sizeof(float));
    return part.scale *
           (part.doubles ? number_at<double>(at, std::endian::big) : number_at<float>(at, std::endian::big));
  }

  /// Reads the numbers of a frame into bytes_.
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
  bool single_ = false;
  std::uint64_t fixed_frames_ = 0;  // 0: frames are records
  PerFrame coordinates_;
  std::optional<PerFrame> time_, edges_, angles_;
  std::vector<std::byte> bytes_;
};

/// NetCDF-4 too, so that its reader names it.
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
