// SPDX-License-Identifier: BSD-3-Clause
// Commands that ask for the atom under the cursor, times of the renderer, and the state.

#include "app/preview/command_json.h"
#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera_json.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/ordered_classes.h"
#include "core/properties/properties.h"
#include "core/queries/copies.h"
#include "core/structure/element_tables.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

const char* kind_word(PatchKind kind) {
  constexpr const char* kWords[] = {"convex", "toroidal", "concave"};
  return kWords[static_cast<std::size_t>(kind)];
}

Json atom_json(const Atom& atom) {
  return {{"index", atom.index},
          {"name", escaped(atom.name)},
          {"element", atom.element ? element_symbol(atom.element) : ""},
          {"residue", escaped(atom.residue_name)},
          {"residue_number", atom.residue_number},
          {"insertion_code", atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code)},
          {"chain", escaped(atom.chain)},
          {"model", atom.model},
          {"place", escaped(atom_place(atom))}};
}

/// Returns why the molecule cannot be coloured by a scheme; empty: it can.
std::string lacking(const Structure& structure, const ColorScheme& color) {
  using By = ColorScheme::By;
  const std::vector<Atom>& atoms = structure.atoms;
  try {
    if (color.by == By::copy && std::ranges::none_of(atoms, [](const Atom& atom) { return atom.copy > 0; }))
      return "has no copies";
    if (color.by == By::model && std::ranges::all_of(atoms, [&](const Atom& a) { return a.model == atoms[0].model; }))
      return "has one model";
    if (color.by == By::secondary) {
      const std::vector<ColorClass> classes = secondary_classes(structure).classes;
      if (classes.size() == 1 && classes[0].name == "other") return "has no amino acids";
    }
    if (color.by == By::plddt && (confidence_classes(structure), doubt_of_confidence(structure)))
      return "is not known to be a predicted model";
    if (color.has_scale()) color_scale(structure, color);
  } catch (const Error& error) {
    const std::string text = error.what(), place = structure.file + ": ";
    const std::string sentence = text.starts_with(place) ? text.substr(place.size()) : text;
    return escaped(sentence.substr(0, sentence.find_first_of(";,")));
  }
  return {};
}

/// Returns the visible point of a pixel, or of an atom by its index in the picture's atoms.
std::optional<PickedPoint> point_of(const CommandReader& command, const Surroundings& around) {
  const ShownMolecule& molecule = around.molecule;
  if (!command.has("place")) {
    const glm::ivec2 size = around.state.size;
    return around.pictures.pick(around.state, molecule,
                                {command.integer("x", 0, size.x - 1), command.integer("y", 0, size.y - 1)});
  }
  const std::vector<Atom> atoms = molecule.atoms_in_view();
  const int place = command.integer("place", 0, static_cast<int>(atoms.size()) - 1);
  const std::uint32_t object = static_cast<std::size_t>(place) < molecule.atoms().size() ? 0 : 1;
  return PickedPoint{static_cast<std::uint32_t>(place), {}, atoms[static_cast<std::size_t>(place)].position, object, 0};
}

}  // namespace

Json get_state(const CommandReader&, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  const Structure& structure = molecule.structure();
  std::size_t copies = 1;
  for (const Instances& group : structure.instances) copies = std::max(copies, group.motions.size());
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const Ball& ball : molecule.balls()) {
    low = glm::min(low, ball.center - ball.radius);
    high = glm::max(high, ball.center + ball.radius);
  }
  const std::size_t atoms = molecule.balls().size();
  Json reply{{"file", escaped(structure.file)},
             {"atoms", atoms},
             {"copies", copies},
             {"low", {low.x, low.y, low.z}},
             {"high", {high.x, high.y, high.z}},
             {"revision", state.revision},
             {"strip",
              {{"scenes", state.strip.size()},
               {"place", state.strip_place},
               {"playing", state.playing && state.plays_strip},
               {"kept", Json::array()}}},
             {"frame", state.frame},
             {"frame_number", molecule.number_of(state.frame)},
             {"frames", molecule.frame_count()},
             {"keys", Json(camera_path_object(camera_keys(molecule, state)))["keys"]},
             {"follow_keys", state.follows_keys},
             {"playing", state.playing},
             {"fps", state.frames_per_second},
             {"camera", Json(camera_object(state.camera))},
             {"width", state.size.x},
             {"height", state.size.y},
             {"export_size", state.has_size ? Json{state.picture.width, state.picture.height} : Json(nullptr)},
             {"own_map", state.molecule.color.own_map != nullptr},
             {"undo", around.history.undo_steps()},
             {"redo", around.history.redo_steps()},
             {"unsaved", !around.exporter.keeps(state)},
             {"drawn_by", around.pictures.draws_on_cpu() ? "cpu" : "gl"}};
  for (const KeptScene& kept : state.strip)
    reply["strip"]["kept"].push_back(
        {{"number", kept.number}, {"frame", kept.frame}, {"hold", kept.hold}, {"transition", kept.transition}});
  reply["values"] = property_values(state);
  reply["legend_fault"] = molecule.legend_fault();
  return reply;
}

Json get_stats(const CommandReader&, const Surroundings& around) {
  const ViewCache& pictures = around.pictures;
  const double milliseconds = pictures.milliseconds();
  Json stages = Json::array();
  for (const StageTime& stage : pictures.stages())
    stages.push_back({{"name", stage.name}, {"milliseconds", stage.milliseconds}});
  return {{"frame_milliseconds", milliseconds},    {"fps", milliseconds > 0.0 ? 1000.0 / milliseconds : 0.0},
          {"width", pictures.molecule_size().x},   {"height", pictures.molecule_size().y},
          {"radii_grown_by", pictures.grown_by()}, {"stages", stages}};
}

Json get_choices(const CommandReader&, const Surroundings& around) {
  const ColorScheme& first = around.first.molecule.color;
  Json schemes = Json::array(), maps = Json::array();
  for (const ColorSchemeMetadata& scheme : color_schemes()) {
    if (!is_previewed(scheme.by) && scheme.by != first.by) continue;
    ColorScheme color;
    color.by = scheme.by;
    if (color.takes_file() && (first.file.empty() || first.by == ColorScheme::By::rmsf)) continue;
    color.file = first.file;
    schemes.push_back({{"word", scheme.word}, {"has_map", color.has_scale()}, {"description", scheme.description}});
    if (scheme.by == first.by) continue;
    if (const std::string lack = lacking(around.molecule.structure(), color); !lack.empty())
      schemes.back()["lacks"] = lack;
  }
  for (const ColorMapMetadata& map : color_maps()) maps.push_back(map.name);
  return {{"schemes", schemes}, {"maps", maps}, {"properties", property_choices()}};
}

Json pick(const CommandReader& command, const Surroundings& around) {
  const PreviewState& state = around.state;
  const ShownMolecule& molecule = around.molecule;
  const bool waits = command.flag_or(true, "wait"), area_wanted = command.flag_or(true, "area");
  const std::optional<PickedPoint> point = point_of(command, around);
  if (!point) return {{"hit", false}};
  const bool has_copies = !molecule.structure().instances.empty();
  const bool of_molecule = point->object == 0 || has_copies;
  const bool of_surface =
      of_molecule || (point->object > 1 && molecule.extras()->objects.at(point->object - 2).surface);
  Json reply = atom_json(molecule.atom_in_view(point->atom));
  reply["hit"] = true;
  reply["kind"] = point->kind ? kind_word(*point->kind) : of_surface ? "cap" : "shape";
  reply["selections"] = place_selections(molecule.atom_in_view(point->atom), molecule);
  reply["position"] = {point->position.x, point->position.y, point->position.z};
  if (has_copies) reply["copy"] = point->copy + 1;
  reply["exposed_area"] = nullptr;
  reply["area_follows"] = false;
  // The atom is not part of the molecule's surface, or the point is on another surface.
  if (point->atom >= molecule.atoms().size() || (of_surface && !of_molecule)) return reply;
  if (const std::optional<double> area = around.pictures.exposed_area(state, molecule, point->atom, waits, area_wanted))
    reply["exposed_area"] = *area;
  else
    reply["area_follows"] = around.pictures.computes_areas();
  return reply;
}

}  // namespace meniscus
