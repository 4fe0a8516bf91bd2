// SPDX-License-Identifier: BSD-3-Clause
// The commands that move the camera, and views that are kept under a name.
#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "app/preview/camera_motion.h"
#include "core/camera/camera_json.h"
#include "app/preview/command_json.h"
#include "app/preview/command_values.h"
#include "app/preview/merge_commands.h"
#include "app/preview/session.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/copied_atoms.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr double kLongestDrag = 100.0;  // heights of the picture

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

}  // namespace

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
  const double factor = std::clamp(command.number("factor", 1.0 / kMostZoom, kMostZoom), 1.0 / kMost, kMost);
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
  const Selection selection = selection_of(command);
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

Json PreviewSession::set_camera(const CommandReader& command) {
  look_from(parse_camera(json_line(command.value("camera")), "camera"));
  return Json::object();
}

Json PreviewSession::set_projection(const CommandReader& command) {
  const std::size_t word = command.choice("projection", {"perspective", "orthographic"});
  look_from(projected(view_.camera, word == 0 ? Projection::perspective : Projection::orthographic, balls_in_view()));
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

}  // namespace meniscus
