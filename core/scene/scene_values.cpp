// SPDX-License-Identifier: BSD-3-Clause
// Binds each property to its member of a scene, reads its value from text and writes it as text.
#include "core/scene/scene_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <map>
#include <optional>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/named_colors.h"
#include "core/scene/object_json.h"
#include "core/base/parse_number.h"

namespace meniscus {
namespace {

using Texts = std::span<const std::string>;
using Written = std::vector<std::string>;

const Scene& usual_scene() {
  static const Scene usual;
  return usual;
}

/// One property and its member. read() throws RequestError, SelectionError.
struct SceneValue {
  std::string_view key;
  void (*read)(const Property& property, Texts texts, Scene& scene);
  Written (*write)(const Property& property, const Scene& scene);
};

// Values of common types.

double number_in_range(const Property& property, const std::string& text) {
  double number = 0.0;
  std::int64_t whole = 0;
  const bool is_count = property.type == ValueType::count;
  const bool is_read = is_count ? parse_whole_number(text, whole) : parse_number(text, number);
  if (is_count) number = static_cast<double>(whole);
  if (is_read && (!property.has_range() || property.is_within(number))) return number;
  const char* const kind = is_count ? "whole number" : "number";
  if (!property.has_range()) throw RequestError(fmt::format("{} is not a {}", in_quotes(text), kind));
  if (property.highest >= kUnlimited)
    throw RequestError(fmt::format("{} is not a {} of at least {}", in_quotes(text), kind, property.lowest));
  throw RequestError(
      fmt::format("{} is not a {} from {} to {}", in_quotes(text), kind, property.lowest, property.highest));
}

template <typename Number>
requires std::is_arithmetic_v<Number>
void read(const Property& property, Texts texts, Number& number) {
  if constexpr (std::same_as<Number, bool>)
    number = texts.back() != "false";
  else
    number = static_cast<Number>(number_in_range(property, texts.back()));
}
void read(const Property&, Texts texts, std::string& text) { text = texts.back(); }
void read(const Property&, Texts texts, std::vector<std::string>& all) {
  all.insert(all.end(), texts.begin(), texts.end());
}
void read(const Property&, Texts texts, std::optional<Selection>& atoms) { atoms = parse_selection(texts.back()); }
template <typename Value>
void read(const Property& property, Texts texts, std::optional<Value>& value) {
  read(property, texts, value.emplace());
}

template <typename Number>
requires std::is_arithmetic_v<Number> Written written(const Number& number, const Number& usual) {
  if (number == usual) return {};
  return {fmt::format("{}", number)};
}
Written written(const std::string& text, const std::string& usual) {
  if (text == usual) return {};
  return {text};
}
Written written(const std::vector<std::string>& all, const std::vector<std::string>&) { return all; }
Written written(const std::optional<Selection>& atoms, const std::optional<Selection>&) {
  if (!atoms) return {};
  return {atoms->text()};
}
template <typename Value>
Written written(const std::optional<Value>& value, const std::optional<Value>&) {
  if (!value) return {};
  if constexpr (std::is_arithmetic_v<Value>)
    return {fmt::format("{}", *value)};
  else
    return {*value};
}

/// A value whose type says how it is read. Member: a function without state from a scene to it.
template <typename Member>
constexpr SceneValue plain(std::string_view key, Member) {
  return {key, [](const Property& property, Texts texts, Scene& scene) { read(property, texts, Member{}(scene)); },
          [](const Property&, const Scene& scene) { return written(Member{}(scene), Member{}(usual_scene())); }};
}

std::size_t place_of_word(const std::vector<std::string>& words, const std::string& text) {
  const auto word = std::ranges::find(words, text);
  if (word == words.end())
    throw RequestError(fmt::format("{} is not one of {}", in_quotes(text), fmt::join(words, ", ")));
  return static_cast<std::size_t>(word - words.begin());
}

/// One of the property's words. meanings: of them, in their order. Scene files of version 0.1.0 have the number of the
/// enumerator instead.
template <auto... meanings, typename Member>
constexpr SceneValue worded(std::string_view key, Member) {
  using Value = std::common_type_t<decltype(meanings)...>;
  constexpr auto read_word = [](const Property& property, Texts texts, Scene& scene) {
    constexpr Value kMeanings[] = {meanings...};
    const std::string& text = texts.back();
    const auto* const numbered = std::ranges::find_if(
        kMeanings, [&](Value meaning) { return text == fmt::format("{}", static_cast<int>(meaning)); });
    Member{}(scene) = numbered != std::end(kMeanings) ? *numbered : kMeanings[place_of_word(words_of(property), text)];
  };
  constexpr auto write_word = [](const Property& property, const Scene& scene) -> Written {
    constexpr Value kMeanings[] = {meanings...};
    const Value value = Member{}(scene);
    if (value == Member{}(usual_scene())) return {};
    return {words_of(property)[static_cast<std::size_t>(std::ranges::find(kMeanings, value) - kMeanings)]};
  };
  return {key, read_word, write_word};
}

// Lengths: pixels, or millimetres and the like on paper.

constexpr int kLargestSide = 65535;  // pixels; PNG and EXR readers of other programs stop here
constexpr double kUsualResolution = 300.0, kMillimetersPerInch = 25.4, kPointsPerInch = 72.0;

struct Length {
  double value = 0.0;
  double per_inch = 0.0;  ///< 0: pixels

  double pixels(double dots_per_inch) const {
    if (per_inch == 0.0) return value;
    return value * (dots_per_inch == 0.0 ? kUsualResolution : dots_per_inch) / per_inch;
  }
};

Length parse_length(const std::string& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  const std::string unit = text.substr(end);
  const std::map<std::string, double> per_inch{
      {"in", 1.0}, {"cm", kMillimetersPerInch / 10.0}, {"mm", kMillimetersPerInch}, {"pt", kPointsPerInch}};
  const auto known = per_inch.find(unit);
  Length length;
  if (!parse_number(text.substr(0, end), length.value) || (known == per_inch.end() && !unit.empty() && unit != "px"))
    throw RequestError(in_quotes(text) + " is no length, such as 85mm, 8.5cm, 3.5in, 8pt or 1000px");
  if (known != per_inch.end()) length.per_inch = known->second;
  return length;
}

/// Whether it is known how many pixels a length is: of one on paper once the resolution is.
bool is_settled(const Length& length, double dots_per_inch) { return length.per_inch == 0.0 || dots_per_inch > 0.0; }

int side_in_pixels(const std::string& text, double dots_per_inch) {
  const Length length = parse_length(text);
  const double pixels = std::round(length.pixels(dots_per_inch));
  if (is_settled(length, dots_per_inch) && !(pixels >= 1.0 && pixels <= kLargestSide))
    throw RequestError(
        fmt::format("{} makes {:.0f} pixels; a side has 1 to {}", in_quotes(text), pixels, kLargestSide));
  return static_cast<int>(pixels);
}

/// Of lines and letters, within the range of the property. what: "a line has".
double pixels_in_range(const Property& property, const std::string& text, double dots_per_inch, const char* what) {
  const Length length = parse_length(text);
  const double pixels = length.pixels(dots_per_inch);
  if (!is_settled(length, dots_per_inch) || property.is_within(pixels)) return pixels;
  throw RequestError(fmt::format("{} makes {:.4g} pixels; {} {} to {}", in_quotes(text), pixels, what, property.lowest,
                                 property.highest));
}

void keep_length(Scene& scene, std::string_view key, const std::string& text) {
  scene.lengths.erase(std::string(key));
  if (parse_length(text).per_inch != 0.0) scene.lengths[std::string(key)] = text;
}

/// A width of lines in pixels. The text on paper counts as long as it still means that width.
Written written_line(const Scene& scene, std::string_view key, const std::optional<float>& pixels) {
  if (!pixels) return {};
  const auto length = scene.lengths.find(key);
  if (length != scene.lengths.end() &&
      static_cast<float>(parse_length(length->second).pixels(scene.picture.dots_per_inch)) == *pixels)
    return {length->second};
  return {fmt::format("{}", *pixels)};
}

void read_size(const Property&, Texts texts, Scene& scene) {
  const std::string_view text = texts.back();
  const std::size_t cross = text.find('x');
  const auto parse_side = [](std::string_view digits, int& side) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    return error == std::errc() && end == digits.data() + digits.size() && side >= 1 && side <= kLargestSide;
  };
  if (cross == std::string::npos || !parse_side(text.substr(0, cross), scene.picture.width) ||
      !parse_side(text.substr(cross + 1), scene.picture.height))
    throw RequestError(fmt::format("{} is not WIDTHxHEIGHT in pixels, 1 to {} each, such as 1920x1080", in_quotes(text),
                                   kLargestSide));
  scene.lengths.erase("image.width");
  scene.lengths.erase("image.height");
}

/// The size that lengths make of sides. One side alone keeps the shape of the usual picture.
glm::ivec2 size_by_lengths(const Scene& scene) {
  const double shape = usual_scene().picture.aspect(), dots = scene.picture.dots_per_inch;
  const auto wide = scene.lengths.find("image.width"), high = scene.lengths.find("image.height");
  glm::ivec2 size = scene.picture.size();
  if (wide != scene.lengths.end()) {
    size.x = side_in_pixels(wide->second, dots);
    size.y = std::clamp(static_cast<int>(std::lround(size.x / shape)), 1, kLargestSide);
  }
  if (high != scene.lengths.end()) {
    size.y = side_in_pixels(high->second, dots);
    if (wide == scene.lengths.end())
      size.x = std::clamp(static_cast<int>(std::lround(size.y * shape)), 1, kLargestSide);
  }
  return size;
}

bool has_lengths_of_sides(const Scene& scene) {
  return (scene.lengths.contains("image.width") || scene.lengths.contains("image.height")) &&
         size_by_lengths(scene) == scene.picture.size();
}

Written write_size(const Property&, const Scene& scene) {
  if (scene.picture.size() == usual_scene().picture.size() || has_lengths_of_sides(scene)) return {};
  return {fmt::format("{}x{}", scene.picture.width, scene.picture.height)};
}

void read_side(const Property& property, Texts texts, Scene& scene) {
  side_in_pixels(texts.back(), scene.picture.dots_per_inch);
  scene.lengths[std::string(property.key)] = texts.back();
}

Written write_side(const Property& property, const Scene& scene) {
  const auto length = scene.lengths.find(property.key);
  if (length == scene.lengths.end() || !has_lengths_of_sides(scene)) return {};
  return {length->second};
}

template <typename Member>
constexpr SceneValue line_width(std::string_view key, Member) {
  return {
      key,
      [](const Property& property, Texts texts, Scene& scene) {
        Member{}(scene) =
            static_cast<float>(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, "a line has"));
        keep_length(scene, property.key, texts.back());
      },
      [](const Property& property, const Scene& scene) { return written_line(scene, property.key, Member{}(scene)); }};
}

void read_letters(const Property& property, Texts texts, Scene& scene) {
  scene.legend.style.letters = static_cast<int>(
      std::round(pixels_in_range(property, texts.back(), scene.picture.dots_per_inch, "letters have")));
  keep_length(scene, property.key, texts.back());
}

Written write_letters(const Property& property, const Scene& scene) {
  if (!scene.legend.style.letters) return {};
  const auto length = scene.lengths.find(property.key);
  if (length != scene.lengths.end() &&
      std::round(parse_length(length->second).pixels(scene.picture.dots_per_inch)) == *scene.legend.style.letters)
    return {length->second};
  return {fmt::format("{}", *scene.legend.style.letters)};
}

// The molecule.

void read_model(const Property&, Texts texts, Scene& scene) {
  const std::string& text = texts.back();
  ModelChoice choice;
  choice.all = text == "all";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), choice.number);
  if (!choice.all && (error != std::errc() || end != text.data() + text.size() || choice.number < 1))
    throw RequestError(fmt::format("{} is neither a number from 1 nor all", in_quotes(text)));
  scene.molecule.reading.model = choice;
}

Written write_model(const Property&, const Scene& scene) {
  const ModelChoice& choice = scene.molecule.reading.model;
  if (choice.all) return {"all"};
  if (choice.number == ModelChoice{}.number) return {};
  return {std::to_string(choice.number)};
}

void read_altloc(const Property&, Texts texts, Scene& scene) {
  const std::optional<AltlocChoice> choice = parse_altloc_choice(texts.back());
  if (!choice) throw RequestError(in_quotes(texts.back()) + " is not best, first, all or one letter");
  scene.molecule.reading.altloc = *choice;
}

Written write_altloc(const Property&, const Scene& scene) {
  switch (scene.molecule.reading.altloc.rule) {
    case AltlocChoice::Rule::first:
      return {"first"};
    case AltlocChoice::Rule::letter:
      return {std::string(1, scene.molecule.reading.altloc.letter)};
    case AltlocChoice::Rule::all:
      return {"all"};
    case AltlocChoice::Rule::best:
      break;
  }
  return {};
}

void read_radii(const Property&, Texts texts, Scene& scene) {
  if (texts.back().empty()) return;  // info --radii, which prints them
  std::vector<std::string> sets{"file"};
  for (const RadiiSet* set : radii_sets()) sets.emplace_back(set->name);
  scene.molecule.reading.radii.set = sets[place_of_word(sets, texts.back())];
}

Written write_radii(const Property&, const Scene& scene) {
  return written(scene.molecule.reading.radii.set, std::string());
}

void read_radius(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) scene.molecule.reading.radii.overrides.push_back(parse_radius_override(text));
}

Written write_radius(const Property&, const Scene& scene) {
  Written texts;
  for (const RadiusOverride& one : scene.molecule.reading.radii.overrides)
    texts.push_back(fmt::format("{}={}", one.atoms.text(), one.radius));
  return texts;
}

// The surface.

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

void read_device(const Property&, Texts texts, Scene& scene) {
  SurfaceRequest& surface = scene.molecule.surface;
  surface.cpu = texts.back() == "cpu";
  const std::optional<DeviceChoice> choice = parse_device_choice(surface.cpu ? "auto" : texts.back());
  if (!choice)
    throw RequestError(in_quotes(texts.back()) +
                       " is none of auto, gpu, gpu:N, gpu:UUID, gpu:PCI-ADDRESS, software, cpu");
  surface.gl.kind = choice->kind;
  surface.gl.index = choice->index;
  surface.gl.name = choice->name;
}

Written write_device(const Property&, const Scene& scene) {
  if (scene.molecule.surface.cpu) return {"cpu"};
  return written(to_string(scene.molecule.surface.gl), to_string(DeviceChoice{}));
}

/// "auto" becomes any hardware GPU and nothing else; set behind the device.
void read_require_gpu(const Property&, Texts texts, Scene& scene) {
  SurfaceRequest& surface = scene.molecule.surface;
  if (texts.back() == "false") return;
  if (surface.cpu || surface.gl.kind == DeviceChoice::Kind::software)
    throw GpuError(fmt::format("--require-gpu refuses --device {}; leave one of them away",
                               surface.cpu ? "cpu" : to_string(surface.gl)));
  if (surface.gl.kind == DeviceChoice::Kind::automatic) surface.gl.kind = DeviceChoice::Kind::gpu;
}

constexpr std::pair<const char*, Grouping> kGroupings[] = {{"chain", Grouping::chain},
                                                           {"model", Grouping::model},
                                                           {"class", Grouping::atom_class},
                                                           {"residue", Grouping::residue}};

void read_division(const Property&, Texts texts, Scene& scene) {
  Division& division = scene.molecule.division;
  division.groups.reset();
  division.components = texts.back() == "component";
  if (division.components) return;
  for (const auto& [word, grouping] : kGroupings)
    if (texts.back() == word) division.groups = grouping;
  if (!division.groups)
    throw RequestError(in_quotes(texts.back()) + " is none of chain, model, class, residue, component");
}

Written write_division(const Property&, const Scene& scene) {
  if (scene.molecule.division.components) return {"component"};
  for (const auto& [word, grouping] : kGroupings)
    if (scene.molecule.division.groups == grouping) return {word};
  return {};
}

void read_interface(const Property&, Texts texts, Scene& scene) {
  scene.molecule.interface = parse_interface(texts.back());
}

Written write_interface(const Property&, const Scene& scene) {
  if (!scene.molecule.interface) return {};
  return {scene.molecule.interface->left.text() + ":" + scene.molecule.interface->right.text()};
}

// Colours.

/// A scheme for all, or a rule for some.
void read_color(const Property&, Texts texts, Scene& scene) {
  ColorScheme& color = scene.molecule.color;
  for (const std::string& text : texts) {
    if (text.find('=') != std::string::npos) {
      color.rules.push_back(parse_color_rule(text));
      continue;
    }
    const std::optional<ColorScheme> scheme = parse_color_scheme(text);
    if (!scheme) throw RequestError(in_quotes(text) + " is none of " + color_scheme_words());
    color.by = scheme->by;
    color.fixed = scheme->fixed;
    scene.molecule.color_named = true;
  }
}

Written write_color(const Property&, const Scene& scene) {
  const ColorScheme& color = scene.molecule.color;
  Written texts;
  if (scene.molecule.color_named) texts.push_back(scheme_word(color));
  for (const ColorRule& rule : color.rules) texts.push_back(rule.atoms.text() + "=" + scheme_word(rule.paint));
  return texts;
}

void read_map(const Property&, Texts texts, Scene& scene) {
  scene.molecule.color.map = parse_color_map(texts.back());
  if (scene.molecule.color.map) return;
  std::vector<std::string_view> names;
  for (const ColorMapMetadata& map : color_maps()) names.push_back(map.name);
  throw RequestError(fmt::format("{} is none of {}", in_quotes(texts.back()), fmt::join(names, ", ")));
}

Written write_map(const Property&, const Scene& scene) {
  if (!scene.molecule.color.map) return {};
  return {std::string(map_name(*scene.molecule.color.map))};
}

void read_range(const Property&, Texts texts, Scene& scene) {
  scene.molecule.color.range = parse_color_range(texts.back());
  if (!scene.molecule.color.range && texts.back() != "auto")
    throw RequestError(in_quotes(texts.back()) + " is neither auto nor lo:hi with lo < hi, such as 10:60");
}

Written write_range(const Property&, const Scene& scene) {
  const auto& range = scene.molecule.color.range;
  if (!range) return {};
  return {fmt::format("{}:{}", (*range)[0], (*range)[1])};
}

void read_missing(const Property&, Texts texts, Scene& scene) {
  scene.molecule.color.missing = parse_color(texts.back());
  if (!scene.molecule.color.missing)
    throw RequestError(in_quotes(texts.back()) + " is neither a colour's name such as red nor #rrggbb");
}

Written write_missing(const Property&, const Scene& scene) {
  if (!scene.molecule.color.missing) return {};
  return {hex_color(*scene.molecule.color.missing)};
}

void read_opacity(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) scene.molecule.color.opacities.push_back(parse_opacity_rule(text));
}

Written write_opacity(const Property&, const Scene& scene) {
  Written texts;
  for (const OpacityRule& rule : scene.molecule.color.opacities)
    texts.push_back((rule.atoms ? rule.atoms->text() + "=" : "") + fmt::format("{}", rule.opacity));
  return texts;
}

// The figure.

void read_cuts(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) scene.figure.cuts.push_back(parse_cut(text));
}

Written write_cuts(const Property&, const Scene& scene) {
  Written texts;
  for (const Cut& cut : scene.figure.cuts) texts.push_back(cut_text(cut));
  return texts;
}

void read_cap_color(const Property&, Texts texts, Scene& scene) {
  std::optional<glm::vec3>& color = scene.figure.cap.color;
  color.reset();
  if (texts.back() == "atom") return;
  color = parse_color(texts.back());
  if (!color) throw RequestError(in_quotes(texts.back()) + " is neither atom nor a colour (red, #rrggbb)");
}

Written write_cap_color(const Property&, const Scene& scene) {
  if (!scene.figure.cap.color) return {};
  return {hex_color(*scene.figure.cap.color)};
}

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
          }};
}

/// Says of which object a fault is.
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

// Look, camera and picture.

void read_light(const Property&, Texts texts, Scene& scene) {
  std::array<float, 3> parts{};
  std::size_t count = 0;
  std::string_view left = texts.back();
  bool is_read = true;
  while (is_read && !left.empty() && count < parts.size()) {
    const std::size_t comma = std::min(left.find(','), left.size());
    is_read = parse_single(left.substr(0, comma), parts[count++]);
    left.remove_prefix(std::min(comma + 1, left.size()));
  }
  const float length = std::hypot(parts[0], parts[1], parts[2]);
  if (!is_read || count != parts.size() || !left.empty() || !std::isfinite(length) || length < 1e-6f)
    throw RequestError("expected a direction: three numbers that are not all 0, such as -1,1,1");
  scene.look.light_direction = glm::vec3(parts[0], parts[1], parts[2]);
}

Written write_light(const Property&, const Scene& scene) {
  const auto& light = scene.look.light_direction;
  if (!light) return {};
  return {fmt::format("{},{},{}", light->x, light->y, light->z)};
}

void read_view(const Property&, Texts texts, Scene& scene) {
  scene.picture.direction = parse_view_direction(texts.back());
  if (!scene.picture.direction)
    throw RequestError(
        fmt::format("{} is none of {}", in_quotes(texts.back()), fmt::join(view_direction_words(), ", ")));
}

Written write_view(const Property&, const Scene& scene) {
  if (!scene.picture.direction) return {};
  for (const std::string& word : view_direction_words())
    if (parse_view_direction(word) == scene.picture.direction) return {word};
  return {};
}

void read_turns(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) {
    const std::optional<Turn> turn = parse_turn(text);
    if (!turn)
      throw RequestError(in_quotes(text) +
                         " is no axis of the picture (x, y, z) with degrees behind it, such as y90 or x-30");
    scene.picture.turns.push_back(*turn);
  }
}

Written write_turns(const Property&, const Scene& scene) {
  Written texts;
  for (const Turn& turn : scene.picture.turns) texts.push_back(fmt::format("{}{}", "xyz"[turn.axis], turn.degrees));
  return texts;
}

void read_background(const Property&, Texts texts, Scene& scene) {
  std::optional<glm::vec3>& color = scene.image.background;
  const std::string& text = texts.back();
  color.reset();
  if (text == "transparent") return;
  if (text == "white") color = glm::vec3(1.0f);
  if (text == "black") color = glm::vec3(0.0f);
  if (!color) color = parse_hex_color(text);
  if (!color) throw RequestError(in_quotes(text) + " is none of transparent, white, black, #rrggbb");
}

Written write_background(const Property&, const Scene& scene) {
  if (!scene.image.background) return {};
  return {hex_color(*scene.image.background)};
}

void read_extent(const Property& property, Texts texts, Scene& scene) {
  constexpr Extent kMeanings[] = {Extent::visible, Extent::complete, Extent::paper};
  scene.image.extent = kMeanings[place_of_word(words_of(property), texts.back())];
}

Written write_extent(const Property& property, const Scene& scene) {
  constexpr Extent kMeanings[] = {Extent::visible, Extent::complete, Extent::paper};
  if (!scene.image.extent) return {};
  return {words_of(property)[static_cast<std::size_t>(std::ranges::find(kMeanings, *scene.image.extent) - kMeanings)]};
}

// Runs of frames, and what is written into pictures.

void read_whole(const Property&, Texts texts, Scene& scene) {
  const std::string& text = texts.back();
  if (text == "guess")
    scene.frames.whole = WholeBy::guess;
  else if (text.empty() || text == "bonds" || text == "true")
    scene.frames.whole = WholeBy::bonds;
  else
    throw RequestError(in_quotes(text) + " is neither bonds nor guess");
}

Written write_whole(const Property&, const Scene& scene) {
  if (scene.frames.whole == WholeBy::nothing) return {};
  return {scene.frames.whole == WholeBy::guess ? "guess" : "bonds"};
}

void read_scale_bar(const Property&, Texts texts, Scene& scene) { parse_scale_bar(texts.back(), scene.annotations); }

Written write_scale_bar(const Property&, const Scene& scene) {
  if (!scene.annotations.scale_bar) return {};
  return {scene.annotations.bar_length ? fmt::format("{}", *scene.annotations.bar_length) : "auto"};
}

void read_labels(const Property&, Texts texts, Scene& scene) {
  for (const std::string& text : texts) scene.annotations.labels.push_back(parse_label(text));
}

Written write_labels(const Property&, const Scene& scene) {
  Written texts;
  for (const LabelRequest& label : scene.annotations.labels) texts.push_back(label.atoms.text() + "=" + label.text);
  return texts;
}

template <int... possible>
constexpr auto one_of_numbers(const Property& property, const std::string& text) {
  const auto number = static_cast<int>(number_in_range(property, text));
  if (((number == possible) || ...)) return number;
  throw RequestError(fmt::format("{} is not one of {}", in_quotes(text), fmt::join({possible...}, ", ")));
}

void read_unit(const Property& property, Texts texts, Scene& scene) {
  constexpr double kNanometers = 0.1;
  scene.mesh.scale = place_of_word(words_of(property), texts.back()) == 0 ? 1.0 : kNanometers;
}

constexpr auto kValues = std::to_array<SceneValue>({
    plain(
        "molecule.file", [](auto& s) -> auto& { return s.molecule.file; }),
    {"molecule.model", read_model, write_model},
    {"molecule.altloc", read_altloc, write_altloc},
    plain(
        "molecule.select", [](auto& s) -> auto& { return s.molecule.reading.selection; }),
    plain(
        "molecule.keep_water", [](auto& s) -> auto& { return s.molecule.reading.keep_water; }),
    plain(
        "molecule.keep_ions", [](auto& s) -> auto& { return s.molecule.reading.keep_ions; }),
    worded<UnknownElement::halt, UnknownElement::guess, UnknownElement::skip>(
        "molecule.unknown_element", [](auto& s) -> auto& { return s.molecule.reading.unknown_element; }),
    worded<Hydrogens::keep, Hydrogens::drop, Hydrogens::automatic>(
        "molecule.hydrogens", [](auto& s) -> auto& { return s.molecule.reading.hydrogens; }),
    {"molecule.radii", read_radii, write_radii},
    plain(
        "molecule.radii_file", [](auto& s) -> auto& { return s.molecule.reading.radii.files; }),
    {"molecule.radius", read_radius, write_radius},
    plain(
        "molecule.assembly", [](auto& s) -> auto& { return s.molecule.reading.assembly; }),
    worded<InstanceMode::exact, InstanceMode::separate>(
        "molecule.instances", [](auto& s) -> auto& { return s.molecule.division.instances; }),

    plain(
        "frames.trajectory", [](auto& s) -> auto& { return s.frames.trajectories; }),
    plain(
        "frames.trajectory_atoms", [](auto& s) -> auto& { return s.frames.trajectory_atoms; }),
    plain(
        "frames.trust_atom_order", [](auto& s) -> auto& { return s.frames.trust_atom_order; }),
    plain(
        "frames.frames", [](auto& s) -> auto& { return s.frames.frames; }),
    plain(
        "frames.stride", [](auto& s) -> auto& { return s.frames.stride; }),
    plain(
        "frames.begin", [](auto& s) -> auto& { return s.frames.begin; }),
    plain(
        "frames.end", [](auto& s) -> auto& { return s.frames.end; }),
    plain(
        "frames.repeat", [](auto& s) -> auto& { return s.frames.repeat; }),
    plain(
        "frames.only", [](auto& s) -> auto& { return s.frames.only; }),
    plain(
        "frames.select_once", [](auto& s) -> auto& { return s.frames.select_once; }),
    {"frames.whole", read_whole, write_whole},
    plain(
        "frames.superpose", [](auto& s) -> auto& { return s.frames.superpose; }),
    plain(
        "frames.center", [](auto& s) -> auto& { return s.frames.center; }),
    plain(
        "frames.reference", [](auto& s) -> auto& { return s.frames.reference; }),
    plain(
        "frames.smooth", [](auto& s) -> auto& { return s.frames.smooth; }),
    plain(
        "frames.fps", [](auto& s) -> auto& { return s.film.frames_per_second; }),
    plain(
        "frames.codec", [](auto& s) -> auto& { return s.film.codec; }),
    plain(
        "frames.crf", [](auto& s) -> auto& { return s.film.rate_factor; }),
    {"frames.bits",
     [](const Property& property, Texts texts, Scene& scene) {
       scene.film.bits = one_of_numbers<8, 10>(property, texts.back());
     },
     [](const Property&, const Scene& scene) { return written(scene.film.bits, 0); }},
    {"frames.chroma",
     [](const Property& property, Texts texts, Scene& scene) {
       scene.film.chroma = one_of_numbers<420, 422, 444>(property, texts.back());
     },
     [](const Property&, const Scene& scene) { return written(scene.film.chroma, 0); }},

    plain(
        "surface.shown", [](auto& s) -> auto& { return s.figure.hides_surface; }),
    {"surface.interface", read_interface, write_interface},
    worded<SurfaceKind::ses, SurfaceKind::sas, SurfaceKind::vdw>(
        "surface.kind", [](auto& s) -> auto& { return s.molecule.surface.kind; }),
    {"surface.probe", read_probe, write_probe},
    plain(
        "surface.show", [](auto& s) -> auto& { return s.molecule.show; }),
    {"surface.by", read_division, write_division},
    worded<Cavities::keep, Cavities::drop, Cavities::only>(
        "surface.cavities", [](auto& s) -> auto& { return s.molecule.division.cavities; }),
    {"surface.device", read_device, write_device},
    {"surface.require_gpu", read_require_gpu, [](const Property&, const Scene&) { return Written(); }},
    plain(
        "surface.threads", [](auto& s) -> auto& { return s.molecule.surface.threads; }),
    plain(
        "surface.verify", [](auto& s) -> auto& { return s.molecule.surface.verify; }),
    {"surface.color", read_color, write_color},
    plain(
        "surface.color_by_file", [](auto& s) -> auto& { return s.molecule.number_file; }),
    plain(
        "surface.color_column", [](auto& s) -> auto& { return s.molecule.number_column; }),
    plain(
        "surface.color_map_file", [](auto& s) -> auto& { return s.molecule.volume_file; }),
    plain(
        "surface.map_offset", [](auto& s) -> auto& { return s.molecule.volume_offset; }),
    {"surface.map", read_map, write_map},
    plain(
        "surface.map_file", [](auto& s) -> auto& { return s.molecule.map_file; }),
    {"surface.color_range", read_range, write_range},
    {"surface.missing_color", read_missing, write_missing},
    plain(
        "surface.color_title", [](auto& s) -> auto& { return s.molecule.color.title; }),
    plain(
        "surface.color_unit", [](auto& s) -> auto& { return s.molecule.color.unit; }),
    {"surface.opacity", read_opacity, write_opacity},
    plain(
        "surface.film_opacity", [](auto& s) -> auto& { return s.figure.thickens; }),
    {"surface.clip", read_cuts, write_cuts},
    {"surface.cap_color", read_cap_color, write_cap_color},
    plain(
        "surface.cap_hatching", [](auto& s) -> auto& { return s.figure.cap.hatching; }),
    shapes<Shape::sticks>("figure.sticks"),
    shapes<Shape::balls_and_sticks>("figure.balls"),
    shapes<Shape::spheres>("figure.spheres"),
    shapes<Shape::backbone>("figure.tube"),
    plain(
        "shapes.stick_radius", [](auto& s) -> auto& { return s.figure.representations.stick_radius; }),
    plain(
        "shapes.tube_radius", [](auto& s) -> auto& { return s.figure.representations.tube_radius; }),
    {"figure.object", read_objects, write_objects},

    worded<LookPreset::publication, LookPreset::cover, LookPreset::flat, LookPreset::soft, LookPreset::classic>(
        "look.preset", [](auto& s) -> auto& { return s.look.preset; }),
    {"look.light", read_light, write_light},
    plain(
        "look.light_strength", [](auto& s) -> auto& { return s.look.light_strength; }),
    plain(
        "look.ambient", [](auto& s) -> auto& { return s.look.ambient; }),
    plain(
        "look.roughness", [](auto& s) -> auto& { return s.look.roughness; }),
    plain(
        "look.specular", [](auto& s) -> auto& { return s.look.specular; }),
    plain(
        "look.shininess", [](auto& s) -> auto& { return s.look.shininess; }),
    plain(
        "look.ambient_occlusion", [](auto& s) -> auto& { return s.look.ambient_occlusion; }),
    plain(
        "look.ambient_occlusion_radius", [](auto& s) -> auto& { return s.look.ambient_occlusion_radius; }),
    line_width(
        "look.silhouettes", [](auto& s) -> auto& { return s.look.silhouettes; }),
    line_width(
        "look.outer_lines", [](auto& s) -> auto& { return s.look.outer_lines; }),
    line_width(
        "look.inner_lines", [](auto& s) -> auto& { return s.look.inner_lines; }),
    line_width(
        "look.part_lines", [](auto& s) -> auto& { return s.look.part_lines; }),
    plain(
        "look.depth_cue", [](auto& s) -> auto& { return s.look.depth_cue; }),
    plain(
        "look.linear_alpha", [](auto& s) -> auto& { return s.look.linear_alpha; }),
    plain(
        "look.material", [](auto& s) -> auto& { return s.renderer.material; }),
    plain(
        "look.comments", [](auto& s) -> auto& { return s.renderer.comments; }),

    plain(
        "camera.from", [](auto& s) -> auto& { return s.picture.camera_file; }),
    worded<Projection::perspective, Projection::orthographic>(
        "camera.projection", [](auto& s) -> auto& { return s.picture.projection; }),
    {"camera.view", read_view, write_view},
    {"camera.turn", read_turns, write_turns},
    plain(
        "camera.zoom_to", [](auto& s) -> auto& { return s.picture.zoom_to; }),
    plain(
        "camera.path", [](auto& s) -> auto& { return s.run_camera.path_file; }),
    plain(
        "camera.turntable", [](auto& s) -> auto& { return s.run_camera.turns; }),
    plain(
        "camera.follow", [](auto& s) -> auto& { return s.run_camera.follow; }),
    {"image.size", read_size, write_size},
    {"image.width", read_side, write_side},
    {"image.height", read_side, write_side},
    plain(
        "image.dpi", [](auto& s) -> auto& { return s.picture.dots_per_inch; }),
    plain(
        "image.samples", [](auto& s) -> auto& { return s.image.samples; }),
    {"image.background", read_background, write_background},
    plain(
        "image.aovs", [](auto& s) -> auto& { return s.image.aovs; }),
    {"image.extent", read_extent, write_extent},

    plain(
        "legend.shown", [](auto& s) -> auto& { return s.legend.within; }),
    plain(
        "legend.file", [](auto& s) -> auto& { return s.legend.file; }),
    plain(
        "legend.title", [](auto& s) -> auto& { return s.legend.style.title; }),
    {"legend.size", read_letters, write_letters},
    worded<LegendStyle::Place::automatic, LegendStyle::Place::right, LegendStyle::Place::below>(
        "legend.place", [](auto& s) -> auto& { return s.legend.style.place; }),
    plain(
        "annotations.panel", [](auto& s) -> auto& { return s.annotations.panel; }),
    {"annotations.scale_bar", read_scale_bar, write_scale_bar},
    {"annotations.labels", read_labels, write_labels},
    plain(
        "annotations.time_stamp", [](auto& s) -> auto& { return s.annotations.time_stamp; }),
    plain(
        "annotations.curve", [](auto& s) -> auto& { return s.annotations.curve; }),
    plain(
        "annotations.curve_column", [](auto& s) -> auto& { return s.annotations.curve_column; }),

    plain(
        "mesh.tolerance", [](auto& s) -> auto& { return s.mesh.tolerance; }),
    plain(
        "mesh.tolerance_pixels", [](auto& s) -> auto& { return s.mesh.tolerance_pixels; }),
    plain(
        "mesh.density", [](auto& s) -> auto& { return s.mesh.density; }),
    plain(
        "mesh.even", [](auto& s) -> auto& { return s.mesh.even; }),
    plain(
        "mesh.format", [](auto& s) -> auto& { return s.mesh.format; }),
    plain(
        "mesh.attributes", [](auto& s) -> auto& { return s.mesh.attributes; }),
    {"mesh.unit", read_unit, [](const Property&, const Scene&) { return Written(); }},
    plain(
        "mesh.scale", [](auto& s) -> auto& { return s.mesh.scale; }),
    plain(
        "output.file", [](auto& s) -> auto& { return s.output; }),
});

const SceneValue* value_of(std::string_view key) {
  const auto* const found = std::ranges::find(kValues, key, &SceneValue::key);
  return found == kValues.end() ? nullptr : found;
}

// Values that depend on each other.

void complete_lengths(Scene& scene) {
  if (scene.picture.dots_per_inch == 0.0 && std::ranges::any_of(scene.lengths, [](const auto& length) {
        return parse_length(length.second).per_inch != 0.0;
      }))
    scene.picture.dots_per_inch = kUsualResolution;
  const std::map<std::string, std::string, std::less<>> lengths = scene.lengths;
  for (const auto& [key, text] : lengths) {
    if (key == "image.width" || key == "image.height") continue;
    try {
      set_value(scene, property_of(key), std::array{text});
    } catch (const RequestError& error) {
      throw ValueError(key, error.what());
    }
  }
  const glm::ivec2 size = size_by_lengths(scene);
  scene.picture.width = size.x;
  scene.picture.height = size.y;
}

void complete_colors(MoleculeRequest& molecule) {
  using By = ColorScheme::By;
  ColorScheme& color = molecule.color;
  const bool has_numbers = !molecule.number_file.empty(), has_volume = !molecule.volume_file.empty();
  if (has_numbers && !molecule.color_named && !color.uses_file()) color.by = By::file;
  if (has_volume) {
    if (molecule.color_named)
      throw ValueError("surface.color_map_file", "is itself a --color; leave the other one out, but EXPR=COLOR");
    if (!color.range) throw ValueError("surface.color_map_file", "needs --color-range LO:HI, such as -5:5 for kT/e");
    color.by = By::volume;
  }
  if (color.uses_file() && !has_numbers) throw ValueError("surface.color", "file needs --color-by-file FILE");
  if (has_numbers && !color.uses_file())
    throw ValueError("surface.color_by_file", "is itself a --color; leave the other one out");
  if (color.by == By::kind && !color.rules.empty())
    throw ValueError("surface.color", "kind colours patches, EXPR=COLOR atoms; choose another scheme beside it");
  if (color.uses_scale()) return;
  const char* const key = !molecule.map_file.empty() ? "surface.map_file"
                          : color.map                ? "surface.map"
                          : color.range              ? "surface.color_range"
                          : color.missing            ? "surface.missing_color"
                                                     : nullptr;
  if (key)
    throw ValueError(
        key,
        "is for colours by a number: bfactor, occupancy, charge, hydrophobicity, index, radial, file, a volume map");
}

void complete_interface(Scene& scene) {
  MoleculeRequest& molecule = scene.molecule;
  if (!molecule.interface) return;
  if (!molecule.color_named && molecule.color.rules.empty() && molecule.number_file.empty())
    molecule.color.by = ColorScheme::By::buried;
  if (!scene.picture.direction && scene.picture.camera_file.empty())
    scene.picture.direction = parse_view_direction("z");
}

}  // namespace

bool operator==(const Scene& one, const Scene& other) {
  return std::ranges::all_of(properties(), [&](const Property* property) {
    return !property->has(in_scene) || value_texts(one, *property) == value_texts(other, *property);
  });
}

bool is_scene_value(const Property& property) { return value_of(property.key) != nullptr; }

void set_value(Scene& scene, const Property& property, std::span<const std::string> texts) {
  try {
    value_of(property.key)->read(property, texts, scene);
  } catch (const RequestError& error) {
    throw ValueError(property.key, error.what());
  }
}

std::vector<std::string> value_texts(const Scene& scene, const Property& property) {
  return value_of(property.key)->write(property, scene);
}

void complete(Scene& scene) {
  complete_lengths(scene);
  complete_interface(scene);
  complete_colors(scene.molecule);
}

Scene readied(Scene scene) {
  MoleculeRequest& molecule = scene.molecule;
  scene.figure.ask_for(molecule.reading);
  if (!molecule.interface) return scene;
  if (!molecule.reading.shown.empty())
    throw ValueError("surface.interface", "moves the atoms of both sides; nothing can stand beside them");
  std::string atoms = "(" + molecule.interface->left.text() + ") or (" + molecule.interface->right.text() + ")";
  if (molecule.reading.selection) atoms = "(" + molecule.reading.selection->text() + ") and (" + atoms + ")";
  molecule.reading.selection = parse_selection(atoms);
  molecule.reading.sides = {molecule.interface->left, molecule.interface->right};
  return scene;
}

}  // namespace meniscus
