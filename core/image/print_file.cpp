// SPDX-License-Identifier: BSD-3-Clause
// Writes TIFF files by libtiff, and JPEG files by TurboJPEG; their Exif data is a TIFF file without a picture.
#include "core/image/print_file.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>

#include <tiffio.h>
#include <turbojpeg.h>

#include "core/base/error.h"
#include "core/image/color_space.h"

namespace meniscus {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A TIFF file that libtiff writes into memory. Functions throw std::runtime_error with libtiff's message.
class TiffFile {
 public:
  TiffFile() {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, this);
    tiff_.reset(TIFFClientOpenExt("", "wl", this, read, write, seek, close, size, nullptr, nullptr, options.get()));
    require(tiff_ != nullptr);
  }

  /// Sets a tag to values of the types that the manual of TIFFSetField() names.
  template <class... Values>
  void set(std::uint32_t tag, Values... values) {
    require(TIFFSetField(tiff_.get(), tag, values...) == 1);
  }

  /// Sets a tag to a text, unless it is empty.
  void set_text(std::uint32_t tag, const std::string& text) {
    if (!text.empty()) set(tag, text.c_str());
  }

  /// Sets the resolution of a picture and the program that made it.
  void set_origin(const ImageToEncode& image) {
    if (image.dots_per_inch > 0.0) {
      set(TIFFTAG_XRESOLUTION, image.dots_per_inch);
      set(TIFFTAG_YRESOLUTION, image.dots_per_inch);
      set(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
    }
    set_text(TIFFTAG_SOFTWARE, image.software);
  }

  /// Adds rows of a picture. libtiff replaces their samples by differences.
  void add_strip(Bytes& samples, std::uint32_t strip) {
    constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max(), kRoomOfTags = 64 << 20;
    if (bytes_.size() > kLargest - kRoomOfTags) throw std::runtime_error("a TIFF file has at most 4 GiB");
    require(TIFFWriteEncodedStrip(tiff_.get(), strip, samples.data(), static_cast<tmsize_t>(samples.size())) >= 0);
  }

  /// Adds the tags, and returns the bytes of the file.
  std::span<const std::uint8_t> finish() {
    require(TIFFWriteDirectory(tiff_.get()) == 1);
    return bytes_;
  }

 private:
  // libtiff calls these functions; `file` and `data` point to this object.
  static int keep_error(TIFF*, void* data, const char*, const char* format, std::va_list values) {
    std::array<char, 256> text{};
    std::vsnprintf(text.data(), text.size(), format, values);
    static_cast<TiffFile*>(data)->error_ = text.data();
    return 1;
  }
  static tmsize_t read(thandle_t, void*, tmsize_t) { return 0; }
  static tmsize_t write(thandle_t file, void* data, tmsize_t count) try {
    auto& [bytes, place, error, tiff] = *static_cast<TiffFile*>(file);
    bytes.resize(std::max(bytes.size(), place + static_cast<std::size_t>(count)));
    std::memcpy(bytes.data() + place, data, static_cast<std::size_t>(count));
    place += static_cast<std::size_t>(count);
    return count;
  } catch (const std::bad_alloc&) {
    return -1;
  }
  static toff_t seek(thandle_t file, toff_t offset, int from) {
    auto& [bytes, place, error, tiff] = *static_cast<TiffFile*>(file);
    place = offset + (from == SEEK_SET ? 0 : from == SEEK_CUR ? place : bytes.size());
    return place;
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t file) { return static_cast<TiffFile*>(file)->bytes_.size(); }

  void require(bool is_good) const {
    if (!is_good) throw std::runtime_error(error_);
  }

  Bytes bytes_;
  std::size_t place_ = 0;
  std::string error_;
  // The last member is destroyed first: TIFFClose() may still write to the others.
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff_{nullptr, TIFFClose};
};

/// Encodes a TIFF file strip by strip.
class TiffRows final : public RowEncoder {
 public:
  explicit TiffRows(const ImageToEncode& image)
      : has_words_(image.sample == SampleType::uint16),
        height_(static_cast<std::uint32_t>(image.height)),
        row_size_(static_cast<std::size_t>(image.width) * image.channels.size()) {
    constexpr std::uint16_t kUnassociated = EXTRASAMPLE_UNASSALPHA;
    file_.set(TIFFTAG_IMAGEWIDTH, image.width);
    file_.set(TIFFTAG_IMAGELENGTH, image.height);
    file_.set(TIFFTAG_BITSPERSAMPLE, has_words_ ? 16 : 8);
    file_.set(TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(image.channels.size()));
    file_.set(TIFFTAG_ROWSPERSTRIP, kRowsOfAStrip);
    file_.set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    file_.set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    file_.set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    if (image.alpha_channel >= 0) file_.set(TIFFTAG_EXTRASAMPLES, 1, &kUnassociated);
    if (image.compression != "none") {
      file_.set(TIFFTAG_COMPRESSION, image.compression == "lzw" ? COMPRESSION_LZW : COMPRESSION_ADOBE_DEFLATE);
      file_.set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    }
    if (!image.color_profile.empty())
      file_.set(TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(image.color_profile.size()), image.color_profile.data());
    file_.set_origin(image);
    file_.set_text(TIFFTAG_IMAGEDESCRIPTION, image.command.empty() ? image.scene : image.command);
    file_.set_text(TIFFTAG_DATETIME, image.date);
  }

  void add(std::span<const float> rows) override {
    for (; !rows.empty(); rows = rows.subspan(row_size_)) {
      has_words_ ? add_row<std::uint16_t>(rows.first(row_size_)) : add_row<std::uint8_t>(rows.first(row_size_));
      if (++row_ % kRowsOfAStrip != 0 && row_ != height_) continue;
      file_.add_strip(strip_, (row_ - 1) / kRowsOfAStrip);
      strip_.clear();
    }
  }

  void finish(const std::function<void(std::span<const std::byte>)>& take) override {
    take(std::as_bytes(file_.finish()));
  }

 private:
  static constexpr std::uint32_t kRowsOfAStrip = 32;

  template <class Sample>
  void add_row(std::span<const float> row) {
    constexpr float kLargest = std::numeric_limits<Sample>::max();
    for (const float value : row) {
      const auto sample = static_cast<Sample>(std::clamp(value * kLargest, 0.0f, kLargest) + 0.5f);
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&sample);
      strip_.insert(strip_.end(), bytes, bytes + sizeof sample);
    }
  }

  bool has_words_;  // true if samples have 16 bits, false if they have 8
  std::uint32_t height_, row_ = 0;
  std::size_t row_size_;  // in samples
  Bytes strip_;
  TiffFile file_;
};

/// Appends a segment: its marker, its size, a text that names its content, and the content.
void add_segment(Bytes& file, std::uint8_t marker, std::string_view name, std::span<const std::uint8_t> content) {
  const std::size_t size = 2 + name.size() + content.size();
  if (size > 0xffff) throw std::runtime_error("a text of a JPEG file has at most 64 KiB");
  for (const std::size_t byte : {std::size_t{0xff}, std::size_t{marker}, size >> 8, size & 0xff})
    file.push_back(static_cast<std::uint8_t>(byte));
  file.insert(file.end(), name.begin(), name.end());
  file.insert(file.end(), content.begin(), content.end());
}

/// Keeps all rows until the end, because TurboJPEG takes whole pictures.
class JpegRows final : public RowEncoder {
 public:
  explicit JpegRows(const ImageToEncode& image) : image_(image) {
    constexpr int kLargest = 65500;
    if (std::max(image.width, image.height) > kLargest)
      throw std::runtime_error("a JPEG file has at most 65,500 pixels a side");
  }

  void add(std::span<const float> rows) override {
    for (const float value : rows) pixels_.push_back(display_byte(value));
  }

  void finish(const std::function<void(std::span<const std::byte>)>& take) override {
    using namespace std::string_view_literals;
    constexpr std::uint8_t kExif = 0xe1, kProfile = 0xe2, kComment = 0xfe;
    constexpr std::size_t kUnit = 13, kBegin = 20;  // the offset of JFIF's resolution, and the end of JFIF's segment
    const Bytes picture = encode_jpeg(pixels_, image_.width, image_.height, JpegUse::file);
    Bytes file(picture.begin(), picture.begin() + kBegin);
    if (image_.dots_per_inch > 0.0) {
      const auto density = static_cast<std::uint16_t>(std::min(std::lround(image_.dots_per_inch), 0xffffL));
      const auto high = static_cast<std::uint8_t>(density >> 8), low = static_cast<std::uint8_t>(density & 0xff);
      std::ranges::copy(std::array<std::uint8_t, 5>{1, high, low, high, low}, file.begin() + kUnit);
    }
    if (image_.dots_per_inch > 0.0 || !image_.software.empty()) {
      TiffFile exif;
      exif.set_origin(image_);
      add_segment(file, kExif, "Exif\0\0"sv, exif.finish());
    }
    if (!image_.color_profile.empty()) add_segment(file, kProfile, "ICC_PROFILE\0\1\1"sv, image_.color_profile);
    if (const std::string& text = image_.command.empty() ? image_.scene : image_.command; !text.empty())
      add_segment(file, kComment, text, {});
    take(std::as_bytes(std::span(file)));
    take(std::as_bytes(std::span(picture).subspan(kBegin)));
  }

 private:
  ImageToEncode image_;
  Bytes pixels_;
};

}  // namespace

std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t> pixels, int width, int height, JpegUse use) {
  struct Settings {
    int quality, colors, flags;  // quality: 0 to 100
  };
  constexpr std::array<Settings, 3> kSettings{
      {{80, TJSAMP_420, TJFLAG_FASTDCT}, {80, TJSAMP_444, 0}, {95, TJSAMP_444, TJFLAG_ACCURATEDCT}}};
  const Settings& settings = kSettings[static_cast<std::size_t>(use)];
  const bool has_fourth = pixels.size() > 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::unique_ptr<void, int (*)(void*)> compressor(tjInitCompress(), tjDestroy);
  if (!compressor) throw Error(std::string("JPEG: ") + tjGetErrorStr2(nullptr));
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  const int failed = tjCompress2(compressor.get(), pixels.data(), width, 0, height, has_fourth ? TJPF_RGBX : TJPF_RGB,
                                 &bytes, &count, settings.colors, settings.quality, settings.flags);
  Bytes result;
  if (!failed) result.assign(bytes, bytes + count);
  tjFree(bytes);
  if (failed) throw Error(std::string("JPEG: ") + tjGetErrorStr2(compressor.get()));
  return result;
}

std::unique_ptr<RowEncoder> begin_rows(const ImageToEncode& image) {
  if (image.format == "tiff") return std::make_unique<TiffRows>(image);
  if (image.format == "jpeg") return std::make_unique<JpegRows>(image);
  return image_codec().begin(image);
}

}  // namespace meniscus
