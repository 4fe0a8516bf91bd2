// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of what is drawn: sticks and tubes beside the surface, objects, opacity, cuts, interfaces.
#include "app/options/figure_options.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/options/object_option.h"
#include "app/options/property_options.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_schemes.h"

namespace meniscus {
namespace {

Cut cut_of(const std::string& text) {
  try {
    return parse_cut(text);
  } catch (const RequestError& error) {
    throw CLI::ValidationError("--clip", error.what());
  }
}

void parse_cap_color(const std::string& text, CapStyle& cap) {
  cap.color.reset();
  if (text == "atom") return;
  cap.color = parse_color(text);
  if (!cap.color)
    throw CLI::ValidationError("--cap-color", in_quotes(text) + " is neither atom nor a colour (red, #rrggbb)");
}

void add_cuts(PropertyOptions& options, FigureRequest& figure) {
  options.add_list("surface.clip", [&figure](const std::vector<std::string>& texts) {
    figure.cuts.clear();
    for (const std::string& text : texts) figure.cuts.push_back(cut_of(text));
  });
  options.add_parsed("surface.cap_color", [&figure](const std::string& text) { parse_cap_color(text, figure.cap); });
  options.add("surface.cap_hatching", figure.cap.hatching);
}

/// Says of which object a fault is.
FigureObjectRequest numbered_object(const std::vector<std::string>& texts, std::size_t n) {
  const auto named = [&](std::string_view fault) {
    constexpr std::string_view kPrefix = "object: ";
    if (fault.starts_with(kPrefix)) fault.remove_prefix(kPrefix.size());
    return texts.size() == 1 ? fmt::format("--object: {}", fault)
                             : fmt::format("--object {} of {}: {}", n + 1, texts.size(), fault);
  };
  try {
    return parse_figure_object(texts[n]);
  } catch (const SelectionError& error) {
    throw SelectionError(named(error.sentence()), error.picture());
  } catch (const RequestError& error) {
    throw RequestError(named(error.what()));
  }
}

}  // namespace

void add_representation_options(CLI::App& command, Representations& representations) {
  PropertyOptions options(command);
  using Kind = RepresentationRequest::Kind;
  const auto add = [&](const char* key, Kind kind) {
    options.add_list(key, [&representations, kind](const std::vector<std::string>& texts) {
      for (const std::string& text : texts) {
        if (representations.requests.size() == kMostShown)
          throw UsageError(
              fmt::format("{}: at most {} sets of atoms are drawn beside a surface", option_word(kind), kMostShown));
        representations.requests.push_back({kind, parse_selection_option(option_word(kind), text)});
      }
    });
  };
  add("figure.sticks", Kind::sticks);
  add("figure.balls", Kind::balls_and_sticks);
  add("figure.spheres", Kind::spheres);
  add("figure.tube", Kind::backbone);
  options.add("shapes.stick_radius", representations.stick_radius);
  options.add("shapes.tube_radius", representations.tube_radius);
}

void add_figure_options(CLI::App& command, MoleculeOptions& molecule, FigureRequest& figure) {
  PropertyOptions options(command);
  add_representation_options(command, figure.representations);
  options.add_list("figure.object", [&figure](const std::vector<std::string>& texts) {
    figure.objects.clear();
    for (std::size_t n = 0; n < texts.size(); ++n) figure.objects.push_back(numbered_object(texts, n));
  });
  options.add("surface.shown", figure.hides_surface);
  add_opacity_option(command, molecule);
  options.add("surface.film_opacity", figure.thickens);
  add_cuts(options, figure);
}

void add_interface_option(CLI::App& command, MoleculeOptions& molecule) {
  PropertyOptions(command).add_parsed("surface.interface", [&molecule](const std::string& text) {
    try {
      molecule.interface = parse_interface(text);
    } catch (const SelectionError& error) {
      throw SelectionError("--interface: " + error.sentence(), error.picture());
    } catch (const RequestError& error) {
      throw CLI::ValidationError("--interface", error.what());
    }
  });
}

void take_interface(const CLI::App& command, MoleculeOptions& molecule, ViewRequest& picture) {
  if (!molecule.interface) return;
  if (!molecule.reading.shown.empty() || !molecule.representations.empty())
    throw CLI::ValidationError("--interface", "moves the atoms of both sides; nothing can stand beside them");
  std::string atoms = "(" + molecule.interface->left.text() + ") or (" + molecule.interface->right.text() + ")";
  if (molecule.reading.selection) atoms = "(" + molecule.reading.selection->text() + ") and (" + atoms + ")";
  molecule.reading.selection = parse_selection(atoms);
  molecule.reading.sides = {molecule.interface->left, molecule.interface->right};
  if (command.count("--color") + command.count("--color-by-file") == 0) molecule.color.by = ColorScheme::By::buried;
  if (!picture.direction && picture.camera_file.empty()) picture.direction = parse_view_direction("z");
}

}  // namespace meniscus
