// SPDX-License-Identifier: BSD-3-Clause
// Lists the trajectory formats, chooses one by content, and loads the module that reads H5MD.
#include "core/trajectory/formats/trajectory_formats.h"

#include "core/base/binary_file.h"
#include "core/base/error.h"
#include "core/base/module_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/base/version.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// A new format has a file read_<name>.cpp, a declaration in trajectory_formats.h and an entry here before the last
/// one.
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

}  // namespace meniscus
