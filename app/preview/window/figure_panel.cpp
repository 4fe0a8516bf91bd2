// SPDX-License-Identifier: BSD-3-Clause
// Widgets for the state's lists; like those of the panel they hold no value of the session.
#include "app/preview/window/figure_panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/preview/window/gui.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/scene/cut.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

/// The same side of the same plane elsewhere, or the other side.
std::string moved(Cut cut, double bound, bool turned) {
  cut.bound = bound;
  cut.keeps_less = cut.keeps_less != turned;
  return cut_text(cut);
}

/// Of the whole object, as one number; below 0: it has rules.
float object_opacity(const Json& object) {
  if (!object.contains("opacity")) return 1.0f;
  const Json& opacity = object["opacity"];
  if (opacity.is_number()) return opacity.get<float>();
  if (!opacity.is_string() || opacity.get<std::string>().find('=') != std::string::npos) return -1.0f;
  return parse_opacity_rule(opacity.get<std::string>()).opacity;
}

}  // namespace

void FigurePanel::draw() {
  atoms();
  rows();
  objects();
  cuts();
  caps();
  legend();
  views();
}

void FigurePanel::atoms() {
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputTextWithHint("##atoms", "atoms: ligand, chain A ...", &selection_);
  Gui::mark("##atoms");
  tooltip("A selection; then one of the buttons below");
  const bool empty = selection_.empty();
  if (empty) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 0.5f);
  constexpr int kInRow = 4;  // more are wider than the panel
  int count = 0;
  for (const Json& shape : link_.choices()["representations"]) {
    if (count++ % kInRow != 0) same_line();
    if (ImGui::Button(shape.get<std::string>().c_str()) && !empty)
      link_.send({{"command", "represent"}, {"as", shape}, {"selection", selection_}});
  }
  if (count % kInRow != 0) same_line();
  if (ImGui::Button("surface") && !empty)
    link_.send({{"command", "object"}, {"object", {{"selection", selection_}, {"color", hex_color(paint_)}}}});
  tooltip("A surface of their own, in this colour");
  same_line();
  if (ImGui::Button("hide") && !empty) link_.send({{"command", "hide"}, {"selection", selection_}});
  if (ImGui::Button("only") && !empty) link_.send({{"command", "show"}, {"selection", selection_}});
  same_line();
  if (ImGui::Button("paint") && !empty)
    link_.send({{"command", "paint"}, {"selection", selection_}, {"color", hex_color(paint_)}});
  Gui::mark("paint");
  same_line();
  ImGui::ColorEdit3("##paint", &paint_.x, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel);
  same_line();
  if (ImGui::Button("see through") && !empty)
    link_.send({{"command", "opacity"}, {"selection", selection_}, {"opacity", 0.4}});
  if (ImGui::Button("outline") && !empty) link_.send({{"command", "patches"}, {"selection", selection_}});
  tooltip("A line around their contiguous areas");
  if (empty) ImGui::PopStyleVar();
}

bool FigurePanel::removed(const std::string& text, const char* of, int index) {
  const bool clicked = ImGui::SmallButton(fmt::format("x##{}{}", of, index).c_str());
  same_line();
  ImGui::TextUnformatted(text.c_str());
  if (clicked && index >= 0) link_.send({{"command", "remove"}, {"of", of}, {"index", index}});
  return clicked;
}

void FigurePanel::rows() {
  const Json state = link_.state();
  if (state["show"].is_string() && removed("surface of " + state["show"].get<std::string>(), "show", -1))
    link_.send({{"command", "show"}});
  const Json& patches = state["patches"]["selection"];
  if (patches.is_string() && removed("patches of " + patches.get<std::string>(), "patches", -1))
    link_.send({{"command", "patches"}});
  int index = 0;
  for (const Json& shown : state["representations"])
    removed(fmt::format("{}: {}", shown["as"].get<std::string>(), shown["selection"].get<std::string>()),
            "representations", index++);
  index = 0;
  for (const Json& rule : state["color"].value("rules", Json::array())) removed(rule, "rules", index++);
  index = 0;
  for (const Json& rule : state["opacities"]) {
    removed("see through: " + rule.value("selection", "all"), "opacities", index);
    float opacity = rule["opacity"];
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::SliderFloat(fmt::format("##opacity{}", index).c_str(), &opacity, 0.0f, 1.0f, "%.2f",
                           ImGuiSliderFlags_AlwaysClamp))
      link_.send({{"command", "opacity"}, {"index", index}, {"opacity", std::round(100.0 * opacity) / 100.0}});
    ++index;
  }
}

void FigurePanel::objects() {
  const Json state = link_.state();
  const Json& objects = state["objects"];
  if (!objects.empty() || state["representations"].size() > 0) {
    bool shown = !state["surface_hidden"].get<bool>();
    if (ImGui::Checkbox("the molecule's surface", &shown)) link_.send({{"command", "hide_surface"}, {"on", !shown}});
  }
  int index = 0;
  for (const Json& object : objects) {
    const auto change = [&](const char* key, const Json& value) {
      Json changed = object;
      value.is_null() ? static_cast<void>(changed.erase(key)) : static_cast<void>(changed[key] = value);
      link_.send({{"command", "object"}, {"index", index}, {"object", changed}});
    };
    removed(fmt::format("{}: {}", object["representation"].get<std::string>(), object["selection"].get<std::string>()),
            "objects", index);
    const std::string word = object.contains("color") && object["color"].is_string() ? object["color"] : Json("");
    glm::vec3 color = parse_color(word).value_or(glm::vec3(0.85f));
    if (ImGui::ColorEdit3(fmt::format("##object{}", index).c_str(), &color.x,
                          ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel))
      change("color", hex_color(color));
    if (object["representation"] == "surface") {
      same_line();
      bool is_cut = object.contains("clip");
      if (ImGui::Checkbox(fmt::format("cut##object{}", index).c_str(), &is_cut))
        change("clip", is_cut ? Json("depth>0.5") : Json(nullptr));
    }
    same_line();
    float opacity = object_opacity(object);
    ImGui::SetNextItemWidth(-1.0f);
    if (opacity >= 0.0f && ImGui::SliderFloat(fmt::format("##objectopacity{}", index).c_str(), &opacity, 0.0f, 1.0f,
                                              "covers %.2f", ImGuiSliderFlags_AlwaysClamp))
      change("opacity", opacity < 1.0f ? Json(fmt::format("{:.2f}", opacity)) : Json(nullptr));
    ++index;
  }
}

void FigurePanel::cuts() {
  const Json state = link_.state();
  int index = 0;
  for (const Json& text : state["cuts"]) {
    const Cut cut = parse_cut(text.get<std::string>());
    removed("cut " + text.get<std::string>(), "cuts", index);
    if (cut.atoms) {  // which say where it is
      ++index;
      continue;
    }
    const auto move = [&](double bound, bool turned) {
      link_.send({{"command", "cut"}, {"plane", moved(cut, bound, turned)}, {"index", index}});
    };
    float low = 0.0f, high = 1.0f;
    if (cut.direction != glm::dvec3(0.0)) {
      low = high = 0.0f;  // how far the molecule reaches along the direction
      for (int c = 0; c < 3; ++c) {
        const double a = cut.direction[c] * state["low"][c].get<double>();
        const double b = cut.direction[c] * state["high"][c].get<double>();
        low += static_cast<float>(std::min(a, b));
        high += static_cast<float>(std::max(a, b));
      }
    }
    auto bound = static_cast<float>(cut.bound);
    ImGui::SetNextItemWidth(-2.5f * ImGui::GetFontSize());
    if (ImGui::SliderFloat(fmt::format("##cut{}", index).c_str(), &bound, low, high, "%.2f"))
      move(std::round(100.0 * bound) / 100.0, false);
    same_line();
    if (ImGui::SmallButton(fmt::format("<>##side{}", index).c_str())) move(cut.bound, true);
    tooltip("Show the other side");
    ++index;
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Cut along");
  for (const char* axis : {"view", "x", "y", "z"}) {
    same_line();
    if (!ImGui::Button(fmt::format("{}##cut", axis).c_str())) continue;
    const auto c = static_cast<std::size_t>(axis[0] - 'x');
    const double middle =
        axis[0] == 'v' ? 0.5
                       : std::round(5.0 * (state["low"][c].get<double>() + state["high"][c].get<double>())) / 10.0;
    link_.send({{"command", "cut"}, {"plane", fmt::format("{}>{}", axis[0] == 'v' ? "depth" : axis, middle)}});
  }
}

void FigurePanel::caps() {
  const Json& state = link_.state();
  if (state["cuts"].empty()) return;
  const std::string word = state["cap"]["color"];
  bool of_atoms = word == "atom";
  if (ImGui::Checkbox("caps as the atoms", &of_atoms))
    link_.send({{"command", "cap"}, {"color", of_atoms ? "atom" : "#d8d8d0"}});
  if (!of_atoms) {
    same_line();
    glm::vec3 color = parse_color(word).value_or(glm::vec3(0.85f));
    if (ImGui::ColorEdit3("##cap", &color.x, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel))
      link_.send({{"command", "cap"}, {"color", hex_color(color)}});
  }
  float hatching = state["cap"]["hatching"];
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##hatching", &hatching, 0.0f, 6.0f, "hatching %.1f \xc3\x85"))
    link_.send({{"command", "cap"}, {"hatching", std::round(10.0 * hatching) / 10.0}});
}

void FigurePanel::legend() {
  const Json state = link_.state();
  bool on = state["legend"]["on"];
  if (ImGui::Checkbox("legend", &on)) link_.send({{"command", "legend"}, {"on", on}});
  if (!on) return;
  same_line();
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##title", "its title", &legend_title_, ImGuiInputTextFlags_EnterReturnsTrue))
    link_.send({{"command", "legend"}, {"title", legend_title_.empty() ? Json(nullptr) : Json(legend_title_)}});
  if (state["legend"].contains("fault")) ImGui::TextWrapped("%s", state["legend"]["fault"].get<std::string>().c_str());
}

void FigurePanel::views() {
  const Json state = link_.state();
  if (ImGui::Button("undo") && state["undo"] != 0) link_.send({{"command", "undo"}});
  same_line();
  if (ImGui::Button("redo") && state["redo"] != 0) link_.send({{"command", "redo"}});
  same_line();
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##view", "keep view as ...", &view_name_, ImGuiInputTextFlags_EnterReturnsTrue)) {
    link_.send({{"command", "save_view"}, {"name", view_name_}});
    view_name_.clear();
  }
  for (const Json& name : state["views"]) {
    const std::string text = name;
    if (ImGui::SmallButton(fmt::format("x##view{}", text).c_str()))
      link_.send({{"command", "forget_view"}, {"name", text}});
    same_line();
    if (ImGui::SmallButton(text.c_str())) link_.send({{"command", "recall_view"}, {"name", text}});
  }
}

}  // namespace meniscus
