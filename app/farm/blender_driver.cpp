// SPDX-License-Identifier: BSD-3-Clause
// Compares, copies and removes the driver that Blender runs.
#include "app/farm/blender_driver.h"

#include <algorithm>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/farm/driver_checksums.h"
#include "app/farm/inner_path.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInside = "inputs/blender/";
constexpr std::size_t kLargestDriverFile = std::size_t{4} << 20;

}  // namespace

const std::vector<DriverFile>& driver_files() {
  static const std::vector<DriverFile> files{MENISCUS_DRIVER_FILES};
  return files;
}

void check_driver(const Bundle& bundle) {
  const bool needed = !bundle.steps.empty() && bundle.steps.back().maker == Maker::blender;
  std::size_t found = 0;
  for (const Input& input : bundle.inputs) {
    if (!input.path.starts_with(kInside)) continue;
    const auto same = [&](const DriverFile& file) {
      return kInside + file.path == input.path && file.sha256 == input.sha256;
    };
    if (!needed || std::ranges::none_of(driver_files(), same))
      throw RequestError(fmt::format("{} is not of the Blender add-on that belongs to this program", input.path));
    ++found;
  }
  if (needed && found != driver_files().size())
    throw RequestError("does not bring all of the Blender add-on that belongs to this program");
}

DriverCopy::DriverCopy(const fs::path& bundle_folder, std::string name)
    : name_(std::move(name)), path_(bundle_folder / name_) {}

// An object whose first constructor is done is destroyed when the second throws, and the folder with it.
DriverCopy::DriverCopy(const fs::path& bundle_folder)
    : DriverCopy(bundle_folder, fmt::format(".blender_{}", ::getpid())) {
  std::error_code error;
  fs::remove_all(path_, error);  // of a process that had this number before
  for (const DriverFile& file : driver_files()) {
    const std::optional<std::string> text = inner_text(bundle_folder, kInside + file.path, kLargestDriverFile);
    if (!text || sha256(*text) != file.sha256)
      throw InputError((bundle_folder / kInside / file.path).string(), 0, "is not what was bundled");
    fs::create_directories((path_ / file.path).parent_path(), error);
    OutputFile copy(path_ / file.path, Existing::refuse);
    copy.write(*text);
    copy.commit();
  }
}

DriverCopy::~DriverCopy() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace meniscus::farm
