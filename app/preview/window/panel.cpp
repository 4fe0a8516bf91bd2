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

#include "app/preview/look_json.h"
#include "app/preview/command_json.h"
#include "app/preview/window/keys.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr float kLargestSliderProbe = 10.0f;  // Å; larger ones can be typed
constexpr float kFooterLines = 2.3f;          // room for a fault

void heading(const char* text) {
  ImGui::Dummy({0.0f, 0.2f * ImGui::GetFontSize()});
  ImGui::TextDisabled("%s", text);
  ImGui::Separator();
}

/// Text of a file or the session, never a format.
void plain(const std::string& text) { ImGui::TextWrapped("%s", text.c_str()); }

void fault(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, {0.70f, 0.16f, 0.12f, 1.0f});
  plain(text);
  ImGui::PopStyleColor();
}

/// A name at the left; the next widget stands at its right and fills the line.
void label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(6.5f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1.0f);
}

/// A number of a slider with no more digits than it shows.
double rounded(float value) { return std::round(100.0 * value) / 100.0; }

/// A list to choose from; the word chosen now, or nothing.
std::optional<std::string> chosen(const char* id, const std::string& current, const std::vector<std::string>& words) {
  std::optional<std::string> choice;
  if (!ImGui::BeginCombo(id, current.c_str(), ImGuiComboFlags_HeightLarge)) return choice;
  for (const std::string& word : words)
    if (ImGui::Selectable(word.c_str(), word == current)) choice = word;
  ImGui::EndCombo();
  return choice;
}

/// Kinds of patch have a switch of their own.
std::vector<std::string> words_of(const Json& schemes) {
  std::vector<std::string> words;
  for (const Json& scheme : schemes)
    if (scheme["word"] != "kind") words.push_back(scheme["word"]);
  return words;
}

std::vector<std::string> map_names() {
  std::vector<std::string> names;
  for (const ColorMapMetadata& map : color_maps()) names.emplace_back(map.name);
  return names;
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
  ImGui::BeginChild("widgets", {0.0f, -footer});
  if (link_.has_state()) widgets();
  ImGui::EndChild();
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
  look();
  if (link_.state()["frames"].get<int>() > 1) frames();
  exports();
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
  if (const auto word = chosen("##kind", kind, {"ses", "sas", "vdw"}))
    link_.send({{"command", "surface"}, {"kind", *word}});
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("ses: solvent-excluded\nsas: solvent-accessible\nvdw: van der Waals, without a probe");
  label("Probe");
  if (kind == "vdw") return ImGui::TextDisabled("none");
  float radius = link_.state()["probe_radius"];
  if (ImGui::SliderFloat("##probe", &radius, 0.0f, kLargestSliderProbe, "%.2f \xc3\x85", ImGuiSliderFlags_Logarithmic))
    link_.send({{"command", "probe"}, {"radius", rounded(std::max(radius, 0.0f))}});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Ctrl + click to type a radius; 0 shows the van der Waals surface");
}

void Panel::coloring() {
  heading("Colour");
  const Json& state = link_.state();
  label("By");
  const std::string scheme = state["color"]["scheme"];
  if (const auto word = chosen("##scheme", scheme, words_of(link_.choices()["schemes"])))
    link_.send({{"command", "color"}, {"scheme", *word}});
  const auto parsed = parse_color_scheme(scheme);
  if (parsed && parsed->has_scale()) {
    label("Map");
    const char* own = state["color"].value("own_map", false) ? "the file's" : "its own";
    std::vector<std::string> maps = map_names();
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
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("A selection, such as chain A and resid 10-50; then Enter");
  ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
  if (ImGui::Button("all")) link_.send({{"command", "reset_view"}});
}

void Panel::look() {
  heading("Look");
  label("Preset");
  if (const auto preset = chosen("##preset", link_.state()["preset"].get<std::string>(),
                                 link_.choices()["presets"].get<std::vector<std::string>>()))
    link_.send({{"command", "preset"}, {"preset", *preset}});
  label("Background");
  const auto hex = parse_hex_color(link_.state()["look"]["background"].get<std::string>());
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
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", slider["help"].get<std::string>().c_str());
}

void Panel::light() {
  if (!link_.state()["look"].contains("light_direction")) return;
  const Json& direction = link_.state()["look"]["light_direction"];
  const glm::vec3 light =
      glm::normalize(glm::vec3(direction[0].get<float>(), direction[1].get<float>(), direction[2].get<float>()));
  label("Light from");
  glm::vec2 across(light);
  if (!ImGui::SliderFloat2("##light", &across.x, -1.0f, 1.0f, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Where the key light stands: left to right, below to above");
    return;
  }
  const float front = std::sqrt(std::max(0.0f, 1.0f - glm::dot(across, across)));
  link_.send({{"command", "look"}, {"light_direction", {rounded(across.x), rounded(across.y), rounded(front)}}});
}

void Panel::frames() {
  heading("Frames");
  const Json& state = link_.state();
  const int count = state["frames"];
  const bool playing = state["playing"];
  if (ImGui::Button(playing ? "Pause" : "Play", {5.5f * ImGui::GetFontSize(), 0.0f}))
    link_.send({{"command", playing ? "pause" : "play"}});
  ImGui::SameLine(6.5f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1.0f);
  int number = state["frame"].get<int>() + 1;
  const std::string format = fmt::format("%d of {}", count);
  if (ImGui::SliderInt("##frame", &number, 1, count, format.c_str(), ImGuiSliderFlags_AlwaysClamp))
    link_.send({{"command", "frame"}, {"index", number - 1}});
  bool is_key = false;
  for (const Json& key : state["keys"]) is_key |= key["frame"] == state["frame_number"];
  if (ImGui::Button(is_key ? "Remove key" : "Set key")) link_.send({{"command", "key"}, {"on", !is_key}});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("The camera passes here at this frame; %zu keys", state["keys"].size());
  float rate = state["fps"];
  label("A second");
  if (ImGui::SliderFloat("##fps", &rate, 1.0f, 60.0f, "%.0f frames", ImGuiSliderFlags_AlwaysClamp))
    link_.send({{"command", playing ? "play" : "pause"}, {"fps", std::round(rate)}});
  bool follows = state["follow_keys"];
  if (ImGui::Checkbox("follow", &follows)) link_.send({{"command", "follow_keys"}, {"on", follows}});
}

void Panel::exports() {
  struct Format {
    const char *word, *shown, *ending;
  };
  constexpr Format kFormats[] = {{"png", "picture (PNG)", ".png"},
                                 {"scene", "scene (JSON)", ".json"},
                                 {"povray", "POV-Ray scene", "_povray"},
                                 {"blender", "Blender file", ".mns"},
                                 {"camera", "camera (JSON)", "_camera.json"},
                                 {"camera_path", "camera keys (JSON)", "_path.json"}};
  take_wishes();
  heading("Export this view");
  label("As");
  if (ImGui::BeginCombo("##format", kFormats[format_].shown)) {
    for (int f = 0; f < static_cast<int>(std::size(kFormats)); ++f)
      if (ImGui::Selectable(kFormats[f].shown, f == format_)) format_ = f;
    ImGui::EndCombo();
  }
  label("Name");
  if (std::exchange(name_wanted_, false)) ImGui::SetKeyboardFocusHere();
  bool go = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  const std::string path = name_ + kFormats[format_].ending;
  go |= ImGui::Button(fmt::format("Write {}###write", path).c_str(), {-7.0f * ImGui::GetFontSize(), 0.0f});
  ImGui::SameLine();
  ImGui::Checkbox("replace", &replace_);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Replace a file of this name");
  const std::string word = kFormats[format_].word;
  if (word == "png" || word == "scene") picture_wishes();
  if (word == "scene") {
    if (ImGui::Button(fmt::format("Open {}###open", path).c_str())) link_.send({{"command", "open"}, {"path", path}});
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("A scene of this molecule; undo brings back what is shown now");
  }
  if (ImGui::Button("Copy command")) link_.send(wished({{"command", "render_command"}}));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("The command that makes this picture, into the clipboard");
  if (go && word == "scene") link_.send(wished({{"command", "save"}, {"path", path}, {"force", replace_}}));
  if (go && word != "scene") {
    const Json command{{"command", "export"}, {"format", word}, {"path", path}, {"force", replace_}, {"wait", false}};
    link_.send(word == "png" ? wished(command) : command);
  }
  progress();
}

/// Those that a scene came with are in the fields until somebody types others.
void Panel::take_wishes() {
  const Json& wishes = link_.state()["export"];
  if (wishes == wishes_) return;
  wishes_ = wishes;
  const auto number = [&](const char* key) { return wishes[key].is_number() ? wishes[key].get<int>() : 0; };
  width_ = number("width");
  height_ = number("height");
  samples_ = number("samples");
  transparent_ = wishes["transparent"];
}

void Panel::picture_wishes() {
  label("Pixels");
  int size[] = {width_, height_};
  if (ImGui::InputInt2("##size", size)) {
    width_ = size[0];
    height_ = size[1];
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Width and height; 0: as shown, or as the other side has it");
  label("Samples");
  ImGui::SliderInt("##samples", &samples_, 0, 64, samples_ > 0 ? "%d a pixel" : "as shown");
  ImGui::Checkbox("transparent", &transparent_);
}

void Panel::progress() {
  if (!exporting_.running()) return;
  const Json& told = exporting_.told();
  const std::string stage = told.value("stage", "begin");
  ImGui::ProgressBar(static_cast<float>(told.value("share", 0.0)), {-5.0f * ImGui::GetFontSize(), 0.0f},
                     fmt::format("{}, {:.0f} s", stage, told.value("seconds", 0.0)).c_str());
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) link_.send({{"command", "cancel_export"}});
}

Json Panel::wished(Json command) const {
  if (samples_ > 0) command["samples"] = samples_;
  command["transparent"] = transparent_;
  if (width_ <= 0 && height_ <= 0) return command;
  constexpr int kLeast = 16, kMost = 16384;
  const double shape = link_.state()["height"].get<double>() / link_.state()["width"].get<double>();
  const int width = width_ > 0 ? width_ : static_cast<int>(std::lround(height_ / shape));
  const int height = height_ > 0 ? height_ : static_cast<int>(std::lround(width_ * shape));
  command["width"] = std::clamp(width, kLeast, kMost);
  command["height"] = std::clamp(height, kLeast, kMost);
  return command;
}

std::array<std::string, 4> pick_lines(const Json& pick) {
  if (!pick.value("hit", false)) return {};
  const auto text = [&](const char* key) { return pick.value(key, std::string()); };
  std::string area;  // not known yet
  if (pick["exposed_area"].is_number())
    area = fmt::format("exposed area {:.2f} \xc3\x85\xc2\xb2", pick["exposed_area"].get<double>());
  const std::string element = text("element").empty() ? "" : fmt::format(" ({})", text("element"));
  const std::string kind = text("kind");
  return {fmt::format("atom {}{}", text("name"), element),
          fmt::format("residue {} {}{}, chain {}", text("residue"), pick["residue_number"].get<int>(),
                      text("insertion_code"), text("chain")),
          kind == "cap" || kind == "shape" ? kind : kind + " patch", area};
}

std::string timing_line(const Json& stats, bool full) {
  const std::string line =
      fmt::format("{} \xc3\x97 {}{}: {:.1f} ms", stats["width"].get<int>(), stats["height"].get<int>(),
                  full ? "" : ", draft", stats["frame_milliseconds"].get<double>());
  return full ? line : line + fmt::format(", {:.1f} fps", stats["fps"].get<double>());
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

void Panel::show_reply(const SessionReply& reply, double time) {
  const std::string word = command_word(reply.command);
  if (exporting_.take(reply, time) && exporting_.running()) return;
  if (word == "export_state" && !reply.reply.contains("path")) return;
  line_is_fault_ = !reply.reply.value("ok", false) || reply.reply.contains("error");
  if (line_is_fault_) line_ = sentence_of(reply.reply.value("error", "the command failed"), word);
  if (line_is_fault_) return;
  if (word == "export" || word == "export_state" || word == "save") {
    line_ = "written: " + reply.reply.value("path", std::string());
    if (reply.reply.contains("note")) line_ += "; " + reply.reply["note"].get<std::string>();
    if (reply.reply.contains("render_with"))
      line_ += "; render it with: " + reply.reply["render_with"].get<std::string>();
  }
  if (word == "render_command") {
    ImGui::SetClipboardText(reply.reply["text"].get<std::string>().c_str());
    line_ = "the command is in the clipboard";
  }
}

void Panel::status() {
  constexpr double kPatience = 0.4;  // seconds; shorter work is not worth a word
  ImGui::Separator();
  const auto& busy = link_.news().busy_seconds;
  const std::string& reason = link_.news().fault;
  if (busy && *busy > kPatience)
    plain(fmt::format("{}working, {:.0f} s ...", link_.has_state() ? "" : "the first picture: ", std::floor(*busy)));
  else if (!reason.empty() || line_is_fault_)
    fault(reason.empty() ? line_ : reason);
  else if (!line_.empty())
    plain(line_);
  else
    ImGui::TextDisabled("h: help");
}

}  // namespace meniscus
