// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes the note as JSON.
#include "app/farm/film_note.h"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "app/farm/inner_path.h"
#include "core/base/text_file.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNote = "state/film.json";
constexpr std::size_t kLargestNote = std::size_t{64} << 20;

}  // namespace

std::string_view word_of(InPlace in_place) { return in_place == InPlace::hold ? "hold" : "drop"; }

std::string_view FilmNote::sentence() const {
  return in_place == InPlace::hold ? "the frame before is shown again" : "the film is shorter";
}

std::optional<FilmNote> read_film_note(const Bundle& bundle, const std::filesystem::path& folder) {
  const std::optional<std::string> text = inner_text(folder, kNote, kLargestNote);
  if (!text || is_nested_too_deep(*text)) return {};
  try {
    const Json json = Json::parse(*text);
    if (json.at("bundle") != bundle.fingerprint()) return {};
    FilmNote note{json.at("in_place") == word_of(InPlace::drop) ? InPlace::drop : InPlace::hold,
                  json.at("missing").get<std::vector<std::uint64_t>>()};
    std::erase_if(note.missing, [&](std::uint64_t frame) { return !std::ranges::count(bundle.frames, frame); });
    return note.missing.empty() ? std::nullopt : std::optional(note);
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

void write_film_note(const Bundle& bundle, const std::filesystem::path& folder, const FilmNote& note) {
  if (note.missing.empty()) {
    std::error_code ignored;
    std::filesystem::remove(folder / kNote, ignored);
    return;
  }
  OutputFile file(folder / kNote, Existing::replace);
  file.write(
      Json{{"bundle", bundle.fingerprint()}, {"in_place", word_of(note.in_place)}, {"missing", note.missing}}.dump(
          1, ' ', true) +
      "\n");
  file.commit();
}

}  // namespace meniscus::farm
