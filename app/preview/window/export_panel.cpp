// SPDX-License-Identifier: BSD-3-Clause
// Widgets for exports, and the line that tells their result.
#include "app/preview/window/export_panel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/preview/command_json.h"
#include "app/preview/window/gui.h"

namespace meniscus {

using Json = nlohmann::json;

void ExportPanel::draw() {
  struct Format {
    const char *word, *shown, *ending;
  };
  constexpr Format kFormats[] = {{"png", "picture (PNG)", ".png"},
                                 {"scene", "scene (JSON)", ".json"},
                                 {"film", "film (MP4)", ".mp4"},
                                 {"povray", "POV-Ray scene", "_povray"},
                                 {"blender", "Blender file", ".mns"},
                                 {"camera", "camera (JSON)", "_camera.json"},
                                 {"camera_path", "camera keys (JSON)", "_path.json"}};
  take_options();
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
  Gui::mark("write");
  ImGui::SameLine();
  ImGui::Checkbox("replace", &replace_);
  tooltip("Replace a file of this name");
  const std::string word = kFormats[format_].word;
  if (word == "film")
    plain(link_.state()["frames"] > 1 ? "all frames, as many a second as they are played" : "one turn in 6 s");
  if (word == "png" || word == "scene" || word == "film") picture_controls();
  if (word == "scene") {
    if (ImGui::Button(fmt::format("Open {}###open", path).c_str())) link_.send({{"command", "open"}, {"path", path}});
    tooltip("A scene of this molecule; undo brings back what is shown now");
  }
  if (ImGui::Button("Copy command")) link_.send(with_picture_options({{"command", "render_command"}}));
  tooltip("The command that makes this picture, into the clipboard");
  if (go && word == "scene")
    link_.send(with_picture_options({{"command", "save"}, {"path", path}, {"force", replace_}}));
  if (go && word != "scene") {
    const Json command{{"command", "export"}, {"format", word}, {"path", path}, {"force", replace_}, {"wait", false}};
    link_.send(word == "png" || word == "film" ? with_picture_options(command) : command);
  }
  progress();
}

/// Those that a scene came with are in the fields until someone types others.
void ExportPanel::take_options() {
  const Json& options = link_.state()["export"];
  if (options == options_) return;
  options_ = options;
  const auto number = [&](const char* key) { return options[key].is_number() ? options[key].get<int>() : 0; };
  width_ = number("width");
  height_ = number("height");
  samples_ = number("samples");
  transparent_ = options["transparent"];
}

void ExportPanel::picture_controls() {
  label("Pixels");
  int size[] = {width_, height_};
  if (ImGui::InputInt2("##size", size)) {
    width_ = size[0];
    height_ = size[1];
  }
  tooltip("Width and height; 0: as shown, or as the other side has it");
  label("Samples");
  ImGui::SliderInt("##samples", &samples_, 0, 64, samples_ > 0 ? "%d a pixel" : "as shown");
  ImGui::Checkbox("transparent", &transparent_);
}

void ExportPanel::progress() {
  if (!question_.running()) return;
  const Json& state = question_.state();
  const std::string stage = state.value("stage", "begin");
  ImGui::ProgressBar(static_cast<float>(state.value("share", 0.0)), {-5.0f * ImGui::GetFontSize(), 0.0f},
                     fmt::format("{}, {:.0f} s", stage, state.value("seconds", 0.0)).c_str());
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) link_.send({{"command", "cancel_export"}});
}

Json ExportPanel::with_picture_options(Json command) const {
  if (samples_ > 0) command["samples"] = samples_;
  command["transparent"] = transparent_;
  if (width_ <= 0 && height_ <= 0) return command;
  constexpr int kShortest = 16, kLongest = 16384;
  const double shape = link_.state()["height"].get<double>() / link_.state()["width"].get<double>();
  const int width = width_ > 0 ? width_ : static_cast<int>(std::lround(height_ / shape));
  const int height = height_ > 0 ? height_ : static_cast<int>(std::lround(width_ * shape));
  command["width"] = std::clamp(width, kShortest, kLongest);
  command["height"] = std::clamp(height, kShortest, kLongest);
  return command;
}

void ExportPanel::show_reply(const SessionReply& reply, double time) {
  const std::string word = command_word(reply.command);
  if (question_.take(reply, time) && question_.running()) return;
  if (word == "export_state" && !reply.reply.contains("path")) return;
  const bool failed = !reply.reply.value("ok", false) || reply.reply.contains("error");
  if (failed) line_ = sentence_of(reply.reply.value("error", "the command failed"), word);
  if (failed) line_is_fault_ = true;
  // What the window sends by itself clears nothing.
  if (failed || word == "end_step" || word == "resize" || word == "next_frame") return;
  if (std::exchange(line_is_fault_, false)) line_.clear();
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

}  // namespace meniscus
