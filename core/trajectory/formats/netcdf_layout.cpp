// SPDX-License-Identifier: BSD-3-Clause
// Parses headers of classic NetCDF strictly: every count is bounded by the bytes that follow.
#include "core/trajectory/formats/netcdf_layout.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/formats/binary_file.h"

namespace meniscus {
namespace {

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
      refuse("begins like no NetCDF file of the classic formats");
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
    throw InputError(file_.path(), 0, fmt::format("{} (byte {})", what, with_thousands(next_)));
  }

  const std::byte* take(std::uint64_t count) {
    if (count > bytes_.size() - next_) refuse("is damaged or cut short: its NetCDF header does not end");
    next_ += count;
    return bytes_.data() + next_ - count;
  }

  std::uint32_t word() { return number_at<std::uint32_t>(take(4), std::endian::big); }
  std::uint64_t wide() { return number_at<std::uint64_t>(take(8), std::endian::big); }
  std::uint64_t count() { return version_ == 5 ? wide() : word(); }

  /// The number of entries of a list; each takes at least 8 bytes.
  std::uint64_t list(std::uint32_t expected_tag) {
    const std::uint32_t tag = word();
    const std::uint64_t entries = count();
    if (tag == 0 && entries == 0) return 0;
    if (tag != expected_tag) refuse(fmt::format("is damaged: a list in its NetCDF header begins with {}", tag));
    if (entries > (bytes_.size() - next_) / 8)
      refuse(fmt::format("is damaged: {} entries are promised in its NetCDF header", with_thousands(entries)));
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
    if (record_variables == 1) layout.record_stride = unpadded;  // as the format has it
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
    count();  // its size, which the dimensions tell
    variable.begin = version_ == 1 ? word() : wide();
    return variable;
  }

  const BinaryFile& file_;
  std::vector<std::byte> bytes_;
  std::uint64_t next_ = 0;
  int version_ = 1;
  std::vector<std::uint64_t> lengths_;
};

}  // namespace

NetcdfLayout read_netcdf_layout(const BinaryFile& file) { return HeaderReader(file).run(); }

}  // namespace meniscus
