// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of pockets.
#include "app/options/pocket_options.h"

#include <string>

#include <fmt/format.h>

#include "core/base/text.h"
#include "core/text/parse_number.h"

namespace meniscus {
namespace {

/// A finite number of at least `least` and at most `most`.
double bounded(const std::string& option, const std::string& text, const char* unit, double least, double most) {
  double number = 0.0;
  if (!parse_number(text, number))
    throw CLI::ValidationError(option, fmt::format("{} is not a finite number of {}", in_quotes(text), unit));
  if (number < least || number > most)
    throw CLI::ValidationError(option, fmt::format("{} {} is not from {} to {}", number, unit, least, most));
  return number;
}

void add_number(CLI::App& command, const std::string& option, double& number, const char* unit, double least,
                double most, const std::string& what) {
  command
      .add_option_function<std::string>(
          option, [=, &number](const std::string& text) { number = bounded(option, text, unit, least, most); }, what)
      ->type_name(unit);
}

}  // namespace

void add_pocket_options(CLI::App& command, SurfaceRequest& surface, PocketRequest& pockets) {
  const Heading heading(command, "Surface");
  add_probe_option(command, surface);
  add_number(command, "--large-probe", pockets.large_probe_radius, "Å", kSmallestLargeProbe, kLargestLargeProbe,
             "Radius of the probe that rolls over the mouths in Å [4]; larger ones see wider, shallower pockets");
  add_number(command, "--trim", pockets.trim, "Å", 0.0, kLargestTrim,
             "Pockets begin so far below the large probe's surface [1]; more parts neighbours that meet at it");
  add_number(command, "--min-volume", pockets.min_volume, "Å³", 0.0, kLargestMinVolume,
             "Leave out smaller ones [30: a molecule of water]");
  add_number(command, "--mouth-tolerance", pockets.tolerance, "Å", kSmallestMouthTolerance, kLargestMouthTolerance,
             "How far a mouth may lie outside of where it should be [0.1]; less costs time");
}

}  // namespace meniscus
