// SPDX-License-Identifier: BSD-3-Clause
// The commands that change what is seen, and the table of all.
#include <algorithm>
#include <array>
#include <new>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "app/preview/camera_motion.h"
#include "app/preview/command_reader.h"
#include "app/preview/key_table.h"
#include "app/preview/look_json.h"
#include "app/preview/session.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/molecule.h"
#include "core/scene/surface_objects.h"
#include "core/scene/surface_request.h"
#include "core/structure/selection/selection.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_atoms.h"
#include "core/color/css_colors.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr double kLongestDrag = 100.0;  // heights of the picture
constexpr int kLongestSide = 8192;      // pixels; a GL texture holds it on all hardware of GL 4.5
constexpr int kMostSamples = 64;
constexpr std::size_t kMostRules = 100;

glm::dvec2 drag_of(const CommandReader& command) {
  return {command.number("dx", -kLongestDrag, kLongestDrag), command.number("dy", -kLongestDrag, kLongestDrag)};
}

/// Of the chosen atoms; none of groups that have none.
std::vector<Instances> copies_of(const std::vector<Instances>& copies, const std::vector<bool>& chosen) {
  std::vector<Instances> kept;
  for (Instances group : copies) {
    std::erase_if(group.atoms, [&](std::uint32_t atom) { return !chosen[atom]; });
    if (!group.atoms.empty()) kept.push_back(std::move(group));
  }
  return kept;
}

/// "rules": a list of texts, as --color reads them.
std::vector<ColorRule> rules_of(const CommandReader& command) {
  std::vector<ColorRule> rules;
  const Json& texts = command.value("rules");
  if (!texts.is_array() || texts.size() > kMostRules)
    throw RequestError(
        fmt::format("color: \"rules\" is a list of at most {} texts such as \"ligand=red\"", kMostRules));
  for (const Json& text : texts) {
    if (!text.is_string()) throw RequestError("color: each of \"rules\" is a text such as \"ligand=red\"");
    try {
      rules.push_back(parse_color_rule(text.get<std::string>()));
    } catch (const RequestError& error) {
      throw RequestError(std::string("color: ") + error.what());
    }
  }
  return rules;
}

/// Of words and numbers that a command has, what `parse` makes of them; both kinds of errors name the command.
template <typename Parse>
auto naming(const CommandReader& command, const Parse& parse) {
  try {
    return parse();
  } catch (const SelectionError& error) {
    throw RequestError(command.word() + ": " + error.sentence());
  } catch (const RequestError& error) {
    throw RequestError(command.word() + ": " + error.what());
  }
}

Selection selection_of(const CommandReader& command, const char* key = "selection") {
  const std::string text = command.text(key);
  return naming(command, [&] { return parse_selection(text); });
}

/// "#rrggbb" or a name.
glm::vec3 color_of(const CommandReader& command, const char* key) {
  const std::optional<glm::vec3> color = parse_color(command.text(key));
  if (!color)
    throw RequestError(fmt::format("{}: \"{}\" is {}; it must be a colour's name such as red, or #rrggbb",
                                   command.word(), key, in_quotes(command.text(key))));
  return *color;
}

/// The scale of a scheme: as the command says, else its own.
void read_scale(const CommandReader& command, ColorScheme& color) {
  for (const char* key : {"map", "range", "missing"})
    if (command.has(key) && !color.uses_scale())
      throw RequestError(
          fmt::format("color: \"{}\" is for colours by a number, not {}", key, in_quotes(command.text("scheme"))));
  if (command.has("map")) {
    color.map = parse_color_map(command.text("map"));
    color.own_map.reset();
    if (!color.map) throw RequestError("color: " + in_quotes(command.text("map")) + " is no map; see meniscus colors");
  }
  if (command.has("range")) {
    const std::string text = command.text("range");
    color.range = parse_color_range(text);
    if (!color.range && text != "auto")
      throw RequestError("color: \"range\" is " + in_quotes(text) + "; it must be auto or lo:hi with lo < hi");
  }
  if (command.has("missing")) color.missing = color_of(command, "missing");
}

/// Rules and opacities of before stay unless the command has others; what a file said stays for its scheme.
ColorScheme scheme_of(const CommandReader& command, const ColorScheme& before, const ColorScheme& first) {
  const std::string word = command.text("scheme");
  const std::optional<ColorScheme> scheme = parse_color_scheme(word);
  if (!scheme) throw RequestError("color: " + in_quotes(word) + " is none of " + color_scheme_words());
  ColorScheme color = *scheme;
  if (color.by == ColorScheme::By::component)
    throw RequestError("color: parts of the surface have no atoms of their own; use meniscus render --color component");
  if (color.by == ColorScheme::By::volume) throw RequestError("color: volume maps are for render and export ply");
  color.rules = command.has("rules") ? rules_of(command) : before.rules;
  if (color.by == ColorScheme::By::kind && !color.rules.empty())
    throw RequestError("color: \"kind\" colours patches, rules colour atoms; send \"rules\": [] with it");
  color.opacities = before.opacities;
  if (color.uses_file() && first.file.empty())
    throw RequestError("color: \"file\" needs numbers; begin the preview with --color-by-file FILE");
  color.set_numbers(first.file);
  if (color.uses_scale()) color.own_map = first.own_map;
  if (color.by == first.by && color.has_scale()) {  // as it was begun with
    color.map = first.map;
    color.range = first.range;
    color.missing = first.missing;
  }
  read_scale(command, color);
  color.share_scale();
  return color;
}

/// Removes the entry that "index" names from what "of" names.
template <typename Entries>
void remove_from(const CommandReader& command, Entries& entries) {
  const std::string of = command.text("of");
  if (entries.empty()) throw RequestError(fmt::format("remove: there are no {}", of));
  if (!command.has("index")) return entries.clear();
  entries.erase(entries.begin() + command.integer("index", 0, static_cast<int>(entries.size()) - 1));
}

}  // namespace

struct PreviewSession::Command {
  /// What it does to the picture, and how it is undone.
  enum class Effect {
    none,
    picture,  ///< there is another; not to be undone
    edit,     ///< and this is a step by itself
    slide,    ///< the same command again makes one step of both
    motion    ///< and so do all movements of the camera
  };
  std::string_view word;
  std::vector<std::string_view> keys;
  Json (PreviewSession::*run)(const CommandReader&);
  Effect effect;

  std::string_view step() const {
    if (effect == Effect::edit) return {};
    return effect == Effect::motion ? "motion" : word;
  }
};

const std::vector<PreviewSession::Command>& PreviewSession::commands() {
  using S = PreviewSession;
  using Effect = Command::Effect;
  const std::span<const std::string_view> look = look_keys();
  static const std::vector<Command> table{
      {"orbit", {"dx", "dy"}, &S::orbit, Effect::motion},
      {"pan", {"dx", "dy"}, &S::pan, Effect::motion},
      {"zoom", {"factor", "x", "y"}, &S::zoom, Effect::motion},
      {"roll", {"degrees"}, &S::roll, Effect::motion},
      {"zoom_to", {"selection"}, &S::zoom_to, Effect::edit},
      {"center", {"x", "y"}, &S::center, Effect::edit},
      {"reset_view", {}, &S::reset_view, Effect::edit},
      {"camera", {"camera"}, &S::set_camera, Effect::edit},
      {"projection", {"projection"}, &S::set_projection, Effect::edit},
      {"save_view", {"name"}, &S::save_view, Effect::none},
      {"recall_view", {"name"}, &S::recall_view, Effect::edit},
      {"forget_view", {"name"}, &S::forget_view, Effect::none},
      {"probe", {"radius"}, &S::set_probe, Effect::slide},
      {"show", {"selection"}, &S::show, Effect::edit},
      {"hide", {"selection"}, &S::hide, Effect::edit},
      {"represent", {"as", "selection"}, &S::represent, Effect::edit},
      {"radii", {"stick", "tube"}, &S::set_radii, Effect::slide},
      {"color", {"scheme", "map", "range", "missing", "rules"}, &S::set_color, Effect::edit},
      {"paint", {"selection", "color"}, &S::paint, Effect::edit},
      {"patch_kinds", {"on"}, &S::set_patch_kinds, Effect::edit},
      {"opacity", {"opacity", "selection", "index"}, &S::set_opacity, Effect::slide},
      {"film_opacity", {"on"}, &S::set_film_opacity, Effect::edit},
      {"cut", {"plane", "index"}, &S::set_cut, Effect::slide},
      {"cap", {"color", "hatching"}, &S::set_cap, Effect::slide},
      {"remove", {"of", "index"}, &S::remove, Effect::edit},
      {"look", {look.begin(), look.end()}, &S::set_look, Effect::slide},
      {"preset", {"preset"}, &S::set_preset, Effect::edit},
      {"legend", {"on", "title", "letters", "place"}, &S::set_legend, Effect::edit},
      {"undo", {}, &S::undo, Effect::picture},
      {"redo", {}, &S::redo, Effect::picture},
      {"end_step", {}, &S::end_step, Effect::none},
      {"frame", {"index"}, &S::set_frame, Effect::picture},
      {"next_frame", {}, &S::next_frame, Effect::picture},
      {"key", {"on"}, &S::set_key, Effect::none},
      {"follow_keys", {"on"}, &S::follow_keys, Effect::picture},
      {"play", {"fps"}, &S::play, Effect::none},
      {"pause", {}, &S::pause, Effect::none},
      {"resize", {"width", "height"}, &S::resize, Effect::picture},
      {"samples", {"count"}, &S::set_samples, Effect::picture},
      {"press", {"key"}, &S::press, Effect::none},
      {"pick", {"x", "y", "wait", "area"}, &S::pick, Effect::none},
      {"export",
       {"format", "path", "width", "height", "samples", "transparent", "force"},
       &S::export_view,
       Effect::none},
      {"render_command", {"width", "height", "samples", "transparent"}, &S::render_command, Effect::none},
      {"stats", {}, &S::stats, Effect::none},
      {"state", {}, &S::state, Effect::none},
      {"choices", {}, &S::choices, Effect::none},
      {"quit", {}, &S::quit, Effect::none},
  };
  return table;
}

Json PreviewSession::apply(const Json& command) {
  const auto failed = [](const std::string& error) { return Json{{"ok", false}, {"error", escaped(error)}}; };
  try {
    return carry_out(command);
  } catch (const GpuError&) {
    throw;
  } catch (const SelectionError& error) {
    return failed(error.sentence());
  } catch (const Error& error) {
    return failed(error.what());
  } catch (const std::bad_alloc&) {
    return failed("not enough memory");
  }
}

Json PreviewSession::carry_out(const Json& json) {
  const CommandReader reader(json);
  const auto command = std::ranges::find(commands(), reader.word(), &Command::word);
  if (command == commands().end()) {
    std::string words;
    for (const Command& known : commands()) words.append(words.empty() ? "" : ", ").append(known.word);
    throw RequestError(fmt::format("{} is no command; there are {}", in_quotes(reader.word()), words));
  }
  reader.expect_only(command->keys);
  const bool edits = command->effect >= Command::Effect::edit;
  const std::optional<PreviewFigure> before = edits ? std::optional<PreviewFigure>(view_) : std::nullopt;
  Json reply = (this->*command->run)(reader);
  if (edits) history_.note(command->step(), *before);
  if (command->effect != Command::Effect::none) reply["revision"] = ++revision_;
  if (sink_ && !is_question(json) && command->word != "press") sink_(json);
  reply["ok"] = true;
  return reply;
}

Json PreviewSession::orbit(const CommandReader& command) {
  look_from(orbited(view_.camera, drag_of(command)));
  return Json::object();
}

Json PreviewSession::pan(const CommandReader& command) {
  look_from(panned(view_.camera, drag_of(command)));
  return Json::object();
}

Json PreviewSession::zoom(const CommandReader& command) {
  constexpr double kMost = 1e3;  // more does not come of one movement; wheels are added up while a picture is drawn
  const double factor = std::clamp(command.number("factor", 1e-300, 1e300), 1.0 / kMost, kMost);
  if (command.has("x") != command.has("y")) throw RequestError("zoom: \"x\" and \"y\" are one place; give both");
  if (!command.has("x")) {
    look_from(zoomed(view_.camera, factor));
    return Json::object();
  }
  const glm::dvec2 size(molecule_size());
  const glm::dvec2 place{command.number("x", 0.0, view_.size.x), command.number("y", 0.0, view_.size.y)};
  look_from(zoomed_at(view_.camera, factor, (place - 0.5 * size) / size.y));
  return Json::object();
}

Json PreviewSession::roll(const CommandReader& command) {
  look_from(rolled(view_.camera, command.number("degrees", -360.0, 360.0) * (std::numbers::pi / 180.0)));
  return Json::object();
}

Json PreviewSession::zoom_to(const CommandReader& command) {
  const Selection selection = parse_selection(command.text("selection"));
  const std::vector<Atom> atoms = atoms_in_view();
  const std::vector<bool> chosen = selection.evaluate(atoms);
  std::vector<Ball> shown;
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (chosen[n]) shown.push_back({atoms[n].position, atoms[n].radius});
  const std::size_t count = shown.size();
  if (!structure_.instances.empty()) shown = reaching_balls(balls_, copies_of(structure_.instances, chosen));
  if (shown.empty()) throw RequestError("zoom_to: no atom of this frame is " + in_quotes(selection.text()));
  look_from(zoomed_to(view_.camera, shown, balls_in_view(), aspect()));
  return {{"atoms", count}};
}

Json PreviewSession::center(const CommandReader& command) {
  const std::optional<PickedPoint> point = point_at(command);
  if (!point) throw RequestError("center: nothing is there");
  look_from(centered(view_.camera, point->position, balls_in_view()));
  return {{"position", {point->position.x, point->position.y, point->position.z}}};
}

Json PreviewSession::reset_view(const CommandReader&) {
  if (first_overview_)
    look_at_all();
  else
    look_from(first_camera_);
  return Json::object();
}

Json PreviewSession::save_view(const CommandReader& command) {
  constexpr std::size_t kMostViews = 100, kLongestName = 60;
  const std::string name = command.text("name");
  if (name.empty() || name.size() > kLongestName)
    throw RequestError(fmt::format("save_view: a name has 1 to {} letters", kLongestName));
  if (!named_views_.contains(name) && named_views_.size() == kMostViews)
    throw RequestError(fmt::format("save_view: at most {} views are kept; forget one", kMostViews));
  named_views_[name] = view_.camera;
  return {{"views", named_views_.size()}};
}

Json PreviewSession::recall_view(const CommandReader& command) {
  const auto view = named_views_.find(command.text("name"));
  if (view == named_views_.end())
    throw RequestError("recall_view: no view is called " + in_quotes(command.text("name")));
  look_from(view->second);
  return Json::object();
}

Json PreviewSession::forget_view(const CommandReader& command) {
  if (named_views_.erase(command.text("name")) == 0)
    throw RequestError("forget_view: no view is called " + in_quotes(command.text("name")));
  return {{"views", named_views_.size()}};
}

Json PreviewSession::set_camera(const CommandReader& command) {
  look_from(parse_camera(json_line(command.value("camera")), "camera"));
  return Json::object();
}

Json PreviewSession::set_projection(const CommandReader& command) {
  const std::size_t word = command.choice("projection", {"perspective", "orthographic"});
  look_from(projected(view_.camera, word == 0 ? Projection::perspective : Projection::orthographic, balls_in_view()));
  return Json::object();
}

Json PreviewSession::set_probe(const CommandReader& command) {
  const double radius = command.number("radius", 0.0, 1e6);
  const std::string fault = probe_fault(radius);
  if (!fault.empty()) throw RequestError("probe: " + fault);
  if (view_.copies_apart && radius > view_.probe_radius) require_apart(structure_, radius);
  view_.probe_radius = radius;
  return Json::object();
}

Json PreviewSession::show(const CommandReader& command) {
  PreviewFigure next = view_;
  next.show.reset();
  if (command.has("selection")) next.show = selection_of(command);
  const std::size_t atoms = count_shown(next, command);
  become(std::move(next), Changed::colors);
  return {{"atoms", atoms}};
}

Json PreviewSession::hide(const CommandReader& command) {
  PreviewFigure next = view_;
  const std::string hidden = "not (" + selection_of(command).text() + ")";
  next.show = naming(command, [&] {
    return parse_selection(view_.show ? fmt::format("({}) and {}", view_.show->text(), hidden) : hidden);
  });
  const std::size_t atoms = count_shown(next, command);
  become(std::move(next), Changed::colors);
  return {{"atoms", atoms}};
}

std::size_t PreviewSession::count_shown(const PreviewFigure& figure, const CommandReader& command) const {
  if (!figure.show) return shown_atoms().size();
  std::vector<Atom> atoms;
  for (const std::uint32_t a : shown_atoms()) atoms.push_back(structure_.atoms[a]);
  const std::vector<bool> shown = figure.show->evaluate(atoms);
  const auto count = static_cast<std::size_t>(std::ranges::count(shown, true));
  if (count == 0)
    throw RequestError(fmt::format("{}: of the surface of {} nothing would be left; {}", command.word(),
                                   in_quotes(figure.show->text()), figure.show->why_none(atoms)));
  return count;
}

Json PreviewSession::represent(const CommandReader& command) {
  constexpr std::array<std::string_view, 4> kWords{"sticks", "balls", "spheres", "tube"};
  using Kind = RepresentationRequest::Kind;
  constexpr std::array<Kind, 4> kKinds{Kind::sticks, Kind::balls_and_sticks, Kind::spheres, Kind::backbone};
  const Kind kind = kKinds[command.choice("as", {kWords[0], kWords[1], kWords[2], kWords[3]})];
  PreviewFigure next = view_;
  std::vector<RepresentationRequest>& requests = next.figure.representations.requests;
  if (requests.size() == kMostShown)
    throw RequestError(
        fmt::format("represent: at most {} sets of atoms are drawn beside a surface; remove one", kMostShown));
  requests.push_back({kind, selection_of(command)});
  const std::size_t index = requests.size() - 1;
  become(std::move(next), Changed::shapes);
  return {{"index", index}};
}

Json PreviewSession::set_radii(const CommandReader& command) {
  PreviewFigure next = view_;
  Representations& representations = next.figure.representations;
  if (command.has("stick")) representations.stick_radius = command.number("stick", 0.001, 10.0);
  if (command.has("tube")) representations.tube_radius = command.number("tube", 0.001, 10.0);
  become(std::move(next), Changed::colors);  // of the same atoms
  return Json::object();
}

Json PreviewSession::set_color(const CommandReader& command) {
  PreviewFigure next = view_;
  next.color = scheme_of(command, view_.color, first_color_);
  become(std::move(next), Changed::colors);
  return Json::object();
}

Json PreviewSession::paint(const CommandReader& command) {
  PreviewFigure next = view_;
  const Selection selection = selection_of(command);
  if (next.color.by == ColorScheme::By::kind)
    throw RequestError("paint: kinds of patch are coloured now, not atoms; choose another scheme first");
  if (next.color.rules.size() == kMostRules)
    throw RequestError(fmt::format("paint: at most {} selections have colours of their own; remove one", kMostRules));
  const std::string rule = selection.text() + "=" + command.text("color");
  next.color.rules.push_back(naming(command, [&] { return parse_color_rule(rule); }));
  if (next.color.uses_file() && first_color_.file.empty())
    throw RequestError("paint: \"file\" needs numbers; begin the preview with --color-by-file FILE");
  next.color.set_numbers(first_color_.file);
  next.color.share_scale();
  become(std::move(next), Changed::colors);
  return {{"index", view_.color.rules.size() - 1}};
}

Json PreviewSession::set_opacity(const CommandReader& command) {
  PreviewFigure next = view_;
  std::vector<OpacityRule>& rules = next.color.opacities;
  OpacityRule rule;
  rule.opacity = static_cast<float>(command.number("opacity", 0.0, 1.0));
  std::size_t index = rules.size();
  if (command.has("index")) {
    index = static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(rules.size()) - 1));
    rules[index].opacity = rule.opacity;
  } else {
    if (command.has("selection")) rule.atoms = selection_of(command);
    const auto same = std::ranges::find_if(rules, [&](const OpacityRule& known) {
      return known.atoms.has_value() == rule.atoms.has_value() &&
             (!rule.atoms || known.atoms->text() == rule.atoms->text());
    });
    if (same == rules.end() && rules.size() == kMostRules)
      throw RequestError(fmt::format("opacity: at most {} selections have one of their own; remove one", kMostRules));
    if (same != rules.end()) rules.erase(same);  // the last counts
    rules.push_back(rule);
    index = rules.size() - 1;
  }
  become(std::move(next), Changed::colors);
  return {{"index", index}};
}

Json PreviewSession::set_film_opacity(const CommandReader& command) {
  PreviewFigure next = view_;
  next.figure.thickens = command.flag("on");
  become(std::move(next), Changed::cuts);
  return Json::object();
}

Json PreviewSession::set_cut(const CommandReader& command) {
  constexpr std::size_t kMostCuts = 16;
  PreviewFigure next = view_;
  std::vector<Cut>& cuts = next.figure.cuts;
  const Cut cut = naming(command, [&] { return parse_cut(command.text("plane")); });
  std::size_t index = cuts.size();
  if (command.has("index")) {
    index = static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(cuts.size()) - 1));
    cuts[index] = cut;
  } else {
    if (cuts.size() == kMostCuts) throw RequestError(fmt::format("cut: at most {} planes; remove one", kMostCuts));
    cuts.push_back(cut);
  }
  become(std::move(next), Changed::cuts);
  return {{"index", index}};
}

Json PreviewSession::set_cap(const CommandReader& command) {
  PreviewFigure next = view_;
  CapStyle& cap = next.figure.cap;
  if (command.has("color")) {
    cap.color.reset();
    if (command.text("color") != "atom") cap.color = color_of(command, "color");
  }
  cap.hatching = command.number_or(cap.hatching, "hatching", 0.0, 1000.0);
  become(std::move(next), Changed::cuts);
  return Json::object();
}

Json PreviewSession::remove(const CommandReader& command) {
  PreviewFigure next = view_;
  switch (command.choice("of", {"representations", "cuts", "rules", "opacities"})) {
    case 0:
      remove_from(command, next.figure.representations.requests);
      become(std::move(next), Changed::shapes);
      break;
    case 1:
      remove_from(command, next.figure.cuts);
      become(std::move(next), Changed::cuts);
      break;
    case 2:
      remove_from(command, next.color.rules);
      become(std::move(next), Changed::colors);
      break;
    default:
      remove_from(command, next.color.opacities);
      become(std::move(next), Changed::colors);
  }
  return Json::object();
}

Json PreviewSession::set_patch_kinds(const CommandReader& command) {
  PreviewFigure next = view_;
  next.patch_kinds = command.flag("on");
  become(std::move(next), Changed::colors);
  return Json::object();
}

Json PreviewSession::set_look(const CommandReader& command) {
  PreviewFigure next = view_;
  next.look = changed_look(view_.look, command);
  next.background = changed_background(view_.background, command);
  become(std::move(next), Changed::view);
  return Json::object();
}

Json PreviewSession::set_preset(const CommandReader& command) {
  const std::size_t preset = command.choice("preset", {"publication", "cover", "flat", "soft", "classic"});
  PreviewFigure next = view_;
  next.look = {.preset = static_cast<LookPreset>(preset)};
  become(std::move(next), Changed::view);
  return Json::object();
}

Json PreviewSession::set_legend(const CommandReader& command) {
  constexpr std::size_t kLongestTitle = 200;
  PreviewFigure next = view_;
  LegendStyle& style = next.legend_style;
  next.legend = command.flag_or(next.legend, "on");
  if (command.has("title")) {
    style.title.reset();
    if (!command.value("title").is_null()) style.title = shortened(command.text("title"), kLongestTitle);
  }
  if (command.has("letters")) {
    style.letters.reset();
    if (!command.value("letters").is_null()) style.letters = command.integer("letters", 6, 1000);
  }
  if (command.has("place"))
    style.place = static_cast<LegendStyle::Place>(command.choice("place", {"auto", "right", "below"}));
  const ColorScheme color = next.told_scheme();
  if (next.legend && color.by == ColorScheme::By::fixed && color.rules.empty())
    throw RequestError("legend: there is nothing to explain where all is of one colour; choose another scheme first");
  become(std::move(next), Changed::view);
  if (view_.overview) look_at_all();
  return Json::object();
}

Json PreviewSession::undo(const CommandReader&) {
  restore(history_.undo(view_), "undo: nothing was changed yet");
  return {{"undo", history_.undo_steps()}, {"redo", history_.redo_steps()}};
}

Json PreviewSession::redo(const CommandReader&) {
  restore(history_.redo(view_), "redo: nothing was undone");
  return {{"undo", history_.undo_steps()}, {"redo", history_.redo_steps()}};
}

void PreviewSession::restore(const std::optional<PreviewFigure>& figure, const char* none) {
  if (!figure) throw RequestError(none);
  become(*figure, Changed::shapes);
}

Json PreviewSession::end_step(const CommandReader&) {
  history_.end_step();
  return Json::object();
}

Json PreviewSession::set_frame(const CommandReader& command) {
  show_frame(static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(frame_count()) - 1)));
  return Json::object();
}

Json PreviewSession::next_frame(const CommandReader&) {
  // A frame that cannot be read is passed over, or playing would never come past it.
  for (std::size_t step = 1;; ++step) {
    try {
      show_frame((view_.frame + step) % frame_count());
      return {{"frame", view_.frame}};
    } catch (const InputError&) {
      if (step >= frame_count()) throw;
    }
  }
}

Json PreviewSession::set_key(const CommandReader& command) {
  if (!command.flag_or(true, "on")) {
    view_.keys.erase(view_.frame);
  } else {
    for (const auto& [frame, camera] : view_.keys)
      if (frame != view_.frame && camera.projection != view_.camera.projection)
        throw RequestError("key: all keys of the camera must have one projection, that of the first");
    view_.keys[view_.frame] = view_.camera;
  }
  return {{"keys", view_.keys.size()}};
}

Json PreviewSession::follow_keys(const CommandReader& command) {
  view_.follows_keys = command.flag("on");
  show_frame(view_.frame);
  return {{"follow_keys", view_.follows_keys}};
}

Json PreviewSession::play(const CommandReader& command) {
  view_.frames_per_second = command.number_or(view_.frames_per_second, "fps", 0.1, 240.0);
  view_.playing = frame_count() > 1;
  return {{"playing", view_.playing}};
}

Json PreviewSession::pause(const CommandReader&) {
  view_.playing = false;
  return Json::object();
}

Json PreviewSession::resize(const CommandReader& command) {
  view_.size = {command.integer("width", 16, kLongestSide), command.integer("height", 16, kLongestSide)};
  update_legend();
  if (view_.overview) look_at_all();
  return Json::object();
}

Json PreviewSession::set_samples(const CommandReader& command) {
  view_.samples = command.integer("count", 1, kMostSamples);
  return Json::object();
}

Json PreviewSession::press(const CommandReader& command) {
  const KeyMeaning meaning = key_meaning(command.text("key"), carry_out({{"command", "state"}}));
  Json reply = Json::object();
  if (meaning.command) {
    reply = carry_out(*meaning.command);  // which is recorded
    reply["command"] = *meaning.command;
  }
  if (meaning.action) reply["action"] = face_action_word(*meaning.action);
  return reply;
}

Json PreviewSession::quit(const CommandReader&) {
  quit_ = true;
  return Json::object();
}

}  // namespace meniscus
