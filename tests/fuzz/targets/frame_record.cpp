// SPDX-License-Identifier: BSD-3-Clause
// Records of frames in a bundle, which other processes write: read, or taken for none.
#include <cmath>

#include "app/farm/frame_record.h"
#include "core/base/error.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

constexpr std::string_view kFingerprint = "FINGERPRINT";  // in seeds, for that of the bundle below

/// A bundle with one step and one frame, whose record is given by the bytes.
farm::Bundle sample_bundle() {
  farm::Bundle bundle;
  bundle.program_version = "0.1.0";
  bundle.command = {"render", "inputs/a.pdb"};
  bundle.frames = {0};
  bundle.steps = {{"render", farm::Maker::meniscus, {}}};
  bundle.width = bundle.height = 16;
  return bundle;
}

void run(std::string_view bytes) {
  static const farm::Bundle bundle = sample_bundle();
  static const ScratchFile scratch("unused");
  static const std::filesystem::path state = scratch.folder() / "state" / "render";
  std::filesystem::create_directories(state);
  std::string text(bytes);
  if (const std::size_t place = text.find(kFingerprint); place != std::string::npos)
    text.replace(place, kFingerprint.size(), bundle.fingerprint());
  std::FILE* file = std::fopen((state / "frame_00000.json").c_str(), "wb");
  require(file != nullptr, "the scratch folder can be written");
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
  const farm::FrameRecords records(scratch.folder(), bundle);
  const std::optional<farm::FrameRecord> record = records.read("render", 0);
  if (!record) return;
  require(record->frame == 0, "a record is of the frame asked for");
  require(std::isfinite(record->seconds), "a frame took a time");
  records.fault(*record);
  records.write("render", *record);
  const std::optional<farm::FrameRecord> again = records.read("render", 0);
  require(again && again->exit_code == record->exit_code && again->files.size() == record->files.size(),
          "a record written is read as it was");
}

const Registration registration{"frame_record", run};

}  // namespace
}  // namespace meniscus::fuzz
