// SPDX-License-Identifier: BSD-3-Clause
// The commands that say what is shown: parts of the surface, what stands beside it, cuts.
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/scene/object_json.h"
#include "app/preview/command_values.h"
#include "app/preview/session.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/cut.h"
#include "core/scene/surface_objects.h"
#include "core/scene/surface_request.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

/// Removes the entry that "index" names from what "of" names.
template <typename Entries>
void remove_from(const CommandReader& command, Entries& entries) {
  const std::string of = command.text("of");
  if (entries.empty()) throw RequestError(fmt::format("remove: there are no {}", of));
  if (!command.has("index")) return entries.clear();
  entries.erase(entries.begin() + command.integer("index", 0, static_cast<int>(entries.size()) - 1));
}

/// Whether both are made of the same atoms in the same way, so that only looks differ.
bool same_shape(const FigureObjectRequest& a, const FigureObjectRequest& b) {
  return a.shapes == b.shapes && a.atoms.text() == b.atoms.text() && a.radius == b.radius && a.kind == b.kind &&
         a.probe_radius == b.probe_radius;
}

}  // namespace

Json PreviewSession::set_probe(const CommandReader& command) {
  const double radius = command.number("radius", 0.0, 1e6);
  const std::string fault = probe_fault(radius);
  if (!fault.empty()) throw RequestError("probe: " + fault);
  if (view_.kind == SurfaceKind::vdw)
    throw RequestError("probe: the van der Waals surface has no probe; choose another kind of surface first");
  PreviewFigure next = view_;
  next.probe_radius = radius;
  require_apart_in(next);
  become(std::move(next), Changed::view);
  return Json::object();
}

Json PreviewSession::set_surface(const CommandReader& command) {
  PreviewFigure next = view_;
  next.kind = static_cast<SurfaceKind>(command.choice("kind", {"ses", "sas", "vdw"}));
  require_apart_in(next);
  become(std::move(next), Changed::view);
  if (view_.overview) look_at_all();
  return Json::object();
}

Json PreviewSession::show(const CommandReader& command) {
  PreviewFigure next = view_;
  next.show.reset();
  if (command.has("selection")) next.show = selection_of(command);
  const std::size_t atoms = naming(command, [&] { return count_shown(next, marked_.get()); });
  become(std::move(next), Changed::colors);
  return {{"atoms", atoms}};
}

Json PreviewSession::hide(const CommandReader& command) {
  PreviewFigure next = view_;
  const std::string hidden = "not (" + selection_of(command).text() + ")";
  next.show = naming(command, [&] {
    return parse_selection(view_.show ? fmt::format("({}) and {}", view_.show->text(), hidden) : hidden);
  });
  const std::size_t atoms = naming(command, [&] { return count_shown(next, marked_.get()); });
  become(std::move(next), Changed::colors);
  return {{"atoms", atoms}};
}

Json PreviewSession::represent(const CommandReader& command) {
  constexpr std::array<std::string_view, 4> kWords{"sticks", "balls", "spheres", "tube"};
  using Kind = RepresentationRequest::Kind;
  constexpr std::array<Kind, 4> kKinds{Kind::sticks, Kind::balls_and_sticks, Kind::spheres, Kind::backbone};
  const Kind kind = kKinds[command.choice("as", {kWords[0], kWords[1], kWords[2], kWords[3]})];
  PreviewFigure next = view_;
  std::vector<RepresentationRequest>& requests = next.figure.representations.requests;
  if (requests.size() + next.figure.objects.size() >= kMostShown)
    throw RequestError(
        fmt::format("represent: at most {} sets of atoms are drawn beside a surface; remove one", kMostShown));
  requests.push_back({kind, selection_of(command)});
  const std::size_t index = requests.size() - 1;
  become(std::move(next), Changed::shapes);
  return {{"index", index}};
}

Json PreviewSession::put_object(const CommandReader& command) {
  PreviewFigure next = view_;
  std::vector<FigureObjectRequest>& objects = next.figure.objects;
  FigureObjectRequest object = naming(command, [&] { return parse_figure_object(command.value("object").dump()); });
  if (object.color) naming(command, [&] { return require_previewed(*object.color); });
  std::size_t index = objects.size();
  Changed changed = Changed::shapes;
  if (command.has("index")) {
    index = static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(objects.size()) - 1));
    if (same_shape(objects[index], object)) changed = Changed::colors;
    objects[index] = std::move(object);
  } else {
    if (objects.size() + next.figure.representations.requests.size() >= kMostShown)
      throw RequestError(
          fmt::format("object: at most {} sets of atoms are drawn beside a surface; remove one", kMostShown));
    objects.push_back(std::move(object));
  }
  become(std::move(next), changed);
  return {{"index", index}};
}

Json PreviewSession::hide_surface(const CommandReader& command) {
  PreviewFigure next = view_;
  next.figure.hides_surface = command.flag("on");
  become(std::move(next), Changed::cuts);
  return Json::object();
}

Json PreviewSession::set_radii(const CommandReader& command) {
  PreviewFigure next = view_;
  Representations& representations = next.figure.representations;
  if (command.has("stick")) representations.stick_radius = command.number("stick", 0.001, 10.0);
  if (command.has("tube")) representations.tube_radius = command.number("tube", 0.001, 10.0);
  become(std::move(next), Changed::colors);  // of the same atoms
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
  Json reply{{"index", index}};
  if (const std::vector<std::string> idle = idle_among({&cut, 1}); !idle.empty()) reply["note"] = idle.front();
  return reply;
}

std::vector<std::string> PreviewSession::idle_among(std::span<const Cut> cuts) const {
  const std::vector<Ball>& balls = reach();  // with all copies, if there are any
  return view_.figure.hides_surface ? std::vector<std::string>{} : idle_cuts(cuts, view_.camera, balls, balls);
}

Json PreviewSession::remove(const CommandReader& command) {
  PreviewFigure next = view_;
  switch (command.choice("of", {"representations", "cuts", "rules", "opacities", "objects"})) {
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
    case 3:
      remove_from(command, next.color.opacities);
      become(std::move(next), Changed::colors);
      break;
    default:
      remove_from(command, next.figure.objects);
      become(std::move(next), Changed::shapes);
  }
  return Json::object();
}

}  // namespace meniscus
