// SPDX-License-Identifier: BSD-3-Clause
// Draws pictures into files, or for a film, with their legend and annotations, and compares the notes of existing
// pictures with the run that is to be resumed.
#include "app/commands/picture_sink.h"

#include <fmt/ranges.h>

#include "app/farm/bundle_folder.h"
#include "app/reports/notes.h"
#include "core/base/version.h"
#include "core/image/png_file.h"
#include "core/render/picture_file.h"
#include "core/scene/scene_value.h"

namespace meniscus {
namespace {

/// Reports the progress of a picture that takes long on the CPU; GL makes it in a fraction of the time.
class PictureProgress {
 public:
  PictureProgress(const RenderCommand& command, RenderSettings& settings) {
    const double rays = static_cast<double>(settings.samples) * settings.size.x * settings.size.y;
    if (command.reporting.quiet || rays < kManyRays) return;
    progress_.emplace(progress_on_stderr(command), "picture", kParts);
    settings.progress = [this](double share) { advance_to(static_cast<std::uint64_t>(share * kParts)); };
  }
  void end() {
    if (progress_) advance_to(kParts);
  }

 private:
  void advance_to(std::uint64_t parts) {
    if (parts <= advanced_) return;
    progress_->advance(parts - advanced_);
    advanced_ = parts;
  }

  static constexpr double kManyRays = 5e7;  // a few seconds
  static constexpr std::uint64_t kParts = 100;
  std::optional<Progress> progress_;
  std::uint64_t advanced_ = 0;
};

std::optional<Curve> curve_of_run(const Scene& scene, const FrameRun& run) {
  std::vector<std::uint64_t> numbers = run.numbers();
  for (std::uint64_t& number : numbers) number = run.source(number);
  return curve_of(scene.annotations, numbers);
}

/// Warns of small letters in pictures with a size on paper.
void warn_of_small_letters(const RenderCommand& command, const PictureLayout& layout) {
  constexpr double kPointsPerInch = 72.0, kLeast = 5.0;  // the limit of most journals
  const Scene& scene = command.scene;
  if (!scene_values::has_lengths_of_sides(scene) || scene.picture.dots_per_inch <= 0.0) return;
  const glm::ivec2 size = layout.size.size() + glm::ivec2(0, layout.strips.top + layout.strips.bottom);
  const LetterHeights heights(scene.annotations.letters, size);
  const AnnotationRequest& requested = scene.annotations;
  double least = kLeast;
  std::vector<std::string> small;
  const auto check_height = [&](bool is_there, const char* what, int pixels) {
    const double points = pixels * kPointsPerInch / scene.picture.dots_per_inch;
    if (!is_there || points >= kLeast - 0.05) return;
    least = std::min(least, points);
    small.emplace_back(what);
  };
  if (layout.legend) check_height(true, "the legend", layout.legend->font().height());
  check_height(!requested.labels.empty(), "labels", heights.labels);
  check_height(requested.scale_bar, "the scale bar", heights.scale_bar);
  check_height(!requested.panel.empty(), "the panel", heights.panel);
  check_height(requested.time_stamp && scene.frames.is_requested(), "the time", heights.usual);
  if (small.empty()) return;
  log_line(command,
           fmt::format("warning: letters of {} are as small as {:.1f} pt on paper; most journals ask for {:g} pt; add "
                       "--letter-size 6pt",
                       fmt::join(small, ", "), least, kLeast));
}

}  // namespace

FrameAnnotations::FrameAnnotations(const Scene& scene, FrameRun* run)
    : request_(scene.annotations), is_run_(run != nullptr) {
  if (!run) return;
  curve_ = curve_of_run(scene, *run);
  last_ = run->source(run->numbers().back());
  if (request_.time_stamp) longest_ = run->last_time().value_or(0.0);
}

Annotations FrameAnnotations::of(const SinkPicture& picture, const Structure& structure,
                                 std::span<const PlaceLabel> lengths) const {
  Annotations annotations = annotations_of(request_, structure, lengths);
  if (!is_run_) return annotations;
  annotations.labels_must_fit = false;  // a frame without room for its labels must not fail
  if (request_.time_stamp) annotations.time = time_text(picture.time, picture.source, longest_);
  annotations.curve = curve_;
  if (curve_) annotations.curve->now = picture.place;
  return annotations;
}

void FrameAnnotations::check(const PictureLayout& layout, std::span<const Camera> cameras,
                             const Structure& structure) const {
  const glm::ivec2 size = layout.size.size() + glm::ivec2(0, layout.strips.top + layout.strips.bottom);
  const auto scale = [&](const Camera& camera) { return angstroms_per_pixel(camera, size); };
  const auto [nearest, farthest] = std::ranges::minmax_element(cameras, {}, scale);
  std::optional<double> time;
  if (longest_ > 0.0) time = longest_;
  try {
    for (const Camera& camera : {*nearest, *farthest})
      AnnotationLayer(of({0, 0, last_, time, camera}, structure), camera, size, std::nullopt, layout.strips);
  } catch (const InputError&) {
    if (!is_run_) throw;
  }
}

std::optional<NumberedPath> numbered_output(const std::string& path, const FilmFormat& format, glm::ivec2 size) {
  if (is_film_path(path)) {
    check_film_size(film_encoder(path, format), size);
    return {};
  }
  std::optional<NumberedPath> numbered = NumberedPath::parse(path);
  if (!numbered)
    throw UsageError(
        "-o {}: every picture would replace the one before; put # where its number goes, as in {}, or name a "
        "film (.mp4, .mov, .mkv, .webm, .gif)",
        in_quotes(path), in_quotes(numbered_name(path)));
  check_image_path(path);
  return numbered;
}

void check_pictures(const NumberedPath& path, std::span<const std::uint64_t> numbers, Existing existing) {
  const auto is_there = [&](std::uint64_t number) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(path.at(number), ignored));
  };
  // The folder of the first path is checked, too.
  check_output(path.at(numbers.front()), existing);
  if (existing == Existing::replace) return;
  const auto there = std::ranges::find_if(numbers, is_there);
  if (there != numbers.end()) check_output(path.at(*there), existing);
}

std::optional<glm::vec3> ground_of_film(const std::optional<glm::vec3>& background, const FilmPixels& pixels) {
  if (background || pixels.channels == 4) return background;
  return glm::vec3(1.0f);
}

PictureSink::PictureSink(const RenderCommand& command, const PictureLayout& layout, FrameRun* run)
    : command_(command), layout_(layout), run_(run), annotations_(command.scene, run) {
  warn_of_small_letters(command, layout);
  if (run) name_files();
}

void PictureSink::name_files() {
  const Scene& scene = command_.scene;
  numbered_ = numbered_output(scene.output, scene.film, scene.picture.size());
  if (numbered_) return check_pictures(*numbered_, run_->chunk(), command_.existing());
  film_ = std::make_unique<FilmWriter>(scene.output, command_.existing(), scene.picture.size(),
                                       scene.film.frames_per_second, scene.film);
}

FinishFrame PictureSink::keep(const SinkPicture& picture, const Annotations& annotations, const Draw& draw) {
  return film_ ? to_film(picture, annotations, draw) : to_file(picture, annotations, draw);
}

FinishFrame PictureSink::to_file(const SinkPicture& picture, const Annotations& annotations, const Draw& draw) {
  RenderSettings settings = picture_settings(command_, layout_);
  std::optional<PictureProgress> progress;
  if (!run_) progress.emplace(command_, settings);
  settings.motion = picture.moves;
  ImageSettings image = image_settings(command_);
  image.exr.mattes = picture.mattes;
  const std::string path = numbered_ ? numbered_->at(picture.number) : command_.scene.output;
  PictureFile file(path, {annotations, layout_.legend, layout_.strips}, picture.camera, image, settings);
  if (run_ && layout_.legend)
    settings.take_band = [this, take = settings.take_band](Framebuffer band, int first_row) {
      const std::lock_guard lock(legend_);
      take(std::move(band), first_row);
    };
  draw(settings);
  if (progress) progress->end();
  file.commit();
  return [path, shows_nothing = !file.shows_something(), lacks_labels = file.lacks_labels()] {
    return MadeFrame{{path}, shows_nothing, lacks_labels};
  };
}

FinishFrame PictureSink::to_film(const SinkPicture& picture, const Annotations& annotations, const Draw& draw) {
  Framebuffer drawn = draw(picture_settings(command_, layout_));
  const bool shows_nothing = std::ranges::none_of(drawn.color, [](const glm::vec4& pixel) { return pixel.w > 0.0f; });
  bool lacks_labels = false;
  {
    std::unique_lock lock(legend_, std::defer_lock);
    if (layout_.legend) lock.lock();
    drawn = finished_picture(std::move(drawn), annotations, layout_, picture.camera, command_.scene.image.background,
                             &lacks_labels);
  }
  const FilmPixels& format = film_->pixels();
  auto pixels = std::make_shared<const std::vector<std::uint8_t>>(
      srgb_pixels(drawn, ground_of_film(command_.scene.image.background, format), format.bytes));
  return [this, pixels, shows_nothing, lacks_labels] {
    film_->add(*pixels);
    return MadeFrame{{}, shows_nothing, lacks_labels};
  };
}

void PictureSink::finish() {
  if (film_) film_->finish();
}

std::string made_of(const Scene& scene) {
  std::string text = fmt::format("{}\n{}\n", MENISCUS_VERSION, scene_text(scene, ""));
  for (const Property* property : properties()) {
    const bool is_file = property->type == ValueType::file || property->type == ValueType::camera;
    if (!is_file || !is_scene_value(*property)) continue;
    for (const std::string& path : value_texts(scene, *property)) {
      std::error_code error;
      const std::uintmax_t size = std::filesystem::file_size(path, error);
      if (error) continue;  // the JSON of a camera is not a path
      const auto time = std::filesystem::last_write_time(path, error).time_since_epoch().count();
      text += fmt::format("{} {} {}\n", property->key, size, time);
    }
  }
  return farm::sha256(text);
}

std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing) {
  for (const std::string& path : paths)
    if (std::filesystem::path(path).extension() != ".png")
      throw UsageError("--resume: only .png pictures record how they were made; use names such as frame_#####.png");
  const std::vector<std::size_t> not_there = farm::missing_files(paths);
  const std::set<std::size_t> absent(not_there.begin(), not_there.end());
  std::vector<std::size_t> missing, others;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const bool is_absent = absent.contains(n);  // true also for incomplete pictures
    const bool is_other = is_absent ? std::filesystem::exists(paths[n]) : png_note(paths[n], kMadeOfNote) != made_of;
    if (is_other) others.push_back(n);
    if (is_other || is_absent) missing.push_back(n);
  }
  if (!others.empty() && existing == Existing::refuse)
    throw UsageError(
        "--resume: {}{} made of another scene, of other files, by another version, without --resume, or cut short; "
        "choose another name, or add --force to replace {}",
        escaped(paths[others.front()]),
        others.size() == 1 ? " was" : fmt::format(" and {} more were", with_thousands(others.size() - 1)),
        others.size() == 1 ? "it" : "them");
  return missing;
}

}  // namespace meniscus
