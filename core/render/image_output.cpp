// SPDX-License-Identifier: BSD-3-Clause
// Converts pictures to the pixels of each format and to the channels of EXR files, and writes them row by row.
#include "core/render/image_output.h"

#include <cctype>
#include <chrono>
#include <cstring>
#include <initializer_list>

#include <glm/mat3x3.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/image_codec.h"
#include "core/image/png_file.h"
#include "core/image/print_file.h"

namespace meniscus {
namespace {

float index_value(std::uint32_t index) { return index == kNone ? -1.0f : static_cast<float>(index); }

float* put(std::initializer_list<float> values, float* to) { return std::ranges::copy(values, to).out; }

float* put(const glm::vec3& v, float* to) { return put({v.x, v.y, v.z}, to); }

/// Returns a matrix in the order of OpenEXR, which multiplies row vectors: its rows are the columns of GLM's matrix.
std::array<float, 16> in_rows(const glm::dmat4& matrix) {
  std::array<float, 16> numbers{};
  for (int n = 0; n < 16; ++n) numbers[static_cast<std::size_t>(n)] = static_cast<float>(matrix[n / 4][n % 4]);
  return numbers;
}

}  // namespace

ExrChannels::ExrChannels(const PictureLayers& layers, const std::optional<glm::vec3>& background, ExrContent content)
    : layers_(layers), background_(background), content_(std::move(content)), names_{"R", "G", "B", "A"} {
  const auto add = [&](std::initializer_list<const char*> names) {
    names_.insert(names_.end(), names.begin(), names.end());
  };
  if (layers_.aovs) add({"Z", "N.x", "N.y", "N.z", "P.x", "P.y", "P.z", "atom", "kind", "component"});
  if (has_view()) add({"Nview.x", "Nview.y", "Nview.z", "Pview.x", "Pview.y", "Pview.z"});
  if (layers_.aovs && layers_.motion) add({"forward.u", "forward.v", "forward.a"});
  if (layers_.rays == 0 || !content_.mattes) return;
  for (const Matte& matte : *content_.mattes)
    for (std::string& name : matte_channels(matte)) names_.push_back(std::move(name));
}

std::vector<float> ExrChannels::values(const Framebuffer& picture, std::size_t first, std::size_t count) const {
  std::vector<float> values(count * names_.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 12), [&](const auto& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const std::size_t pixel = first + n;
      float* to = &values[n * names_.size()];
      const glm::vec4 color = over(picture.color[pixel], background_);
      to = put(from_rec709(glm::vec3(color), content_.primaries), to);
      *to++ = color.w;
      if (layers_.aovs) to = write_aovs(picture, pixel, to);
      if (layers_.rays > 0 && content_.mattes) to = write_mattes_of(picture, pixel, to);
    }
  });
  return values;
}

float* ExrChannels::write_aovs(const Framebuffer& picture, std::size_t pixel, float* to) const {
  *to++ = picture.z[pixel];
  to = put(picture.normal[pixel], to);
  to = put(picture.position[pixel], to);
  to = put({index_value(picture.atom[pixel]), index_value(picture.kind[pixel]), index_value(picture.component[pixel])},
           to);
  const bool is_hit = picture.kind[pixel] != kNone;
  if (has_view()) {
    const glm::dmat4& view = content_.view->to_camera;
    const glm::vec3 towards_viewer(1.0f, 1.0f, -1.0f), none(0.0f);
    to = put(glm::vec3(glm::dmat3(view) * glm::dvec3(picture.normal[pixel])) * towards_viewer, to);
    const glm::vec3 place(view * glm::dvec4(picture.position[pixel], 1.0));
    to = put(is_hit ? place * towards_viewer : none, to);
  }
  if (!layers_.motion) return to;
  // Blender reads no layers of two channels, so there is a third.
  return put({picture.motion[pixel].x, picture.motion[pixel].y, is_hit ? 1.0f : 0.0f}, to);
}

float* ExrChannels::write_mattes_of(const Framebuffer& picture, std::size_t pixel, float* to) const {
  const auto rays = static_cast<std::size_t>(layers_.rays);
  const auto seen = std::span(picture.seen).subspan(pixel * rays, rays);
  // Most pixels show nothing, and need no ranking.
  const bool is_empty = std::ranges::all_of(seen, [](std::uint32_t thing) { return thing == kNone; });
  if (is_empty) return to + content_.mattes->size() * kMatteChannels;
  std::vector<std::uint32_t> ids(rays);
  for (const Matte& matte : *content_.mattes) {
    std::ranges::transform(seen, ids.begin(),
                           [&](std::uint32_t thing) { return thing == kNone ? 0 : matte.id[thing]; });
    write_mattes(ids, to);
    to += kMatteChannels;
  }
  return to;
}

void ExrChannels::describe(ImageToEncode& image) const {
  image.chromaticities = chromaticities(content_.primaries);
  image.header = {{"colorInteropID", content_.primaries == Primaries::ap1 ? "lin_ap1_scene" : "lin_rec709_scene"}};
  if (content_.view)
    image.maps = {{"worldtocamera", in_rows(content_.view->to_camera)},
                  {"worldToNDC", in_rows(content_.view->to_file)}};
  if (layers_.rays == 0 || !content_.mattes) return;
  for (const Matte& matte : *content_.mattes)
    for (auto& line : matte_header(matte)) image.header.push_back(std::move(line));
}

namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = text_of_path(path.extension());
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Returns the date of SOURCE_DATE_EPOCH in UTC; empty if it is not set.
std::string date_of_pictures() {
  using namespace std::chrono;
  constexpr sys_days kFirst = year(1000) / 1 / 1, kBehind = year(10000) / 1 / 1;  // years of four digits
  const sys_seconds time{seconds(source_date())};
  if (time == sys_seconds() || time < kFirst || time >= kBehind) return {};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  return fmt::format("{}:{:02}:{:02} {:02}:{:02}:{:02}", int{date.year()}, unsigned{date.month()}, unsigned{date.day()},
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

bool is_jpeg(const std::string& extension) { return extension == ".jpg" || extension == ".jpeg"; }

/// Returns the name of a format, as OpenImageIO has it.
std::string format_of(const std::string& extension) {
  if (is_jpeg(extension)) return "jpeg";
  return extension == ".tif" ? "tiff" : extension.substr(1);
}

/// Some rows of a picture.
struct Rows {
  const Framebuffer& picture;
  std::size_t first, count;  // range of pixels

  std::span<const glm::vec4> color() const { return std::span(picture.color).subspan(first, count); }
};

Rows all_rows(const Framebuffer& picture) { return {picture, 0, picture.color.size()}; }

std::vector<std::string> display_names(const std::optional<glm::vec3>& background) {
  if (background) return {"R", "G", "B"};
  return {"R", "G", "B", "A"};
}

/// Calls work(pixels from, to) on all threads.
void for_pixels(std::size_t count, const auto& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 14),
                    [&](const auto& range) { work(range.begin(), range.end()); });
}

/// Returns pixels in sRGB with unassociated alpha, as in TIFF files.
std::vector<float> display_values(const Rows& rows, const std::optional<glm::vec3>& background, bool linear_alpha) {
  const bool for_layout = !background && !linear_alpha;
  const std::size_t channels = background ? 3 : 4;
  std::vector<float> values(rows.count * channels);
  for_pixels(rows.count, [&](std::size_t from, std::size_t to) {
    for (std::size_t n = from; n < to; ++n) {
      const glm::vec4& pixel = rows.color()[n];
      const glm::vec4 color = for_layout ? layout_color(pixel) : display_color(pixel, background);
      for (std::size_t channel = 0; channel < channels; ++channel)
        values[n * channels + channel] = color[static_cast<int>(channel)];
    }
  });
  return values;
}

/// Returns the same pixels with 8 bits per channel, as in PNG files.
std::vector<std::uint8_t> display_values_8(const Rows& rows, const std::optional<glm::vec3>& background,
                                           bool linear_alpha) {
  const std::size_t channels = background ? 3 : 4;
  std::vector<std::uint8_t> values(rows.count * channels);
  for_pixels(rows.count, [&](std::size_t from, std::size_t to) {
    const std::span<const glm::vec4> pixels = rows.color().subspan(from, to - from);
    if (background || linear_alpha)
      display_bytes(pixels, background, channels, &values[from * channels]);
    else
      layout_bytes(pixels, &values[from * channels]);
  });
  return values;
}

ImageToEncode described(glm::ivec2 size, const std::vector<std::string>& channels, const ImageSettings& settings,
                        const std::string& extension) {
  ImageToEncode image;
  image.format = format_of(extension);
  const bool exr = image.format == "exr", tiff = image.format == "tiff";
  image.width = size.x;
  image.height = size.y;
  image.channels = channels;
  image.sample = exr ? SampleType::float32 : tiff && settings.tiff.bits == 16 ? SampleType::uint16 : SampleType::uint8;
  image.alpha_channel = channels.size() > 3 ? 3 : -1;
  const auto z = std::ranges::find(channels, "Z");
  if (z != channels.end()) image.depth_channel = static_cast<int>(z - channels.begin());
  image.color_space = exr ? "Linear" : "sRGB";
  image.unassociated_alpha = !exr;
  if (tiff || is_jpeg(extension)) image.color_profile = srgb_profile();
  // The quality of WebP is chosen so that the loss is invisible and text stays sharp.
  constexpr std::array kOfTiff{"none", "lzw", "zip"};
  image.compression = extension == ".webp" ? "webp:95"
                      : tiff               ? kOfTiff[static_cast<std::size_t>(settings.tiff.compression)]
                                           : "zip";
  if (settings.names_program) image.software = "Meniscus " MENISCUS_VERSION;
  if (exr || tiff) image.date = date_of_pictures();
  image.command = settings.command;
  image.scene = settings.scene;
  image.made_of = settings.made_of;
  image.dots_per_inch = settings.dots_per_inch;
  return image;
}

}  // namespace

/// The file of an ImageWriter. Encoders write to memory only.
class ImageWriter::File {
 public:
  File(const std::filesystem::path& path, glm::ivec2 size, const PictureLayers& layers, ImageSettings settings)
      : path_(path),
        extension_(extension_of(path)),
        width_(static_cast<std::size_t>(size.x)),
        settings_(std::move(settings)),
        exr_(layers, settings_.background, settings_.exr),
        output_(path, settings_.existing) {
    // JPEG has no transparency, so the background is white.
    if (is_jpeg(extension_) && !settings_.background) settings_.background = glm::vec3(1.0f);
    ImageToEncode image = described(size, extension_ == ".exr" ? exr_.names() : display_names(settings_.background),
                                    settings_, extension_);
    if (extension_ == ".exr") exr_.describe(image);
    if (extension_ == ".png") {
      png_.emplace(image, [this](std::span<const std::uint8_t> bytes) { output_.write(std::as_bytes(bytes)); });
      return;
    }
    encoding([&] { rows_ = begin_rows(image); });
  }

  void add(const Framebuffer& picture) {
    constexpr std::size_t kTogether = 128;  // whole strips of TIFF files and parts of EXR files
    for (std::size_t first = 0; first < picture.color.size(); first += kTogether * width_)
      add(Rows{picture, first, std::min(kTogether * width_, picture.color.size() - first)});
  }

  void commit() {
    if (png_) {
      png_->finish();
    } else {
      encoding([&] { rows_->finish([&](std::span<const std::byte> bytes) { output_.write(bytes); }); });
    }
    output_.commit();
  }

 private:
  void add(const Rows& rows) {
    if (png_) {
      const std::vector<std::uint8_t> values = display_values_8(rows, settings_.background, settings_.linear_alpha);
      return png_->add(values, settings_.background ? 3 : 4);
    }
    const std::vector<float> values = extension_ == ".exr"
                                          ? exr_.values(rows.picture, rows.first, rows.count)
                                          : display_values(rows, settings_.background, settings_.linear_alpha);
    encoding([&] { rows_->add(values); });
  }

  void encoding(const auto& step) {
    try {
      step();
    } catch (const Error&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw OutputError(text_of_path(path_), std::string("cannot be encoded: ") + error.what());
    }
  }

  std::filesystem::path path_;
  std::string extension_;
  std::size_t width_;
  ImageSettings settings_;
  ExrChannels exr_;
  OutputFile output_;
  std::optional<PngEncoder> png_;
  std::unique_ptr<RowEncoder> rows_;
};

bool holds_aovs(const std::filesystem::path& path) { return extension_of(path) == ".exr"; }

bool is_encoded_in_memory(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 3> kStreamed{".png", ".svg", ".pdf"};
  return std::ranges::find(kStreamed, extension_of(path)) == kStreamed.end();
}

std::vector<std::uint8_t> srgb_pixels(const Framebuffer& picture, const std::optional<glm::vec3>& background,
                                      int bytes) {
  if (bytes == 1) return display_values_8(all_rows(picture), background, false);
  const std::vector<float> values = display_values(all_rows(picture), background, false);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(2 * values.size());
  for (const float value : values) {
    const auto word = static_cast<std::uint16_t>(std::clamp(value, 0.0f, 1.0f) * 65535.0f + 0.5f);
    pixels.push_back(static_cast<std::uint8_t>(word & 0xff));
    pixels.push_back(static_cast<std::uint8_t>(word >> 8));
  }
  return pixels;
}

void check_image_path(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 2> kByOpenImageIO{".webp", ".exr"};
  constexpr std::array<std::string_view, 7> kOwn{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".svg", ".pdf"};
  const std::string extension = extension_of(path);
  if (std::ranges::find(kOwn, extension) != kOwn.end()) return;
  if (std::ranges::find(kByOpenImageIO, extension) == kByOpenImageIO.end())
    throw OutputError(text_of_path(path),
                      "a picture's name must end in .png, .jpg, .webp, .tif, .tiff, .exr, .svg or .pdf");
  image_codec();  // a missing library is reported before anything is computed
}

ImageWriter::ImageWriter(const std::filesystem::path& path, glm::ivec2 size, const PictureLayers& layers,
                         const ImageSettings& settings) {
  check_image_path(path);
  file_ = std::make_unique<File>(path, size, layers, settings);
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::add(const Framebuffer& rows) { file_->add(rows); }

void ImageWriter::commit() { file_->commit(); }

void write_image(const std::filesystem::path& path, const Framebuffer& picture, const ImageSettings& settings) {
  ImageWriter writer(path, picture.size, layers_of(picture), settings);
  writer.add(picture);
  writer.commit();
}

}  // namespace meniscus
