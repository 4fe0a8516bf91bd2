// SPDX-License-Identifier: BSD-3-Clause
// Checks records, checksums and pixels.
#include "app/farm/verify.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "app/farm/frame_record.h"
#include "app/farm/inner_path.h"
#include "app/farm/png_without_time.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/image/image_codec.h"

namespace meniscus::farm {
namespace {

// Every value equals the one a pixel before.
bool is_blank(const DecodedImage& picture) {
  const auto one = static_cast<std::ptrdiff_t>(picture.channels);
  return std::equal(picture.values.begin() + one, picture.values.end(), picture.values.begin());
}

std::string picture_fault(const std::filesystem::path& path, const Bundle& bundle) {
  if (!is_png(path)) return "is not a PNG file";
  DecodedImage picture;
  try {
    picture = image_codec().decode(path.string());
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    return fmt::format("cannot be read as a picture: {}", error.what());
  }
  if (picture.width != bundle.width || picture.height != bundle.height)
    return fmt::format("is {}x{} pixels, not {}x{}", picture.width, picture.height, bundle.width, bundle.height);
  if (is_blank(picture)) return "is blank: all its pixels are equal";
  return {};
}

bool is_picture(const std::string& path) { return path.starts_with("images/"); }

}  // namespace

std::string fault_of(const FrameRecord& record, const FrameRecords& records, const Bundle& bundle,
                     const std::filesystem::path& folder) {
  std::string fault = records.fault(record);
  for (const MadeFile& file : record.files) {
    if (!fault.empty() || !is_picture(file.path)) continue;
    const std::string wrong = picture_fault(folder / file.path, bundle);
    if (!wrong.empty()) fault = file.path + ": " + wrong;
  }
  return fault;
}

std::vector<FrameFault> faults_of(const Bundle& bundle, const std::filesystem::path& folder) {
  const FrameRecords records(folder, bundle);
  std::vector<FrameFault> faults;
  for (const Step& step : bundle.steps) {
    for (const std::uint64_t frame : bundle.frames) {
      const std::optional<FrameRecord> record = records.read(step.name, frame);
      if (!record) {
        faults.push_back({step.name, frame, kExitInput, false, "is not made yet"});
      } else if (!record->done()) {
        faults.push_back({step.name, frame, record->exit_code, true, "failed: " + record->error});
      } else if (const std::string fault = fault_of(*record, records, bundle, folder); !fault.empty()) {
        faults.push_back({step.name, frame, kExitInput, false, fault});
      }
    }
  }
  return faults;
}

}  // namespace meniscus::farm
