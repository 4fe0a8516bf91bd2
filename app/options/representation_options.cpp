// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of representations.
#include "app/options/representation_options.h"

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "app/process/program_error.h"

namespace meniscus {

void add_representation_options(CLI::App& command, Representations& representations) {
  using Kind = RepresentationRequest::Kind;
  const Heading heading(command, "Beside the surface");
  const auto add = [&](Kind kind, const char* help) {
    command
        .add_option_function<std::vector<std::string>>(
            option_word(kind),
            [&representations, kind](const std::vector<std::string>& texts) {
              for (const std::string& text : texts) {
                if (representations.requests.size() == kMostShown)
                  throw UsageError(fmt::format("{}: at most {} sets of atoms are drawn beside a surface",
                                               option_word(kind), kMostShown));
                representations.requests.push_back({kind, parse_selection_option(option_word(kind), text)});
              }
            },
            help)
        ->allow_extra_args(false)
        ->type_name("EXPR");
  };
  add(Kind::sticks, "Draw the bonds of these atoms as sticks; may be repeated, and name atoms outside --select");
  add(Kind::balls_and_sticks, "Draw them as balls and sticks");
  add(Kind::spheres, "Draw them as spheres of their van der Waals radii");
  add(Kind::backbone, "Draw their backbone as a tube, with helices as ribbons and strands as arrows");
  command.add_option("--stick-radius", representations.stick_radius, "Of sticks, in Å [0.25; 0.15 between balls]")
      ->check(CLI::Range(0.001, 10.0).description(""))
      ->type_name("Å");
  command.add_option("--tube-radius", representations.tube_radius, "Of tubes, in Å [0.3]; ribbons are in proportion")
      ->check(CLI::Range(0.001, 10.0).description(""))
      ->type_name("Å");
}

}  // namespace meniscus
