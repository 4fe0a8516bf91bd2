// SPDX-License-Identifier: BSD-3-Clause
// Binds the values of the surface, its colours and cuts, and the shapes drawn in addition to it.
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_value.h"

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
  throw RequestError(fmt::format("{} is not one of {}", in_quotes(text), fmt::join(names, ", ")));
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
                throw RequestError(fmt::format("at most {} sets of atoms are drawn beside a surface", kMostShown));
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
