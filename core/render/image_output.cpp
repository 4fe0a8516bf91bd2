// SPDX-License-Identifier: BSD-3-Clause
// Pictures encoded in memory.
#include "core/render/image_output.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/image_codec.h"
#include "core/image/png_encoder.h"
#include "core/image/display_color.h"
#include "core/image/memory_file.h"
#include "core/image/srgb_profile.h"

namespace meniscus {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// EXR and TIFF always have a date. So that the same command gives the same bytes it is that of SOURCE_DATE_EPOCH
/// (reproducible-builds.org), in UTC, or else the first second of 1970.
std::string date_of_pictures() {
  std::int64_t seconds = 0;
  if (const char* const text = std::getenv("SOURCE_DATE_EPOCH")) {
    const std::string_view digits(text);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
    if (error != std::errc() || end != digits.data() + digits.size()) seconds = 0;
  }
  const std::time_t time = seconds;
  std::tm parts{};
  std::array<char, 32> date{};
  if (!::gmtime_r(&time, &parts) || std::strftime(date.data(), date.size(), "%Y:%m:%d %H:%M:%S", &parts) != 19)
    return "1970:01:01 00:00:00";
  return date.data();
}

bool is_jpeg(const std::string& extension) { return extension == ".jpg" || extension == ".jpeg"; }

/// What OpenImageIO calls it.
std::string format_of(const std::string& extension) {
  if (is_jpeg(extension)) return "jpeg";
  return extension == ".tif" ? "tiff" : extension.substr(1);
}

/// A picture's channels, pixel after pixel: floats, or bytes for PNG.
struct Channels {
  std::vector<std::string> names;
  std::vector<float> values;
  std::vector<std::uint8_t> bytes;
  int alpha = -1;
};

Channels display_names(const std::optional<glm::vec3>& background) {
  Channels channels;
  channels.names = {"R", "G", "B"};
  if (background) return channels;
  channels.names.push_back("A");
  channels.alpha = 3;
  return channels;
}

/// sRGB, alpha not multiplied in, as TIFF has it.
Channels display_channels(const Framebuffer& picture, const ImageSettings& settings) {
  const std::optional<glm::vec3>& background = settings.background;
  const bool for_layout = !background && !settings.linear_alpha;
  Channels channels = display_names(background);
  channels.values.reserve(picture.color.size() * channels.names.size());
  for (const glm::vec4& pixel : picture.color) {
    const glm::vec4 c = for_layout ? layout_color(pixel) : display_color(pixel, background);
    channels.values.insert(channels.values.end(), {c.x, c.y, c.z});
    if (!background) channels.values.push_back(c.w);
  }
  return channels;
}

/// The same in 8 bits, as PNG has it.
Channels byte_channels(const Framebuffer& picture, const std::optional<glm::vec3>& background,
                       bool linear_alpha = true) {
  Channels channels = display_names(background);
  const std::size_t count = channels.names.size();
  channels.bytes.resize(picture.color.size() * count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture.color.size(), 1 << 14), [&](const auto& range) {
    std::uint8_t* const bytes = &channels.bytes[range.begin() * count];
    if (background || linear_alpha)
      display_bytes(std::span(picture.color).subspan(range.begin(), range.size()), background, count, bytes);
    else
      layout_bytes(std::span(picture.color).subspan(range.begin(), range.size()), bytes);
  });
  return channels;
}

float index_value(std::uint32_t index) { return index == kNone ? -1.0f : static_cast<float>(index); }

/// Linear light and everything else there is.
Channels scene_channels(const Framebuffer& picture, const ImageSettings& settings) {
  Channels channels;
  channels.names = {"R", "G", "B", "A"};
  channels.alpha = 3;
  const bool aovs = !picture.z.empty();
  if (aovs)
    for (const char* name : {"Z", "N.x", "N.y", "N.z", "P.x", "P.y", "P.z", "atom", "kind", "component"})
      channels.names.emplace_back(name);
  auto& values = channels.values;
  values.reserve(picture.color.size() * channels.names.size());
  for (std::size_t i = 0; i < picture.color.size(); ++i) {
    const glm::vec4 c = over(picture.color[i], settings.background);
    values.insert(values.end(), {c.x, c.y, c.z, c.w});
    if (!aovs) continue;
    const glm::vec3& n = picture.normal[i];
    const glm::vec3& p = picture.position[i];
    values.insert(values.end(), {picture.z[i], n.x, n.y, n.z, p.x, p.y, p.z, index_value(picture.atom[i]),
                                 index_value(picture.kind[i]), index_value(picture.component[i])});
  }
  return channels;
}

ImageToEncode described(const Framebuffer& picture, const Channels& channels, const ImageSettings& settings,
                        const std::string& extension) {
  ImageToEncode image;
  image.format = format_of(extension);
  const bool exr = image.format == "exr", tiff = image.format == "tiff";
  image.width = picture.size.x;
  image.height = picture.size.y;
  image.channels = channels.names;
  image.sample = exr ? SampleType::float32 : tiff ? SampleType::uint16 : SampleType::uint8;
  image.alpha_channel = channels.alpha;
  const auto z = std::ranges::find(channels.names, "Z");
  if (z != channels.names.end()) image.depth_channel = static_cast<int>(z - channels.names.begin());
  image.color_space = exr ? "Linear" : "sRGB";
  image.unassociated_alpha = !exr;
  if (tiff || is_jpeg(extension)) image.color_profile = srgb_profile();
  // Of JPEG and WebP the quality: nobody sees the loss, and text stays sharp.
  image.compression = is_jpeg(extension) ? "jpeg:95" : extension == ".webp" ? "webp:95" : "zip";
  if (settings.names_program) image.software = "Meniscus " MENISCUS_VERSION;
  if (exr || tiff) image.date = date_of_pictures();
  image.command = settings.command;
  image.scene = settings.scene;
  image.dots_per_inch = settings.dots_per_inch;
  image.floats = channels.values;
  image.bytes = channels.bytes;
  image.byte_stride = static_cast<int>(channels.names.size());
  return image;
}

std::vector<std::uint8_t> encode(const std::filesystem::path& path, const ImageToEncode& image) {
  if (image.format == "png") return encode_png(image);
  try {
    return image_codec().encode(image);
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw OutputError(path.string(), std::string("cannot be encoded: ") + error.what());
  }
}

/// A TIFF file that meets a limit on the size of files lacks what libtiff writes last, and libtiff does not tell. So it
/// is refused where it might meet one: where the limit is below what the pixels take if they cannot be compressed.
void refuse_limited_size(const std::filesystem::path& path, const ImageToEncode& image) {
  constexpr rlim_t kDirectories = 1 << 16, kOfALine = 32;
  const rlim_t pixels = pixel_bytes(image), lines = static_cast<rlim_t>(image.height);
  const rlim_t largest = pixels + pixels / 1000 + kOfALine * lines + kDirectories;
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= largest) return;
  throw OutputError(path.string(), fmt::format("may have up to {} bytes, and the system allows files of {} (ulimit -f)",
                                               with_thousands(largest), with_thousands(limit.rlim_cur)));
}

/// By name: through a proxy OpenImageIO 2.4 cannot read back what it wrote, and the file would lack its last directory.
std::vector<std::uint8_t> encoded_tiff(const std::filesystem::path& path, ImageToEncode image) {
  refuse_limited_size(path, image);
  const MemoryFile file;
  image.file = file.name();
  encode(path, image);
  return file.bytes();
}

/// The bytes of the file. OpenImageIO never writes to the disk itself, for its PNG writer overlooks writes that fail.
std::vector<std::uint8_t> encoded(const std::filesystem::path& path, const Framebuffer& picture,
                                  const ImageSettings& settings) {
  const std::string extension = extension_of(path);
  // JPEG knows no transparency.
  ImageSettings shown = settings;
  if (is_jpeg(extension) && !shown.background) shown.background = glm::vec3(1.0f);
  const Channels channels = extension == ".exr"   ? scene_channels(picture, shown)
                            : extension == ".png" ? byte_channels(picture, shown.background, shown.linear_alpha)
                                                  : display_channels(picture, shown);
  const ImageToEncode image = described(picture, channels, settings, extension);
  return image.format == "tiff" ? encoded_tiff(path, image) : encode(path, image);
}

}  // namespace

bool holds_aovs(const std::filesystem::path& path) { return extension_of(path) == ".exr"; }

std::vector<std::uint8_t> srgb_pixels(const Framebuffer& picture, const std::optional<glm::vec3>& background,
                                      int bytes) {
  if (bytes == 1) return byte_channels(picture, background, false).bytes;
  const Channels channels = display_channels(picture, {.background = background, .linear_alpha = false});
  std::vector<std::uint8_t> pixels;
  pixels.reserve(2 * channels.values.size());
  for (const float value : channels.values) {
    const auto word = static_cast<std::uint16_t>(std::clamp(value, 0.0f, 1.0f) * 65535.0f + 0.5f);
    pixels.push_back(static_cast<std::uint8_t>(word & 0xff));
    pixels.push_back(static_cast<std::uint8_t>(word >> 8));
  }
  return pixels;
}

void check_image_path(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 7> kExtensions{".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".exr"};
  if (std::ranges::find(kExtensions, extension_of(path)) == kExtensions.end())
    throw OutputError(path.string(), "a picture's name must end in .png, .jpg, .webp, .tif, .tiff or .exr");
  if (extension_of(path) != ".png") image_codec();  // what is missing is missed before anything is computed
}

void write_image(const std::filesystem::path& path, const Framebuffer& picture, const ImageSettings& settings) {
  check_image_path(path);
  OutputFile file(path, settings.existing);
  const std::vector<std::uint8_t> bytes = encoded(path, picture, settings);
  file.write(std::as_bytes(std::span(bytes)));
  file.commit();
}

}  // namespace meniscus
