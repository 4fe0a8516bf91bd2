// SPDX-License-Identifier: BSD-3-Clause
// Writes, reads and checks the records of frames.
#include "app/farm/frame_record.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/farm/checksum.h"
#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kLargestRecord = std::size_t{1} << 20;

// Frames are made of files in these two folders.
bool is_made_path(const std::string& path) {
  return is_inner_path(path) && (path.starts_with("images/") || path.starts_with("scene/"));
}

// By "_00042" in its name.
bool is_of_one_frame(const std::string& name) {
  constexpr std::size_t kDigits = 5;
  for (std::size_t at = name.find('_'); at != std::string::npos; at = name.find('_', at + 1)) {
    const std::size_t end = name.find_first_not_of("0123456789", at + 1);
    if ((end == std::string::npos ? name.size() : end) - at - 1 >= kDigits) return true;
  }
  return false;
}

Json to_json(const FrameRecord& record) {
  Json json;
  json["frame"] = record.frame;
  json["state"] = record.done() ? "done" : "failed";
  if (!record.done()) {
    json["exit"] = record.exit_code;
    json["error"] = record.error;
    if (record.tries > 1) json["tries"] = record.tries;
    if (record.again) json["again"] = *record.again;
  }
  json["files"] = Json::array();
  for (const MadeFile& file : record.files)
    json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  json["seconds"] = record.seconds;
  if (!record.first_try.empty()) json["first_try"] = record.first_try;
  json["worker"] = record.worker;
  json["ended"] = record.ended;
  return json;
}

// A whole number; the library would make any number one.
std::uint64_t whole_number(const Json& json) {
  if (!json.is_number_unsigned()) throw Json::type_error::create(302, "this is not a whole number", &json);
  return json.get<std::uint64_t>();
}

FrameRecord record_from_json(const Json& json) {
  FrameRecord record;
  record.frame = whole_number(json.at("frame"));
  if (json.at("state") != "done") {
    record.exit_code = static_cast<int>(std::min<std::uint64_t>(whole_number(json.at("exit")), 255));
    record.error = json.at("error").get<std::string>();
    if (json.contains("tries")) record.tries = whole_number(json.at("tries"));
    if (json.contains("again")) record.again = json.at("again").get<double>();
  }
  for (const Json& file : json.at("files"))
    record.files.push_back(
        {file.at("path").get<std::string>(), whole_number(file.at("bytes")), file.at("sha256").get<std::string>()});
  record.seconds = json.at("seconds").get<double>();
  record.first_try = json.value("first_try", "");
  record.worker = json.value("worker", "");
  record.ended = json.value("ended", 0.0);
  return record;
}

bool is_sound(const FrameRecord& record) {
  return record.exit_code >= 0 && record.exit_code < 256 && record.again.value_or(0.0) <= Tries::kLongestWait &&
         std::ranges::all_of(record.files, [](const MadeFile& file) { return is_made_path(file.path); });
}

}  // namespace

FrameRecords::FrameRecords(fs::path folder, const Bundle& bundle)
    : folder_(std::move(folder)), fingerprint_(bundle.fingerprint()) {}

fs::path FrameRecords::path_of(const std::string& step, std::uint64_t frame) const {
  return fs::path("state") / step /
         (frame == kSharedFiles ? "shared.json" : fmt::format("frame_{}.json", frame_digits(frame)));
}

std::optional<FrameRecord> FrameRecords::read(const std::string& step, std::uint64_t frame) const {
  const std::optional<std::string> text = inner_text(folder_, path_of(step, frame), kLargestRecord);
  if (!text) return {};
  if (is_nested_too_deep(*text)) return {};
  try {
    const Json json = Json::parse(*text);
    if (json.at("bundle") != fingerprint_) return {};
    FrameRecord record = record_from_json(json);
    if (record.frame != frame || !is_sound(record)) return {};
    return record;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

std::optional<FileTime> FrameRecords::written(const std::string& step, std::uint64_t frame) const {
  return modified(folder_ / path_of(step, frame));
}

void FrameRecords::write(const std::string& step, const FrameRecord& record) const {
  const fs::path path = folder_ / path_of(step, record.frame);
  make_folders_of(path);
  Json json = to_json(record);
  json["bundle"] = fingerprint_;
  OutputFile file(path, Existing::replace);
  file.write(json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n");
  file.commit();
}

void FrameRecords::write_shared(const std::string& step) const {
  const std::optional<FrameRecord> known = read(step, kSharedFiles);
  if (known && fault(*known).empty()) return;
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "scene"))
    if (const std::string name = entry.path().filename().string(); !name.starts_with('.') && !is_of_one_frame(name))
      paths.push_back("scene/" + name);
  std::ranges::sort(paths);
  if (!paths.empty()) write(step, measured(kSharedFiles, paths, 0.0));
}

FrameRecord FrameRecords::measured(std::uint64_t frame, const std::vector<std::string>& paths, double seconds) const {
  FrameRecord record;
  record.frame = frame;
  record.seconds = seconds;
  for (const std::string& path : paths) {
    if (!is_made_path(path) || inner_entry(folder_, path) != Entry::file)
      throw InputError(path, 0, "is not a file that a frame can have");
    const std::string sum = sha256_of_file(folder_ / path);
    record.files.push_back({path, fs::file_size(folder_ / path), sum});
  }
  return record;
}

std::string FrameRecords::fault(const FrameRecord& record, Look look) const {
  if (record.files.empty()) return "its record names no file";
  for (const MadeFile& file : record.files) {
    try {
      if (inner_entry(folder_, file.path) != Entry::file) return file.path + ": is missing";
      const std::uintmax_t bytes = fs::file_size(folder_ / file.path);
      if (bytes != file.bytes) return fmt::format("{}: has {} bytes, not {}", file.path, bytes, file.bytes);
      if (look == Look::contents && sha256_of_file(folder_ / file.path) != file.sha256)
        return file.path + ": is not what was made (SHA-256)";
    } catch (const InputError& unreadable) {
      return unreadable.what();
    }
  }
  return {};
}

}  // namespace meniscus::farm
