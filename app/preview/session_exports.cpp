// SPDX-License-Identifier: BSD-3-Clause
// The commands that write: pictures and other exports, scenes, and the command that makes the same picture.
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/preview/command_values.h"
#include "app/preview/export_job.h"
#include "app/options/scene_words.h"
#include "app/preview/session.h"
#include "app/preview/view_export.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_scale.h"
#include "core/render/image_output.h"
#include "core/scene/scene_json.h"
#include "core/scene/surface_objects.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr int kLongestExportedSide = 16384;  // pixels

/// What is asked of an exported picture beside the view.
struct PictureWishes {
  glm::ivec2 size;
  int samples;
  bool transparent;
};

PictureWishes wishes_of(const CommandReader& command, const PreviewView& view) {
  const glm::ivec2 size = view.wishes.size.value_or(view.size);
  return {{command.integer_or(size.x, "width", 16, kLongestExportedSide),
           command.integer_or(size.y, "height", 16, kLongestExportedSide)},
          command.integer_or(view.wishes.samples.value_or(view.samples), "samples", 1, 1024),
          command.flag_or(view.wishes.transparent, "transparent")};
}

/// Throws RequestError for a name that is none, OutputError for a file that is there and may not be replaced.
ExportTarget target_of(const CommandReader& command, const std::filesystem::path& folder) {
  ExportTarget target{export_path(folder, command.text("path")),
                      command.flag_or(false, "force") ? Existing::replace : Existing::refuse};
  if (target.existing == Existing::refuse && std::filesystem::exists(target.path))
    throw RequestError(target.path.string() + " exists already; let it be replaced, or give another name");
  return target;
}

}  // namespace

Json PreviewSession::export_view(const CommandReader& command) {
  const std::size_t format = command.choice("format", {"png", "povray", "blender", "camera", "camera_path"});
  constexpr std::string_view kEndings[] = {"", "", ".mns", ".json", ".json"};
  const std::string name = command.text("path");
  // A scene is a folder; so no file of another kind is replaced.
  if (format == 1 ? name.find('.') != std::string::npos : !name.ends_with(kEndings[format]))
    throw RequestError(fmt::format("export: \"path\" is {}; {}", in_quotes(name),
                                   format == 1 ? "a scene is a folder, whose name has no dot"
                                               : fmt::format("its name must end in {}", kEndings[format])));
  const bool waits = command.flag_or(true, "wait");
  if (export_ && export_->running())
    throw RequestError("export: " + export_->told()["path"].get<std::string>() +
                       " is being written; wait for it, or cancel it");
  const ExportTarget target = target_of(command, export_folder_);
  const PictureWishes wishes = wishes_of(command, view_);
  if (format == 0) check_image_path(target.path);
  if (format == 3 || format == 4) {
    format == 3 ? export_camera(view_.camera, target) : export_camera_path(camera_keys(), target);
    return {{"path", target.path.string()}};
  }
  Annotations annotations;
  if (context_.annotations) annotations = context_.annotations(marked_ ? *marked_ : frame_structure());
  auto view = std::make_shared<const ExportedView>(
      ExportedView{structure_, shown_atoms(), balls_, frame_coloring(), view_.told_scheme(), view_, beside_,
                   std::move(annotations), wishes.size, wishes.samples, wishes.transparent,
                   format == 0 ? scene_of(command) : "", view_.wishes.dots_per_inch});
  const auto work = [view, target, format, make_device = context_.make_device](const ExportWatch& watch) {
    Json reply{{"path", target.path.string()}};
    if (format == 2 && !view->figure.figure.plain())
      reply["note"] = "without cuts and what stands beside the surface; meniscus export has options for these";
    if (format == 0) export_picture(*view, make_device, target, watch);
    if (format == 1) reply["render_with"] = export_povray(*view, target, watch);
    if (format == 2) export_blender(*view, target, watch);
    return reply;
  };
  export_.reset();  // the one before, which is done
  export_ = std::make_unique<ExportJob>(target.path.string(), work);
  return waits ? export_->result() : Json{{"path", target.path.string()}, {"running", true}};
}

Json PreviewSession::export_state(const CommandReader&) { return export_ ? export_->told() : Json{{"running", false}}; }

Json PreviewSession::cancel_export(const CommandReader&) {
  if (!export_ || !export_->running()) throw RequestError("cancel_export: nothing is being written");
  export_->cancel();
  return Json::object();
}

std::string PreviewSession::scene_of(const CommandReader& command) const {
  if (!context_.scene || trajectory_) return {};  // frames of a run carry none
  try {
    return scene_text(shown_scene(command), "");
  } catch (const RequestError&) {
    return {};  // render cannot make this view
  }
}

Scene PreviewSession::shown_scene(const CommandReader& command) const {
  const PictureWishes wishes = wishes_of(command, view_);
  RenderedView view{view_, wishes.size, wishes.samples, wishes.transparent, {}, {}, {}, view_.wishes.dots_per_inch};
  if (trajectory_) view.frame = number_of(view_.frame);
  if (frames_.size() > 1) {
    using By = ColorScheme::By;
    if (!view_.patch_kinds && (view_.color.by == By::index || view_.color.by == By::radial))
      throw RequestError(
          fmt::format("{}: {} counts the atoms of all models here, and those of one in a picture by "
                      "render; choose another scheme",
                      command.word(), in_quotes(scheme_word(view_.color))));
    view.model = structure_.atoms[shown_atoms().front()].model;
    // A model alone would have a scale of its own.
    if (view_.color.has_scale()) view.range = color_scale(structure_, view_.color).range;
  }
  return rendered_scene(context_.scene.value_or(Scene{}), view);
}

Json PreviewSession::render_command(const CommandReader& command) {
  const std::vector<std::string> words = render_words(shown_scene(command));
  return {{"words", words}, {"text", shell_line(words)}};
}

Json PreviewSession::save_scene(const CommandReader& command) {
  if (!context_.scene) throw RequestError("save: this preview writes no scenes");
  if (!command.text("path").ends_with(".json"))
    throw RequestError(
        fmt::format("save: \"path\" is {}; a scene's name must end in .json", in_quotes(command.text("path"))));
  const ExportTarget target = target_of(command, export_folder_);
  OutputFile file(target.path, target.existing);
  file.write(scene_text(shown_scene(command), target.path.parent_path().string()));
  file.commit();
  return {{"path", target.path.string()}};
}

Json PreviewSession::open_scene(const CommandReader& command) {
  if (!context_.open_scene) throw RequestError("open: this preview reads no scenes");
  const std::string name = command.text("path");
  if (!name.ends_with(".json") && !name.ends_with(".png"))
    throw RequestError(
        fmt::format("open: \"path\" is {}; a scene ends in .json, a picture that holds one in .png", in_quotes(name)));
  OpenedScene opened = context_.open_scene(export_path(export_folder_, name));
  ColorScheme& color = opened.figure.color;
  if (color.by == ColorScheme::By::rmsf && color.by == first_color_.by) color.file = first_color_.file;
  require_previewed(color);
  require_apart_in(opened.figure);
  const std::size_t frame = frames_.size() > 1 ? static_cast<std::size_t>(opened.frame) : view_.frame;
  if (frame >= frame_count()) throw RequestError(fmt::format("open: {} is of a model that is not there", name));
  const std::size_t before = view_.frame;
  if (frame != before) show_frame(frame);
  try {
    become(opened.figure, Changed::shapes);
  } catch (...) {
    if (frame != before) show_frame(before);
    throw;
  }
  view_.wishes = opened.wishes;
  return {{"path", (export_folder_ / name).string()}};
}

}  // namespace meniscus
