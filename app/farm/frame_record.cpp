// SPDX-License-Identifier: BSD-3-Clause
// Writes, reads and checks the records of frames.
#include "app/farm/frame_record.h"

#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/farm/checksum.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json to_json(const FrameRecord& record) {
  Json json;
  json["frame"] = record.frame;
  json["state"] = record.done() ? "done" : "failed";
  if (!record.done()) {
    json["exit"] = record.exit_code;
    json["error"] = record.error;
  }
  json["files"] = Json::array();
  for (const MadeFile& file : record.files)
    json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  json["seconds"] = record.seconds;
  return json;
}

FrameRecord from_json(const Json& json) {
  FrameRecord record;
  record.frame = json.at("frame").get<std::uint64_t>();
  if (json.at("state") != "done") {
    record.exit_code = json.at("exit").get<int>();
    record.error = json.at("error").get<std::string>();
  }
  for (const Json& file : json.at("files"))
    record.files.push_back({file.at("path").get<std::string>(), file.at("bytes").get<std::uint64_t>(),
                            file.at("sha256").get<std::string>()});
  record.seconds = json.at("seconds").get<double>();
  return record;
}

}  // namespace

FrameRecords::FrameRecords(fs::path folder, const Bundle& bundle)
    : folder_(std::move(folder)), fingerprint_(bundle.fingerprint()) {}

fs::path FrameRecords::path_of(const std::string& step, std::uint64_t frame) const {
  return folder_ / "state" / step / fmt::format("frame_{}.json", frame_digits(frame));
}

std::optional<FrameRecord> FrameRecords::read(const std::string& step, std::uint64_t frame) const {
  std::ifstream file(path_of(step, frame), std::ios::binary);
  if (!file) return {};
  const std::string text(std::istreambuf_iterator<char>(file), {});
  try {
    const Json json = Json::parse(text);
    if (json.at("bundle") != fingerprint_) return {};
    const FrameRecord record = from_json(json);
    if (record.frame != frame) return {};
    return record;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

void FrameRecords::write(const std::string& step, const FrameRecord& record) const {
  const fs::path path = path_of(step, record.frame);
  std::error_code ignored;  // if it cannot be made, the file says so
  fs::create_directories(path.parent_path(), ignored);
  Json json = to_json(record);
  json["bundle"] = fingerprint_;
  OutputFile file(path, Existing::replace);
  file.write(json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n");
  file.commit();
}

FrameRecord FrameRecords::measured(std::uint64_t frame, const std::vector<std::string>& paths, double seconds) const {
  FrameRecord record;
  record.frame = frame;
  record.seconds = seconds;
  for (const std::string& path : paths) {
    const std::string sum = sha256_of_file(folder_ / path);
    record.files.push_back({path, fs::file_size(folder_ / path), sum});
  }
  return record;
}

std::string FrameRecords::fault(const FrameRecord& record) const {
  if (record.files.empty()) return "its record names no file";
  for (const MadeFile& file : record.files) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(folder_ / file.path, error);
    if (error) return file.path + ": is missing";
    try {
      if (bytes != file.bytes || sha256_of_file(folder_ / file.path) != file.sha256)
        return file.path + ": is not what was made (SHA-256)";
    } catch (const InputError& unreadable) {
      return unreadable.what();
    }
  }
  return {};
}

}  // namespace meniscus::farm
