// SPDX-License-Identifier: BSD-3-Clause
// Finds the frames of a file one after another, and stores their offsets with a checksum.
#include "core/trajectory/formats/trajectory_formats.h"

#include <chrono>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/base/binary_file.h"
#include "core/base/system_file.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "meniscus frame index 1\n";

/// Returns the checksum FNV-1a of G. Fowler, L. C. Noll and K.-P. Vo, 64 bits.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return sum;
}

void append(std::string& bytes, std::uint64_t number) {
  const auto raw = std::bit_cast<std::array<char, sizeof number>>(number);
  bytes.append(raw.data(), raw.size());
}

void append(std::string& bytes, std::string_view text) {
  append(bytes, std::uint64_t{text.size()});
  bytes += text;
}

/// Returns the bytes with which the index of this file in its current state begins.
std::string identity(const BinaryFile& file) {
  std::string bytes(kMagic);
  append(bytes, text_of_path(fs::absolute(path_of_text(file.path()))));
  append(bytes, file.size());
  append(bytes, static_cast<std::uint64_t>(file.modified()));
  return bytes;
}

class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}
  std::uint64_t number() {
    if (rest_.size() < sizeof(std::uint64_t)) return 0;
    const auto number = number_at<std::uint64_t>(reinterpret_cast<const std::byte*>(rest_.data()), std::endian::native);
    rest_.remove_prefix(sizeof number);
    return number;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

std::optional<FrameIndex> load_index(const BinaryFile& file, const std::string& folder) {
  std::ifstream stream(path_of_text(frame_index_path(folder, file.path())), std::ios::binary);
  if (!stream) return std::nullopt;
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const std::string expected = identity(file);
  if (bytes.size() < expected.size() + sizeof(std::uint64_t) || !bytes.starts_with(expected)) return std::nullopt;
  const std::string_view content = std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint64_t));
  if (Fields(std::string_view(bytes).substr(content.size())).number() != checksum(content)) return std::nullopt;
  Fields fields(content.substr(expected.size()));
  FrameIndex index;
  const std::uint64_t count = fields.number();
  if (count == 0 || count > fields.rest().size() / sizeof(std::uint64_t)) return std::nullopt;
  index.offsets.resize(count);
  for (std::uint64_t& offset : index.offsets) offset = fields.number();
  if (std::ranges::max(index.offsets) >= file.size()) return std::nullopt;
  fields.number();
  index.cut_short = fields.rest();
  return index;
}

/// True if the file was changed in the last two seconds. It may change again without getting another time, so that its
/// index must not be stored.
bool changed_just_now(const BinaryFile& file) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count() - file.modified() < 2'000'000'000;
}

void store_index(const BinaryFile& file, const std::string& folder, const FrameIndex& index) {
  std::string bytes = identity(file);
  append(bytes, std::uint64_t{index.offsets.size()});
  for (const std::uint64_t offset : index.offsets) append(bytes, offset);
  append(bytes, std::string_view(index.cut_short));
  append(bytes, checksum(bytes));
  std::error_code ignored;
  fs::create_directories(path_of_text(folder), ignored);
  try {
    OutputFile output(path_of_text(frame_index_path(folder, file.path())), Existing::replace);
    output.write(bytes);
    output.commit();
  } catch (const OutputError&) {
    // Without a stored index the file is walked through again, which only costs time.
  }
}

FrameIndex walk(const BinaryFile& file, const std::function<FrameExtent(std::uint64_t)>& extent_at) {
  FrameIndex index;
  for (std::uint64_t offset = 0; offset < file.size();) {
    const FrameExtent extent = extent_at(offset);
    const std::uint64_t number = index.offsets.size();
    if (!extent.fault.empty()) {
      const std::string sentence =
          fmt::format("frame {} at byte {} {}", with_thousands(number), with_thousands(offset), extent.fault);
      if (number == 0) throw InputError(file.path(), 0, sentence);
      index.cut_short = sentence + (number == 1 ? "; the frame before it is used"
                                                : fmt::format("; the {} before it are used", with_thousands(number)));
      return index;
    }
    if (extent.bytes > file.size() - offset) {
      index.cut_short = cut_short_sentence(number);
      break;
    }
    if (extent.has_positions) index.offsets.push_back(offset);
    offset += extent.bytes;
  }
  return index;
}

}  // namespace

std::string frame_index_path(const std::string& folder, const std::string& path) {
  const std::string whole = text_of_path(fs::absolute(path_of_text(path)));
  return text_of_path(path_of_text(folder) / fmt::format("{:016x}.frames", checksum(whole)));
}

FrameIndex find_frames(BinaryFile& file, const std::string& folder,
                       const std::function<FrameExtent(std::uint64_t)>& extent_at) {
  if (!folder.empty()) {
    if (auto index = load_index(file, folder)) return *std::move(index);
  }
  FrameIndex index = walk(file, extent_at);
  file.check_unchanged();
  if (index.offsets.empty())
    throw InputError(file.path(), 0, "holds no complete frame{} in its {} bytes",
                     index.cut_short.empty() ? " with positions" : "", with_thousands(file.size()));
  if (!folder.empty() && !changed_just_now(file)) store_index(file, folder, index);
  return index;
}

}  // namespace meniscus
