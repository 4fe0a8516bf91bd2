// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads bundle.json, and cuts the run into chunks.
#include "app/farm/bundle.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchemaVersion = 2;
constexpr std::uint64_t kMostChunks = 1000;         // Slurm's MaxArraySize is 1001 unless a site says otherwise
constexpr std::uint64_t kMostFrames = 100'000'000;  // a manifest that asks for more is damaged
constexpr std::uint64_t kLargestSide = 65'535;      // of a picture, in pixels
constexpr std::uint64_t kAnyNumber = ~std::uint64_t{0};
constexpr std::size_t kLongestShown = 200;  // bytes of a value in a message
constexpr std::size_t kLargestManifest = std::size_t{64} << 20;
constexpr const char* kPlace = "#####";

// A whole number; the library would make any number one.
template <typename Key>
std::uint64_t whole_number(const Json& part, const Key& key, std::uint64_t least, std::uint64_t most) {
  const Json& json = part.at(key);
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() < least || json.get<std::uint64_t>() > most)
    throw RequestError(fmt::format("is damaged: \"{}\" is {}, not a whole number from {} to {}", key,
                                   shortened(json.dump(), kLongestShown), least, most));
  return json.get<std::uint64_t>();
}

std::optional<std::uint64_t> whole_number_if_there(const Json& part, const char* key) {
  return part.contains(key) ? std::optional(whole_number(part, key, 1, kAnyNumber)) : std::nullopt;
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

Json json_of(const Bundle& bundle, bool measured) {
  Json json;
  json["schema"] = "meniscus-farm-bundle";
  json["schema_version"] = kSchemaVersion;
  json["program_version"] = bundle.program_version;
  json["command"] = bundle.command;
  json["device"] = bundle.device;
  json["renderer"] = bundle.renderer;
  json["frames"] = frame_list_text(bundle.frames);
  json["frame_count"] = bundle.frames.size();
  json["size"] = {bundle.width, bundle.height};
  json["inputs"] = Json::array();
  for (const Input& input : bundle.inputs)
    json["inputs"].push_back({{"path", input.path}, {"bytes", input.bytes}, {"sha256", input.sha256}});
  if (bundle.film) json["film"] = film_json(*bundle.film);
  json["chunks"] = chunking_json(bundle.chunking, measured);
  return json;
}

Chunking read_chunking(const Json& json, std::uint64_t frames) {
  Chunking chunking;
  chunking.asked_frames = whole_number_if_there(json, "frames");
  if (json.contains("minutes")) chunking.asked_minutes = json.at("minutes").get<double>();
  if (json.contains("seconds_per_frame")) chunking.seconds_per_frame = json.at("seconds_per_frame").get<double>();
  chunking.cores = whole_number(json, "cores", 1, kAnyNumber);
  chunking.asked_memory = whole_number_if_there(json, "memory");
  chunking.peak_memory = whole_number_if_there(json, "peak_memory");
  chunking.count = whole_number(json, "count", 1, std::min(kMostChunks, frames));
  return chunking;
}

Film read_film(const Json& json) {
  const auto number = [&](const char* key) { return static_cast<int>(whole_number(json, key, 0, 1000)); };
  Film film{json.at("file").get<std::string>(), json.at("frames_per_second").get<double>(), {}};
  if (json.contains("codec")) film.format.codec = json.at("codec").get<std::string>();
  if (json.contains("crf")) film.format.rate_factor = number("crf");
  if (json.contains("bits")) film.format.bits = number("bits");
  if (json.contains("chroma")) film.format.chroma = number("chroma");
  film.format.transparent = json.value("transparent", false);
  if (!(film.frames_per_second >= 0.1 && film.frames_per_second <= 1000.0))
    throw RequestError("is damaged: its film's frames per second are not from 0.1 to 1000");
  if (film.file.find('/') != std::string::npos || !is_film_path(film.file))
    throw RequestError(fmt::format("is damaged: film {} is not a plain name of a film", in_quotes(film.file)));
  return film;
}

Bundle bundle_from_json(const Json& json) {
  if (json.at("schema") != "meniscus-farm-bundle") throw RequestError("is not a farm bundle");
  if (json.at("schema_version") != kSchemaVersion)
    throw RequestError(fmt::format("has schema version {}; this program reads {}: use the program of version {}",
                                   shortened(json.at("schema_version").dump(), kLongestShown), kSchemaVersion,
                                   in_quotes(json.value("program_version", "?"))));
  using Words = std::vector<std::string>;
  Bundle bundle;
  bundle.program_version = json.at("program_version").get<std::string>();
  bundle.command = json.at("command").get<Words>();
  steps_of(bundle.command);
  bundle.device = json.at("device").get<Words>();
  bundle.renderer = json.at("renderer").get<Words>();
  bundle.frames = parse_frame_list("frames", json.at("frames").get<std::string>(), kMostFrames);
  if (whole_number(json, "frame_count", 1, kMostFrames) != bundle.frames.size())
    throw RequestError(fmt::format("is damaged: \"frame_count\" is {}, and there are {} frames in \"frames\"",
                                   json.at("frame_count").dump(), bundle.frames.size()));
  bundle.width = static_cast<int>(whole_number(json.at("size"), 0, 1, kLargestSide));
  bundle.height = static_cast<int>(whole_number(json.at("size"), 1, 1, kLargestSide));
  for (const Json& input : json.at("inputs"))
    bundle.inputs.push_back({input.at("path").get<std::string>(), whole_number(input, "bytes", 0, kAnyNumber),
                             input.at("sha256").get<std::string>()});
  if (json.contains("film")) bundle.film = read_film(json.at("film"));
  bundle.chunking = read_chunking(json.at("chunks"), bundle.frames.size());
  return bundle;
}

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

}  // namespace

std::string_view word_of(Step step) { return step == Step::surface ? "surface" : "render"; }

std::uint64_t Chunking::wanted_count(std::uint64_t frame_count) const {
  double frames = static_cast<double>(frame_count);
  if (asked_frames) {
    frames = static_cast<double>(*asked_frames);
  } else if (seconds_per_frame) {
    frames = std::floor(60.0 * asked_minutes / *seconds_per_frame);
  }
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

std::vector<Step> steps_of(const std::vector<std::string>& command) {
  const bool exports = command.size() > 1 && command.front() == "export";
  const std::string name = command.empty() ? "" : exports ? command[0] + " " + command[1] : command[0];
  if (name == "render") return {Step::render};
  if (name == "export povray" || name == "export blender") return {Step::surface, Step::render};
  if (name == "export mitsuba" || name == "export pbrt") return {Step::surface};
  throw RequestError(
      fmt::format("{} cannot be bundled; render and export povray, blender, mitsuba and pbrt can", in_quotes(name)));
}

std::vector<Step> Bundle::steps() const { return steps_of(command); }

Maker Bundle::maker(Step step) const {
  if (step == Step::surface || command.front() == "render") return Maker::meniscus;
  return command[1] == "povray" ? Maker::povray : Maker::blender;
}

std::string Bundle::result_pattern(Step step) const {
  if (step == Step::surface) return fmt::format("scene/frame_{}.done", kPlace);
  const bool is_layered = std::ranges::any_of(command, [](const std::string& word) {
    return word == "--aovs" || word == "--cryptomatte" || word.starts_with("--color-space");
  });
  return fmt::format("images/frame_{}.{}", kPlace, is_layered ? "exr" : "png");
}

std::vector<std::uint64_t> chunk_of(const Bundle& bundle, std::uint64_t k, std::uint64_t n) {
  const std::uint64_t count = bundle.frames.size();
  // First of chunk k without a product that could overflow: the first `count % n` chunks have one frame more.
  const auto first = [&](std::uint64_t before) {
    return static_cast<std::ptrdiff_t>(before * (count / n) + std::min(before, count % n));
  };
  return {bundle.frames.begin() + first(k - 1), bundle.frames.begin() + first(k)};
}

std::string numbered(std::string_view pattern, std::uint64_t frame) {
  std::string name(pattern);
  return name.replace(name.find(kPlace), std::string_view(kPlace).size(), fmt::format("{:05}", frame));
}

std::string bundle_json(const Bundle& bundle) { return json_of(bundle, true).dump(2, ' ', true) + "\n"; }

bool same_but_for_measurement(const Bundle& a, const Bundle& b) { return json_of(a, false) == json_of(b, false); }

Bundle read_bundle(const std::filesystem::path& folder) {
  const std::string path = (folder / "bundle.json").string();
  if (!std::filesystem::exists(path)) throw InputError(path, 0, "is missing; meniscus farm bundle makes it");
  const std::string text = read_text_file(path, kLargestManifest).text;
  try {
    return parse_bundle(text);
  } catch (const RequestError& error) {
    throw InputError(path, 0, error.what());
  }
}

}  // namespace meniscus::farm
