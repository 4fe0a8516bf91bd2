// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads bundle.json, and cuts the run into chunks.
#include "app/farm/bundle.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/farm/checksum.h"
#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/base/text.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchemaVersion = 1;
constexpr std::uint64_t kMostChunks = 1000;         // Slurm's MaxArraySize is 1001 unless a site says otherwise
constexpr std::uint64_t kMostFrames = 100'000'000;  // a manifest that asks for more is damaged
constexpr std::uint64_t kAnyNumber = ~std::uint64_t{0};
constexpr std::size_t kLongestShown = 200;  // bytes of a value in a message
constexpr const char* kMakers[] = {"meniscus", "povray", "blender"};

std::string word_of(Maker maker) { return kMakers[static_cast<std::size_t>(maker)]; }

Maker maker_of(const std::string& word) {
  for (const Maker maker : {Maker::meniscus, Maker::povray, Maker::blender})
    if (word == word_of(maker)) return maker;
  throw RequestError(fmt::format("{} makes no frames", in_quotes(word)));
}

// A whole number; the library would make any number one.
template <typename Key>
std::uint64_t whole_number(const Json& part, const Key& key, std::uint64_t most) {
  const Json& json = part.at(key);
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > most)
    throw RequestError(fmt::format("is damaged: \"{}\" is {}, not a whole number up to {}", key,
                                   shortened(json.dump(), kLongestShown), most));
  return json.get<std::uint64_t>();
}

// What decides how frames look.
Json work_json(const Bundle& bundle) {
  Json json;
  json["schema"] = "meniscus-farm-bundle";
  json["schema_version"] = kSchemaVersion;
  json["program_version"] = bundle.program_version;
  json["command"] = bundle.command;
  json["frames"] = frame_list_text(bundle.frames);
  json["frame_count"] = bundle.frames.size();
  json["size"] = {bundle.width, bundle.height};
  json["steps"] = Json::array();
  for (const Step& step : bundle.steps)
    json["steps"].push_back({{"name", step.name}, {"maker", word_of(step.maker)}, {"arguments", step.arguments}});
  json["inputs"] = Json::array();
  for (const Input& input : bundle.inputs)
    json["inputs"].push_back({{"path", input.path}, {"bytes", input.bytes}, {"sha256", input.sha256}});
  return json;
}

Json chunking_json(const Chunking& chunking, bool measured) {
  Json json;
  if (chunking.asked_frames) {
    json["frames"] = *chunking.asked_frames;
  } else {
    json["minutes"] = chunking.asked_minutes;
  }
  json["cores"] = chunking.cores;
  if (chunking.asked_memory) json["memory"] = *chunking.asked_memory;
  if (measured && chunking.seconds_per_frame) json["seconds_per_frame"] = *chunking.seconds_per_frame;
  if (measured && chunking.peak_memory) json["peak_memory"] = *chunking.peak_memory;
  if (measured) json["count"] = chunking.count;
  return json;
}

Json film_json(const Film& film) {
  Json json{{"file", film.file}, {"frames_per_second", film.frames_per_second}};
  const FilmFormat& format = film.format;
  if (!format.codec.empty()) json["codec"] = format.codec;
  if (format.rate_factor) json["crf"] = *format.rate_factor;
  if (format.bits != 0) json["bits"] = format.bits;
  if (format.chroma != 0) json["chroma"] = format.chroma;
  if (format.transparent) json["transparent"] = true;
  return json;
}

// Where inputs are does not decide how frames look: copies of a bundle may have them in different places.
Json references_json(const Bundle& bundle) {
  Json json = Json::object();
  for (const Input& input : bundle.inputs)
    if (!input.source.empty()) json[input.path] = input.source;
  return json;
}

Json whole_json(const Bundle& bundle, bool measured) {
  Json json = work_json(bundle);
  if (bundle.film) json["film"] = film_json(*bundle.film);
  json["chunks"] = chunking_json(bundle.chunking, measured);
  if (Json references = references_json(bundle); !references.empty()) json["references"] = std::move(references);
  if (bundle.tries.most > 1) json["tries"] = {{"most", bundle.tries.most}, {"wait_seconds", bundle.tries.wait_seconds}};
  return json;
}

void read_references(const Json& json, Bundle& bundle) {
  for (const auto& [path, source] : json.get<std::map<std::string, std::string>>()) {
    const auto input = std::ranges::find(bundle.inputs, path, &Input::path);
    if (input == bundle.inputs.end()) throw RequestError(fmt::format("{} is no input of it", in_quotes(path)));
    input->source = source;
  }
}

Chunking read_chunking(const Json& json) {
  Chunking chunking;
  if (json.contains("frames")) chunking.asked_frames = whole_number(json, "frames", kMostFrames);
  if (json.contains("minutes")) chunking.asked_minutes = json.at("minutes").get<double>();
  if (json.contains("seconds_per_frame")) chunking.seconds_per_frame = json.at("seconds_per_frame").get<double>();
  chunking.cores = whole_number(json, "cores", kAnyNumber);
  if (json.contains("memory")) chunking.asked_memory = whole_number(json, "memory", kAnyNumber);
  if (json.contains("peak_memory")) chunking.peak_memory = whole_number(json, "peak_memory", kAnyNumber);
  chunking.count = whole_number(json, "count", kMostChunks);
  return chunking;
}

Film read_film(const Json& json) {
  constexpr std::uint64_t kMost = 1000;
  const auto number = [&](const char* key) { return static_cast<int>(whole_number(json, key, kMost)); };
  Film film{json.at("file").get<std::string>(), json.at("frames_per_second").get<double>(), {}};
  if (json.contains("codec")) film.format.codec = json.at("codec").get<std::string>();
  if (json.contains("crf")) film.format.rate_factor = number("crf");
  if (json.contains("bits")) film.format.bits = number("bits");
  if (json.contains("chroma")) film.format.chroma = number("chroma");
  film.format.transparent = json.value("transparent", false);
  return film;
}

Bundle bundle_from_json(const Json& json) {
  if (json.at("schema") != "meniscus-farm-bundle") throw RequestError("is not a farm bundle");
  if (json.at("schema_version") != kSchemaVersion)
    throw RequestError(fmt::format("has schema version {}; this program reads {}: use the program of version {}",
                                   shortened(json.at("schema_version").dump(), kLongestShown), kSchemaVersion,
                                   in_quotes(json.value("program_version", "?"))));
  Bundle bundle;
  bundle.program_version = json.at("program_version").get<std::string>();
  bundle.command = json.at("command").get<std::vector<std::string>>();
  bundle.frames = parse_frame_list("frames", json.at("frames").get<std::string>(), kMostFrames);
  if (whole_number(json, "frame_count", kMostFrames) != bundle.frames.size())
    throw RequestError(fmt::format("is damaged: \"frame_count\" is {}, and there are {} frames in \"frames\"",
                                   json.at("frame_count").dump(), bundle.frames.size()));
  bundle.width = static_cast<int>(whole_number(json.at("size"), 0, kLargestSide));
  bundle.height = static_cast<int>(whole_number(json.at("size"), 1, kLargestSide));
  for (const Json& step : json.at("steps"))
    bundle.steps.push_back({step.at("name").get<std::string>(), maker_of(step.at("maker").get<std::string>()),
                            step.at("arguments").get<std::vector<std::string>>()});
  for (const Json& input : json.at("inputs"))
    bundle.inputs.push_back({input.at("path").get<std::string>(),
                             whole_number(input, "bytes", kAnyNumber),
                             input.at("sha256").get<std::string>(),
                             {}});
  if (json.contains("references")) read_references(json.at("references"), bundle);
  if (json.contains("film")) bundle.film = read_film(json.at("film"));
  bundle.chunking = read_chunking(json.at("chunks"));
  if (json.contains("tries"))
    bundle.tries = {whole_number(json.at("tries"), "most", Tries::kMost),
                    json.at("tries").at("wait_seconds").get<double>()};
  return bundle;
}

}  // namespace

std::uint64_t Chunking::wanted_count(std::uint64_t frame_count) const {
  double frames = 10.0;
  if (asked_frames) frames = static_cast<double>(*asked_frames);
  if (!asked_frames && seconds_per_frame) frames = std::floor(60.0 * asked_minutes / *seconds_per_frame);
  const double tasks = std::ceil(static_cast<double>(frame_count) / std::max(frames, 1.0));
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(tasks), 1, frame_count);
}

void Chunking::decide(std::uint64_t frame_count) { count = std::min(wanted_count(frame_count), kMostChunks); }

std::optional<std::uint64_t> Chunking::memory() const {
  constexpr std::uint64_t kWorker = 256, kStep = 256;
  if (asked_memory || !peak_memory) return asked_memory;
  const std::uint64_t needed = *peak_memory + *peak_memory / 2 + kWorker;
  return (needed + kStep - 1) / kStep * kStep;
}

std::optional<double> Tries::wait_after(std::uint64_t failed) const {
  if (failed >= most) return {};
  return std::min(std::ldexp(wait_seconds, static_cast<int>(std::min(failed, Tries::kMost)) - 1), Tries::kLongestWait);
}

std::string Bundle::fingerprint() const { return sha256(work_json(*this).dump()); }

std::size_t Bundle::place_of(std::uint64_t frame) const {
  const auto found = std::ranges::find(frames, frame);
  if (found == frames.end())
    throw RequestError(fmt::format("frame {} is not in this bundle; it has {}", frame, frame_list_text(frames)));
  return static_cast<std::size_t>(found - frames.begin());
}

const Step* Bundle::step(const std::string& name) const {
  const auto found = std::ranges::find(steps, name, &Step::name);
  return found == steps.end() ? nullptr : &*found;
}

std::vector<std::uint64_t> chunk_of(const Bundle& bundle, std::uint64_t k, std::uint64_t n) {
  const std::uint64_t count = bundle.frames.size();
  // First of chunk k without a product that could overflow: the first `count % n` chunks have one frame more.
  const auto first = [&](std::uint64_t before) {
    return static_cast<std::ptrdiff_t>(before * (count / n) + std::min(before, count % n));
  };
  return {bundle.frames.begin() + first(k - 1), bundle.frames.begin() + first(k)};
}

std::string frame_digits(std::uint64_t frame) { return fmt::format("{:05}", frame); }

std::string bundle_json(const Bundle& bundle) { return whole_json(bundle, true).dump(2, ' ', true) + "\n"; }

Bundle parse_bundle(const std::string& text) {
  try {
    if (is_nested_too_deep(text)) throw RequestError("is damaged: it is nested too deep");
    return bundle_from_json(Json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.type_error.302] (/film/file) type must be string, but is number"
    constexpr std::string_view kOwnWords = "cannot use at() with ";
    std::string fault(error.what());
    fault.erase(0, fault.find("] ") + 2);
    if (const std::size_t at = fault.find(kOwnWords); at != std::string::npos)
      fault.replace(at, kOwnWords.size(), "should be an object or a list, but is ");
    throw RequestError("is damaged: " + shortened(fault, kLongestShown));
  }
}

bool same_but_for_measurement(const Bundle& a, const Bundle& b) { return whole_json(a, false) == whole_json(b, false); }

}  // namespace meniscus::farm
