// SPDX-License-Identifier: BSD-3-Clause
// Lists the trajectory formats, chooses one by content, loads the module that reads H5MD, finds the frames of a file
// one after another, and stores their offsets with a checksum.
#include "core/trajectory/formats/trajectory_formats.h"

#include <chrono>
#include <fstream>
#include <iterator>

#include "core/base/binary_file.h"
#include "core/base/error.h"
#include "core/base/module_file.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// A new format has a file read_<name>.cpp, a declaration in trajectory_formats.h and an entry before the last.
constexpr std::array<const TrajectoryFormat*, 10> kFormats{
    &kXtcFormat,          &kTrrFormat,         &kDcdFormat,
    &kH5mdFormat,         &kAmberNetcdfFormat, &kMdcrdFormat,
    &kAmberRestartFormat, &kLammpsFormat,      &kNamdCoordinatesFormat,
    &kModelsFormat};
constexpr std::span<const TrajectoryFormat* const> kBareFormats{kFormats.data(), kFormats.size() - 1};

std::string bare_format_names() {
  std::string names;
  for (const TrajectoryFormat* format : kBareFormats) names += fmt::format("{}, ", format->metadata.name);
  return names;
}

const TrajectoryFormat* format_by_name(std::string_view path) {
  const auto found =
      std::ranges::find_if(kBareFormats, [&](const TrajectoryFormat* format) { return format->metadata.names(path); });
  return found == kBareFormats.end() ? nullptr : *found;
}

const TrajectoryFormat* format_by_content(std::string_view start) {
  const auto found = std::find_if(kBareFormats.begin(), kBareFormats.end(),
                                  [&](const TrajectoryFormat* format) { return format->recognizes(start); });
  return found == kBareFormats.end() ? nullptr : *found;
}

std::string start_of(const std::string& path) {
  const BinaryFile file(path);
  std::string start(std::min<std::uint64_t>(file.size(), kTrajectoryStart), '\0');
  file.read(0, std::as_writable_bytes(std::span(start)));
  return start;
}

/// True if the file begins with the version of the program as an XDR string, with its length before it twice.
bool is_run_input(std::string_view start) {
  constexpr std::string_view kLengths("\0\0\0", 3);
  return start.size() > 16 && start.starts_with(kLengths) && start.substr(4).starts_with(kLengths) &&
         start.substr(8).starts_with("VERSION ");
}

[[noreturn]] void refuse_run_input(const std::string& path) {
  throw InputError(
      path, 0,
      "is a run input file of GROMACS (TPR), whose format changes with each version and is not read; give its "
      "atoms as a PDB file: gmx editconf -f run.tpr -conect -o run.pdb");
}

const TrajectoryFormat& choose_format(const std::string& path, const std::string& start) {
  if (is_run_input(start)) refuse_run_input(path);
  refuse_packed(path, start);
  const bool packed = start.starts_with("\x1f\x8b");
  if (packed && path.ends_with(".gz") && format_by_name(std::string_view(path).substr(0, path.size() - 3)))
    throw InputError(path, 0, "is packed with gzip; unpack it first, as frames are read in any order: gzip -dk {}",
                     shell_word(path));
  const TrajectoryFormat* by_name = format_by_name(path);
  if (by_name && by_name->recognizes(start)) return *by_name;
  const TrajectoryFormat* by_content = format_by_content(start);
  if (by_name && by_content)
    throw InputError(path, 0,
                     "the name says {}, but the content is {}; rename the file, or check that it is the "
                     "right one",
                     by_name->metadata.name, by_content->metadata.name);
  if (by_name) return *by_name;  // the reader of this format reports what is missing
  if (by_content) return *by_content;
  if (!packed && !kBinaryCifReader.recognizes(start) && start.find('\0') != std::string::npos)
    throw InputError(path, 0, "is in none of the trajectory formats that are read ({}or models of {})",
                     bare_format_names(), format_names());
  return kModelsFormat;
}

}  // namespace

std::span<const TrajectoryFormat* const> trajectory_formats() { return kFormats; }

std::string_view bare_trajectory_format(const std::string& path) {
  if (path == "-") return {};
  std::string start;
  try {
    start = start_of(path);
  } catch (const InputError&) {
    return {};
  }
  if (is_run_input(start)) refuse_run_input(path);
  const TrajectoryFormat* format = format_by_content(start);
  return format ? format->metadata.name : std::string_view();
}

std::unique_ptr<Trajectory> open_trajectory(const std::string& path, const TrajectoryOptions& options) {
  if (path == "-")
    throw InputError("standard input", 0,
                     "cannot be a trajectory, whose frames are read in any order; save it as a file");
  return choose_format(path, start_of(path)).open(path, options);
}

namespace {

bool recognizes(std::string_view start) { return start.starts_with("\x89HDF\r\n\x1a\n"); }

OpenH5md* load() {
  constexpr ModuleFile kModule{"meniscus_hdf5.so", "H5MD files", std::size_t{96} << 20};
  using Give = OpenH5md*(const char* version, std::size_t frame_size);
  void* const give = load_from_module(kModule, "meniscus_open_h5md");
  if (OpenH5md* const open = reinterpret_cast<Give*>(give)(MENISCUS_VERSION, sizeof(Frame))) return open;
  refuse_module(kModule);
}

std::unique_ptr<Trajectory> open(const std::string& path, const TrajectoryOptions&) {
  static OpenH5md* const open_h5md = load();
  return open_h5md(path);
}

}  // namespace

const TrajectoryFormat kH5mdFormat{
    {"H5MD", ".h5md .h5", "trajectories in HDF5, as MDAnalysis, LAMMPS and ESPResSo write them, and MDTraj's own",
     "P. de Buyl, P. H. Colberg and F. Höfling, Comput. Phys. Commun. 185, 1546 (2014)",
     "positions of the first group of particles, with their unit; boxes (edges or vectors), steps and times"},
    recognizes,
    open};

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
    // An index that cannot be stored only costs time: the next run reads through the file again.
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
