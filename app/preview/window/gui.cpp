// SPDX-License-Identifier: BSD-3-Clause
// Passes events to ImGui one frame after the other, and draws the parts that panels share.
#include "app/preview/window/gui.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <set>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "app/preview/key_table.h"
#include "core/render/lettering.h"

namespace meniscus {
namespace {

const ImVec4 kPaper{0.965f, 0.965f, 0.957f, 1.0f};
const ImVec4 kInk{0.13f, 0.15f, 0.17f, 1.0f};
const ImVec4 kPaleInk{0.42f, 0.45f, 0.48f, 1.0f};
const ImVec4 kField{0.89f, 0.90f, 0.90f, 1.0f};
const ImVec4 kFieldHovered{0.83f, 0.86f, 0.87f, 1.0f};
const ImVec4 kFieldActive{0.76f, 0.82f, 0.85f, 1.0f};
const ImVec4 kAccent{0.13f, 0.43f, 0.53f, 1.0f};
const ImVec4 kLine{0.80f, 0.82f, 0.83f, 1.0f};

void set_colors(ImVec4* colors) {
  colors[ImGuiCol_Text] = kInk;
  colors[ImGuiCol_TextDisabled] = kPaleInk;
  colors[ImGuiCol_WindowBg] = colors[ImGuiCol_PopupBg] = kPaper;
  colors[ImGuiCol_Border] = colors[ImGuiCol_Separator] = kLine;
  colors[ImGuiCol_FrameBg] = colors[ImGuiCol_Button] = colors[ImGuiCol_Header] = kField;
  colors[ImGuiCol_FrameBgHovered] = colors[ImGuiCol_ButtonHovered] = colors[ImGuiCol_HeaderHovered] = kFieldHovered;
  colors[ImGuiCol_FrameBgActive] = colors[ImGuiCol_ButtonActive] = colors[ImGuiCol_HeaderActive] = kFieldActive;
  colors[ImGuiCol_CheckMark] = kAccent;
  colors[ImGuiCol_SliderGrab] = ImVec4(kAccent.x, kAccent.y, kAccent.z, 0.40f);  // the number shows through
  colors[ImGuiCol_SliderGrabActive] = ImVec4(kAccent.x, kAccent.y, kAccent.z, 0.60f);
  colors[ImGuiCol_PlotHistogram] = kAccent;
  colors[ImGuiCol_TableRowBgAlt] = ImVec4(0.0f, 0.0f, 0.0f, 0.03f);
}

void set_style(float scale) {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {14.0f, 10.0f};
  style.FramePadding = {8.0f, 3.0f};
  style.ItemSpacing = {8.0f, 5.0f};
  style.ItemInnerSpacing = {6.0f, 4.0f};
  style.GrabMinSize = 12.0f;
  style.ScrollbarSize = 12.0f;
  style.WindowRounding = style.PopupRounding = 6.0f;
  style.FrameRounding = style.GrabRounding = 4.0f;
  style.FrameBorderSize = 0.0f;
  set_colors(style.Colors);
  style.ScaleAllSizes(scale);
}

/// pixels: height of a letter. Without a font file ImGui's own letters do.
void load_font(float pixels) {
  ImGuiIO& io = ImGui::GetIO();
  const auto file = find_font_file();
  if (!file || !io.Fonts->AddFontFromFileTTF(file->c_str(), pixels)) {
    ImFontConfig plain;
    plain.SizePixels = pixels;
    io.Fonts->AddFontDefault(&plain);
  }
}

}  // namespace

Gui::Gui(DesktopWindow& window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is written into the user's folder
  io.LogFilename = nullptr;
  io.UserData = this;
  const float scale = static_cast<float>(window.scale());
  const float per_unit = static_cast<float>(window.pixels_per_unit().y);
  load_font(kLetterHeight * scale);
  io.FontGlobalScale = 1.0f / per_unit;
  em_ = kLetterHeight * scale / per_unit;
  set_style(scale / per_unit);
  ImGui_ImplGlfw_InitForOpenGL(window.glfw(), false);  // events come from take()
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::begin() {
  places_.clear();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  hand_on();
  ImGui::NewFrame();
  if (std::exchange(lists_close_, false)) ImGui::ClosePopupToLevel(0, true);
}

bool Gui::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  return !waiting_.empty();
}

void Gui::hand_on() {
  ImGuiIO& io = ImGui::GetIO();
  std::set<int> changed;  // keys, and buttons as negative numbers, that went up or down in this frame
  const auto changes = [&](int key) { return changed.insert(key).second; };
  bool button_changed = false, dragged = false;
  for (; !waiting_.empty(); waiting_.pop_front()) {
    const InputEvent& event = waiting_.front();
    const int button = static_cast<int>(event.button);
    const bool moves = event.kind == InputEvent::Kind::move || event.kind == InputEvent::Kind::leave;
    if (moves && button_changed) break;  // what was pressed is where the pointer was
    if (moves) {
      dragged |= std::ranges::count(held_, true) > 0;
      inside_ = event.kind == InputEvent::Kind::move;
      pointer_ = event.position / window_.pixels_per_unit();
    } else if (event.kind == InputEvent::Kind::press || event.kind == InputEvent::Kind::release) {
      if (dragged || !changes(-1 - button)) break;  // a slider follows to where it is let go
      button_changed = true;
      held_[button] = event.kind == InputEvent::Kind::press;
    } else if (event.kind == InputEvent::Kind::key || event.kind == InputEvent::Kind::key_up) {
      if (!changes(event.key)) break;
      io.KeysDown[event.key] = event.kind == InputEvent::Kind::key;
    } else if (event.kind == InputEvent::Kind::scroll) {
      io.MouseWheel += static_cast<float>(event.scroll);
    } else if (event.kind == InputEvent::Kind::text) {
      io.AddInputCharacter(event.letter);
    }
  }
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
  std::ranges::copy(held_, io.MouseDown);
  const bool known = inside_ || std::ranges::count(held_, true) > 0;
  io.MousePos =
      known ? ImVec2(static_cast<float>(pointer_.x), static_cast<float>(pointer_.y)) : ImVec2(-FLT_MAX, -FLT_MAX);
}

bool Gui::list_open() { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup); }
bool Gui::typing() { return ImGui::GetIO().WantTextInput; }

void Gui::mark(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 middle{0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
  if (!ImGui::IsRectVisible(middle, {middle.x + 1.0f, middle.y + 1.0f})) return;
  Gui& gui = *static_cast<Gui*>(ImGui::GetIO().UserData);
  const glm::dvec2 scale = gui.window_.pixels_per_unit();
  gui.places_[name] = {low.x * scale.x, low.y * scale.y, high.x * scale.x, high.y * scale.y};
}

void heading(const char* text) {
  ImGui::Dummy({0.0f, 0.2f * ImGui::GetFontSize()});
  ImGui::TextDisabled("%s", text);
  ImGui::Separator();
}

void plain(const std::string& text) { ImGui::TextWrapped("%s", text.c_str()); }

void fault(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, {0.70f, 0.16f, 0.12f, 1.0f});
  plain(text);
  ImGui::PopStyleColor();
}

void label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine(6.5f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1.0f);
}

void same_line() { ImGui::SameLine(0.0f, 0.35f * ImGui::GetFontSize()); }

void tooltip(const std::string& text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

std::optional<std::string> chosen(const char* id, const std::string& current, const std::vector<std::string>& words) {
  std::optional<std::string> choice;
  if (!ImGui::BeginCombo(id, current.c_str(), ImGuiComboFlags_HeightLarge)) {
    Gui::mark(id);
    return choice;
  }
  for (const std::string& word : words) {
    if (ImGui::Selectable(word.c_str(), word == current)) choice = word;
    Gui::mark(word);
  }
  ImGui::EndCombo();
  return choice;
}

double rounded(float value) { return std::round(100.0 * value) / 100.0; }

std::array<std::string, 4> pick_lines(const nlohmann::json& pick) {
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

namespace {

/// In the middle of the picture.
void begin_in_the_middle(const char* name, float panel, ImGuiWindowFlags more) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * (window.x - panel), 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.95f);
  ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | more);
}

}  // namespace

void draw_notice(float panel, const std::string& text) {
  begin_in_the_middle("notice", panel, ImGuiWindowFlags_NoInputs);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

std::optional<bool> draw_close_question(float panel) {
  std::optional<bool> answer;
  begin_in_the_middle("close", panel, ImGuiWindowFlags_NoMove);
  ImGui::TextUnformatted("The figure was changed and is not saved.");
  if (ImGui::Button("Close all the same (y)")) answer = true;
  Gui::mark("close");
  ImGui::SameLine();
  if (ImGui::Button("Stay (n)")) answer = false;
  Gui::mark("stay");
  ImGui::End();
  return answer;
}

void draw_help(float panel) {
  begin_in_the_middle("help", panel, ImGuiWindowFlags_NoInputs);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyHelp& row : key_help()) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row.keys);
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", row.what);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

void draw_answer(const nlohmann::json& pick) {
  if (!pick.is_object() || !pick.value("hit", false)) return;
  ImGui::BeginTooltip();
  for (const std::string& line : pick_lines(pick))
    if (!line.empty()) ImGui::TextUnformatted(line.c_str());
  ImGui::EndTooltip();
}

}  // namespace meniscus
