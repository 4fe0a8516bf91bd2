// SPDX-License-Identifier: BSD-3-Clause
// Widgets that read the state and send commands; none of them holds a value of the session.
#include "app/preview/window/panel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/preview/window/gui.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr float kLargestSliderProbe = 10.0f;  // Å; larger ones can be typed
constexpr float kFooterLines = 2.3f;          // room for a fault
constexpr float kMostOfWrite = 0.45f;         // of the window's height

/// The scheme of this word; null: one that is not to be chosen.
Json scheme_of(const Json& schemes, const std::string& word) {
  const auto found = std::ranges::find_if(schemes, [&](const Json& scheme) { return scheme["word"] == word; });
  return found == schemes.end() ? Json() : *found;
}

}  // namespace

void Panel::draw(float em) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x - width(em), 0.0f});
  ImGui::SetNextWindowSize({width(em), window.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
  ImGui::PopStyleVar();
  const float footer = kFooterLines * ImGui::GetTextLineHeightWithSpacing();
  // What writes is always in sight; on a small screen it scrolls, too.
  const float write = link_.has_state() ? std::min(write_height_, kMostOfWrite * window.y) : 0.0f;
  ImGui::BeginChild("widgets", {0.0f, -footer - write});
  if (link_.has_state()) widgets();
  ImGui::EndChild();
  if (link_.has_state()) {
    ImGui::BeginChild("write", {0.0f, write});
    heading("Write");
    exports_.draw();
    write_height_ = ImGui::GetCursorPosY() + ImGui::GetStyle().ItemSpacing.y;
    ImGui::EndChild();
  }
  status();
  ImGui::End();
}

void Panel::widgets() {
  title();
  surface();
  coloring();
  heading("Figure");
  figure_.draw();
  view();
  strip();
  look();
  if (link_.state()["frames"].get<int>() > 1) frames();
  picked();
  timing();
}

void Panel::title() {
  const Json& state = link_.state();
  const std::string file = state["file"];
  plain(file.substr(file.rfind('/') + 1));
  ImGui::TextDisabled("%s atoms", with_thousands(state["atoms"].get<std::size_t>()).c_str());
}

void Panel::surface() {
  label("Surface");
  const std::string kind = link_.state()["surface"];
  const Property& kinds = property_of("surface.kind");
  if (const auto word = chosen("##kind", kind, words_of(kinds))) link_.send({{"command", "surface"}, {"kind", *word}});
  tooltip(std::string(kinds.help));
  label("Probe");
  if (kind == "vdw") return ImGui::TextDisabled("none");
  float radius = link_.state()["probe_radius"];
  if (ImGui::SliderFloat("##probe", &radius, 0.0f, kLargestSliderProbe, "%.2f \xc3\x85", ImGuiSliderFlags_Logarithmic))
    link_.send({{"command", "probe"}, {"radius", rounded(std::max(radius, 0.0f))}});
  Gui::mark("##probe");
  tooltip("Ctrl + click to type a radius; 0 shows the van der Waals surface");
}

void Panel::coloring() {
  heading("Colour");
  const Json& state = link_.state();
  label("By");
  const std::string scheme = state["color"]["scheme"];
  const Json& schemes = link_.choices()["schemes"];
  std::vector<std::string> words;
  for (const Json& one : schemes)
    if (one["word"] != "kind" && !one.contains("lacks")) words.push_back(one["word"]);  // kinds have a switch
  if (const auto word = chosen("##scheme", scheme, words)) link_.send({{"command", "color"}, {"scheme", *word}});
  if (const Json offered = scheme_of(schemes, scheme); offered.is_object() && offered["has_map"] == true) {
    label("Map");
    const char* own = state["color"].value("own_map", false) ? "the file's" : "its own";
    auto maps = link_.choices()["maps"].get<std::vector<std::string>>();
    maps.insert(maps.begin(), own);
    if (const auto map = chosen("##map", state["color"].value("map", own), maps)) {
      Json command{{"command", "color"}, {"scheme", scheme}};
      if (*map != own) command["map"] = *map;
      link_.send(command);
    }
  }
  bool kinds = state["patch_kinds"];
  if (ImGui::Checkbox("Kinds of patch instead", &kinds)) link_.send({{"command", "patch_kinds"}, {"on", kinds}});
  if (!kinds) return;
  constexpr const char* kWords[] = {"convex", "toroidal", "concave"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0) ImGui::SameLine();
    const glm::vec3 color = kPatchKindColors[k];
    const float edge = 0.8f * ImGui::GetFontSize();
    ImGui::ColorButton(kWords[k], {color.x, color.y, color.z, 1.0f}, ImGuiColorEditFlags_NoTooltip, {edge, edge});
    ImGui::SameLine(0.0f, 0.4f * edge);
    ImGui::TextUnformatted(kWords[k]);
  }
}

void Panel::view() {
  heading("View");
  const bool perspective = link_.state()["camera"]["projection"] == "perspective";
  if (ImGui::RadioButton("perspective", perspective) && !perspective)
    link_.send({{"command", "projection"}, {"projection", "perspective"}});
  ImGui::SameLine();
  if (ImGui::RadioButton("orthographic", !perspective) && perspective)
    link_.send({{"command", "projection"}, {"projection", "orthographic"}});
  label("Zoom to");
  const ImGuiStyle& style = ImGui::GetStyle();
  const float button = ImGui::CalcTextSize("all").x + 2.0f * style.FramePadding.x;
  ImGui::SetNextItemWidth(-button - style.ItemInnerSpacing.x);
  if (ImGui::InputTextWithHint("##zoom", "chain A ...", &selection_, ImGuiInputTextFlags_EnterReturnsTrue) &&
      !selection_.empty())
    link_.send({{"command", "zoom_to"}, {"selection", selection_}});
  tooltip("A selection, such as chain A and resid 10-50; then Enter");
  ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
  if (ImGui::Button("all")) link_.send({{"command", "reset_view"}});
}

void Panel::strip() {
  heading("Film");
  const Json& told = link_.state()["strip"];
  const int count = told["scenes"];
  if (ImGui::Button("Keep scene")) link_.send({{"command", "keep_scene"}});
  Gui::mark("keep scene");
  tooltip("The figure as it is now becomes the last scene of a film");
  for (int n = 0; n < count; ++n) {
    constexpr int kInARow = 6;
    if (n % kInARow > 0) ImGui::SameLine();
    if (ImGui::Button(fmt::format("{}##scene", n + 1).c_str())) link_.send({{"command", "strip"}, {"place", n}});
    tooltip("Shows this scene; a click on the right forgets it");
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) link_.send({{"command", "forget_scene"}, {"index", n}});
  }
  if (count < 2) return;
  float place = told["place"];
  const bool playing = told["playing"];
  if (ImGui::Button(playing ? "Pause film" : "Play film")) {
    constexpr int kRate = 24;  // pictures a second
    // At its end it starts anew. Undo goes back to what was shown before the film.
    if (!playing) link_.send({{"command", "strip"}, {"place", place < static_cast<float>(count - 1) ? place : 0.0f}});
    link_.send(playing ? Json{{"command", "pause"}} : Json{{"command", "play"}, {"strip", true}, {"fps", kRate}});
  }
  Gui::mark("play film");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##strip", &place, 0.0f, static_cast<float>(count - 1), "%.2f", ImGuiSliderFlags_AlwaysClamp))
    link_.send({{"command", "strip"}, {"place", rounded(place)}});
}

void Panel::look() {
  heading("Look");
  label("Preset");
  if (const auto preset = chosen("##preset", link_.state()["preset"].get<std::string>(),
                                 link_.choices()["presets"].get<std::vector<std::string>>()))
    link_.send({{"command", "preset"}, {"preset", *preset}});
  label("Background");
  const auto hex = parse_color(link_.state()["look"]["background"].get<std::string>());
  glm::vec3 color = hex.value_or(glm::vec3(1.0f));
  if (ImGui::ColorEdit3("##background", &color.x, ImGuiColorEditFlags_DisplayHex))
    link_.send({{"command", "look"}, {"background", hex_color(color)}});
  for (const Json& slider : link_.choices()["sliders"]) strength(slider);
  light();
}

void Panel::strength(const Json& slider) {
  const auto key = slider["key"].get<std::string>();
  if (!link_.state()["look"].contains(key)) return;
  label(slider["label"].get<std::string>().c_str());
  float value = link_.state()["look"][key];
  const float end = slider["end"];
  if (ImGui::SliderFloat(("##" + key).c_str(), &value, 0.0f, end, "%.2f", ImGuiSliderFlags_AlwaysClamp))
    link_.send({{"command", "look"}, {key, rounded(value)}});
  tooltip(slider["help"]);
}

void Panel::light() {
  if (!link_.state()["look"].contains("light_direction")) return;
  const Json& direction = link_.state()["look"]["light_direction"];
  const glm::vec3 light =
      glm::normalize(glm::vec3(direction[0].get<float>(), direction[1].get<float>(), direction[2].get<float>()));
  label("Light from");
  glm::vec2 across(light);
  if (!ImGui::SliderFloat2("##light", &across.x, -1.0f, 1.0f, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
    tooltip("Position of the key light: left to right, bottom to top");
    return;
  }
  const float front = std::sqrt(std::max(0.0f, 1.0f - glm::dot(across, across)));
  link_.send({{"command", "look"}, {"light_direction", {rounded(across.x), rounded(across.y), rounded(front)}}});
}

void Panel::frames() {
  heading("Frames");
  const Json& state = link_.state();
  const int count = state["frames"];
  const bool playing = state["playing"] && !state["strip"]["playing"];
  if (ImGui::Button(playing ? "Pause" : "Play", {5.5f * ImGui::GetFontSize(), 0.0f}))
    link_.send({{"command", playing ? "pause" : "play"}});
  Gui::mark("play");
  ImGui::SameLine(6.5f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1.0f);
  int number = state["frame"].get<int>() + 1;
  const std::string format = fmt::format("%d of {}", count);
  if (ImGui::SliderInt("##frame", &number, 1, count, format.c_str(), ImGuiSliderFlags_AlwaysClamp))
    link_.send({{"command", "frame"}, {"index", number - 1}});
  bool is_key = false;
  for (const Json& key : state["keys"]) is_key |= key["frame"] == state["frame_number"];
  if (ImGui::Button(is_key ? "Remove key" : "Set key")) link_.send({{"command", "key"}, {"on", !is_key}});
  tooltip(fmt::format("The camera passes here at this frame; {} keys", state["keys"].size()));
  float rate = state["fps"];
  label("A second");
  if (ImGui::SliderFloat("##fps", &rate, 1.0f, 60.0f, "%.0f frames", ImGuiSliderFlags_AlwaysClamp))
    link_.send({{"command", playing ? "play" : "pause"}, {"fps", std::round(rate)}});
  Gui::mark("##fps");
  bool follows = state["follow_keys"];
  if (ImGui::Checkbox("follow", &follows)) link_.send({{"command", "follow_keys"}, {"on", follows}});
}

std::string timing_line(const Json& stats, bool full) {
  const std::string line =
      fmt::format("{} \xc3\x97 {}{}: {:.1f} ms", stats["width"].get<int>(), stats["height"].get<int>(),
                  full ? "" : ", draft", stats["frame_milliseconds"].get<double>());
  return full ? line : line + fmt::format(", {:.1f} fps", stats["fps"].get<double>());
}

std::string working_line(const SessionLink& link) {
  const SessionUpdate& news = link.news();
  return fmt::format("{}, {:.0f} s ...", link.has_state() || news.stage.empty() ? "working" : news.stage,
                     std::floor(news.busy_seconds.value_or(0.0)));
}

void Panel::picked() {
  heading("Picked");
  if (!pick_.value("hit", false)) {
    ImGui::TextDisabled("click an atom, or rest on it");
    return;
  }
  for (const std::string& line : pick_lines(pick_))
    if (!line.empty()) plain(line);
}

void Panel::timing() {
  heading("Last picture");
  const Json& stats = link_.stats();
  if (!stats.is_object()) return;
  plain(timing_line(stats, link_.news().full));
  if (const double grown_by = stats["radii_grown_by"].get<double>(); grown_by > 0.0)
    plain(fmt::format("radii grown for ties by up to {:.1e} \xc3\x85", grown_by));
  if (!ImGui::TreeNodeEx("stages", ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
  if (!ImGui::BeginTable("times", 2, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("stage", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthFixed);
  for (const Json& stage : stats["stages"]) {
    ImGui::TableNextColumn();
    plain(stage["name"]);
    ImGui::TableNextColumn();
    const std::string time = fmt::format("{:.1f} ms", stage["milliseconds"].get<double>());
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(time.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(room, 0.0f));
    plain(time);
  }
  ImGui::EndTable();
}

void Panel::status() {
  constexpr double kPatience = 0.4;  // seconds; shorter work is not worth a word
  ImGui::Separator();
  const auto& busy = link_.news().busy_seconds;
  const std::string& reason = link_.news().fault;
  if (busy && *busy > kPatience)
    plain(working_line(link_));
  else if (!reason.empty() || exports_.line_is_fault())
    fault(reason.empty() ? exports_.line() : reason);
  else if (!exports_.line().empty())
    plain(exports_.line());
  else
    ImGui::TextDisabled("h: help");
}

}  // namespace meniscus
