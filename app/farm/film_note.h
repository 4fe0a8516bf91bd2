// SPDX-License-Identifier: BSD-3-Clause
// The frames that a bundle's film lacks: a small file, state/film.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// What a film shows instead of a frame that is missing.
enum class InPlace {
  hold,  ///< the frame before once more; before the first good frame that one
  drop   ///< nothing: the film is shorter
};

/// "hold" or "drop".
std::string_view word_of(InPlace in_place);

/// A film that was made without some frames.
struct FilmNote {
  InPlace in_place = InPlace::hold;
  std::vector<std::uint64_t> missing;  ///< in the order of the run

  /// "the frame before is shown again".
  std::string_view sentence() const;
};

/// Of the film as it was made last; nothing if it has all frames, or if the note is another bundle's or damaged.
std::optional<FilmNote> read_film_note(const Bundle& bundle, const std::filesystem::path& folder);
/// Without missing frames there is no note. Throws OutputError.
void write_film_note(const Bundle& bundle, const std::filesystem::path& folder, const FilmNote& note);

}  // namespace meniscus::farm
