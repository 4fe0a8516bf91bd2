// SPDX-License-Identifier: BSD-3-Clause
// Reads CCP4 maps and MRC files (A. Cheng et al., J. Struct. Biol. 192, 146, 2015, and CCP4's maplib).
//
// gemmi reads them, too, but in the other byte order only floats, and it trusts the header's sizes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/volume/read_volume.h"

namespace meniscus {
namespace {

constexpr std::size_t kHeader = 1024, kStamp = 208, kMachine = 212;  ///< bytes of the header; places of its stamps

class Ccp4Reader {
 public:
  Ccp4Reader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {
    if (bytes_.size() < kHeader) fail("is cut short: a header of a CCP4 map has 1,024 bytes");
    const char machine = bytes_[kMachine];
    if (machine != 0x44 && machine != 0x11)
      fail(fmt::format("has {:#04x} as its machine stamp; 0x44 (little endian) or 0x11 (big) are known",
                       static_cast<unsigned char>(machine)));
    swapped_ = (machine == 0x44) != (std::endian::native == std::endian::little);
  }

  VolumeGrid read() const {
    const std::array<int, 3> axis_of = axes();
    std::array<std::int64_t, 3> stored{word(1), word(2), word(3)};
    check_volume_size(path_, 0, stored);
    if (word(25) == 1 && word(50) == 0 && word(51) == 0 && word(52) == 0 && real(26) != 0.0F)
      fail("is rotated against its cell (LSKFLG); write it without rotation");
    VolumeFrame frame;
    std::array<std::size_t, 3> stride{};  // values of the file from one point to the next along each axis of space
    std::size_t run = 1;
    for (std::size_t n = 0; n < 3; ++n) {
      frame.size[axis_of[n]] = static_cast<std::size_t>(stored[n]);
      stride[axis_of[n]] = run;
      run *= static_cast<std::size_t>(stored[n]);
    }
    set_frame(axis_of, frame);
    return {path_, frame, values(frame, stride)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_, 0, what); }

  /// Returns a word of the header as an integer. Words are counted from 1, as in the format's description.
  std::int32_t word(std::size_t number) const { return number_at<std::int32_t>(4 * (number - 1)); }
  float real(std::size_t number) const { return number_at<float>(4 * (number - 1)); }

  template <typename Number>
  Number number_at(std::size_t at) const {
    char bytes[sizeof(Number)];
    for (std::size_t n = 0; n < sizeof bytes; ++n) bytes[n] = bytes_[at + (swapped_ ? sizeof bytes - 1 - n : n)];
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
  }

  /// Returns the axes of space that columns, rows and sections run along.
  std::array<int, 3> axes() const {
    std::array<int, 3> axis_of{word(17) - 1, word(18) - 1, word(19) - 1};
    if (axis_of == std::array<int, 3>{-1, -1, -1}) return {0, 1, 2};  // some programs leave them open
    for (int axis = 0; axis < 3; ++axis)
      if (std::ranges::count(axis_of, axis) != 1)
        fail(fmt::format("has axes in the order {}, {}, {}; each of 1, 2, 3 must appear once", word(17), word(18),
                         word(19)));
    return axis_of;
  }

  /// Sets the steps and the origin of the grid.
  void set_frame(const std::array<int, 3>& axis_of, VolumeFrame& frame) const {
    glm::dvec3 angle(90.0), length(0.0), start(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t intervals = word(8 + axis);
      if (intervals < 1) fail(fmt::format("has {} intervals along axis {} of its cell", intervals, axis + 1));
      length[axis] = static_cast<double>(real(11 + axis)) / intervals;
      angle[axis] = real(14 + axis) == 0.0F ? 90.0 : static_cast<double>(real(14 + axis));
      start[axis_of[axis]] = word(5 + axis);
      if (!(angle[axis] > 1.0 && angle[axis] < 179.0))
        fail(fmt::format("has {:.6g}° as an angle of its cell", angle[axis]));
    }
    const auto cosine = [&](int axis) {  // exactly 0 for a right angle
      return angle[axis] == 90.0 ? 0.0 : std::cos(angle[axis] * std::numbers::pi / 180.0);
    };
    const double alpha = cosine(0), beta = cosine(1), gamma = cosine(2), sine = std::sqrt(1.0 - gamma * gamma);
    const double y = (alpha - beta * gamma) / sine;
    frame.step[0] = {length.x, 0.0, 0.0};
    frame.step[1] = {length.y * gamma, length.y * sine, 0.0};
    frame.step[2] = length.z * glm::dvec3(beta, y, std::sqrt(std::max(0.0, 1.0 - beta * beta - y * y)));
    const glm::dvec3 origin(real(50), real(51), real(52));
    frame.origin = origin == glm::dvec3(0.0) ? frame.step * start : origin;
  }

  std::vector<float> values(const VolumeFrame& frame, const std::array<std::size_t, 3>& stride) const {
    switch (word(4)) {
      case 0:
        return values_of<std::int8_t>(frame, stride);
      case 1:
        return values_of<std::int16_t>(frame, stride);
      case 2:
        return values_of<float>(frame, stride);
      case 6:
        return values_of<std::uint16_t>(frame, stride);
      default:
        fail(fmt::format("has values of mode {}; 0, 1, 2 and 6 are read", word(4)));
    }
  }

  template <typename Number>
  std::vector<float> values_of(const VolumeFrame& frame, const std::array<std::size_t, 3>& stride) const {
    const std::int32_t extended = word(24);
    const std::size_t begin = kHeader + static_cast<std::size_t>(std::max(extended, 0));
    if (extended < 0 || begin > bytes_.size() || (bytes_.size() - begin) / sizeof(Number) < frame.count())
      fail(fmt::format("is cut short: {} values of {} bytes do not fit into the {} bytes after its header",
                       with_thousands(frame.count()), sizeof(Number),
                       with_thousands(bytes_.size() - std::min(begin, bytes_.size()))));
    std::vector<float> values;
    values.reserve(frame.count());
    for (std::size_t x = 0; x < frame.size[0]; ++x)
      for (std::size_t y = 0; y < frame.size[1]; ++y)
        for (std::size_t z = 0; z < frame.size[2]; ++z)
          values.push_back(static_cast<float>(
              number_at<Number>(begin + sizeof(Number) * (x * stride[0] + y * stride[1] + z * stride[2]))));
    return values;
  }

  const std::string& path_;
  std::string_view bytes_;
  bool swapped_ = false;
};

}  // namespace

bool is_ccp4(std::string_view bytes) { return bytes.size() > kStamp + 4 && bytes.substr(kStamp, 3) == "MAP"; }

VolumeGrid read_ccp4(const std::string& path, std::string_view bytes) { return Ccp4Reader(path, bytes).read(); }

}  // namespace meniscus
