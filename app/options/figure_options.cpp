// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of figures and checks what they say.
#include "app/options/figure_options.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/options/object_option.h"
#include "app/options/representation_options.h"
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

/// --opacity and --film-opacity, whether what is seen through is a thin film.
void add_opacity_options(CLI::App& command, MoleculeOptions& molecule, bool& thickens) {
  const Heading heading(command, "Figure");
  add_opacity_option(command, molecule);
  command.add_flag("--film-opacity", thickens,
                   "A surface that is seen through is denser where the view grazes it, as a thin film is");
}

/// --clip, --cap-color and --cap-hatching.
void add_cut_options(CLI::App& command, FigureRequest& figure) {
  const Heading heading(command, "Figure");
  command
      .add_option_function<std::vector<std::string>>(
          "--clip",
          [&figure](const std::vector<std::string>& texts) {
            figure.cuts.clear();
            for (const std::string& text : texts) figure.cuts.push_back(cut_of(text));
          },
          "Show of the surface what lies where this holds, with exact caps: x<20, 1,1,0>35 (a direction), or depth>0.5 "
          "along the view (0 nearest, 1 farthest); repeatable, all count")
      ->allow_extra_args(false)
      ->type_name("PLANE");
  command
      .add_option_function<std::string>(
          "--cap-color", [&figure](const std::string& text) { parse_cap_color(text, figure.cap); },
          "Of caps: atom (default: that of the nearest atom) or a colour (red, #rrggbb)")
      ->type_name("COLOR");
  command.add_option("--cap-hatching", figure.cap.hatching, "Dark lines on caps, so many Å apart [0: none]")
      ->check(CLI::Range(0.0, 1000.0).description(""))
      ->type_name("Å");
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

void add_figure_options(CLI::App& command, MoleculeOptions& molecule, FigureRequest& figure) {
  const Heading heading(command, "Figure");
  add_representation_options(command, figure.representations);
  command
      .add_option_function<std::vector<std::string>>(
          "--object",
          [&figure](const std::vector<std::string>& texts) {
            figure.objects.clear();
            for (std::size_t n = 0; n < texts.size(); ++n) figure.objects.push_back(numbered_object(texts, n));
          },
          "Draw something more, with colour, opacity, material and cuts of its own, as in a scene file: "
          "'{\"representation\": \"surface\", \"selection\": \"chain B\", \"color\": \"red\"}'; repeatable")
      ->allow_extra_args(false)
      ->type_name("JSON");
  command.add_flag("--hide-surface", figure.hides_surface, "Draw only what stands beside the surface");
  add_opacity_options(command, molecule, figure.thickens);
  add_cut_options(command, figure);
}

void add_interface_option(CLI::App& command, MoleculeOptions& molecule) {
  command
      .add_option_function<std::string>(
          "--interface",
          [&molecule](const std::string& text) {
            try {
              molecule.interface = parse_interface(text);
            } catch (const SelectionError& error) {
              throw SelectionError("--interface: " + error.sentence(), error.picture());
            } catch (const RequestError& error) {
              throw CLI::ValidationError("--interface", error.what());
            }
          },
          "Open the contact of two groups like a book, both sides to the viewer, coloured by buried area: chains (A:B, "
          "A,C:B) or EXPR:EXPR")
      ->type_name("A:B");
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
