// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads bundle.json, and cuts the run into chunks.
#include "app/farm/bundle.h"

#include <concepts>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/trajectory/frame_list.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

constexpr int kSchemaVersion = 2;
constexpr std::uint64_t kMostFrames = 100'000'000;  // a manifest with more is damaged
constexpr std::size_t kLongestShown = 200;          // bytes of a value in a message
constexpr std::size_t kLargestManifest = std::size_t{64} << 20;
constexpr const char* kPlace = "#####";

Json json_of(const Film& film) {
  Json json{{"file", film.file}, {"frames_per_second", film.format.frames_per_second}};
  const FilmFormat& format = film.format;
  if (!format.codec.empty()) json["codec"] = format.codec;
  if (format.rate_factor) json["crf"] = *format.rate_factor;
  if (format.bits != 0) json["bits"] = format.bits;
  if (format.chroma != 0) json["chroma"] = format.chroma;
  if (format.transparent) json["transparent"] = true;
  return json;
}

Json json_of(const Chunking& chunking) {
  Json json;
  if (chunking.wanted_frames) {
    json["frames"] = *chunking.wanted_frames;
  } else {
    json["minutes"] = chunking.wanted_minutes;
  }
  json["cores"] = chunking.cores;
  if (chunking.wanted_memory) json["memory"] = *chunking.wanted_memory;
  if (chunking.seconds_per_frame) json["seconds_per_frame"] = *chunking.seconds_per_frame;
  if (chunking.peak_memory) json["peak_memory"] = *chunking.peak_memory;
  json["count"] = chunking.count;
  return json;
}

/// Returns a whole number; the JSON library would also convert a negative number or a fraction.
std::uint64_t whole_number(const Json& json) {
  if (!json.is_number_unsigned())
    throw RequestError("is damaged: {} is not a whole number", shortened(json.dump(), kLongestShown));
  return json.get<std::uint64_t>();
}

template <typename Value>
std::optional<Value> value_if_there(const Json& json, const char* key) {
  if (!json.contains(key)) return {};
  if constexpr (std::integral<Value>)
    return static_cast<Value>(whole_number(json.at(key)));
  else
    return json.at(key).get<Value>();
}

Chunking read_chunking(const Json& json) {
  Chunking chunking;
  chunking.wanted_frames = value_if_there<std::uint64_t>(json, "frames");
  chunking.wanted_minutes = json.value("minutes", chunking.wanted_minutes);
  chunking.seconds_per_frame = value_if_there<double>(json, "seconds_per_frame");
  chunking.cores = whole_number(json.at("cores"));
  chunking.wanted_memory = value_if_there<std::uint64_t>(json, "memory");
  chunking.peak_memory = value_if_there<std::uint64_t>(json, "peak_memory");
  chunking.count = whole_number(json.at("count"));
  return chunking;
}

Film read_film(const Json& json) {
  Film film{json.at("file").get<std::string>(), {}};
  film.format.frames_per_second = json.at("frames_per_second").get<double>();
  film.format.codec = json.value("codec", "");
  film.format.rate_factor = value_if_there<int>(json, "crf");
  film.format.bits = value_if_there<int>(json, "bits").value_or(0);
  film.format.chroma = value_if_there<int>(json, "chroma").value_or(0);
  film.format.transparent = json.value("transparent", false);
  return film;
}

Bundle bundle_from_json(const Json& json) {
  if (json.at("schema") != "meniscus-farm-bundle") throw RequestError("is not a farm bundle");
  if (json.at("schema_version") != kSchemaVersion)
    throw RequestError("has schema version {}; this program reads {}: use the program of version {}",
                       shortened(json.at("schema_version").dump(), kLongestShown), kSchemaVersion,
                       in_quotes(json.value("program_version", "?")));
  Bundle bundle;
  bundle.program_version = json.at("program_version").get<std::string>();
  bundle.command = json.at("command").get<Words>();
  kind_of(bundle.command);
  bundle.device = json.at("device").get<Words>();
  bundle.renderer = json.at("renderer").get<Words>();
  bundle.frames = parse_frame_list("frames", json.at("frames").get<std::string>(), kMostFrames);
  bundle.width = static_cast<int>(whole_number(json.at("size").at(0)));
  bundle.height = static_cast<int>(whole_number(json.at("size").at(1)));
  for (const Json& input : json.at("inputs"))
    bundle.inputs.push_back(
        {input.at("path").get<std::string>(), whole_number(input.at("bytes")), input.at("sha256").get<std::string>()});
  if (json.contains("film")) bundle.film = read_film(json.at("film"));
  bundle.chunking = read_chunking(json.at("chunks"));
  return bundle;
}

}  // namespace

const CommandKind& kind_of(const Words& command) {
  using enum Step;
  static const std::vector<CommandKind> kinds{{"render", {render}, Maker::meniscus},
                                              {"export povray", {surface, render}, Maker::povray},
                                              {"export blender", {surface, render}, Maker::blender},
                                              {"export mitsuba", {surface}, Maker::meniscus},
                                              {"export pbrt", {surface}, Maker::meniscus}};
  const bool exports = command.size() > 1 && command.front() == "export";
  const std::string name = command.empty() ? "" : exports ? command[0] + " " + command[1] : command[0];
  const auto found = std::ranges::find(kinds, name, &CommandKind::name);
  if (found == kinds.end())
    throw RequestError("{} cannot be bundled; render and export povray, blender, mitsuba and pbrt can",
                       in_quotes(name));
  return *found;
}

std::uint64_t Chunking::wanted_count(std::uint64_t frame_count) const {
  const double all = static_cast<double>(frame_count);
  double frames = all;
  if (wanted_frames) {
    frames = static_cast<double>(*wanted_frames);
  } else if (seconds_per_frame) {
    frames = std::floor(60.0 * wanted_minutes / *seconds_per_frame);
  }
  return static_cast<std::uint64_t>(std::ceil(all / std::clamp(frames, 1.0, all)));
}

std::optional<std::uint64_t> Chunking::memory() const {
  constexpr std::uint64_t kWorker = 256, kStep = 256;
  if (wanted_memory || !peak_memory) return wanted_memory;
  const std::uint64_t needed = *peak_memory + *peak_memory / 2 + kWorker;
  return (needed + kStep - 1) / kStep * kStep;
}

std::string Bundle::result_pattern(Step step) const {
  if (step == Step::surface) return fmt::format("scene/frame_{}.done", kPlace);
  const bool is_layered = std::ranges::any_of(command, [](const std::string& word) {
    return word == "--aovs" || word == "--cryptomatte" || word.starts_with("--color-space");
  });
  return fmt::format("images/frame_{}.{}", kPlace, is_layered ? "exr" : "png");
}

std::string Bundle::result(Step step, std::uint64_t frame) const { return numbered(result_pattern(step), frame); }

std::vector<std::uint64_t> chunk_of(const Bundle& bundle, std::uint64_t k, std::uint64_t n) {
  const std::uint64_t count = bundle.frames.size();
  // The first `count % n` chunks have one frame more. No product here can overflow.
  const auto first = [&](std::uint64_t before) {
    return static_cast<std::ptrdiff_t>(before * (count / n) + std::min(before, count % n));
  };
  return {bundle.frames.begin() + first(k - 1), bundle.frames.begin() + first(k)};
}

std::string numbered(std::string_view pattern, std::uint64_t frame) {
  std::string name(pattern);
  return name.replace(name.find(kPlace), std::string_view(kPlace).size(), fmt::format("{:05}", frame));
}

std::string bundle_json(const Bundle& bundle) {
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
  if (bundle.film) json["film"] = json_of(*bundle.film);
  json["chunks"] = json_of(bundle.chunking);
  return json.dump(2, ' ', true) + "\n";
}

Bundle read_bundle(const std::filesystem::path& folder) {
  const std::string path = (folder / "bundle.json").string();
  if (!std::filesystem::exists(path)) throw InputError(path, 0, "is missing; meniscus farm bundle makes it");
  const std::string text = read_text_file(path, kLargestManifest).text;
  try {
    if (is_nested_too_deep(text)) throw RequestError("is damaged: it is nested too deep");
    return bundle_from_json(Json::parse(text));
  } catch (const RequestError& error) {
    throw InputError(path, 0, error.what());
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path, 0, "is damaged: " + shortened(error.what(), kLongestShown));
  }
}

}  // namespace meniscus::farm
