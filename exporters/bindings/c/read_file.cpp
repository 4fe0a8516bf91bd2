// SPDX-License-Identifier: BSD-3-Clause
// Reads molecules from files with the options of a caller.
#include "exporters/bindings/c/c_structure.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {
namespace {

constexpr std::size_t kMostTexts = 10'000;

/// Returns the result of a function that parses a selection. Refuses an invalid selection; the message shows its place.
template <typename Understand>
auto understood(const char* option, const Understand& understand) {
  try {
    return understand();
  } catch (const SelectionError& error) {
    refuse(MENISCUS_USAGE, "{}: {}\n{}", option, error.sentence(), error.picture());
  }
}

/// Returns a copy of a caller's list of texts. Refuses NULL texts.
std::vector<std::string> texts_of(const char* const* texts, std::size_t count, const char* name) {
  if (count > kMostTexts)
    refuse(MENISCUS_CAPACITY, "{}: {} are more than the {} that are read", name, count, kMostTexts);
  require_rows(texts, {count, 1, sizeof(const char*)}, name);
  std::vector<std::string> result;
  for (std::size_t n = 0; n < count; ++n) {
    if (!texts[n]) refuse(MENISCUS_USAGE, "{}[{}] is NULL", name, n);
    result.emplace_back(texts[n]);
  }
  return result;
}

AltlocChoice altloc_of(const char* text) {
  const std::optional<AltlocChoice> choice = parse_altloc_choice(text ? text : kReadDefaults.altloc);
  if (!choice) refuse(MENISCUS_USAGE, "altloc is {}; it must be best, first, all or one letter", in_quotes(text));
  return *choice;
}

Hydrogens hydrogens_of(std::int32_t word) {
  switch (word) {
    case MENISCUS_HYDROGENS_AUTO:
      return Hydrogens::automatic;
    case MENISCUS_HYDROGENS_KEEP:
      return Hydrogens::keep;
    case MENISCUS_HYDROGENS_DROP:
      return Hydrogens::drop;
    default:
      refuse(MENISCUS_USAGE, "hydrogens is {}, none of MENISCUS_HYDROGENS_AUTO, _KEEP, _DROP", word);
  }
}

UnknownElement unknown_element_of(std::int32_t word) {
  switch (word) {
    case MENISCUS_UNKNOWN_HALT:
      return UnknownElement::halt;
    case MENISCUS_UNKNOWN_GUESS:
      return UnknownElement::guess;
    case MENISCUS_UNKNOWN_SKIP:
      return UnknownElement::skip;
    default:
      refuse(MENISCUS_USAGE, "unknown_element is {}, none of MENISCUS_UNKNOWN_HALT, _GUESS, _SKIP", word);
  }
}

ReadOptions reading_of(const meniscus_read_options& given) {
  require_zero(given.reserved, "meniscus_read_options.reserved");
  if (given.model < 0) refuse(MENISCUS_USAGE, "model is {}; it must be a number from 1, or 0 for all", given.model);
  ReadOptions reading;
  reading.model = {given.model == 0 ? 1 : given.model, given.model == 0};
  reading.altloc = altloc_of(given.altloc);
  reading.hydrogens = hydrogens_of(given.hydrogens);
  reading.unknown_element = unknown_element_of(given.unknown_element);
  reading.keep_water = given.keep_water != 0;
  reading.keep_ions = given.keep_ions != 0;
  if (given.assembly) reading.assembly = given.assembly;
  if (given.select) reading.selection = understood("select", [&] { return parse_selection(given.select); });
  if (given.radii) reading.radii.set = given.radii;
  reading.radii.files = texts_of(given.radii_files, given.radii_file_count, "radii_files");
  for (const std::string& text : texts_of(given.radius, given.radius_count, "radius"))
    reading.radii.overrides.push_back(understood("radius", [&] { return parse_radius_override(text); }));
  return reading;
}

}  // namespace

Structure read_file(const char* path, const meniscus_read_options* options) {
  const ReadOptions reading = reading_of(read_options(options, kReadDefaults, "meniscus_read_options"));
  // The library does not read the standard input, which "-" means in the program.
  return read_structure(std::string_view(path) == "-" ? "./-" : path, reading);
}

}  // namespace meniscus::c_api
