// SPDX-License-Identifier: BSD-3-Clause
// Help and tooltip by Dear ImGui.
#include "app/preview/window/overlays.h"

#include <imgui.h>

#include "app/preview/window/keys.h"
#include "app/preview/window/panel.h"

namespace meniscus {

void draw_help(float em) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float panel = Panel::width(em);
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
