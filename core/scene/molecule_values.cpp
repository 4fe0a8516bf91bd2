// SPDX-License-Identifier: BSD-3-Clause
// Binds the values of the molecule, of its surface, colours and cuts, of runs of frames and of films, and completes
// those that depend on each other.

#include <charconv>

#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/scene/scene_json.h"
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
    throw RequestError("{} is neither a number from 1 nor all", in_quotes(text));
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
  throw RequestError("{} is not one of {}", in_quotes(text), fmt::join({possible...}, ", "));
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

namespace meniscus::scene_values {
namespace {

// The values of the surface follow.

void read_probe(const Property&, Texts texts, Scene& scene) {
  double radius = 0.0;
  if (!parse_number(texts.back(), radius))
    throw RequestError(in_quotes(texts.back()) + " is not a finite number of Å, such as 1.4");
  if (const std::string fault = probe_fault(radius); !fault.empty()) throw RequestError(fault);
  scene.molecule.surface.probe_radius = radius;
  scene.molecule.surface.probe_named = true;
}

Written write_probe(const Property&, const Scene& scene) {
  const SurfaceRequest& surface = scene.molecule.surface;
  if (surface.kind == SurfaceKind::vdw && !surface.probe_named) return {};
  return written(surface.probe_radius, SurfaceRequest{}.probe_radius);
}

void reset_probe(const Property&, Scene& scene) {
  scene.molecule.surface.probe_radius = SurfaceRequest{}.probe_radius;
  scene.molecule.surface.probe_named = false;
}

void read_device(const Property&, Texts texts, Scene& scene) {
  SurfaceRequest& surface = scene.molecule.surface;
  surface.cpu = texts.back() == "cpu";
  const std::optional<DeviceChoice> choice = parse_device_choice(surface.cpu ? "auto" : texts.back());
  if (!choice)
    throw RequestError(in_quotes(texts.back()) +
                       " is not one of auto, gpu, gpu:N, gpu:UUID, gpu:PCI-ADDRESS, software, cpu");
  surface.gl.kind = choice->kind;
  surface.gl.index = choice->index;
  surface.gl.name = choice->name;
}

Written write_device(const Property&, const Scene& scene) {
  if (scene.molecule.surface.cpu) return {"cpu"};
  return written(to_string(scene.molecule.surface.gl), to_string(DeviceChoice{}));
}

/// Restricts "auto" to hardware GPUs; it is set after the device.
void read_require_gpu(const Property&, Texts texts, Scene& scene) {
  SurfaceRequest& surface = scene.molecule.surface;
  if (texts.back() == "false") return;
  if (surface.cpu || surface.gl.kind == DeviceChoice::Kind::software)
    throw GpuError(message("@require-gpu@ and @device {}@ exclude each other; leave one of them out",
                           surface.cpu ? "cpu" : to_string(surface.gl)));
  if (surface.gl.kind == DeviceChoice::Kind::automatic) surface.gl.kind = DeviceChoice::Kind::gpu;
}

constexpr Grouping kGroupings[] = {Grouping::chain, Grouping::model, Grouping::atom_class, Grouping::residue};

void read_division(const Property& property, Texts texts, Scene& scene) {
  Division& division = scene.molecule.division;
  const std::size_t place = place_of_word(words_of(property), texts.back());
  division.components = place == std::size(kGroupings);
  division.groups = division.components ? std::nullopt : std::optional(kGroupings[place]);
}

Written write_division(const Property& property, const Scene& scene) {
  const Division& division = scene.molecule.division;
  if (!division.components && !division.groups) return {};
  const auto* const group =
      division.components ? std::end(kGroupings) : std::ranges::find(kGroupings, *division.groups);
  return {words_of(property)[static_cast<std::size_t>(group - kGroupings)]};
}

std::string interface_text(const InterfaceRequest& sides) { return sides.left.text() + ":" + sides.right.text(); }

// The values of colours follow.

/// Reads a scheme for all atoms, or a rule for some.
void read_color(const Property&, Texts texts, Scene& scene) {
  ColorScheme& color = scene.molecule.color;
  for (const std::string& text : texts) {
    if (text.find('=') != std::string::npos) {
      color.rules.push_back(named_color_rule(text));
      continue;
    }
    const std::optional<ColorScheme> scheme = parse_color_scheme(text);
    if (!scheme) throw RequestError(in_quotes(text) + " is not one of " + color_scheme_words());
    color.by = scheme->by;
    color.fixed = scheme->fixed;
    scene.molecule.color_named = true;
  }
}

Written write_color(const Property&, const Scene& scene) {
  const ColorScheme& color = scene.molecule.color;
  Written texts;
  if (scene.molecule.color_named) texts.push_back(scheme_word(color));
  for (const ColorRule& rule : color.rules) texts.push_back(color_rule_text(rule));
  return texts;
}

void reset_color(const Property&, Scene& scene) {
  ColorScheme& color = scene.molecule.color;
  color.by = ColorScheme::By::automatic;
  color.rules.clear();
  scene.molecule.color_named = false;
}

ColorMap map_of(const std::string& text) {
  if (const std::optional<ColorMap> map = parse_color_map(text)) return *map;
  std::vector<std::string_view> names;
  for (const ColorMapMetadata& map : color_maps()) names.push_back(map.name);
  throw RequestError("{} is not one of {}", in_quotes(text), fmt::join(names, ", "));
}

std::optional<std::array<double, 2>> range_of(const std::string& text) {
  const std::optional<std::array<double, 2>> range = parse_color_range(text);
  if (!range && text != "auto")
    throw RequestError(in_quotes(text) + " is neither auto nor lo:hi with lo < hi, such as 10:60");
  return range;
}

std::string range_text(const std::array<double, 2>& range) { return fmt::format("{}:{}", range[0], range[1]); }

std::string opacity_text(const OpacityRule& rule) {
  return (rule.atoms ? rule.atoms->text() + "=" : "") + fmt::format("{}", rule.opacity);
}

// The values of the figure follow.

/// Sets the three values that this property is short for. They are written instead of it.
void read_look_into(const Property&, Texts texts, Scene& scene) {
  parse_selection(texts.back());
  const std::string first = fmt::format("first ({})", texts.back());
  scene.picture.zoom_to = parse_selection(first);
  scene.picture.direction = parse_view_direction("open");
  scene.figure.cuts.push_back(parse_cut("before " + first));
}

std::optional<glm::vec3> atom_or_color(const std::string& text) { return parse_color_or("atom", text); }

using Shape = RepresentationRequest::Kind;

template <Shape kind>
constexpr SceneValue shapes(std::string_view key) {
  return {key,
          [](const Property&, Texts texts, Scene& scene) {
            std::vector<RepresentationRequest>& requests = scene.figure.representations.requests;
            for (const std::string& text : texts) {
              if (requests.size() == kMostShown)
                throw RequestError("at most {} sets of atoms can be drawn in addition to the surface", kMostShown);
              requests.push_back({kind, parse_selection(text)});
            }
          },
          [](const Property&, const Scene& scene) {
            Written texts;
            for (const RepresentationRequest& request : scene.figure.representations.requests)
              if (request.kind == kind) texts.push_back(request.atoms.text());
            return texts;
          },
          [](const Property&, Scene& scene) {
            std::erase_if(scene.figure.representations.requests,
                          [](const RepresentationRequest& request) { return request.kind == kind; });
          }};
}

/// Reads objects; messages of errors say which object they refer to.
void read_objects(const Property&, Texts texts, Scene& scene) {
  const auto named = [&](std::size_t n, std::string_view fault) {
    constexpr std::string_view kPrefix = "object: ";
    if (fault.starts_with(kPrefix)) fault.remove_prefix(kPrefix.size());
    return texts.size() == 1 ? std::string(fault) : fmt::format("{} of {}: {}", n + 1, texts.size(), fault);
  };
  for (std::size_t n = 0; n < texts.size(); ++n) {
    try {
      scene.figure.objects.push_back(parse_figure_object(texts[n]));
    } catch (const SelectionError& error) {
      throw SelectionError(named(n, error.sentence()), error.picture());
    } catch (const RequestError& error) {
      throw RequestError(named(n, error.what()));
    }
  }
}

Written write_objects(const Property&, const Scene& scene) {
  Written texts;
  for (const FigureObjectRequest& object : scene.figure.objects)
    texts.push_back(figure_object_json(object).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  return texts;
}

/// Returns the value of dashed lines, which are written as objects.
template <Shape kind>
constexpr SceneValue dashed(std::string_view key) {
  return {key,
          [](const Property&, Texts texts, Scene& scene) {
            for (const std::string& text : texts) scene.figure.objects.push_back(parse_dashes(kind, text));
          },
          [](const Property&, const Scene&) { return Written(); }};
}

constexpr auto kSurfaceRows = std::to_array<SceneValue>({
    plain("surface.shown", [](auto& s) { return &s.figure.hides_surface; }),
    plain("shapes.bare", [](auto& s) { return &s.figure.bare; }),
    coded<parse_interface, interface_text>("surface.interface", [](auto& s) { return &s.molecule.interface; }),
    worded<SurfaceKind::ses, SurfaceKind::sas, SurfaceKind::vdw>("surface.kind",
                                                                 [](auto& s) { return &s.molecule.surface.kind; }),
    {"surface.probe", read_probe, write_probe, reset_probe},
    plain("surface.show", [](auto& s) { return &s.molecule.show; }),
    plain("surface.patches", [](auto& s) { return &s.molecule.patches; }),
    plain("surface.min_patch", [](auto& s) { return &s.molecule.least_patch; }),
    {"surface.by", read_division, write_division},
    worded<Cavities::keep, Cavities::drop, Cavities::only>("surface.cavities",
                                                           [](auto& s) { return &s.molecule.division.cavities; }),
    {"surface.device", read_device, write_device},
    {"surface.require_gpu", read_require_gpu, [](const Property&, const Scene&) { return Written(); }},
    plain("surface.threads", [](auto& s) { return &s.molecule.surface.threads; }),
    plain("surface.verify", [](auto& s) { return &s.molecule.surface.verify; }),
    {"surface.color", read_color, write_color, reset_color},
    plain("surface.color_by_file", [](auto& s) { return &s.molecule.number_file; }),
    plain("surface.color_column", [](auto& s) { return &s.molecule.number_column; }),
    plain("surface.color_map_file", [](auto& s) { return &s.molecule.volume_file; }),
    plain("surface.map_offset", [](auto& s) { return &s.molecule.volume_offset; }),
    coded<map_of, map_name>("surface.map", [](auto& s) { return &s.molecule.color.map; }),
    plain("surface.map_file", [](auto& s) { return &s.molecule.map_file; }),
    coded<range_of, range_text>("surface.color_range", [](auto& s) { return &s.molecule.color.range; }),
    coded<parse_any_color, hex_color>("surface.missing_color", [](auto& s) { return &s.molecule.color.missing; }),
    plain("surface.color_title", [](auto& s) { return &s.molecule.color.title; }),
    plain("surface.color_unit", [](auto& s) { return &s.molecule.color.unit; }),
    coded<parse_opacity_rule, opacity_text>("surface.opacity", [](auto& s) { return &s.molecule.color.opacities; }),
    plain("surface.film_opacity", [](auto& s) { return &s.figure.thickens; }),
    coded<parse_cut, cut_text>("surface.clip", [](auto& s) { return &s.figure.cuts; }),
    plain("surface.clip_all", [](auto& s) { return &s.figure.cuts_all; }),
    {"camera.look_into", read_look_into, [](const Property&, const Scene&) { return Written(); }},
    coded<atom_or_color, hex_color>("surface.cap_color", [](auto& s) { return &s.figure.cap.color; }),
    plain("surface.cap_hatching", [](auto& s) { return &s.figure.cap.hatching; }),
    shapes<Shape::sticks>("figure.sticks"),
    shapes<Shape::balls_and_sticks>("figure.balls"),
    shapes<Shape::spheres>("figure.spheres"),
    shapes<Shape::backbone>("figure.tube"),
    shapes<Shape::bases>("figure.bases"),
    shapes<Shape::sugar_symbols>("figure.glycans"),
    dashed<Shape::hydrogen_bonds>("figure.hydrogen_bonds"),
    dashed<Shape::distance>("figure.distance"),
    plain("shapes.stick_radius", [](auto& s) { return &s.figure.representations.stick_radius; }),
    plain("shapes.tube_radius", [](auto& s) { return &s.figure.representations.tube_radius; }),
    {"figure.object", read_objects, write_objects, [](const Property&, Scene& scene) { scene.figure.objects.clear(); }},
});

}  // namespace

std::span<const SceneValue> surface_values() { return kSurfaceRows; }

}  // namespace meniscus::scene_values
