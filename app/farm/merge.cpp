// SPDX-License-Identifier: BSD-3-Clause
// Checks each result of a copy and copies its files.
#include "app/farm/merge.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/farm/frame_log.h"
#include "app/farm/inner_path.h"
#include "app/farm/check_bundle.h"
#include "app/farm/verify.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

/// Throws InputError unless the copy is one of this bundle.
void check_copy(const Bundle& bundle, const fs::path& copy) {
  const Bundle theirs = read_bundle(copy);
  const std::string path = (copy / "bundle.json").string();
  if (theirs.program_version != bundle.program_version)
    throw InputError(path, 0,
                     fmt::format("was made by meniscus {}, and the bundle that takes from it by {}",
                                 in_quotes(theirs.program_version), in_quotes(bundle.program_version)));
  if (theirs.fingerprint() != bundle.fingerprint())
    throw InputError(path, 0, "is another bundle: command, frames or inputs differ");
  check_places(copy);
}

/// Gives a claim back at the end, whatever the end.
class Claimed {
 public:
  Claimed(Claims& claims, const std::string& step, std::uint64_t frame)
      : claims_(claims), step_(step), frame_(frame), has_it_(claims.take(step, frame)) {}
  ~Claimed() {
    if (has_it_) claims_.give_back(step_, frame_);
  }
  Claimed(const Claimed&) = delete;
  Claimed& operator=(const Claimed&) = delete;
  explicit operator bool() const { return has_it_; }

 private:
  Claims& claims_;
  const std::string& step_;
  std::uint64_t frame_;
  bool has_it_;
};

}  // namespace

MergeTarget::MergeTarget(const Bundle& bundle, fs::path folder)
    : bundle_(bundle), folder_(std::move(folder)), records_(folder_, bundle), claims_(folder_), results_{kSharedFiles} {
  results_.insert(results_.end(), bundle.frames.begin(), bundle.frames.end());
  for (const Step& step : bundle_.steps)
    for (const std::uint64_t frame : results_) look(step.name, frame);
}

Merged MergeTarget::take_from(const fs::path& copy) {
  check_copy(bundle_, copy);
  const FrameRecords records(copy, bundle_);
  Merged merged;
  for (const Step& step : bundle_.steps) {
    for (const std::uint64_t frame : results_) {
      try {
        take(step.name, frame, copy, records, merged);
      } catch (const InputError& error) {
        merged.not_taken.push_back({step.name, frame, error.what()});
      }
    }
  }
  return merged;
}

void MergeTarget::take(const std::string& step, std::uint64_t frame, const fs::path& copy, const FrameRecords& records,
                       Merged& merged) {
  const std::optional<FrameRecord> theirs = records.read(step, frame);
  const std::uint64_t one = frame == kSharedFiles ? 0 : 1;  // counted
  const auto refuse = [&](std::string what) { merged.not_taken.push_back({step, frame, std::move(what)}); };
  if (!theirs) {
    if (records.written(step, frame)) refuse("its record is damaged, or another bundle's");
    return;
  }
  if (!theirs->done()) return take_failure(step, *theirs, copy, merged);
  const auto is_here = [&](const MadeFile& file) {
    const auto found = sums_.find(file.path);
    return found != sums_.end() && found->second == file.sha256;
  };
  if (good_.contains({step, frame}) && std::ranges::all_of(theirs->files, is_here)) {
    merged.there += one;
    return;
  }
  if (std::string fault = fault_of(*theirs, records, bundle_, copy); !fault.empty()) return refuse(std::move(fault));
  const Claimed claimed(claims_, step, frame);
  if (!claimed) {
    ++merged.busy;
    return;
  }
  const bool is_made = look(step, frame);  // by a worker meanwhile
  if (std::string other = difference(*theirs); !other.empty()) return refuse(std::move(other));
  if (is_made) {
    merged.there += one;
    return;
  }
  take_files(*theirs, copy, merged);
  keep(step, *theirs, copy);
  look(step, frame);
  merged.taken += one;
}

/// So that everybody knows why the frame is missing.
void MergeTarget::take_failure(const std::string& step, const FrameRecord& record, const fs::path& copy,
                               Merged& merged) {
  if (good_.contains({step, record.frame})) return;
  ++merged.failed;
  const Claimed claimed(claims_, step, record.frame);
  if (claimed && !records_.read(step, record.frame)) keep(step, record, copy);
}

/// Whether the frame is made here; it and its files are known then.
bool MergeTarget::look(const std::string& step, std::uint64_t frame) {
  const std::optional<FrameRecord> record = records_.read(step, frame);
  if (!record || !record->done() || !records_.fault(*record).empty()) return false;
  for (const MadeFile& file : record->files) sums_[file.path] = file.sha256;
  good_.emplace(step, frame);
  return true;
}

/// What of the files is another one here, where a good frame has it: "" or what to say about it.
std::string MergeTarget::difference(const FrameRecord& record) const {
  for (const MadeFile& file : record.files) {
    const auto found = sums_.find(file.path);
    if (found != sums_.end() && found->second != file.sha256)
      return file.path + ": is good here and differs, so the one here stays";
  }
  return {};
}

void MergeTarget::take_files(const FrameRecord& record, const fs::path& copy, Merged& merged) {
  for (const MadeFile& file : record.files) {
    const fs::path path = folder_ / file.path;
    if (inner_entry(folder_, file.path) == Entry::file && sha256_of_file(path) == file.sha256) continue;
    const std::optional<std::string> content = inner_text(copy, file.path, file.bytes);
    if (!content || sha256(*content) != file.sha256)
      throw InputError((copy / file.path).string(), 0, "changed while it was read");
    make_folders_of(path);
    OutputFile output(path, Existing::replace);
    output.write(*content);
    output.commit();
    merged.bytes += file.bytes;
  }
}

void MergeTarget::keep(const std::string& step, const FrameRecord& record, const fs::path& copy) {
  write_frame_log(folder_, step, record.frame, read_frame_log(copy, step, record.frame));
  records_.write(step, record);
}

}  // namespace meniscus::farm
