// SPDX-License-Identifier: BSD-3-Clause
// Binds the values of the molecule, of runs of frames and of films, and completes those that depend on each other.
#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/scene/scene_value.h"
#include "core/scene/scene_values.h"

namespace meniscus::scene_values {
namespace {

// The values of the molecule follow.

ModelChoice model_of(const std::string& text) {
  ModelChoice choice;
  choice.all = text == "all";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), choice.number);
  if (!choice.all && (error != std::errc() || end != text.data() + text.size() || choice.number < 1))
    throw RequestError(fmt::format("{} is neither a number from 1 nor all", in_quotes(text)));
  return choice;
}

std::string model_text(const ModelChoice& choice) { return choice.all ? "all" : std::to_string(choice.number); }

AltlocChoice altloc_of(const std::string& text) {
  if (const std::optional<AltlocChoice> choice = parse_altloc_choice(text)) return *choice;
  throw RequestError(in_quotes(text) + " is not best, first, all or one letter");
}

std::string altloc_text(const AltlocChoice& choice) {
  switch (choice.rule) {
    case AltlocChoice::Rule::first:
      return "first";
    case AltlocChoice::Rule::letter:
      return {choice.letter};
    case AltlocChoice::Rule::all:
      return "all";
    case AltlocChoice::Rule::best:
      break;
  }
  return "best";
}

void read_radii(const Property&, Texts texts, Scene& scene) {
  if (texts.back().empty()) return;  // `info --radii` prints the sets
  std::vector<std::string> sets{"file"};
  for (const RadiiSet* set : radii_sets()) sets.emplace_back(set->name);
  scene.molecule.reading.radii.set = sets[place_of_word(sets, texts.back())];
}

Written write_radii(const Property&, const Scene& scene) {
  return written(scene.molecule.reading.radii.set, std::string());
}

std::string radius_text(const RadiusOverride& one) { return fmt::format("{}={}", one.atoms.text(), one.radius); }

WholeBy whole_of(const std::string& text) {
  if (text == "guess") return WholeBy::guess;
  if (text.empty() || text == "bonds" || text == "true") return WholeBy::bonds;
  throw RequestError(in_quotes(text) + " is neither bonds nor guess");
}

std::string whole_text(WholeBy whole) {
  return whole == WholeBy::nothing ? "" : whole == WholeBy::guess ? "guess" : "bonds";
}

template <int... possible>
int one_of_numbers(const std::string& text) {
  std::int64_t number = 0;
  if (parse_whole_number(text, number) && ((number == possible) || ...)) return static_cast<int>(number);
  throw RequestError(fmt::format("{} is not one of {}", in_quotes(text), fmt::join({possible...}, ", ")));
}

std::string number_text(int number) { return std::to_string(number); }

// The values that depend on each other follow.

void complete_colors(MoleculeRequest& molecule) {
  using By = ColorScheme::By;
  ColorScheme& color = molecule.color;
  const bool has_numbers = !molecule.number_file.empty(), has_volume = !molecule.volume_file.empty();
  if (has_numbers && !molecule.color_named && !color.uses_file()) color.by = By::file;
  if (has_volume) {
    if (molecule.color_named)
      throw ValueError("surface.color_map_file",
                       message("is itself a colour scheme; leave out the other @color@, except EXPR=COLOR"));
    if (!color.range)
      throw ValueError("surface.color_map_file", message("needs @color-range LO:HI@, such as -5:5 for kT/e"));
    color.by = By::volume;
  }
  if (color.uses_file() && !has_numbers)
    throw ValueError("surface.color",
                     message("{} needs @color-by-file FILE@", color.uses(By::conservation) ? "conservation" : "file"));
  if (has_numbers && !color.uses_file())
    throw ValueError("surface.color_by_file", message("is itself a colour scheme; leave out the other @color@"));
  if (color.by == By::kind && !color.rules.empty())
    throw ValueError("surface.color", "kind colours patches, but EXPR=COLOR colours atoms; choose another scheme");
  if (color.uses_scale()) return;
  const char* const key = !molecule.map_file.empty() ? "surface.map_file"
                          : color.map                ? "surface.map"
                          : color.range              ? "surface.color_range"
                          : color.missing            ? "surface.missing_color"
                                                     : nullptr;
  if (key)
    throw ValueError(key,
                     "is for colours by a number: bfactor, occupancy, charge, hydrophobicity, index, rainbow, radial, "
                     "lipophilicity, file, a volume map");
}

void complete_interface(Scene& scene) {
  MoleculeRequest& molecule = scene.molecule;
  if (!molecule.interface) return;
  if (!molecule.color_named && molecule.color.rules.empty() && molecule.number_file.empty())
    molecule.color.by = ColorScheme::By::buried;
  if (!scene.picture.direction && scene.picture.camera_file.empty())
    scene.picture.direction = parse_view_direction("z");
}

constexpr auto kMoleculeRows = std::to_array<SceneValue>({
    plain("molecule.file", [](auto& s) { return &s.molecule.file; }),
    plain("molecule.add", [](auto& s) { return &s.molecule.reading.added; }),
    plain("molecule.superpose_on", [](auto& s) { return &s.molecule.reading.superpose_on; }),
    coded<model_of, model_text>("molecule.model", [](auto& s) { return &s.molecule.reading.model; }),
    coded<altloc_of, altloc_text>("molecule.altloc", [](auto& s) { return &s.molecule.reading.altloc; }),
    plain("molecule.select", [](auto& s) { return &s.molecule.reading.selection; }),
    plain("molecule.keep_water", [](auto& s) { return &s.molecule.reading.keep_water; }),
    plain("molecule.keep_ions", [](auto& s) { return &s.molecule.reading.keep_ions; }),
    worded<UnknownElement::halt, UnknownElement::guess, UnknownElement::skip>(
        "molecule.unknown_element", [](auto& s) { return &s.molecule.reading.unknown_element; }),
    worded<Hydrogens::keep, Hydrogens::drop, Hydrogens::automatic>(
        "molecule.hydrogens", [](auto& s) { return &s.molecule.reading.hydrogens; }),
    {"molecule.radii", read_radii, write_radii},
    plain("molecule.radii_file", [](auto& s) { return &s.molecule.reading.radii.files; }),
    coded<parse_radius_override, radius_text>("molecule.radius",
                                              [](auto& s) { return &s.molecule.reading.radii.overrides; }),
    plain("molecule.assembly", [](auto& s) { return &s.molecule.reading.assembly; }),
    worded<InstanceMode::exact, InstanceMode::separate>("molecule.instances",
                                                        [](auto& s) { return &s.molecule.division.instances; }),

    plain("frames.trajectory", [](auto& s) { return &s.frames.trajectories; }),
    plain("frames.trajectory_atoms", [](auto& s) { return &s.frames.trajectory_atoms; }),
    plain("frames.trust_atom_order", [](auto& s) { return &s.frames.trust_atom_order; }),
    plain("frames.frames", [](auto& s) { return &s.frames.frames; }),
    plain("frames.stride", [](auto& s) { return &s.frames.stride; }),
    plain("frames.begin", [](auto& s) { return &s.frames.begin; }),
    plain("frames.end", [](auto& s) { return &s.frames.end; }),
    plain("frames.repeat", [](auto& s) { return &s.frames.repeat; }),
    plain("frames.interpolate", [](auto& s) { return &s.frames.interpolate; }),
    plain("frames.only", [](auto& s) { return &s.frames.only; }),
    plain("frames.select_once", [](auto& s) { return &s.frames.select_once; }),
    coded<whole_of, whole_text>("frames.whole", [](auto& s) { return &s.frames.whole; }),
    plain("frames.superpose", [](auto& s) { return &s.frames.superpose; }),
    plain("frames.center", [](auto& s) { return &s.frames.center; }),
    plain("frames.reference", [](auto& s) { return &s.frames.reference; }),
    plain("frames.smooth", [](auto& s) { return &s.frames.smooth; }),
    plain("frames.fps", [](auto& s) { return &s.film.frames_per_second; }),
    plain("frames.codec", [](auto& s) { return &s.film.codec; }),
    plain("frames.crf", [](auto& s) { return &s.film.rate_factor; }),
    coded<one_of_numbers<8, 10>, number_text>("frames.bits", [](auto& s) { return &s.film.bits; }),
    coded<one_of_numbers<420, 422, 444>, number_text>("frames.chroma", [](auto& s) { return &s.film.chroma; }),
});

}  // namespace

std::span<const SceneValue> molecule_values() { return kMoleculeRows; }

void complete_molecule(Scene& scene) {
  take_preset(scene);
  complete_interface(scene);
  complete_colors(scene.molecule);
}

}  // namespace meniscus::scene_values

namespace meniscus {

Scene prepared_scene(Scene scene) {
  MoleculeRequest& molecule = scene.molecule;
  scene.figure.mark_atoms(molecule.reading);
  if (molecule.color.uses(ColorScheme::By::secondary)) molecule.reading.secondary_structure = true;
  if (!molecule.interface) return scene;
  if (!molecule.reading.shown.empty())
    throw ValueError("surface.interface", "moves the atoms of both sides, so nothing else can be drawn with them");
  std::string atoms = "(" + molecule.interface->left.text() + ") or (" + molecule.interface->right.text() + ")";
  if (molecule.reading.selection) atoms = "(" + molecule.reading.selection->text() + ") and (" + atoms + ")";
  molecule.reading.selection = parse_selection(atoms);
  molecule.reading.required_parts = {molecule.interface->left, molecule.interface->right};
  return scene;
}

}  // namespace meniscus
