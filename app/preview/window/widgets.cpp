// SPDX-License-Identifier: BSD-3-Clause
// By Dear ImGui, in heights of a letter.
#include "app/preview/window/widgets.h"

#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "app/preview/key_table.h"
#include "app/preview/window/gui.h"

namespace meniscus {

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

void draw_help(float panel) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * (window.x - panel), 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.95f);
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
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
